// Closed meshes, and oracles of what is inside them. All seeded, all by looking at every triangle.
#pragma once

#include "octoblisk/contact.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

/// Cells [i, i+1]×[j, j+1]×[k, k+1] of a grid, each filled with a probability of one half, and the faces
/// between full and empty ones. Closed, outward; cells may meet in edges or corners alone.
struct Voxels {
  int size;
  std::vector<bool> full;
  SharedMesh mesh;

  bool at(int i, int j, int k) const;
};
Voxels randomVoxels(std::mt19937_64& random, int size);

/// Every vertex moved by the pose after it was scaled.
SharedMesh moved(const TriangleMesh& mesh, const Pose& pose, double scale = 1.0);
SharedMesh scaledAndMoved(const SharedMesh& mesh, double scale, const Vec3& offset);

/// All triangles of both, unconnected.
SharedMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// Without its triangles from `count` on.
SharedMesh firstTriangles(const TriangleMesh& mesh, std::size_t count);

/// How often an oriented surface winds round a point (Van Oosterom, Strackee 1983): 1 inside, 0 outside, as
/// the sum of the solid angles of all triangles.
double windingNumber(const TriangleMesh& mesh, const Vec3& point);

/// The distance to the nearest triangle, by a search of each triangle that shares no step with the library's.
double bruteForceDistance(const TriangleMesh& mesh, const Vec3& point);
double bruteForceDistance(const Triangle& triangle, const Vec3& point);

/// How deep the deepest is of the contacts that push the short way, below 0; 0 where none does. These are
/// contacts of A and B, not all; one pushes the short way where what it pushes is inside the body that it is
/// pushed out of, and no part of the surface is nearer than half of the way.
double deepestShortWay(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a,
                       const std::vector<Contact>& contacts);

}  // namespace octoblisk::testing
