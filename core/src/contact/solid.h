// A closed mesh as a solid: what is inside is pushed out.
#pragma once

#include <array>
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
  void forget() { *this = {}; }

 private:
  Vec3 point_ = Vec3::Zero();  // of the last look
  double clearance_ = 0.0;     // its distance to the surface, from the second look on
  bool is_inside_ = false;
  bool has_looked_ = false;
};

/// Makes contacts of the triangles of a closed mesh (A) and a convex body (B) those of the solid. Triangles
/// do not know which side of them is solid, and push B out of the nearer one.
/// - If B's middle is inside, B leaves by the point of the surface closest to the middle. This contact is
///   added, and the contacts that push against it are removed.
/// - If it is outside, contacts that would push it through the solid are removed, unless all would: those
///   whose plane the middle is behind, by no more than they are deep.
void toSolidContacts(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_mesh,
                     PointInSolid& middle, std::vector<Contact>& contacts);

/// The vertices of a mesh that are farthest out along its axes and its diagonals, in its frame.
struct FarVertices {
  std::array<Vec3, 14> positions;
};
FarVertices farVertices(const ClusteredOctree& tree);

/// Whether the far vertices of a mesh (B) are inside a closed mesh (A). Triangles that meet tell nothing of
/// what is deeper inside.
class FarVerticesInSolid {
 public:
  /// Replaces `ways_out` by contacts of A and B. If the surfaces `meet`, each far vertex that is deeper
  /// inside A than `least_depth` has a contact that moves it out. Otherwise, if B is inside A, one contact
  /// moves all of B out.
  void find(const ClusteredOctree& a, const ClusteredOctree& b, const FarVertices& far_of_b,
            const Pose& b_in_a, bool meet, double least_depth, std::vector<Contact>& ways_out);

  /// One of the meshes has changed.
  void forget() { in_a_ = {}; }

 private:
  std::array<PointInSolid, 14> in_a_;
};

}  // namespace octoblisk::detail
