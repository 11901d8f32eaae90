// A channel between two curved walls, with debris in it.
#include <cmath>
#include <numbers>
#include <random>

#include "dynamics/scenes.h"
#include "octoblisk/containment.h"
#include "shapes/seeded.h"

namespace octoblisk::bench {
namespace {

constexpr int kSegments = 24;                                 // of the section
constexpr double kWidth = 1.2, kHeight = 1.8, kLength = 2.0;  // m; kWidth and kLength are halves

/// Half an ellipse that is open at the top and leans to one side. One wall overhangs like a blade.
shapes::SharedMesh channelMesh() {
  std::vector<Eigen::Vector2d> outer, inner;
  for (int i = 0; i <= kSegments; ++i) {
    const double angle = std::numbers::pi * i / kSegments;
    const auto at = [&](double scale) -> Eigen::Vector2d {
      const double x = -scale * kWidth * std::cos(angle), y = kHeight - scale * kHeight * std::sin(angle);
      return {x + 0.3 * y, y};
    };
    inner.push_back(at(1.0));
    outer.push_back(at(1.15));
  }
  return shapes::extrudedBand(outer, inner, false, kLength);
}

class Channel final : public DynamicsScene {
 public:
  Channel(ShapeKind kind, int bodies) : DynamicsScene(kind) {
    channel_ = &keep(channelMesh(), piecesOfEight(kSegments, 0, 4));
    const Eigen::AngleAxisd upright(0.5 * std::numbers::pi, Vec3::UnitX());
    add(concave(*channel_, false), *channel_, 0, {upright.toRotationMatrix(), Vec3::Zero()});
    for (const double side : {-1.0, 1.0}) addBox({2.5, 0.25, 2.0}, placed({0, side * (kLength + 0.25), 1.0}));
    addDebris(bodies);
  }

  std::vector<Figure> figures() const override {
    const Pose channel = fixed().front().pose();
    double inside = 0;
    for (const Body& body : moving())
      inside += locate(channel_->surface, body.pose().translation, channel) == PointLocation::inside;
    return {{"inside", inside}};
  }

 private:
  void addDebris(int bodies) {
    const Vec3 half(0.15, 0.2, 0.25);
    const Solid& stone = keepMoving(shapes::ellipsoid({0.2, 0.25, 0.3}, 8));
    const Solid& box = keepMoving(shapes::boxMesh(half));
    const Solid& ball = keepMoving(shapes::ellipsoid(Vec3::Constant(0.2), 48));
    const Solid& profile = keepMoving(shapes::uProfile(0.22, 0.2, 0.08, 0.22), piecesOfEight(3, 0, 4));
    auto& hull = keepShape<btConvexHullShape>();
    for (const Vec3& vertex : stone.mesh->vertices()) hull.addPoint(toBullet(vertex), false);
    hull.recalcLocalAabb();
    const std::pair<const Solid*, btCollisionShape*> kinds[] = {
        {&stone, &hull},
        {&box, &keepShape<btBoxShape>(toBullet(half))},
        {&ball, &keepShape<btSphereShape>(btScalar(0.2))},
        {&profile, &concave(profile, true)}};
    std::mt19937_64 random(1);
    for (int i = 0; i < bodies; ++i) {
      const auto& [solid, shape] = kinds[static_cast<std::size_t>(i) % std::size(kinds)];
      Vec3 place(0.7 * (i % 3 - 1), 0.7 * (i / 3 % 5 - 2), 1.8 + 0.7 * (i / 15));
      place.x() += 0.3 * kHeight;  // the mouth is on the side that the walls lean to
      place += shapes::randomPoint(random, 0.03);
      add(*shape, *solid, 1, {shapes::randomRotation(random), place});
    }
  }

  bool isLost(const Body& body) const override { return body.pose().translation.z() < -0.3 * kHeight; }

  const Solid* channel_;
};

}  // namespace

std::unique_ptr<DynamicsScene> makeChannel(ShapeKind kind, int bodies) {
  return std::make_unique<Channel>(kind, bodies);
}

}  // namespace octoblisk::bench
