// Makes a shape from a mesh interface with any types, strides, counts and bytes. The interface is refused
// with a message, or the shape can be queried, scaled and written.
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstring>
#include <deque>

#include "fuzz/bytes.h"
#include "fuzz/fuzz_input.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/register.h"

using namespace octoblisk;

namespace {

using fuzz::Bytes;

/// Small integers, so that edges and planes are shared. One in eight is any number.
template <typename Number>
Number coordinateOf(Bytes& bytes) {
  const std::uint8_t kind = bytes.byte();
  return kind % 8 == 7 ? bytes.any<Number>() : static_cast<Number>(static_cast<std::int8_t>(kind)) / 8;
}

/// A part and its buffers. The buffers are as short as a caller's may be, so that a read beyond the end is
/// detected.
class Part {
 public:
  explicit Part(Bytes& bytes) {
    constexpr PHY_ScalarType kVertexTypes[] = {PHY_FLOAT, PHY_DOUBLE, PHY_FLOAT, PHY_SHORT};
    constexpr PHY_ScalarType kIndexTypes[] = {PHY_INTEGER, PHY_SHORT, PHY_UCHAR, PHY_FLOAT};
    const std::uint8_t types = bytes.byte();
    mesh.m_vertexType = kVertexTypes[types & 3];
    mesh.m_indexType = kIndexTypes[types >> 2 & 3];
    mesh.m_numVertices = static_cast<std::int8_t>(bytes.byte());
    mesh.m_numTriangles = static_cast<std::int8_t>(bytes.byte());
    const std::size_t vertices = static_cast<std::size_t>(std::max(0, mesh.m_numVertices)),
                      triangles = static_cast<std::size_t>(std::max(0, mesh.m_numTriangles));
    const std::size_t padding = types >> 4 & 7;
    const std::size_t scalar = mesh.m_vertexType == PHY_DOUBLE ? 8 : 4,
                      index = mesh.m_indexType == PHY_INTEGER ? 4
                              : mesh.m_indexType == PHY_SHORT ? 2
                                                              : 1;
    mesh.m_vertexStride = static_cast<int>(3 * scalar + padding);
    mesh.m_triangleIndexStride = static_cast<int>(3 * index + padding);
    vertices_.resize(vertices == 0 ? 0 : vertices * mesh.m_vertexStride - padding);
    indices_.resize(triangles == 0 ? 0 : triangles * mesh.m_triangleIndexStride - padding);
    for (std::size_t v = 0; v < vertices; ++v) {
      for (std::size_t k = 0; k < 3; ++k)
        putCoordinate(vertices_.data() + v * mesh.m_vertexStride + k * scalar, scalar, bytes);
    }
    for (std::size_t t = 0; t < triangles; ++t) {
      for (std::size_t k = 0; k < 3; ++k)
        putIndex(indices_.data() + t * mesh.m_triangleIndexStride + k * index, index, bytes);
    }
    mesh.m_vertexBase = vertices_.data();
    mesh.m_triangleIndexBase = indices_.data();
    if (types & 0x80) (bytes.byte() & 1 ? mesh.m_vertexBase : mesh.m_triangleIndexBase) = nullptr;
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  btIndexedMesh mesh;

 private:
  static void putCoordinate(unsigned char* to, std::size_t size, Bytes& bytes) {
    const auto single = size == 4 ? coordinateOf<float>(bytes) : 0.0f;
    const auto twice = size == 8 ? coordinateOf<double>(bytes) : 0.0;
    std::memcpy(to, size == 4 ? static_cast<const void*>(&single) : &twice, size);
  }

  /// Writes an index. It is usually that of a vertex.
  void putIndex(unsigned char* to, std::size_t size, Bytes& bytes) const {
    const std::uint8_t byte = bytes.byte();
    const std::uint32_t index = byte == 0xff             ? bytes.any<std::uint32_t>()
                                : byte >= 0xf0           ? byte
                                : mesh.m_numVertices > 0 ? byte % mesh.m_numVertices
                                                         : byte;
    std::memcpy(to, &index, size);  // the low bytes
  }

  std::vector<unsigned char> vertices_, indices_;
};

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
  btSphereShape ball{btScalar(2)};
  World() { registerAlgorithm(&dispatcher); }
};

struct Counter final : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    if (!std::isfinite(point.getDistance()) || !std::isfinite(point.m_normalWorldOnB.length2()))
      fuzz::fail("a contact that is not finite");
    return 0;
  }
};

void ask(ClusteredOctreeShape& shape) {
  static World world;
  shape.tree().validate();
  btVector3 low, high, inertia;
  shape.getAabb(btTransform::getIdentity(), low, high);
  shape.calculateLocalInertia(1, inertia);
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(inertia[k])) fuzz::fail("an inertia that is not finite");
  }

  btCollisionObject mesh, other, ball;
  mesh.setCollisionShape(&shape);
  other.setCollisionShape(&shape);
  ball.setCollisionShape(&world.ball);
  for (const btScalar x : {btScalar(0), btScalar(5)}) {
    ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(x, 1, 1)));
    Counter counter;
    world.world.contactPairTest(&mesh, &ball, counter);
    other.setWorldTransform(ball.getWorldTransform());
    world.world.contactPairTest(&mesh, &other, counter);
    const btTransform from(btQuaternion::getIdentity(), btVector3(x, 1, 20)),
        to(btQuaternion::getIdentity(), btVector3(-x, -1, -20));
    btCollisionWorld::ClosestRayResultCallback ray(from.getOrigin(), to.getOrigin());
    btCollisionWorld::rayTestSingle(from, to, &mesh, &shape, mesh.getWorldTransform(), ray);
  }
  btDefaultSerializer serializer;
  serializer.startSerialization();
  shape.serializeSingleShape(&serializer);
  serializer.finishSerialization();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t head = bytes.byte();
  std::deque<Part> parts;
  btTriangleIndexVertexArray source;
  for (int k = 0; k < (head & 3); ++k) {
    parts.emplace_back(bytes);
    source.addIndexedMesh(parts.back().mesh, parts.back().mesh.m_indexType);
  }
  const btVector3 scaling(coordinateOf<btScalar>(bytes), coordinateOf<btScalar>(bytes),
                          coordinateOf<btScalar>(bytes));
  if (head & 4) source.setScaling(scaling);
  try {
    ClusteredOctreeShape shape(&source,
                               {.threads = 1, .storage = head & 8 ? Storage::compact : Storage::full});
    ask(shape);
    shape.setLocalScaling(scaling);
    ask(shape);
    shape.refit(&source);
  } catch (const std::invalid_argument& refusal) {
    if (std::string_view(refusal.what()).empty()) fuzz::fail("a refusal without a word");
  }
  return 0;
}
