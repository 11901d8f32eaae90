#include "dynamics/dynamics_scene.h"

#include <algorithm>

#include "contenders/gimpact_shape.h"
#include "octoblisk/depth.h"

namespace octoblisk::bench {

DynamicsScene::DynamicsScene(ShapeKind kind, double time_step, double metres)
    : kind_(kind), time_step_(time_step), metres_(metres) {
  if (kind == ShapeKind::gimpact) btGImpactCollisionAlgorithm::registerAlgorithm(&world_.dispatcher());
}

int DynamicsScene::asleep() const {
  return static_cast<int>(std::ranges::count_if(moving_, [](const Body& b) { return !b.body->isActive(); }));
}

int DynamicsScene::lost() const {
  return static_cast<int>(std::ranges::count_if(moving_, [&](const Body& body) { return isLost(body); }));
}

int DynamicsScene::manifolds() const {
  const btCollisionDispatcher& dispatcher = world_.dispatcher();
  int touching = 0;
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m)
    touching += dispatcher.getManifoldByIndexInternal(m)->getNumContacts() > 0;
  return touching;
}

double DynamicsScene::depth() const {
  struct Measured {
    const Solid* solid;
    Pose pose;
    Aabb bounds;
  };
  std::vector<Measured> all;
  for (const std::vector<Body>* bodies : {&moving_, &fixed_}) {
    for (const Body& body : *bodies) {
      all.push_back({body.solid, body.pose(), {}});
      Measured& one = all.back();
      for (const Vec3& vertex : body.solid->mesh->vertices()) one.bounds.extend(one.pose * vertex);
    }
  }
  DepthQuery query;
  double greatest = 0.0;
  const auto look = [&](const Measured& in, const Measured& of, double tolerance) {
    const GougeDepth found =
        query.deepest(in.solid->surface, of.solid->surface, in.pose.inverse() * of.pose, tolerance);
    greatest = std::max(greatest, found.depth);
  };
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const double tolerance = 1e-3 * all[i].solid->mesh->bounds().halfExtents().norm();
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (!all[i].bounds.meets(all[j].bounds)) continue;
      look(all[i], all[j], tolerance);
      look(all[j], all[i], tolerance);
    }
  }
  return metres_ * greatest;
}

const Solid& DynamicsScene::keep(const shapes::SharedMesh& closed, Pieces pieces) {
  solids_.push_back(std::make_unique<const Solid>(closed, std::move(pieces)));
  return *solids_.back();
}

const Solid& DynamicsScene::keepMoving(const shapes::SharedMesh& closed, Pieces pieces) {
  return keep(inPrincipalFrame(closed), std::move(pieces));
}

btRigidBody& DynamicsScene::add(btCollisionShape& shape, const Solid& solid, double mass, const Pose& pose) {
  btRigidBody& body = world_.add(shape, btScalar(mass), toBullet(pose));
  body.setFriction(btScalar(0.5));
  if (mass > 0) {
    body.setMassProps(btScalar(mass), toBullet(mass * solid.moments));
    body.updateInertiaTensor();
  }
  (mass > 0 ? moving_ : fixed_).push_back({&body, &solid});
  return body;
}

void DynamicsScene::addBox(const Vec3& half_extents, const Pose& pose) {
  add(keepShape<btBoxShape>(toBullet(half_extents)), keep(shapes::boxMesh(half_extents)), 0, pose);
}

void DynamicsScene::addPlane(double size) {
  const double half = 0.5 * size;
  add(keepShape<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(half)),
      keep(shapes::boxMesh({size, size, half})), 0, placed({0, 0, -half}));
}

}  // namespace octoblisk::bench
