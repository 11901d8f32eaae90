// Saves the shape in Bullet's files as a triangle mesh, which every importer knows. Additional data goes into
// the padding, which importers ignore.
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <LinearMath/btSerializer.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "octoblisk/triangle_mesh.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/restore.h"

namespace octoblisk {

namespace {

/// A mesh as a Bullet mesh interface. Each part stores the range of vertices that it uses.
class MeshInParts {
 public:
  MeshInParts(const TriangleMesh& mesh, const TriangleParts& parts) : mesh_(mesh) {
    indices_.reserve(3 * mesh.triangleCount());
    for (std::size_t part = 0; part < parts.count(); ++part) add(parts.begin(part), parts.begin(part + 1));
  }
  MeshInParts(const MeshInParts&) = delete;
  MeshInParts& operator=(const MeshInParts&) = delete;

  btTriangleIndexVertexArray& interface() { return interface_; }

 private:
  void add(std::uint32_t begin, std::uint32_t end) {
    std::uint32_t first = 0xffffffffu, last = 0;
    for (std::uint32_t t = begin; t < end; ++t) {
      const auto [low, high] = std::ranges::minmax(mesh_.triangles()[t]);
      first = std::min(first, low);
      last = std::max(last, high);
    }
    btIndexedMesh part;
    part.m_numTriangles = int(end - begin);
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_vertexStride = sizeof(Vec3);
    part.m_vertexType = PHY_DOUBLE;  // keeps the full precision of the vertices
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices_.data() + indices_.size());
    part.m_numVertices = begin < end ? int(last - first + 1) : 0;
    part.m_vertexBase =
        reinterpret_cast<const unsigned char*>(mesh_.vertices().data() + (begin < end ? first : 0));
    for (std::uint32_t t = begin; t < end; ++t) {
      for (const std::uint32_t vertex : mesh_.triangles()[t]) indices_.push_back(int(vertex - first));
    }
    interface_.addIndexedMesh(part, PHY_INTEGER);
  }

  const TriangleMesh& mesh_;
  std::vector<int> indices_;  // never grows beyond its reserved capacity
  btTriangleIndexVertexArray interface_;
};

constexpr char kOurs[3] = {'O', 'c', 't'};  // distinguishes our data from meshes saved by others
constexpr int kIsSurface = 1, kHasOwnMargin = 2, kFlags = 3;  // in the byte after kOurs

}  // namespace

int ClusteredOctreeShape::calculateSerializeBufferSize() const { return sizeof(btTriangleMeshShapeData); }

const char* ClusteredOctreeShape::serialize(void* buffer, btSerializer* serializer) const {
  auto* data = static_cast<btTriangleMeshShapeData*>(buffer);
  btConcaveShape::serialize(&data->m_collisionShapeData, serializer);
  data->m_collisionShapeData.m_shapeType = TRIANGLE_MESH_SHAPE_PROXYTYPE;
  MeshInParts mesh(*unscaled_, parts_);
  mesh.interface().setScaling(scaling_);
  mesh.interface().serialize(&data->m_meshInterface, serializer);
  data->m_quantizedFloatBvh = nullptr;  // importers build their own
  data->m_quantizedDoubleBvh = nullptr;
  data->m_triangleInfoMap = nullptr;
  data->m_collisionMargin = float(getMargin());
  const float threshold = float(contact_breaking_threshold_);
  static_assert(sizeof threshold == sizeof data->m_pad3 &&
                sizeof kOurs + 1 == sizeof data->m_collisionShapeData.m_padding);
  std::memcpy(data->m_pad3, &threshold, sizeof threshold);
  std::memcpy(data->m_collisionShapeData.m_padding, kOurs, sizeof kOurs);
  data->m_collisionShapeData.m_padding[kFlags] =
      static_cast<char>((may_be_solid_ ? 0 : kIsSurface) | (has_default_margin_ ? 0 : kHasOwnMargin));
  return "btTriangleMeshShapeData";
}

std::unique_ptr<ClusteredOctreeShape> restoredShape(const btCollisionShapeData& saved,
                                                    const btStridingMeshInterface& mesh) {
  if (saved.m_shapeType != TRIANGLE_MESH_SHAPE_PROXYTYPE) return nullptr;
  if (std::memcmp(saved.m_padding, kOurs, sizeof kOurs) != 0) return nullptr;
  const auto& data = reinterpret_cast<const btTriangleMeshShapeData&>(saved);
  auto shape = std::make_unique<ClusteredOctreeShape>(&mesh);
  float threshold;
  std::memcpy(&threshold, data.m_pad3, sizeof threshold);
  shape->setContactBreakingThreshold(btScalar(threshold));
  if ((saved.m_padding[kFlags] & kHasOwnMargin) != 0) shape->setMargin(btScalar(data.m_collisionMargin));
  shape->setSolid((saved.m_padding[kFlags] & kIsSurface) == 0);
  return shape;
}

}  // namespace octoblisk
