#include "octoblisk_bullet/register.h"

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btEmptyCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <memory>
#include <new>
#include <vector>

#include "mesh_concave_algorithm.h"
#include "mesh_convex_algorithm.h"
#include "mesh_mesh_algorithm.h"
#include "mesh_plane_algorithm.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "our_shape.h"

namespace octoblisk {

using namespace detail;

namespace {

// Blocks of the dispatcher's pool may be too small. The dispatcher frees other memory by btAlignedFree.
template <typename Algorithm, typename... Arguments>
btCollisionAlgorithm* make(const Arguments&... arguments) {
  void* memory = btAlignedAlloc(sizeof(Algorithm), alignof(Algorithm) > 16 ? alignof(Algorithm) : 16);
  return new (memory) Algorithm(arguments...);
}

using CreateInfo = btCollisionAlgorithmConstructionInfo;
using Wrapper = btCollisionObjectWrapper;

bool isGImpact(const btCollisionShape& shape) { return shape.getShapeType() == GIMPACT_SHAPE_PROXYTYPE; }

template <typename Shape>
bool is(const btCollisionShape& shape) {
  return dynamic_cast<const Shape*>(&shape) != nullptr;
}

/// The algorithm of our shape and another one.
btCollisionAlgorithm* ofOurShape(const btCollisionShape& other, CreateInfo& info, const Wrapper* body0,
                                 const Wrapper* body1, bool mesh_is_body1) {
  if (other.isConvex()) return make<MeshConvexAlgorithm>(info, body0, body1, mesh_is_body1);
  if (asOurShape(other)) return make<MeshMeshAlgorithm>(info, body0, body1);
  // GImpact's other shapes are left to GImpact, which asks our shape for triangles.
  if (isGImpact(other) && !is<btGImpactMeshShape>(other) && !is<btGImpactMeshShapePart>(other))
    return make<btGImpactCollisionAlgorithm>(info, body0, body1);
  if (is<btStaticPlaneShape>(other)) return make<MeshPlaneAlgorithm>(info, body0, body1, mesh_is_body1);
  if (is<btConcaveShape>(other)) return make<MeshConcaveAlgorithm>(info, body0, body1, mesh_is_body1);
  return make<btEmptyAlgorithm>(info);
}

/// The algorithm of a third-party shape that has our type, and another shape.
btCollisionAlgorithm* ofThirdParty(const btCollisionShape& mesh, const btCollisionShape& other,
                                   CreateInfo& info, const Wrapper* body0, const Wrapper* body1,
                                   bool mesh_is_body1) {
  if (other.isConvex()) return make<btConvexConcaveCollisionAlgorithm>(info, body0, body1, !mesh_is_body1);
  if (isGImpact(other)) return make<btGImpactCollisionAlgorithm>(info, body0, body1);
  if (asOurShape(other) && is<btConcaveShape>(mesh))
    return make<MeshConcaveAlgorithm>(info, body0, body1, !mesh_is_body1);
  return make<btEmptyAlgorithm>(info);
}

/// Creates the algorithm of a shape that has our type, and another shape.
struct CreatePair final : btCollisionAlgorithmCreateFunc {
  explicit CreatePair(bool mesh_is_body1) { m_swapped = mesh_is_body1; }
  btCollisionAlgorithm* CreateCollisionAlgorithm(CreateInfo& info, const Wrapper* body0,
                                                 const Wrapper* body1) override {
    const btCollisionShape& mesh = *(m_swapped ? body1 : body0)->getCollisionShape();
    const btCollisionShape& other = *(m_swapped ? body0 : body1)->getCollisionShape();
    return asOurShape(mesh) ? ofOurShape(other, info, body0, body1, m_swapped)
                            : ofThirdParty(mesh, other, info, body0, body1, m_swapped);
  }
};

}  // namespace

void registerAlgorithm(btCollisionDispatcher* dispatcher) {
  // They have no state, so all dispatchers share them; they outlive every dispatcher.
  static CreatePair mesh_first(false), other_first(true);
  const auto registerPair = [&](int type0, int type1, btCollisionAlgorithmCreateFunc* create) {
    dispatcher->registerCollisionCreateFunc(type0, type1, create);
    dispatcher->registerClosestPointsCreateFunc(type0, type1, create);
  };
  const auto registerBothOrders = [&](int other) {
    registerPair(other, FAST_CONCAVE_MESH_PROXYTYPE, &other_first);
    registerPair(FAST_CONCAVE_MESH_PROXYTYPE, other, &mesh_first);
  };
  for (int convex = 0; convex < CONCAVE_SHAPES_START_HERE; ++convex) registerBothOrders(convex);
  for (const int concave : {TRIANGLE_MESH_SHAPE_PROXYTYPE, SCALED_TRIANGLE_MESH_SHAPE_PROXYTYPE,
                            MULTIMATERIAL_TRIANGLE_MESH_PROXYTYPE, TERRAIN_SHAPE_PROXYTYPE,
                            GIMPACT_SHAPE_PROXYTYPE, STATIC_PLANE_PROXYTYPE, FAST_CONCAVE_MESH_PROXYTYPE}) {
    registerBothOrders(concave);
  }
}

bool isRegistered(btCollisionDispatcher* dispatcher) {
  const auto mesh =
      std::make_shared<const TriangleMesh>(std::vector<Vec3>{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()},
                                           std::vector<TriangleMesh::Indices>{{0, 1, 2}});
  ClusteredOctreeShape shape(std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh)));
  btCollisionObject body;
  body.setCollisionShape(&shape);
  const Wrapper wrapper(nullptr, &shape, &body, body.getWorldTransform(), -1, -1);
  const OwnedAlgorithm algorithm(
      dispatcher->findAlgorithm(&wrapper, &wrapper, nullptr, BT_CLOSEST_POINT_ALGORITHMS), {dispatcher});
  return dynamic_cast<MeshMeshAlgorithm*>(algorithm.get()) != nullptr;
}

}  // namespace octoblisk
