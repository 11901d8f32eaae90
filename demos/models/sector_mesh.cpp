#include "models/sector_mesh.h"

#include <Eigen/Geometry>
#include <numbers>

namespace octoblisk::demos {

SectorMesh::SectorMesh(int sector_count)
    : sector_count_(sector_count), pitch_(2.0 * std::numbers::pi / sector_count) {}

SectorVertex SectorMesh::addVertex(const CylindricalPoint& point) {
  points_.push_back(point);
  return {static_cast<std::uint32_t>(points_.size() - 1), 0};
}

Vec3 SectorMesh::position(SectorVertex vertex) const {
  CylindricalPoint point = points_[vertex.index];
  point.angle += 2.0 * std::numbers::pi * vertex.sector / sector_count_;
  return toCartesian(point);
}

void SectorMesh::addQuad(SectorVertex a, SectorVertex b, SectorVertex c, SectorVertex d, bool of_blade) {
  if (a == b || c == d) {
    faces_.push_back({{a, a == b ? c : b, a == b ? d : c}, of_blade});
    return;
  }
  const Vec3 corner_a = position(a);
  const Vec3 corner_b = position(b);
  const Vec3 corner_c = position(c);
  const Vec3 corner_d = position(d);
  const auto agree = [](const Triangle& s, const Triangle& t) {
    return scaledNormal(s).dot(scaledNormal(t)) > 0.0;
  };
  const bool flat_along_ac = agree({corner_a, corner_b, corner_c}, {corner_a, corner_c, corner_d});
  const bool flat_along_bd = agree({corner_a, corner_b, corner_d}, {corner_b, corner_c, corner_d});
  constexpr double kTie = 1.0 + 1e-6;  // equal diagonals are all cut in the same way, whatever the rounding
  const bool ac_is_shorter = (corner_c - corner_a).norm() <= kTie * (corner_d - corner_b).norm();
  if (flat_along_ac == flat_along_bd ? ac_is_shorter : flat_along_ac) {
    faces_.push_back({{a, b, c}, of_blade});
    faces_.push_back({{a, c, d}, of_blade});
  } else {
    faces_.push_back({{a, b, d}, of_blade});
    faces_.push_back({{b, c, d}, of_blade});
  }
}

Blisk SectorMesh::repeat() const {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<int> blade_of_triangle;
  vertices.reserve(points_.size() * sector_count_);
  triangles.reserve(faces_.size() * sector_count_);
  blade_of_triangle.reserve(faces_.size() * sector_count_);

  const auto points = static_cast<std::uint32_t>(points_.size());
  const auto index = [&](SectorVertex vertex, int sector) {
    const int wrapped = ((vertex.sector + sector) % sector_count_ + sector_count_) % sector_count_;
    return static_cast<std::uint32_t>(wrapped) * points + vertex.index;
  };
  for (int sector = 0; sector < sector_count_; ++sector) {
    for (std::uint32_t p = 0; p < points; ++p) vertices.push_back(position({p, sector}));
    for (const Face& face : faces_) {
      triangles.push_back(
          {index(face.corners[0], sector), index(face.corners[1], sector), index(face.corners[2], sector)});
      blade_of_triangle.push_back(face.of_blade ? sector + 1 : 0);
    }
  }
  return {TriangleMesh(std::move(vertices), std::move(triangles)), std::move(blade_of_triangle)};
}

}  // namespace octoblisk::demos
