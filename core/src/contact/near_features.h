// The pairs of features of two meshes that may be in contact, and the triangles that meet.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/mesh_features.h"
#include "octoblisk/contact.h"
#include "simd/box8.h"

namespace octoblisk::detail {

/// A corner of one mesh, the triangle with which it is listed, and a face of the other mesh over or under
/// which it is.
struct CornerAndFace {
  std::uint32_t corner, triangle, face;
};

struct EdgeAndEdge {
  const SharpEdge *of_a, *of_b;
};

/// What the search knows of one mesh's leaves near the other mesh, in single precision.
struct LeavesNearby {
  /// Up to eight corners of a leaf, in the other tree's local frame.
  struct Corners {
    float position[3][kLanes];
    std::uint32_t corner[kLanes], triangle[kLanes];
  };
  /// An edge, and a ball around it in A's local frame.
  struct Edge {
    const SharpEdge* edge;
    float middle[3], radius;
  };
  /// Eight planes: unit normals, and heights over the origin.
  struct Planes {
    float normal[3][kLanes];
    float height[kLanes];
  };
  /// The faces of a leaf in its frame.
  struct Faces {
    Planes faces;
    Planes edges[3];  ///< through the faces' edges, perpendicular to the faces, facing outward
  };
  struct Leaf {
    std::uint32_t slot;
    std::uint32_t corners_begin, corners_end;
    std::uint32_t edges_begin, edges_end;
    NormalCone against;  ///< that of the corners, in the other mesh's frame
    /// The box of the points that are over or under the faces, within the reach; in the tree's local frame.
    float axes[3][3];
    float center[3];  ///< along the axes
    float half_extents[3];
  };

  std::vector<std::uint32_t> place;  // per slot: the place of its leaf in `leaves`, or none
  std::vector<Leaf> leaves;
  std::vector<Faces> faces;  // of the leaves
  std::vector<Corners> corners;
  std::vector<Edge> edges;
};

/// Finds the pairs of features of two meshes that may be in contact, and the triangles that meet, in one
/// traversal. Allocates nothing once warm.
class NearFeatures {
 public:
  std::vector<CornerAndFace> corners_of_a, corners_of_b;
  std::vector<EdgeAndEdge> edges;
  std::vector<TrianglePair> meeting;  ///< those of touchingPairs, in the order of the traversal

  /// Finds all pairs of triangles that meet. Also finds all pairs of a corner and a face whose height is
  /// within `reach`, on either side, and the pairs of edges of at least the sharpness `least_sharpness` whose
  /// leaves are within `reach`; also a few others. A corner is over a face if it is beside it by no more than
  /// kAlike times its height, because the faces around it may slope.
  void find(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, double reach,
            float least_sharpness);

 private:
  LeavesNearby of_a_, of_b_;
};

}  // namespace octoblisk::detail
