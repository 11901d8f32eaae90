#include "octoblisk_bullet/mesh_interface.h"

#include <BulletCollision/CollisionShapes/btStridingMeshInterface.h>

#include <cstring>
#include <stdexcept>
#include <string>

namespace octoblisk {

namespace {

/// One part, locked for reading while this object lives.
class LockedPart {
 public:
  LockedPart(const btStridingMeshInterface& source, int part) : source_(source), part_(part) {
    source.getLockedReadOnlyVertexIndexBase(&vertices_, vertex_count, vertex_type_, vertex_stride_, &indices_,
                                            index_stride_, triangle_count, index_type_, part);
  }
  ~LockedPart() { source_.unLockReadOnlyVertexBase(part_); }
  LockedPart(const LockedPart&) = delete;
  LockedPart& operator=(const LockedPart&) = delete;

  void requireUsable() const {
    const auto require = [&](int count, const unsigned char* data, int stride, const char* what) {
      const std::string number = std::to_string(count);
      if (count < 0) throw unusable(number + " " + what);
      if (count > 0 && !data) throw unusable("a null pointer to its " + number + " " + what);
      if (count > 1 && stride == 0) throw unusable("a stride of 0 between its " + number + " " + what);
    };
    require(vertex_count, vertices_, vertex_stride_, "vertices");
    require(triangle_count, indices_, index_stride_, "triangles");
  }

  Vec3 vertex(int v) const {
    const unsigned char* data = vertices_ + static_cast<std::ptrdiff_t>(v) * vertex_stride_;
    switch (vertex_type_) {
      case PHY_FLOAT:
        return read<float>(data);
      case PHY_DOUBLE:
        return read<double>(data);
      default:
        throw unusable("an unsupported vertex type");
    }
  }

  std::array<std::uint32_t, 3> triangle(int t) const {
    const unsigned char* data = indices_ + static_cast<std::ptrdiff_t>(t) * index_stride_;
    switch (index_type_) {
      case PHY_INTEGER:
        return readIndices<std::uint32_t>(data);
      case PHY_SHORT:
        return readIndices<std::uint16_t>(data);
      case PHY_UCHAR:
        return readIndices<std::uint8_t>(data);
      default:
        throw unusable("an unsupported index type");
    }
  }

  int vertex_count = 0;
  int triangle_count = 0;

 private:
  template <typename Scalar>
  static Vec3 read(const unsigned char* data) {  // memcpy, because strides may leave the numbers unaligned
    Scalar xyz[3];
    std::memcpy(xyz, data, sizeof xyz);
    return {double(xyz[0]), double(xyz[1]), double(xyz[2])};
  }

  template <typename Index>
  static std::array<std::uint32_t, 3> readIndices(const unsigned char* data) {
    Index corner[3];
    std::memcpy(corner, data, sizeof corner);
    return {corner[0], corner[1], corner[2]};
  }

  std::invalid_argument unusable(const std::string& what) const {
    return std::invalid_argument("part " + std::to_string(part_) + " of the mesh interface has " + what);
  }

  const btStridingMeshInterface& source_;
  const int part_;
  const unsigned char* vertices_ = nullptr;
  const unsigned char* indices_ = nullptr;
  PHY_ScalarType vertex_type_ = PHY_FLOAT, index_type_ = PHY_INTEGER;
  int vertex_stride_ = 0, index_stride_ = 0;
};

}  // namespace

InterfaceMesh readMeshInterface(const btStridingMeshInterface& source) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<std::uint32_t> part_begin;
  for (int p = 0; p < source.getNumSubParts(); ++p) {
    const LockedPart part(source, p);
    part.requireUsable();
    part_begin.push_back(static_cast<std::uint32_t>(triangles.size()));
    const auto first_vertex = static_cast<std::uint32_t>(vertices.size());
    for (int v = 0; v < part.vertex_count; ++v) vertices.push_back(part.vertex(v));
    for (int t = 0; t < part.triangle_count; ++t) {
      TriangleMesh::Indices corners = part.triangle(t);
      for (std::uint32_t& index : corners) {
        if (index >= static_cast<std::uint32_t>(part.vertex_count)) {
          throw std::invalid_argument("triangle " + std::to_string(t) + " of part " + std::to_string(p) +
                                      " uses vertex " + std::to_string(static_cast<std::int32_t>(index)) +
                                      ", but the part has " + std::to_string(part.vertex_count) +
                                      " vertices");
        }
        index += first_vertex;
      }
      triangles.push_back(corners);
    }
  }
  return {TriangleMesh(std::move(vertices), std::move(triangles)), std::move(part_begin)};
}

}  // namespace octoblisk
