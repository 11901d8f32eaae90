#include "mesh_concave_algorithm.h"

#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>

#include <algorithm>
#include <utility>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "orthonormal_pose.h"
#include "shape_bounds.h"

namespace octoblisk::detail {
namespace {

/// The direction in which the triangles of a shape face.
class Facing {
 public:
  explicit Facing(const btConcaveShape& shape) {
    if (const auto* heights = dynamic_cast<const btHeightfieldTerrainShape*>(&shape)) {
      up_axis_ = heights->getUpAxis();
      return;
    }
    if (shape.getShapeType() == FAST_CONCAVE_MESH_PROXYTYPE)
      return;  // third-party: leave the triangles as they are
    turned_ = isMirrored(shape);
    const auto* scaled = dynamic_cast<const btScaledBvhTriangleMeshShape*>(&shape);
    if (scaled) turned_ ^= isMirrored(*scaled->getChildShape());
  }

  /// Reverses a triangle that faces inward: in a mirrored mesh, or in a heightfield whose up axis is not y,
  /// where triangles face down.
  void correct(Triangle& triangle) const {
    const bool is_inward = up_axis_ >= 0 ? scaledNormal(triangle)[up_axis_] < 0.0 : turned_;
    if (is_inward) std::swap(triangle[1], triangle[2]);
  }

 private:
  static bool isMirrored(const btCollisionShape& shape) {
    return (fromBullet(shape.getLocalScaling()).array() < 0.0).count() % 2 == 1;
  }

  int up_axis_ = -1;  // of a heightfield
  bool turned_ = false;
};

/// Passes on the triangles of Bullet's callback.
class Forward final : public btTriangleCallback {
 public:
  Forward(const Facing& facing, FunctionRef<void(const SourceTriangle& triangle)> visit)
      : facing_(facing), visit_(visit) {}

  void processTriangle(btVector3* corners, int part, int index) override {
    SourceTriangle triangle{
        {fromBullet(corners[0]), fromBullet(corners[1]), fromBullet(corners[2])}, part, index};
    facing_.correct(triangle.corners);
    visit_(triangle);
  }

 private:
  const Facing& facing_;
  FunctionRef<void(const SourceTriangle& triangle)> visit_;
};

class ConcaveSource final : public TriangleSource {
 public:
  explicit ConcaveSource(const btConcaveShape& shape)
      : shape_(shape), facing_(shape), bounds_(shapeBounds(shape)) {
    if (shape.getShapeType() != GIMPACT_SHAPE_PROXYTYPE) return;
    // GImpact rounds its boxes and the query box to the nearest of 65,535 steps across its bounds grown by 1.
    slack_ = 1.01 * (2.0 * bounds_.halfExtents() + Vec3::Constant(2.0)) / 65535.0;
  }

  Aabb bounds() const override { return bounds_; }

  void forEachTriangleIn(const Aabb& box,
                         FunctionRef<void(const SourceTriangle& triangle)> visit) const override {
    const double farthest = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
    const Vec3 slack = slack_ + Vec3::Constant(4.0 * double(SIMD_EPSILON) * farthest);
    Forward forward(facing_, visit);
    shape_.processAllTriangles(&forward, toBullet(box.min - slack), toBullet(box.max + slack));
  }

 private:
  const btConcaveShape& shape_;
  const Facing facing_;
  Aabb bounds_;
  Vec3 slack_ = Vec3::Zero();
};

}  // namespace

void MeshConcaveAlgorithm::findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) {
  const ConcaveSource source(static_cast<const btConcaveShape&>(shapes.other));
  source_contacts_.find(shapes.treeOfMesh(), source, shapes.other_in_mesh, shapes.reach, found);
}

bool MeshConcaveAlgorithm::readOther(const PosedShapes& shapes) {
  const Obb box = shapes.other_in_mesh.inverse() * obbOf(shapes.treeOfMesh().mesh().bounds());
  return !sheet_.read(ConcaveSource(static_cast<const btConcaveShape&>(shapes.other)),
                      boundsOf(box.corners()).grown(shapes.reach));
}

void MeshConcaveAlgorithm::findBodyContacts(const PosedShapes& shapes, std::vector<Contact>& found) {
  found.clear();
  if (sheet_.isEmpty()) return;
  feature_contacts_.find(shapes.mesh.features(), sheet_.features(), orthonormal(shapes.other_in_mesh),
                         shapes.other_when_apart, shapes.reach, shapes.breaking, found);
}

}  // namespace octoblisk::detail
