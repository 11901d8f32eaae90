#include "octoblisk_bullet/mesh_convex_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <algorithm>

#include "octoblisk/contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk {
namespace {

/// Bullet's convex shapes are a core and a margin round it, as ours are.
class BulletConvex final : public Convex {
 public:
  explicit BulletConvex(const btConvexShape& shape)
      : shape_(shape), margin_(double(shape.getMarginNonVirtual())) {}

  Vec3 support(const Vec3& direction) const override {
    return fromBullet(shape_.localGetSupportVertexWithoutMarginNonVirtual(toBullet(direction.normalized())));
  }
  double radius() const override { return margin_; }
  double precision() const override { return std::max(16.0 * double(SIMD_EPSILON), 1e-9); }

 private:
  const btConvexShape& shape_;
  const double margin_;
};

}  // namespace

void MeshConvexAlgorithm::findContacts(const btCollisionObjectWrapper& mesh,
                                       const btCollisionObjectWrapper& other, double reach,
                                       std::vector<Contact>& found) {
  const auto& shape = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const BulletConvex convex(static_cast<const btConvexShape&>(*other.getCollisionShape()));
  const Pose convex_in_mesh =
      fromBullet(mesh.getWorldTransform()).inverse() * fromBullet(other.getWorldTransform());
  contacts(shape.tree(), convex, convex_in_mesh, reach, found);
}

}  // namespace octoblisk
