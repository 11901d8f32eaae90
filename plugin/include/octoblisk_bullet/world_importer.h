// Reads .bullet files whose bodies have ClusteredOctreeShape. Needs Bullet's importer (Debian:
// libbullet-extras-dev); link the program to BulletWorldImporter and BulletFileLoader.
#pragma once

#include <BulletFileLoader/btBulletFile.h>
#include <BulletWorldImporter/btBulletWorldImporter.h>
#include <btBulletDynamicsCommon.h>

#include <unordered_map>
#include <unordered_set>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/restore.h"

namespace octoblisk {

/// Replaces btBulletWorldImporter, which turns a saved ClusteredOctreeShape into a static
/// btBvhTriangleMeshShape. Bodies and compounds get their ClusteredOctreeShape back, as restoredShape makes
/// it. Rigid bodies get the state that restoreBody restores, and their collision filters. Call
/// registerAlgorithm (register.h) on the dispatcher. As with Bullet's importer, deleteAllData deletes
/// everything that was created, and named shapes can be found by name.
class WorldImporter : public btBulletWorldImporter {
 public:
  using btBulletWorldImporter::btBulletWorldImporter;
  using btBulletWorldImporter::loadFileFromMemory;

  /// These two do what Bullet's do, and free the file even if a shape throws. Bullet's are not virtual: call
  /// these on a WorldImporter.
  bool loadFile(const char* name, const char* swapped_name = nullptr) {
    bParse::btBulletFile file(name);
    if (!loadFileFromMemory(&file)) return false;
    if (swapped_name) {
      file.preSwap();
      file.writeFile(swapped_name);
    }
    return true;
  }
  bool loadFileFromMemory(char* memory, int size) {
    bParse::btBulletFile file(memory, size);
    return loadFileFromMemory(&file);
  }

  bool convertAllObjects(bParse::btBulletFile* file) override {
    struct Reading {  // also ends if a shape throws
      ~Reading() {
        importer.file_ = nullptr;
        importer.made_.clear();
        importer.compounds_.clear();
      }
      WorldImporter& importer;
    } reading{*this};
    file_ = file;
    next_body_ = next_object_ = 0;
    return btBulletWorldImporter::convertAllObjects(file);
  }

  btRigidBody* createRigidBody(bool is_dynamic, btScalar mass, const btTransform& pose,
                               btCollisionShape* shape, const char* name) override {
    if (!file_) return btBulletWorldImporter::createRigidBody(is_dynamic, mass, pose, shape, name);
    if (isDouble()) return restored<btRigidBodyDoubleData>(pose, name);
    return restored<btRigidBodyFloatData>(pose, name);
  }

  btCollisionObject* createCollisionObject(const btTransform& pose, btCollisionShape* shape,
                                           const char* name) override {
    if (file_ && isDouble()) {
      shape = shapeOf(*next<btCollisionObjectDoubleData>(file_->m_collisionObjects, next_object_));
    } else if (file_) {
      shape = shapeOf(*next<btCollisionObjectFloatData>(file_->m_collisionObjects, next_object_));
    }
    return btBulletWorldImporter::createRigidBody(false, 0, pose, shape, name);  // as Bullet's importer does
  }

 private:
  using Structs = btAlignedObjectArray<bParse::bStructHandle*>;

  bool isDouble() const { return (file_->getFlags() & bParse::FD_DOUBLE_PRECISION) != 0; }

  static const btCollisionObjectFloatData& objectOf(const btCollisionObjectFloatData& saved) { return saved; }
  static const btCollisionObjectDoubleData& objectOf(const btCollisionObjectDoubleData& saved) {
    return saved;
  }
  static const btCollisionObjectFloatData& objectOf(const btRigidBodyFloatData& saved) {
    return saved.m_collisionObjectData;
  }
  static const btCollisionObjectDoubleData& objectOf(const btRigidBodyDoubleData& saved) {
    return saved.m_collisionObjectData;
  }

  /// The entry at which Bullet's importer is: it goes through the same list and skips objects without a
  /// shape.
  template <typename Data>
  const Data* next(const Structs& all, int& index) {
    for (;;) {
      const auto* saved = reinterpret_cast<const Data*>(all[index++]);
      btCollisionShape** shape = m_shapeMap.find(objectOf(*saved).m_collisionShape);
      if (shape && *shape) return saved;
    }
  }

