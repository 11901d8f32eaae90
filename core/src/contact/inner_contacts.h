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
  /// Removes the contacts that are past a face or inner; the order stays. Needs at least one contact.
  /// Receives the pairs whose contacts were not computed. Of each group of connected pairs, at least one
  /// contact stays, and the deepest of all. Allocates nothing once warm.
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
