#include "cluster_test.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>

#include "contact/far_vertices.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "our_shape.h"
#include "proxy_body.h"
#include "query/clusters_near.h"
#include "shape_bounds.h"

namespace octoblisk::detail {

namespace {

/// A body, or a child of a compound.
struct Part {
  const ClusteredOctreeShape* ours;  ///< null: the box represents the part
  btTransform in_world;
  Aabb box;  ///< in the world
};

Part partOf(const btCollisionShape& shape, const btTransform& in_world) {
  const double near = double(gContactBreakingThreshold);  // as Bullet grows boxes
  return {asOurShape(shape), in_world, shapeBounds(shape, in_world).grown(near)};
}

constexpr int kFewChildren = 16;  // up to this number, testing each child is faster than a lookup

/// Tests the children that a compound's own tree finds, until one meets.
template <typename Meets>
class ChildrenMeet final : public btDbvt::ICollide {
 public:
  explicit ChildrenMeet(const Meets& meets) : meets_(meets) {}
  bool found() const { return found_; }

  using btDbvt::ICollide::Process;
  void Process(const btDbvtNode* leaf) override { found_ = found_ || meets_(leaf->dataAsInt); }

 private:
  const Meets& meets_;
  bool found_ = false;
};

/// Whether meets(child) is true for any child, given by its index, that may be in a box in the world.
template <typename Meets>
bool anyChild(const btCompoundShape& compound, const btTransform& in_world, const Aabb& box,
              const Meets& meets) {
  const btDbvt* tree = compound.getDynamicAabbTree();
  if (tree && compound.getNumChildShapes() > kFewChildren) {
    btVector3 min, max;
    btTransformAabb(toBullet(box.min), toBullet(box.max), gContactBreakingThreshold, in_world.inverse(), min,
                    max);
    ChildrenMeet<Meets> children(meets);
    tree->collideTV(tree->m_root, btDbvtVolume::FromMM(min, max), children);
    return children.found();
  }
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    if (meets(i)) return true;
  }
  return false;
}

/// Whether meets(part) is true for any part. Parts outside the box may be skipped.
template <typename Meets>
bool anyPart(const btCollisionShape& shape, const btTransform& in_world, const Aabb& box,
             const Meets& meets) {
  if (!shape.isCompound()) return meets(partOf(shape, in_world));
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  return anyChild(compound, in_world, box, [&](int child) {
    return anyPart(*compound.getChildShape(child), in_world * compound.getChildTransform(child), box, meets);
  });
}

/// The body of a proxy.
struct Body {
  explicit Body(const btBroadphaseProxy& proxy)
      : shape(*bodyOf(proxy)->getCollisionShape()),
        whole(partOf(shape, bodyOf(proxy)->getWorldTransform())),
        box(whole.box) {
    box.extend(fromBullet(proxy.m_aabbMin));
    box.extend(fromBullet(proxy.m_aabbMax));
  }

  const btCollisionShape& shape;
  const Part whole;
  /// Bullet may leave the proxies of sleeping bodies unchanged after they were moved
  /// (setForceUpdateAllAabbs), so this box holds the proxy's box and the box at the body's current position.
  Aabb box;
};

bool clustersMeetBox(const Part& part, const Aabb& box, int depth, double ahead) {
  const Obb in_part = fromBullet(part.in_world).inverse() * obbOf(box);
  return clustersNear(part.ours->tree(), in_part, contactReach(*part.ours) + ahead, depth);
}

/// A body inside a solid may be far from the solid's surface, and so from its clusters.
bool isInside(const Vec3& point_in_world, const Part& part) {
  return part.ours->solid().contains(fromBullet(part.in_world).inverse() * point_in_world);
}

/// Whether one of a mesh's far vertices is inside another mesh. The narrow phase asks for the same vertices
/// of the smaller mesh (FarVerticesInSolid).
bool reachesInto(const Part& part, const Part& solid) {
  return solid.ours->solid().isAnywhereSolid() &&
         std::ranges::any_of(part.ours->farVertices().positions, [&](const Vec3& vertex) {
           return isInside(fromBullet(part.in_world) * vertex, solid);
         });
}

bool meet(const Part& a, const Part& b, int depth, double ahead) {
  // Some boxes are infinite, e.g. a plane's; the common box is finite. Both boxes are grown by `ahead`.
  const Aabb common{a.box.min.cwiseMax(b.box.min).array() - ahead,
                    a.box.max.cwiseMin(b.box.max).array() + ahead};
  if (common.isEmpty()) return false;
  if (a.ours && b.ours) {
    const Pose b_in_a = fromBullet(a.in_world).inverse() * fromBullet(b.in_world);
    const double reach = contactReach(*a.ours) + contactReach(*b.ours) + ahead;
    return clustersNear(a.ours->tree(), b.ours->tree(), b_in_a, reach, depth) || reachesInto(a, b) ||
           reachesInto(b, a);
  }
  if (a.ours) return clustersMeetBox(a, common, depth, ahead) || isInside(common.center(), a);
  if (b.ours) return clustersMeetBox(b, common, depth, ahead) || isInside(common.center(), b);
  return true;
}

}  // namespace

bool ClusterTest::holdsOurShape(const btCollisionShape& shape) {
  if (!shape.isCompound() || static_cast<const btCompoundShape&>(shape).getNumChildShapes() <= kFewChildren)
    return detail::holdsOurShape(shape);
  const auto [known, is_new] = holders_.try_emplace(&shape);
  if (is_new) known->second = detail::holdsOurShape(shape);
  return known->second;
}

bool ClusterTest::applies(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const btCollisionObject *body_a = bodyOf(a), *body_b = bodyOf(b);
  return isBody(body_a) && isBody(body_b) &&
         (holdsOurShape(*body_a->getCollisionShape()) || holdsOurShape(*body_b->getCollisionShape()));
}

bool ClusterTest::mayApply(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const btCollisionObject *body_a = bodyOf(a), *body_b = bodyOf(b);
  const auto mayHold = [](const btCollisionShape& shape) { return shape.isCompound() || asOurShape(shape); };
  return isBody(body_a) && isBody(body_b) &&
         (mayHold(*body_a->getCollisionShape()) || mayHold(*body_b->getCollisionShape()));
}

bool ClusterTest::separates(const btBroadphaseProxy& a, const btBroadphaseProxy& b, double ahead) {
  const Body body_a(a), body_b(b);
  // Calls meets(part) for the parts of a body in a box until it returns true.
  const auto anyPartOf = [&](const Body& body, const Aabb& box, const auto& meets) {
    if (body.whole.ours) return meets(body.whole);
    if (!holdsOurShape(body.shape)) return meets(Part{nullptr, body.whole.in_world, body.box});
    return anyPart(body.shape, body.whole.in_world, box, meets);
  };
  return !anyPartOf(body_a, body_b.box, [&](const Part& part_a) {
    return anyPartOf(body_b, part_a.box,
                     [&](const Part& part_b) { return meet(part_a, part_b, depth_, ahead); });
  });
}

}  // namespace octoblisk::detail
