#include "gallery/rigid_scene.h"

#include <algorithm>

namespace octoblisk::gallery {

ClusteredOctreeShape& RigidScene::shapeOf(const shapes::SharedMesh& mesh, double margin) {
  shapes_.push_back(std::make_unique<ClusteredOctreeShape>(
      std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh))));
  shapes_.back()->setMargin(btScalar(margin));
  return *shapes_.back();
}

btRigidBody& RigidScene::add(btCollisionShape& shape, double mass, const btTransform& pose,
                             const demos::Color& color) {
  btRigidBody& body = world_.add(shape, btScalar(mass), pose);
  colors_.emplace_back(&body, color);
  return body;
}

demos::Picture RigidScene::picture() const {
  demos::Picture picture;
  for (const auto& [body, color] : colors_) {
    const auto* shape = dynamic_cast<const ClusteredOctreeShape*>(body->getCollisionShape());
    if (shape != nullptr)
      picture.scene.addMesh(shape->tree().mesh(), fromBullet(body->getWorldTransform()), color);
  }
  picture.camera = demos::frame(seen_, direction_, Vec3::UnitZ());
  return picture;
}

double RigidScene::kineticEnergy() const {
  double energy = 0.0;
  const btCollisionObjectArray& objects = world_->getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) {
    const btRigidBody* body = btRigidBody::upcast(objects[i]);
    if (body == nullptr || body->isStaticOrKinematicObject()) continue;
    const btVector3 spin = body->getWorldTransform().getBasis().transpose() * body->getAngularVelocity();
    energy += 0.5 / double(body->getInvMass()) * double(body->getLinearVelocity().length2()) +
              0.5 * double((spin * spin).dot(body->getLocalInertia()));
  }
  return energy;
}

int RigidScene::contactPoints() const {
  int points = 0;
  const btCollisionDispatcher& dispatcher = world_.dispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m)
    points += dispatcher.getManifoldByIndexInternal(m)->getNumContacts();
  return points;
}

}  // namespace octoblisk::gallery
