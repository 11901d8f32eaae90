#include "gallery/rigid_scene.h"

#include "octoblisk/clustered_octree.h"

namespace octoblisk::gallery {

ClusteredOctreeShape& RigidScene::shapeOf(const shapes::SharedMesh& mesh, double margin) {
  shapes_.push_back(std::make_unique<ClusteredOctreeShape>(
      std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh, tree_))));
  shapes_.back()->setMargin(btScalar(margin));
  return *shapes_.back();
}

btRigidBody& RigidScene::add(btCollisionShape& shape, double mass, const btTransform& pose,
                             const demos::Color& color) {
  btRigidBody& body = world_.add(shape, btScalar(mass), pose);
  show(body, color);
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

}  // namespace octoblisk::gallery
