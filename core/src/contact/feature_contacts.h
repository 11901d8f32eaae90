// The contacts of two solids: pairs of features, each in a direction in which both can be pushed.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "contact/mesh_features.h"
#include "contact/near_features.h"
#include "geometry/intersection_curve.h"
#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// Most contacts are a corner and a face, or two sharp edges that cross. The normal is the face's normal, or
/// the perpendicular to both edges, and it is in the cones of directions in which both features can be pushed
/// (D. Gregorius, The separating axis test between convex polyhedra, GDC 2013). The distance is that along
/// the normal. A corner outside the other solid has a contact with each face over which it is. A corner
/// inside has one with the nearest point of the surface.
class FeatureContacts {
 public:
  /// Replaces `found` with the contacts of the solids A and B within `reach`. Distances less than 1/40 of
  /// `spacing` have no effect. If no contact is as near as the nearest points of the surfaces, these are one.
  /// If triangles meet where no contact is near, their curve has a contact along its way out; its points are
  /// on neither surface. Returns false where features do not say the way out: if a corner or an edge is
  /// deeper than half the reach, or if such a curve is planar. Allocates nothing once warm.
  bool find(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, double reach, double spacing,
            std::vector<Contact>& found);

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  /// A corner over or under the faces near it.
  struct Heights {
    double nearest = kFar;  ///< the height of the least magnitude
    std::uint32_t face = kNoTriangle;
    bool is_pushed = false;   ///< whether that face can push the corner
    bool is_located = false;  ///< whether the corner is known to be inside or outside
  };
  /// A face that can push a corner.
  struct Push {
    CornerAndFace pair;
    Vec3 point, normal;
    double height;
  };

  void addCorners(const MeshFeatures& own, const MeshFeatures& other, const Pose& own_in_other,
                  std::span<const CornerAndFace> pairs);
  void locateCorner(const MeshFeatures& own, const MeshFeatures& other, const Pose& own_in_other,
                    const CornerAndFace& pair, Heights& heights);
  void addCorner(const CornerAndFace& pair, const Vec3& point, const Vec3& normal, double height);
  void addEdges(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a);
  std::size_t countUnfelt(const MeshFeatures& a, const MeshFeatures& b);
  bool addCrossings(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, std::size_t unfelt);
  bool addCrossing(const TrianglePair& pair);

  double reach_ = 0.0, not_felt_ = 0.0;
  bool is_deep_ = false;               // whether a corner is deeper than half the reach
  std::vector<TrianglePair> meeting_;  // the triangles that meet
  NearFeatures near_;
  std::vector<Heights> heights_;  // per corner of one mesh
  std::vector<Push> pushes_;
  std::vector<char> is_felt_a_,
      is_felt_b_;  // per corner: whether a triangle at it has a contact that touches
  std::vector<Contact> contacts_;
  DisjointSets groups_;  // of triangles of A, then of B, that meet
  std::vector<CurveSegment> curve_;
};

}  // namespace octoblisk::detail
