// A closed mesh as a solid: bodies inside it are pushed out.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/function_ref.h"

namespace octoblisk::detail {

/// Whether a point is inside a closed mesh. Exact. Allocates nothing.
bool isInSolid(const ClusteredOctree& tree, const Vec3& point);

/// Whether a moving point is inside a closed mesh. Exact, except within rounding of the surface. Searches the
/// tree only if the point may have crossed the surface since the last call. Allocates nothing.
class PointInSolid {
 public:
  /// The point is in the mesh's frame. Its distance to the surface is at least leastClearance(), which is
  /// called if earlier clearances do not suffice. A number below 0 says nothing.
  bool contains(const ClusteredOctree& tree, const Vec3& point, FunctionRef<double()> leastClearance);
  bool contains(const ClusteredOctree& tree, const Vec3& point) {
    return contains(tree, point, [] { return 0.0; });
  }

  /// Call this after the mesh has changed.
  void forget() { *this = {}; }

 private:
  std::optional<Vec3> last_;  // the point of the last call
  bool is_inside_ = false;    // the last point
  double clearance_ = 0.0;    // at most its distance to the surface
};

/// Converts contacts between the triangles of a closed mesh (A) and a convex body (B) to contacts with the
/// solid A. Triangles do not know which of their sides is solid, and push B out of the nearer one.
/// - If B's middle is inside A, B leaves through the point of the surface that is closest to the middle. This
///   contact is added, and the contacts that push against it are removed.
/// - If B's middle is outside A and an end of its core is inside, the closest point of the surface to the end
///   gets a contact as well, if that way out leads to the middle. It is as deep as the end and the radius
///   around it.
/// - If B's middle is outside A, contacts that would push B through the solid are removed, if others touch. A
///   contact does so if the middle is behind its plane by no more than the contact's depth.
/// All triangles within `reach` of B have contacts.
void toSolidContacts(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_mesh,
                     double reach, PointInSolid& middle, std::vector<Contact>& contacts);

/// The vertices of a mesh that are farthest out along its axes and diagonals, in the mesh's frame.
struct FarVertices {
  static constexpr std::size_t kCount = 14;
  std::array<Vec3, kCount> positions;
};
FarVertices farVertices(const ClusteredOctree& tree);

/// Tests whether the far vertices of a mesh (B) are inside a closed mesh (A). Triangles that meet do not show
/// what is deeper inside.
class FarVerticesInSolid {
 public:
  /// Replaces `ways_out` with contacts of A and B. If the surfaces meet, each far vertex that is deeper
  /// inside A than `least_depth` gets a contact that moves it out. If they do not meet, and far vertices are
  /// inside A, all contacts push B in one direction: the shortest way out of B's middle, or of a far vertex
  /// if the middle does not show the way. B's farthest vertex in this direction and each far vertex inside A
  /// get a contact.
  void find(const ClusteredOctree& a, const ClusteredOctree& b, const FarVertices& far_of_b,
            const Pose& b_in_a, bool meet, double least_depth, std::vector<Contact>& ways_out);

  /// Call this after one of the meshes has changed.
  void forget() { in_a_ = {}; }

 private:
  std::array<PointInSolid, FarVertices::kCount> in_a_;
};

}  // namespace octoblisk::detail
