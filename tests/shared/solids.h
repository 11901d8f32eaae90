// Seeded closed meshes, and brute-force oracles for points inside them.
#pragma once

#include "octoblisk/contact.h"
#include "octoblisk/function_ref.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

/// Cells [i, i+1]×[j, j+1]×[k, k+1] of a grid, each full with probability 1/2, and the faces between full and
/// empty cells. The mesh is closed and faces outward. Cells may meet only in edges or corners.
struct Voxels {
  int size;
  std::vector<bool> full;
  SharedMesh mesh;

  bool at(int i, int j, int k) const;
};
Voxels randomVoxels(std::mt19937_64& random, int size);

/// A cup around the z axis, from z = 0 to `height`. Its walls are `wall` thick along the radius and its
/// bottom along z. The radii are those of the outside.
SharedMesh cup(double bottom_radius, double top_radius, double height, double wall, std::uint32_t segments);

/// The mesh with the map applied to every vertex.
SharedMesh deformed(const TriangleMesh& mesh, FunctionRef<Vec3(const Vec3&)> map);

/// Scales every vertex and then moves it by the pose.
SharedMesh moved(const TriangleMesh& mesh, const Pose& pose, double scale = 1.0);
SharedMesh scaledAndMoved(const SharedMesh& mesh, double scale, const Vec3& offset);

/// All triangles of both meshes, unconnected.
SharedMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// The mesh with all triangles turned around.
SharedMesh insideOut(const TriangleMesh& mesh);

/// The first `count` triangles of the mesh.
SharedMesh firstTriangles(const TriangleMesh& mesh, std::size_t count);

/// The winding number of an oriented surface around a point: 1 inside, 0 outside. It is the sum of the solid
/// angles of all triangles (Van Oosterom, Strackee 1983).
double windingNumber(const TriangleMesh& mesh, const Vec3& point);

/// The distance to the nearest triangle, by brute force that shares no step with the library.
double bruteForceDistance(const TriangleMesh& mesh, const Vec3& point);
double bruteForceDistance(const Triangle& triangle, const Vec3& point);

}  // namespace octoblisk::testing
