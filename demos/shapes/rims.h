// Closed meshes around the z axis, made of the surfaces between their rims.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "shapes/bodies.h"

namespace octoblisk::shapes {

/// Joins vertices at equal positions, and leaves out triangles without area.
class Welded {
 public:
  std::uint32_t vertex(const Vec3& position);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  /// Call it once, at the end.
  SharedMesh mesh();

 private:
  std::map<std::tuple<double, double, double>, std::uint32_t> number_;
  std::vector<Vec3> vertices_;
  std::vector<TriangleMesh::Indices> triangles_;
};

/// Vertices around the z axis, counter-clockwise seen from above. A surface between reversed rims faces the
/// other way. The two rims of a surface have equally many vertices.
using Rim = std::vector<std::uint32_t>;
Rim reversed(Rim rim);

/// Adds a ring at constant z between two rims; it faces up.
void addRing(Welded& mesh, const Rim& inner, const Rim& outer);

/// Adds a disk at constant z within a rim; it faces up.
void addDisk(Welded& mesh, const Rim& rim, double z);

/// Adds the wall between two rims; it faces outward.
void addWall(Welded& mesh, const Rim& low, const Rim& high);

}  // namespace octoblisk::shapes
