// A Bullet world. Its bodies are measured by the solids that they represent, without Bullet's help.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/kept_shapes.h"
#include "gallery/bullet_world.h"

namespace octoblisk::bench {

/// A figure that only one scene reports. Its name includes the unit.
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

  /// The number of moving bodies.
  int bodies() const { return static_cast<int>(moving_.size()); }
  int asleep() const;
  /// The number of bodies in places that they must not reach.
  int lost() const;
  double kineticEnergy() const { return metres_ * metres_ * world_.kineticEnergy(); }  ///< J
  int contactPoints() const { return world_.contactPoints(); }
  /// The number of manifolds with a contact point. A pair may have several.
  int manifolds() const;
  /// The penetration depth of the deepest surface point of a moving body in another body, or of the floor or
  /// a wall in a moving body, m.
  double depth() const;

  virtual std::vector<Figure> figures() const { return {}; }

 protected:
  static constexpr double kTimeStep = 1.0 / 60.0;  ///< s

  struct Body {
    btRigidBody* body;
    const Solid* solid;
    Pose pose() const { return fromBullet(body->getWorldTransform()); }
  };

  /// `metres`: the length of one unit.
  explicit DynamicsScene(ShapeKind kind, double time_step = kTimeStep, double metres = 1.0);

  virtual bool isLost(const Body& body) const = 0;

  const Solid& keep(const shapes::SharedMesh& closed, Pieces pieces = {});
  /// Keeps the solid in its principal frame, as `add` requires for moving bodies.
  const Solid& keepMoving(const shapes::SharedMesh& closed, Pieces pieces = {});
  template <typename Shape, typename... Arguments>
  Shape& keepShape(Arguments&&... arguments) {
    return shapes_.keep<Shape>(std::forward<Arguments>(arguments)...);
  }
  /// The solid's shape, of this scene's kind.
  btCollisionShape& concave(const Solid& solid, bool moves) { return shapes_.concave(kind_, solid, moves); }

  /// Mass 0 makes the body static. The friction is 0.5. The inertia is that of the solid. `pose` is the pose
  /// of the solid's mesh.
  btRigidBody& add(btCollisionShape& shape, const Solid& solid, double mass, const Pose& pose);
  /// A static box.
  void addBox(const Vec3& half_extents, const Pose& pose);
  /// A static plane at z = 0. It is measured as a box that extends by `size` to each side and down.
  void addPlane(double size);

  btDiscreteDynamicsWorld& world() { return *world_; }
  const std::vector<Body>& moving() const { return moving_; }
  const std::vector<Body>& fixed() const { return fixed_; }

 private:
  ShapeKind kind_;
  double time_step_, metres_;
  std::vector<std::unique_ptr<const Solid>> solids_;
  KeptShapes shapes_;
  gallery::BulletWorld world_;
  std::vector<Body> moving_, fixed_;
};

inline Pose placed(const Vec3& where) { return {Mat3::Identity(), where}; }

}  // namespace octoblisk::bench
