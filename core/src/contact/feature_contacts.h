// The contacts of two meshes: pairs of features, each in a direction in which both can be pushed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/disjoint_sets.h"
#include "contact/corner_contacts.h"
#include "contact/mesh_features.h"
#include "contact/near_features.h"
#include "geometry/intersection_curve.h"
#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// Most contacts are a corner and a face (corner_contacts.h), or two sharp edges that cross. The normal is
/// the face's normal, or the perpendicular to both edges, and it is in the cones of directions in which both
/// features can be pushed (D. Gregorius, The separating axis test between convex polyhedra, GDC 2013). The
/// distance is that along the normal.
class FeatureContacts {
 public:
  /// Replaces `found` with the contacts of the meshes A and B within `reach`. Distances less than 1/40 of
  /// `spacing` have no effect. If no contact is as near as the nearest points of the surfaces, these are one.
  /// If triangles meet where no contact is near, their curve has a contact along its way out; its points are
  /// on neither surface. `b_when_apart` is a pose of B in A before the meshes met, if one is known: it shows
  /// on which side of a sheet a body belongs. The poses are orthonormal in double precision. Allocates
  /// nothing once warm.
  void find(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
            const std::optional<Pose>& b_when_apart, double reach, double spacing,
            std::vector<Contact>& found);

 private:
  void addCorners(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                  const std::optional<Pose>& b_when_apart);
  void addEdges(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                const std::optional<Pose>& b_when_apart);
  std::size_t countUnfelt(const MeshFeatures& a, const MeshFeatures& b);
  void addCrossings(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                    const std::optional<Pose>& b_when_apart, std::size_t unfelt);
  void turnSheets(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                  const std::optional<Pose>& b_when_apart, const TrianglePair& pair,
                  CurveSegment& segment) const;
  void addCrossing(const TrianglePair& pair);
  void addNearest(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a);

  double reach_ = 0.0, not_felt_ = 0.0;
  NearFeatures near_;
  CornerContacts corners_;
  std::vector<char> is_felt_a_,
      is_felt_b_;  // per corner: whether a triangle at it has a contact that touches
  std::vector<Contact> contacts_;
  DisjointSets groups_;  // of triangles of A, then of B, that meet
  std::vector<CurveSegment> curve_;
};

}  // namespace octoblisk::detail
