#include "octoblisk_bullet/mesh_concave_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>

#include <algorithm>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk {
namespace {

Aabb localBounds(const btConcaveShape& shape) {
  btVector3 min, max;
  shape.getAabb(btTransform::getIdentity(), min, max);
  return {fromBullet(min), fromBullet(max)};
}

/// Hands on what Bullet calls back with.
class Forward final : public btTriangleCallback {
 public:
  Forward(void (*visit)(void* user, const SourceTriangle& triangle), void* user)
      : visit_(visit), user_(user) {}

  void processTriangle(btVector3* corners, int part, int index) override {
    visit_(user_, {{fromBullet(corners[0]), fromBullet(corners[1]), fromBullet(corners[2])}, part, index});
  }

 private:
  void (*visit_)(void* user, const SourceTriangle& triangle);
  void* user_;
};

class ConcaveSource final : public TriangleSource {
 public:
  explicit ConcaveSource(const btConcaveShape& shape) : shape_(shape), bounds_(localBounds(shape)) {
    if (shape.getShapeType() != GIMPACT_SHAPE_PROXYTYPE) return;
    // GImpact rounds its boxes, and the one that is asked for, to the nearest of 65,535 steps across its
    // bounds grown by 1.
    slack_ = 1.01 * (2.0 * bounds_.halfExtents() + Vec3::Constant(2.0)) / 65535.0;
  }

  Aabb bounds() const override { return bounds_; }

  void forEachTriangleIn(const Aabb& box, void (*visit)(void* user, const SourceTriangle& triangle),
                         void* user) const override {
    const double farthest = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
    const Vec3 slack = slack_ + Vec3::Constant(4.0 * double(SIMD_EPSILON) * farthest);
    Forward forward(visit, user);
    shape_.processAllTriangles(&forward, toBullet(box.min - slack), toBullet(box.max + slack));
  }

 private:
  const btConcaveShape& shape_;
  Aabb bounds_;
  Vec3 slack_ = Vec3::Zero();
};

}  // namespace

void MeshConcaveAlgorithm::findContacts(const btCollisionObjectWrapper& mesh,
                                        const btCollisionObjectWrapper& other, double reach,
                                        std::vector<Contact>& found) {
  const auto& shape = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const ConcaveSource source(static_cast<const btConcaveShape&>(*other.getCollisionShape()));
  const Pose other_in_mesh =
      fromBullet(mesh.getWorldTransform()).inverse() * fromBullet(other.getWorldTransform());
  source_contacts_.find(shape.tree(), source, other_in_mesh, reach, found);
}

double MeshConcaveAlgorithm::marginOfOther(const btCollisionObjectWrapper& other) const {
  return double(other.getCollisionShape()->getMargin());
}

std::optional<SourceTriangle> MeshConcaveAlgorithm::triangleOfOther(const btCollisionObjectWrapper&,
                                                                    const Contact& contact) const {
  return source_contacts_.triangle(contact.triangle_b);
}

}  // namespace octoblisk
