// The contacts of two solids: pairs of features, each in a direction in which both can be pushed.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "contact/inside_corners.h"
#include "contact/mesh_features.h"
#include "contact/near_features.h"
#include "contact/solid_mesh.h"
#include "geometry/intersection_curve.h"
#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// Most contacts are a corner and a face, or two sharp edges that cross. The normal is the face's normal, or
/// the perpendicular to both edges, and it is in the cones of directions in which both features can be pushed
/// (D. Gregorius, The separating axis test between convex polyhedra, GDC 2013). The distance is that along
/// the normal. A corner outside the other solid has a contact with each face over which it is. A corner
/// inside has one with the nearest point of the surface. If that point cannot push the corner, the contact is
/// with the face straight ahead along the normal of a face that a triangle at the corner meets.
class FeatureContacts {
 public:
  /// A solid and the features of its boundary.
  struct Solid {
    const MeshFeatures& features;
    SolidMesh mesh;
  };

  /// Replaces `found` with the contacts of the solids A and B within `reach`. Distances less than 1/40 of
  /// `spacing` have no effect. If no contact is as near as the nearest points of the surfaces, these are one.
  /// If triangles meet where no contact is near, their curve has a contact along its way out; its points are
  /// on neither surface. The pose is orthonormal in double precision. Allocates nothing once warm.
  void find(const Solid& a, const Solid& b, const Pose& b_in_a, double reach, double spacing,
            const std::optional<Pose>& before, std::vector<Contact>& found);

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  struct PosedSolid {
    const MeshFeatures& features;
    const SolidMesh& mesh;
    Pose in_a, before_in_a;
  };
  /// A face that can push a corner.
  struct Push {
    CornerAndFace pair;
    Vec3 point, normal;
    double height;
  };

  /// A corner inside that the nearest point of the surface cannot push, and a face that can.
  struct CornerWayBack {
    std::uint32_t corner;
    Vec3 to_nearest;  ///< the direction to that point
    std::uint32_t face = kNoTriangle;
    Vec3 normal = Vec3::Zero();
    double length = kFar;  ///< of the way
    double height = 0.0;   ///< over the face
  };

  /// A corner past a sheet, and the direction back.
  struct PastCorner {
    std::uint32_t corner;
    Vec3 out;
  };

  void addCorners(const PosedSolid& own, const PosedSolid& other, std::span<const CornerAndFace> pairs,
                  std::uint32_t TrianglePair::*own_triangle);
  void findInside(const PosedSolid& own, const PosedSolid& other, std::span<const CornerAndFace> pairs,
                  std::uint32_t TrianglePair::*own_triangle);
  void addWayOut(const MeshFeatures& own, const MeshFeatures& other, const Pose& own_in_other,
                 std::uint32_t corner);
  double sideOf(const MeshFeatures& own, std::uint32_t corner, const Vec3& on_plane,
                const Vec3& normal) const;
  void shortenWayBack(const MeshFeatures& own, const MeshFeatures& other, const Pose& own_in_other,
                      const Vec3& out, CornerWayBack& way);
  void addWaysBack(const MeshFeatures& own, const MeshFeatures& other, const Pose& own_in_other,
                   std::uint32_t TrianglePair::*own_triangle);
  void addWayBack(const MeshFeatures& own, const Pose& own_in_other, const CornerWayBack& way);
  void addPastSheets(const MeshFeatures& own, const MeshFeatures& other, const Pose& own_in_other,
                     std::uint32_t TrianglePair::*own_triangle);
  void addCorner(const CornerAndFace& pair, const Vec3& point, const Vec3& normal, double height);
  void addEdges(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, const Pose& b_before);
  std::size_t countUnfelt(const MeshFeatures& a, const MeshFeatures& b);
  void addCrossings(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, std::size_t unfelt);
  void addCrossing(const TrianglePair& pair);
  void addNearest(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a);

  double reach_ = 0.0, not_felt_ = 0.0;
  bool knows_before_ = false;
  Pose own_in_other_;
  std::optional<Pose> before_in_other_;
  NearFeatures near_;
  std::vector<double>
      least_height_;  // per corner of one mesh: the nearest to 0, over a face that can push it
  std::vector<Push> pushes_;
  std::vector<std::uint32_t> seeds_;
  InsideCorners inside_;
  std::vector<CornerWayBack> ways_back_;
  std::vector<PastCorner> past_;
  std::vector<char> is_felt_a_,
      is_felt_b_;  // per corner: whether a triangle at it has a contact that touches
  std::vector<Contact> contacts_;
  DisjointSets groups_;  // of triangles of A, then of B, that meet
  std::vector<CurveSegment> curve_;
};

}  // namespace octoblisk::detail
