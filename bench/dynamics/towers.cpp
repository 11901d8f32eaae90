// Towers of cylinders.
#include <algorithm>
#include <random>
#include <span>

#include "dynamics/scenes.h"
#include "shapes/sheets.h"

namespace octoblisk::bench {
namespace {

/// Each tower has its own floor, far from the others, so that the cylinders of one that falls hit no other.
class Towers final : public DynamicsScene {
 public:
  Towers(ShapeKind kind, int cylinders) : DynamicsScene(kind) {
    const Solid& floor = keep(shapes::solidBelow(*shapes::waveSheet(4.0, 0.0, 24), -4.0));
    btCollisionShape& floor_shape = concave(floor, false);
    const Solid& solid = keepMoving(shapes::cylinder(kRadius, kHalfHeight, 64));
    auto& shape = keepShape<btCylinderShapeZ>(toBullet(Vec3(kRadius, kRadius, kHalfHeight)));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> offset(-1e-3, 1e-3), yaw(-3.0, 3.0);
    for (int i = 0; i < cylinders; ++i) {
      const Vec3 foot = footOf(i);
      if (i % kHigh == 0) add(floor_shape, floor, 0, placed(foot));
      const double x = offset(random), y = offset(random);
      const Mat3 turn = Eigen::AngleAxisd(yaw(random), Vec3::UnitZ()).toRotationMatrix();
      add(shape, solid, 1, {turn, foot + Vec3(x, y, heightOf(i))}).setActivationState(DISABLE_DEACTIVATION);
    }
  }

  std::vector<Figure> figures() const override {
    int fallen = 0;
    double creep = 0.0;
    for (std::size_t first = 0; first < moving().size(); first += kHigh) {
      const auto tower = std::span(moving()).subspan(first, kHigh);
      if (std::ranges::any_of(tower, [&](const Body& body) { return isLost(body); })) {
        ++fallen;
        continue;
      }
      const Vec3 foot = footOf(static_cast<int>(first));
      for (const Body& body : tower)
        creep = std::max(creep, (body.pose().translation - foot).head<2>().norm());
    }
    return {{"fallen", double(fallen)}, {"creep_m", creep}};
  }

 private:
  static constexpr int kHigh = 10;
  static constexpr double kRadius = 1.0, kHalfHeight = 0.5, kApart = 30.0;  ///< m

  /// Of the tower that cylinder i belongs to.
  static Vec3 footOf(int i) { return {kApart * (i / kHigh), 0, 0}; }
  static double heightOf(int i) { return kHalfHeight * (2 * (i % kHigh) + 1); }

  /// A cylinder is lost if it is no longer on the one below.
  bool isLost(const Body& body) const override {
    const auto i = static_cast<int>(&body - moving().data());
    return body.pose().translation.z() < heightOf(i) - kHalfHeight;
  }
};

}  // namespace

std::unique_ptr<DynamicsScene> makeTowers(ShapeKind kind, int cylinders) {
  return std::make_unique<Towers>(kind, cylinders);
}

}  // namespace octoblisk::bench
