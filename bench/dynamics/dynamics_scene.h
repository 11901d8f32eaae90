// A Bullet world whose bodies are measured by the solids that they stand for, without Bullet's help.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/solid.h"
#include "gallery/bullet_mesh.h"
#include "gallery/bullet_world.h"

namespace octoblisk::bench {

/// What the concave bodies of a scene are made of: all that the contenders differ in. Everything else is
/// Bullet's default, and so is everything of these shapes.
enum class ShapeKind {
  octoblisk,  ///< ClusteredOctreeShape
  bvh,        ///< btBvhTriangleMeshShape; of a solid that moves: as `hulls`
  gimpact,    ///< btGImpactMeshShape
  hulls,      ///< btCompoundShape of a btConvexHullShape a piece
  plane,      ///< btStaticPlaneShape on top of the solid: the ideal of a flat floor
};
const char* nameOf(ShapeKind kind);

/// A figure of one scene alone, its name with the unit.
struct Figure {
  std::string name;
  double value = 0.0;
};

class DynamicsScene {
 public:
  virtual ~DynamicsScene() = default;
  DynamicsScene(const DynamicsScene&) = delete;
  DynamicsScene& operator=(const DynamicsScene&) = delete;

  void step() { world_.step(1, time_step_); }
  double timeStep() const { return time_step_; }

  /// Those that move.
  int bodies() const { return static_cast<int>(moving_.size()); }
  int asleep() const;
  /// Those that are where they should not be able to get.
  int lost() const;
  double kineticEnergy() const { return metres_ * metres_ * world_.kineticEnergy(); }  ///< J
  int contactPoints() const { return world_.contactPoints(); }
  /// Of pairs with a contact point, or several of a pair.
  int manifolds() const;
  /// Of the deepest point of a moving body's surface in another body, or of the floor's or a wall's in a
  /// moving body, m.
  double depth() const;

  virtual std::vector<Figure> figures() const { return {}; }

 protected:
  static constexpr double kTimeStep = 1.0 / 60.0;  ///< s

  struct Body {
    btRigidBody* body;
    const Solid* solid;
    Pose pose() const { return fromBullet(body->getWorldTransform()); }
  };

  /// `metres`: a unit of length.
  explicit DynamicsScene(ShapeKind kind, double time_step = kTimeStep, double metres = 1.0);

  virtual bool isLost(const Body& body) const = 0;

  const Solid& keep(const shapes::SharedMesh& closed, Pieces pieces = {});
  /// In its principal frame, as `add` needs it of what moves.
  const Solid& keepMoving(const shapes::SharedMesh& closed, Pieces pieces = {});
  template <typename Shape, typename... Arguments>
  Shape& keepShape(Arguments&&... arguments) {
    auto shape = std::make_unique<Shape>(std::forward<Arguments>(arguments)...);
    Shape& kept = *shape;
    shapes_.push_back(std::move(shape));
    return kept;
  }
  /// The solid's shape of this kind.
  btCollisionShape& concave(const Solid& solid, bool moves);

  /// Mass 0: static. The friction is 0.5, the inertia that of the solid. `pose` is that of the solid's mesh.
  btRigidBody& add(btCollisionShape& shape, const Solid& solid, double mass, const Pose& pose);
  /// A static box.
  void addBox(const Vec3& half_extents, const Pose& pose);
  /// A static plane, z = 0, measured as a box of so much to each side and below.
  void addPlane(double size);

  const std::vector<Body>& moving() const { return moving_; }
  const std::vector<Body>& fixed() const { return fixed_; }

 private:
  ShapeKind kind_;
  double time_step_, metres_;
  std::vector<std::unique_ptr<const Solid>> solids_;
  std::vector<std::unique_ptr<gallery::BulletMesh>> meshes_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  mutable gallery::BulletWorld world_;
  std::vector<Body> moving_, fixed_;

 protected:
  btDiscreteDynamicsWorld& world() { return *world_; }
};

inline Pose placed(const Vec3& where) { return {Mat3::Identity(), where}; }

}  // namespace octoblisk::bench
