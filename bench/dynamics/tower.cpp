// A tower of cylinders.
#include <algorithm>

#include "dynamics/scenes.h"
#include "shapes/sheets.h"

namespace octoblisk::bench {
namespace {

class Tower final : public DynamicsScene {
 public:
  Tower(ShapeKind kind, int cylinders) : DynamicsScene(kind) {
    const Solid& floor = keep(shapes::solidBelow(*shapes::waveSheet(5.0, 0.0, 24), -5.0));
    add(concave(floor, false), floor, 0, {});
    const Solid& solid = keepMoving(shapes::cylinder(kRadius, kHalfHeight, 64));
    auto& shape = keepShape<btCylinderShapeZ>(toBullet(Vec3(kRadius, kRadius, kHalfHeight)));
    for (int i = 0; i < cylinders; ++i)
      add(shape, solid, 1, placed({0, 0, heightOf(i)})).setActivationState(DISABLE_DEACTIVATION);
  }

  std::vector<Figure> figures() const override {
    double creep = 0.0;
    for (const Body& body : moving()) creep = std::max(creep, body.pose().translation.head<2>().norm());
    const double top = moving().back().pose().translation.z() + kHalfHeight;
    const bool has_fallen = lost() > 0;
    return {{"fallen", has_fallen ? 1.0 : 0.0}, {"creep_mm", 1e3 * creep}, {"top_m", top}};
  }

 private:
  static constexpr double kRadius = 0.5, kHalfHeight = 0.25;  ///< m

  static double heightOf(int i) { return kHalfHeight * (2 * i + 1); }

  /// A cylinder is lost if it is no longer on the one below.
  bool isLost(const Body& body) const override {
    const auto i = static_cast<int>(&body - moving().data());
    return body.pose().translation.z() < heightOf(i) - kHalfHeight;
  }
};

}  // namespace

std::unique_ptr<DynamicsScene> makeTower(ShapeKind kind, int cylinders) {
  return std::make_unique<Tower>(kind, cylinders);
}

}  // namespace octoblisk::bench
