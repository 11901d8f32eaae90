// Small convex hulls on the blisk. The blisk lies on a floor within a ring of walls.
#include <cmath>
#include <numbers>
#include <random>

#include "dynamics/scenes.h"
#include "models/blisk.h"
#include "octoblisk/containment.h"
#include "shapes/seeded.h"

namespace octoblisk::bench {
namespace {

class HullsOnBliskScene final : public DynamicsScene {
 public:
  HullsOnBliskScene(ShapeKind kind, int hulls) : DynamicsScene(kind, 1.0 / 240.0, 1e-3) {
    constexpr int kWalls = 24;
    world().setGravity(btVector3(0, 0, -9810));
    blisk_ = &keep(std::make_shared<const TriangleMesh>(demos::makeDefaultBlisk(50'000).mesh));
    add(concave(*blisk_, false), *blisk_, 0, {});
    addBox({300, 300, 15}, placed({0, 0, kFloor - 15}));
    for (int k = 0; k < kWalls; ++k) {
      const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * k / kWalls, Vec3::UnitZ());
      addBox({5, 36, 150}, {turn.toRotationMatrix(), turn * Vec3(kWall + 5, 0, 100)});
    }
    addHulls(hulls);
  }

  std::vector<Figure> figures() const override {
    double inside = 0;
    for (const Body& body : moving())
      inside += locate(blisk_->surface, body.pose().translation) == PointLocation::inside;
    return {{"inside", inside}};
  }

 private:
  static constexpr double kFloor = -30.0, kWall = 242.0;  ///< mm

  /// Adds hulls above the blades, 40 to a layer.
  void addHulls(int hulls) {
    constexpr int kKinds = 8, kLayer = 40;
    std::mt19937_64 random(1);
    std::vector<std::pair<const Solid*, btCollisionShape*>> kinds;
    for (int kind = 0; kind < kKinds; ++kind) {
      Vec3 radii;
      for (double& radius : radii) radius = shapes::uniform(random, 4.5, 6.5);
      const Solid& solid = keepMoving(shapes::ellipsoid(radii, 6));
      auto& shape = keepShape<btConvexHullShape>();
      for (const Vec3& vertex : solid.mesh->vertices()) shape.addPoint(toBullet(vertex), false);
      shape.recalcLocalAabb();
      kinds.emplace_back(&solid, &shape);
    }
    for (int k = 0; k < hulls; ++k) {
      const auto& [solid, shape] = kinds[static_cast<std::size_t>(k) % kKinds];
      const double radius = 140.0 + 8.5 * (k % 10), angle = 2.0 * std::numbers::pi * 0.618 * k;
      const Vec3 place(radius * std::cos(angle), radius * std::sin(angle), 115.0 + 15.0 * (k / kLayer));
      add(*shape, *solid, 0.01, {shapes::randomRotation(random), place});
    }
  }

  bool isLost(const Body& body) const override {
    const Vec3 middle = body.pose().translation;
    return middle.z() < kFloor || middle.head<2>().norm() > kWall + 10.0;
  }

  const Solid* blisk_;
};

}  // namespace

std::unique_ptr<DynamicsScene> makeHullsOnBlisk(ShapeKind kind, int hulls) {
  return std::make_unique<HullsOnBliskScene>(kind, hulls);
}

}  // namespace octoblisk::bench
