#include "octoblisk_bullet/register.h"

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btEmptyCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <memory>
#include <new>
#include <vector>

#include "body_parts.h"
#include "mesh_concave_algorithm.h"
#include "mesh_convex_algorithm.h"
#include "mesh_mesh_algorithm.h"
#include "mesh_plane_algorithm.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"

namespace octoblisk {

using namespace detail;

namespace {

// Blocks of the dispatcher's pool may be too small. The dispatcher frees other memory by btAlignedFree.
template <typename Algorithm, typename... Arguments>
btCollisionAlgorithm* make(const Arguments&... arguments) {
  void* memory = btAlignedAlloc(sizeof(Algorithm), alignof(Algorithm) > 16 ? alignof(Algorithm) : 16);
  return new (memory) Algorithm(arguments...);
}

template <typename Shape>
bool has(const btCollisionObjectWrapper* body) {
  return dynamic_cast<const Shape*>(body->getCollisionShape()) != nullptr;
}

// A dynamic_cast would take longer.
template <>
bool has<btConvexShape>(const btCollisionObjectWrapper* body) {
  return body->getCollisionShape()->isConvex();
}

bool hasOurShape(const btCollisionObjectWrapper* body) {
  return asOurShape(*body->getCollisionShape()) != nullptr;
}

using CreateInfo = btCollisionAlgorithmConstructionInfo;
using Wrapper = btCollisionObjectWrapper;

// Creates the algorithm of a pair that CreateMesh does not handle.
using Otherwise = btCollisionAlgorithm*(CreateInfo&, const Wrapper*, const Wrapper*, bool mesh_is_body1);

btCollisionAlgorithm* nothing(CreateInfo& info, const Wrapper*, const Wrapper*, bool) {
  return make<btEmptyAlgorithm>(info);
}

/// For third-party concave shapes of our type.
btCollisionAlgorithm* convexConcave(CreateInfo& info, const Wrapper* body0, const Wrapper* body1,
                                    bool mesh_is_body1) {
  return make<btConvexConcaveCollisionAlgorithm>(info, body0, body1, !mesh_is_body1);
}

/// GImpact shapes other than meshes are left to GImpact, which asks our shape for triangles.
btCollisionAlgorithm* gimpact(CreateInfo& info, const Wrapper* body0, const Wrapper* body1, bool) {
  return make<btGImpactCollisionAlgorithm>(info, body0, body1);
}

/// Creates the algorithm for our shape and a shape of one of `Others`.
template <typename Algorithm, Otherwise* otherwise, typename... Others>
struct CreateMesh final : btCollisionAlgorithmCreateFunc {
  explicit CreateMesh(bool mesh_is_body1) { m_swapped = mesh_is_body1; }
  btCollisionAlgorithm* CreateCollisionAlgorithm(CreateInfo& info, const Wrapper* body0,
                                                 const Wrapper* body1) override {
    const Wrapper *mesh = m_swapped ? body1 : body0, *other = m_swapped ? body0 : body1;
    if (hasOurShape(mesh) && (has<Others>(other) || ...)) {
      return make<Algorithm>(info, body0, body1, m_swapped);
    }
    return otherwise(info, body0, body1, m_swapped);
  }
};

using CreateMeshConvex = CreateMesh<MeshConvexAlgorithm, convexConcave, btConvexShape>;
using CreateMeshConcave = CreateMesh<MeshConcaveAlgorithm, nothing, btConcaveShape>;
using CreateMeshGImpact =
    CreateMesh<MeshConcaveAlgorithm, gimpact, btGImpactMeshShape, btGImpactMeshShapePart>;
using CreateMeshPlane = CreateMesh<MeshPlaneAlgorithm, nothing, btStaticPlaneShape>;

/// For two shapes of our type. At least one should be our shape.
struct CreateMeshMesh final : btCollisionAlgorithmCreateFunc {
  btCollisionAlgorithm* CreateCollisionAlgorithm(CreateInfo& info, const Wrapper* body0,
                                                 const Wrapper* body1) override {
    if (hasOurShape(body0) && hasOurShape(body1)) return make<MeshMeshAlgorithm>(info, body0, body1);
    if (hasOurShape(body0)) return mesh_concave_.CreateCollisionAlgorithm(info, body0, body1);
    return concave_mesh_.CreateCollisionAlgorithm(info, body0, body1);
  }

 private:
  CreateMeshConcave mesh_concave_{false}, concave_mesh_{true};
};

}  // namespace

void registerAlgorithm(btCollisionDispatcher* dispatcher) {
  // They have no state, so all dispatchers share them; they outlive every dispatcher.
  static CreateMeshConvex mesh_convex(false), convex_mesh(true);
  static CreateMeshConcave mesh_concave(false), concave_mesh(true);
  static CreateMeshGImpact mesh_gimpact(false), gimpact_mesh(true);
  static CreateMeshPlane mesh_plane(false), plane_mesh(true);
  static CreateMeshMesh mesh_mesh;
  const auto registerPair = [&](int type0, int type1, btCollisionAlgorithmCreateFunc* create) {
    dispatcher->registerCollisionCreateFunc(type0, type1, create);
    dispatcher->registerClosestPointsCreateFunc(type0, type1, create);
  };
  const auto registerBothOrders = [&](int other, btCollisionAlgorithmCreateFunc* mesh_first,
                                      btCollisionAlgorithmCreateFunc* other_first) {
    registerPair(FAST_CONCAVE_MESH_PROXYTYPE, other, mesh_first);
    registerPair(other, FAST_CONCAVE_MESH_PROXYTYPE, other_first);
  };
  for (int convex = 0; convex < CONCAVE_SHAPES_START_HERE; ++convex) {
    registerBothOrders(convex, &mesh_convex, &convex_mesh);
  }
  for (const int concave : {TRIANGLE_MESH_SHAPE_PROXYTYPE, SCALED_TRIANGLE_MESH_SHAPE_PROXYTYPE,
                            MULTIMATERIAL_TRIANGLE_MESH_PROXYTYPE, TERRAIN_SHAPE_PROXYTYPE}) {
    registerBothOrders(concave, &mesh_concave, &concave_mesh);
  }
  registerBothOrders(GIMPACT_SHAPE_PROXYTYPE, &mesh_gimpact, &gimpact_mesh);
  registerBothOrders(STATIC_PLANE_PROXYTYPE, &mesh_plane, &plane_mesh);
  registerPair(FAST_CONCAVE_MESH_PROXYTYPE, FAST_CONCAVE_MESH_PROXYTYPE, &mesh_mesh);
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
