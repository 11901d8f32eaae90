// A pile of four kinds of concave bodies on a concave floor, and measures of their depths.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "gallery/bullet_world.h"
#include "octoblisk/depth.h"
#include "shapes/bodies.h"
#include "shapes/seeded.h"
#include "shapes/sheets.h"

namespace octoblisk::gallery {

using shapes::SharedMesh;

/// Makes a shape from a mesh: ours, or another library's for comparison.
using MakeShape = std::function<std::unique_ptr<btCollisionShape>(const SharedMesh& mesh)>;

std::unique_ptr<btCollisionShape> makeOurShape(const SharedMesh& mesh, const BuildOptions& tree = {});

/// Lengths in m, masses in kg. Bodies are dropped in square layers, each turned at random.
class ConcavePile {
 public:
  static constexpr btScalar kMargin = btScalar(0.01);  ///< of each shape
  static constexpr double kTimeStep = 1.0 / 60.0;      ///< s

  struct Depths {
    double in_floor = 0.0;   ///< of the deepest corner of a body below the floor's closed form
    double in_bodies = 0.0;  ///< of the deepest point of a body, or the floor, in another body
  };

  explicit ConcavePile(
      int bodies, unsigned seed,
      const MakeShape& make_shape = [](const SharedMesh& mesh) { return makeOurShape(mesh); },
      int layer_side = 4) {
    std::mt19937_64 random(seed);
    const SharedMesh meshes[] = {shapes::torus(0.4, 0.15, 20, 10), shapes::gear(8, 0.4, 0.5, 0.2, 0.12),
                                 shapes::uProfile(0.35, 0.3, 0.12, 0.4),
                                 shapes::bumpySphere(random, 0.4, 0.15, 16)};
    kinds_.reserve(std::size(meshes) + 1);
    for (const SharedMesh& mesh : meshes) kinds_.emplace_back(mesh, make_shape(mesh));
    const SharedMesh floor_mesh = shapes::tray(5.0, 40);
    kinds_.emplace_back(floor_mesh, make_shape(floor_mesh));
    world_.add(*kinds_.back().shape, 0, btTransform::getIdentity());
    // Large layers begin above the rising rim.
    const double middle = 0.5 * (layer_side - 1), corner = 1.3 * middle;
    const double lift = std::max(0.0, shapes::trayHeight(corner, corner) - 0.3);
    for (int i = 0; i < bodies; ++i) {
      const std::size_t kind = static_cast<std::size_t>(i + i / 4) % std::size(meshes);
      Vec3 position(1.3 * (i % layer_side - middle), 1.3 * (i / layer_side % layer_side - middle),
                    1.3 + lift + 1.2 * (i / (layer_side * layer_side)));
      for (int k = 1; k >= 0; --k) position[k] += shapes::uniform(random, -0.1, 0.1);
      btRigidBody& body =
          world_.add(*kinds_[kind].shape, 1, toBullet(Pose{shapes::randomRotation(random), position}));
      body.setFriction(btScalar(0.5));
      body.setDamping(btScalar(0.05), btScalar(0.05));
      bodies_.push_back({&body, kind});
    }
  }

  BulletWorld& world() { return world_; }
  void step() { world_.step(1, kTimeStep); }
  std::size_t size() const { return bodies_.size(); }
  btRigidBody& body(std::size_t i) { return *bodies_[i].body; }
  const btRigidBody& body(std::size_t i) const { return *bodies_[i].body; }
  const TriangleMesh& mesh(std::size_t i) const { return *kinds_[bodies_[i].kind].mesh; }
  std::size_t kind(std::size_t i) const { return bodies_[i].kind; }
  const TriangleMesh& floor() const { return *kinds_.back().mesh; }

  /// J, of all bodies.
  double kineticEnergy() const { return world_.kineticEnergy(); }

  /// The number of bodies whose centre is below the floor.
  int fallen() const {
    return static_cast<int>(std::ranges::count_if(bodies_, [](const Body& b) {
      const btVector3& middle = b.body->getWorldTransform().getOrigin();
      return double(middle.z()) < shapes::trayHeight(double(middle.x()), double(middle.y())) ||
             middle.length() > 12;
    }));
  }

  /// Of all bodies, computed without Bullet.
  Depths depths() const {
    Depths found;
    DepthQuery query;
    const Kind& floor = kinds_.back();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Kind& kind = kinds_[bodies_[i].kind];
      const Pose pose = fromBullet(bodies_[i].body->getWorldTransform());
      for (const Vec3& vertex : kind.mesh->vertices()) {
        const Vec3 corner = pose * vertex;
        found.in_floor = std::max(found.in_floor, shapes::trayHeight(corner.x(), corner.y()) - corner.z());
      }
      found.in_bodies =
          std::max(found.in_bodies, query.deepest(*kind.surface, *floor.surface, pose.inverse(), 1e-3).depth);
      for (std::size_t j = 0; j < bodies_.size(); ++j) {
        const Pose other = pose.inverse() * fromBullet(bodies_[j].body->getWorldTransform());
        if (i == j || other.translation.norm() > 1.5) continue;
        const Surface& surface = *kinds_[bodies_[j].kind].surface;
        found.in_bodies = std::max(found.in_bodies, query.deepest(*kind.surface, surface, other, 1e-3).depth);
      }
    }
    return found;
  }

 private:
  struct Kind {
    Kind(SharedMesh its_mesh, std::unique_ptr<btCollisionShape> its_shape)
        : mesh(std::move(its_mesh)),
          shape(std::move(its_shape)),
          tree(std::make_unique<const ClusteredOctree>(ClusteredOctree::build(mesh))),
          surface(std::make_unique<const Surface>(*tree)) {}

    SharedMesh mesh;
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<const ClusteredOctree> tree;
    std::unique_ptr<const Surface> surface;
  };
  struct Body {
    btRigidBody* body;
    std::size_t kind;
  };

  std::vector<Kind> kinds_;  // the floor last
  BulletWorld world_;
  std::vector<Body> bodies_;
};

inline std::unique_ptr<btCollisionShape> makeOurShape(const SharedMesh& mesh, const BuildOptions& tree) {
  auto shape = std::make_unique<ClusteredOctreeShape>(
      std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh, tree)));
  shape->setMargin(ConcavePile::kMargin);
  return shape;
}

}  // namespace octoblisk::gallery
