// A chain of tori that only their contacts link.
#include <algorithm>
#include <numbers>

#include "dynamics/scenes.h"

namespace octoblisk::bench {
namespace {

class Chain final : public DynamicsScene {
 public:
  Chain(ShapeKind kind, int links) : DynamicsScene(kind) {
    const Solid& torus = keepMoving(shapes::torus(kRadius, kTube, 32, 16));
    btCollisionShape& shape = concave(torus, true);
    const Eigen::AngleAxisd upright(0.5 * std::numbers::pi, Vec3::UnitX()),
        across(0.5 * std::numbers::pi, Vec3::UnitZ());
    for (int i = 0; i <= links; ++i) {
      const Mat3 turn = i % 2 == 0 ? upright.toRotationMatrix() : (across * upright).toRotationMatrix();
      add(shape, torus, i > 0 ? 1 : 0, {turn, Vec3(0, 0, -kPitch * i)});
    }
  }

  std::vector<Figure> figures() const override {
    double greatest = 0.0;
    for (const Body& body : moving()) greatest = std::max(greatest, pitch(body));
    return {{"greatest_pitch_m", greatest}};
  }

 private:
  static constexpr double kRadius = 0.5, kTube = 0.12;        ///< m
  static constexpr double kPitch = 1.96 * (kRadius - kTube);  ///< nearly touching

  /// The distance from the previous link.
  double pitch(const Body& body) const {
    const auto i = static_cast<std::size_t>(&body - moving().data());
    const Body& before = i > 0 ? moving()[i - 1] : fixed().front();
    return (body.pose().translation - before.pose().translation).norm();
  }

  /// Circles whose centres are a diameter apart are not linked.
  bool isLost(const Body& body) const override { return pitch(body) > 2.0 * kRadius; }
};

}  // namespace

std::unique_ptr<DynamicsScene> makeChain(ShapeKind kind, int links) {
  return std::make_unique<Chain>(kind, links);
}

}  // namespace octoblisk::bench
