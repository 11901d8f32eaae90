// The vertices of a mesh that are farthest out, and their contacts inside a solid.
#pragma once

#include <array>
#include <vector>

#include "contact/point_in_solid.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// The vertices of a mesh that are farthest out along its axes and diagonals, in the mesh's frame.
struct FarVertices {
  static constexpr std::size_t kCount = 14;
  std::array<Vec3, kCount> positions;
};
FarVertices farVertices(const ClusteredOctree& tree);

/// Tests whether the far vertices of a mesh (B) are inside a solid (A). Triangles that meet do not show
/// what is deeper inside.
class FarVerticesInSolid {
 public:
  /// Replaces `ways_out` with contacts of A and B. If the surfaces meet, each far vertex that is deeper
  /// inside A than `least_depth` gets a contact that moves it out. If they do not meet, and far vertices are
  /// inside A, all contacts push B in one direction: the shortest way out of B's middle, or of a far vertex
  /// if the middle does not show the way. B's farthest vertex in this direction and each far vertex inside A
  /// get a contact.
  void find(const SolidMesh& a, const ClusteredOctree& b, const FarVertices& far_of_b, const Pose& b_in_a,
            bool meet, double least_depth, std::vector<Contact>& ways_out);

  /// Call this after one of the meshes has changed.
  void forget() { in_a_ = {}; }

 private:
  std::array<PointInSolid, FarVertices::kCount> in_a_;
};

}  // namespace octoblisk::detail
