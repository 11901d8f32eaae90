#include "octoblisk_bullet/register.h"

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btEmptyCollisionAlgorithm.h>

#include <new>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/mesh_convex_algorithm.h"
#include "octoblisk_bullet/mesh_mesh_algorithm.h"

namespace octoblisk {
namespace {

// Not from the dispatcher's pool, whose blocks may be too small; it frees foreign memory by btAlignedFree.
template <typename Algorithm, typename... Arguments>
btCollisionAlgorithm* make(const Arguments&... arguments) {
  void* memory = btAlignedAlloc(sizeof(Algorithm), alignof(Algorithm) > 16 ? alignof(Algorithm) : 16);
  return new (memory) Algorithm(arguments...);
}

bool hasOurShape(const btCollisionObjectWrapper* body) {
  return dynamic_cast<const ClusteredOctreeShape*>(body->getCollisionShape()) != nullptr;
}

using CreateInfo = btCollisionAlgorithmConstructionInfo;
using Wrapper = btCollisionObjectWrapper;

struct CreateMeshConvex final : btCollisionAlgorithmCreateFunc {
  explicit CreateMeshConvex(bool mesh_is_body1) { m_swapped = mesh_is_body1; }
  btCollisionAlgorithm* CreateCollisionAlgorithm(CreateInfo& info, const Wrapper* body0,
                                                 const Wrapper* body1) override {
    if (!hasOurShape(m_swapped ? body1 : body0)) {  // someone else's shape of the same type
      return make<btConvexConcaveCollisionAlgorithm>(info, body0, body1, !m_swapped);
    }
    return make<MeshConvexAlgorithm>(info, body0, body1, m_swapped);
  }
};

struct CreateMeshMesh final : btCollisionAlgorithmCreateFunc {
  btCollisionAlgorithm* CreateCollisionAlgorithm(CreateInfo& info, const Wrapper* body0,
                                                 const Wrapper* body1) override {
    if (!hasOurShape(body0) || !hasOurShape(body1)) return make<btEmptyAlgorithm>(info);
    return make<MeshMeshAlgorithm>(info, body0, body1);
  }
};

}  // namespace

void registerAlgorithm(btCollisionDispatcher* dispatcher) {
  // Without state, so all dispatchers share them; they outlive every dispatcher.
  static CreateMeshConvex mesh_convex(false), convex_mesh(true);
  static CreateMeshMesh mesh_mesh;
  const auto registerPair = [&](int type0, int type1, btCollisionAlgorithmCreateFunc* create) {
    dispatcher->registerCollisionCreateFunc(type0, type1, create);
    dispatcher->registerClosestPointsCreateFunc(type0, type1, create);
  };
  for (int convex = 0; convex < CONCAVE_SHAPES_START_HERE; ++convex) {
    registerPair(FAST_CONCAVE_MESH_PROXYTYPE, convex, &mesh_convex);
    registerPair(convex, FAST_CONCAVE_MESH_PROXYTYPE, &convex_mesh);
  }
  registerPair(FAST_CONCAVE_MESH_PROXYTYPE, FAST_CONCAVE_MESH_PROXYTYPE, &mesh_mesh);
}

}  // namespace octoblisk
