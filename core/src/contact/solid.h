// A closed mesh as a solid: what is inside is pushed out.
#pragma once

#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"

namespace octoblisk::detail {

/// Whether a point is inside a closed mesh, exactly. Allocates nothing.
bool isInSolid(const ClusteredOctree& tree, const Vec3& point);

/// Whether a point that moves is inside a closed mesh, exactly. Looks into the tree only when the point may
/// have crossed the surface since the last look. Allocates nothing.
class PointInSolid {
 public:
  /// The point is in the mesh's frame.
  bool contains(const ClusteredOctree& tree, const Vec3& point);

  /// The mesh has changed.
  void forget() { clearance_ = -1.0; }

 private:
  Vec3 point_ = Vec3::Zero();  // of the last look
  double clearance_ = -1.0;    // its distance to the surface; below 0: there was no look
  bool is_inside_ = false;
};

/// Makes contacts of the triangles of a closed mesh (A) and a convex body (B) those of the solid. Triangles
/// do not know which side of them is solid, and push B out of the nearer one.
/// - If B's middle is inside, B leaves by the point of the surface closest to the middle. This contact is
///   added, and the contacts that push against it are removed.
/// - If it is outside, contacts that would push it through the solid are removed, unless all would: those
///   whose plane the middle is behind, by no more than they are deep.
void toSolidContacts(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_mesh,
                     PointInSolid& middle, std::vector<Contact>& contacts);

/// The corners of a mesh (B) that are farthest out in 14 directions, and whether they are inside a closed
/// mesh (A). Triangles that meet tell nothing of what is deeper inside.
class CornersInSolid {
 public:
  /// Replaces `ways_out` by contacts of A and B. If the surfaces `meet`, there is one for each of the corners
  /// that is deeper inside A than `least_depth`, and it moves the corner out. Otherwise there is at most one,
  /// for a B that is inside A, and it moves all of B out.
  void find(const ClusteredOctree& a, const TriangleMesh& b, const Pose& b_in_a, bool meet,
            double least_depth, std::vector<Contact>& ways_out);

  /// One of the meshes has changed.
  void forget() { corners_.clear(); }

 private:
  struct Corner {
    Vec3 position;  // in the frame of B
    PointInSolid in_a;
  };

  void findCorners(const TriangleMesh& b);

  std::vector<Corner> corners_;
};

}  // namespace octoblisk::detail
