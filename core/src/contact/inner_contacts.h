// Removes contacts of triangles where the surfaces around them come nearer or meet.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/connected_pairs.h"
#include "contact/surface_pair.h"
#include "query/near_pair.h"

namespace octoblisk::detail {

/// The sine of a tilt of a contact's normal that means nothing: 0.6°.
inline constexpr double kSlightTilt = 0.01;

class InnerContacts {
 public:
  /// Removes two kinds of contacts; the order stays.
  /// - Past a face: the triangles are apart, one is behind the other, and a contact of their group of
  ///   connected pairs touches.
  /// - Inner: the contact is at an edge or corner of a surface, at an angle to its triangle. Beyond this edge
  ///   or corner, the surface leans towards the other body, and comes nearer or meets it.
  /// Of each group, at least one contact stays. The deepest contact of all stays, too. `skipped` holds the
  /// pairs whose contacts were not computed. Needs at least one contact. Allocates nothing once warm.
  void removeFrom(std::vector<PairedContact>& contacts, const SurfacePair& surfaces,
                  const std::vector<NumberPair>& skipped);

 private:
  void findDeepest(const std::vector<PairedContact>& contacts);
  void markPast(std::vector<PairedContact>& contacts, const SurfacePair& surfaces);
  bool isInner(const std::vector<PairedContact>& contacts, const PairedContact& contact, double rounding,
               const SurfaceSide& own, const SurfaceSide& opposite) const;
  void keepDeepest(std::vector<PairedContact>& contacts);

  ConnectedPairs groups_;
  std::vector<bool> is_past_;           // per contact
  std::vector<std::uint32_t> deepest_;  // per group: its deepest contact
  std::vector<bool> stays_;             // per group: whether a contact of it stays
};

/// Whether two triangles that do not meet are surely within the threshold, and the surface of one of them
/// surely comes nearer beyond the edge or corner where they are closest. In a group that meets, false unless
/// both triangles surely face each other there, because contacts past a face decide about others.
bool isSurelyInner(const SurfacePair& surfaces, const NumberPair& pair, const ClosestFeatures& features,
                   double threshold, bool group_meets);

}  // namespace octoblisk::detail