  template <typename Data>
  btRigidBody* restored(const btTransform& pose, const char* name) {
    const Data& saved = *next<Data>(file_->m_rigidBodies, next_body_);
    const btScalar mass = saved.m_inverseMass > 0 ? btScalar(1) / btScalar(saved.m_inverseMass) : btScalar(0);
    btRigidBody* body = btBulletWorldImporter::createRigidBody(mass > 0, mass, pose, shapeOf(saved), name);
    restoreBody(saved, *body);
    restoreFilters(objectOf(saved), *body);
    return body;
  }

  /// Bullet's importer gives all bodies the default filters. In a file of an older Bullet, both are 0.
  template <typename Data>
  void restoreFilters(const Data& saved, btRigidBody& body) {
    btBroadphaseProxy* const proxy = body.getBroadphaseHandle();
    const int group = saved.m_collisionFilterGroup, mask = saved.m_collisionFilterMask;
    if (!proxy || (group == 0 && mask == 0)) return;
    if (proxy->m_collisionFilterGroup == group && proxy->m_collisionFilterMask == mask) return;
    proxy->m_collisionFilterGroup = group;
    proxy->m_collisionFilterMask = mask;
    m_dynamicsWorld->refreshBroadphaseProxy(&body);
  }

  template <typename Data>
  btCollisionShape* shapeOf(const Data& saved) {
    auto* const data = static_cast<btCollisionShapeData*>(objectOf(saved).m_collisionShape);
    btCollisionShape* const read = *m_shapeMap.find(data);
    btCollisionShape* const shape = restored(*data, read);
    if (shape == read) return shape;
    m_shapeMap.insert(data, shape);
    if (const char** found = m_objectNameMap.find(read)) {
      const char* const name = *found;  // copied, because it moves when the map grows
      m_nameShapeMap.insert(name, shape);
      m_objectNameMap.insert(shape, name);
    }
    return shape;
  }

  btCollisionShape* restored(const btCollisionShapeData& saved, btCollisionShape* read) {
    if (auto* compound = dynamic_cast<btCompoundShape*>(read);
        compound && compounds_.insert(compound).second) {
      restoreChildren(reinterpret_cast<const btCompoundShapeData&>(saved), *compound);
    }
    const auto* mesh = dynamic_cast<btBvhTriangleMeshShape*>(read);
    if (!mesh) return read;
    const auto [known, is_new] = made_.try_emplace(&saved, read);
    if (is_new) {
      if (auto shape = restoredShape(saved, *mesh->getMeshInterface())) {
        m_allocatedCollisionShapes.push_back(shape.get());
        known->second = shape.release();
      }
    }
    return known->second;
  }

  void restoreChildren(const btCompoundShapeData& saved, btCompoundShape& compound) {
    compound.setMargin(btScalar(saved.m_collisionMargin));
    for (int child = 0, s = 0; child < compound.getNumChildShapes(); ++child, ++s) {
      btCollisionShape* const read = compound.getChildShape(child);
      // Bullet's importer leaves out children of unknown type.
      const auto isRead = [&] {
        return saved.m_childShapePtr[s].m_childShape->m_shapeType == read->getShapeType();
      };
      while (s < saved.m_numChildShapes && !isRead()) ++s;
      if (s == saved.m_numChildShapes) return;
      btCollisionShape* const shape = restored(*saved.m_childShapePtr[s].m_childShape, read);
      if (shape == read) continue;
      btCompoundShapeChild& place = compound.getChildList()[child];
      place.m_childShape = shape;
      place.m_childShapeType = shape->getShapeType();
      place.m_childMargin = shape->getMargin();
      compound.updateChildTransform(child, place.m_transform);
    }
  }

  bParse::btBulletFile* file_ = nullptr;  // while it is read
  int next_body_ = 0, next_object_ = 0;
  std::unordered_map<const btCollisionShapeData*, btCollisionShape*> made_;  // for the meshes in the file
  std::unordered_set<const btCompoundShape*> compounds_;  // compounds whose children are restored
};

}  // namespace octoblisk
