// Contacts of two surfaces, without those that exist only because the surfaces are divided into triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/connected_pairs.h"
#include "contact/inner_contacts.h"
#include "contact/long_ways.h"
#include "contact/surface_pair.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "query/near_pair.h"

namespace octoblisk::detail {

/// A pair of triangles ignores the surfaces around it. If two bodies meet, the contacts of their triangles
/// include some that are wrong for the bodies:
/// - Contacts that push a triangle out of a face the long way, although it came in over another face and is
///   far less deep below that one. They are as deep as the triangles are large, even if the bodies barely
///   touch.
/// - Contacts between triangles that are past each other's faces, inside the other body and barely apart.
///   They would hold the bodies inside each other.
/// - Contacts at an edge or corner that push at an angle, although a neighbouring triangle is nearer or
///   deeper. The bodies would bump against internal edges of flat surfaces.
/// - Contacts of edges and corners between two faces that lie on each other. The smallest shift of the bodies
///   tilts their normals, each in its own direction.
/// And some are missing: a pair has one contact, so a tetrahedron that lies on a face may have contacts at
/// only two of its three corners there.
class SurfaceContacts {
 public:
  /// Replaces `found` with the contacts of the surfaces A and B within `threshold`: what filter makes of
  /// octoblisk::contacts. Where very many triangle pairs are within the threshold, uses a smaller one, but at
  /// least the distance of the nearest pair plus `surplus`. Most contacts that filter would remove are not
  /// computed in the first place. Where the closest points of two triangles are not unique, or nearly so,
  /// find may keep other contacts than filter does. Allocates nothing once warm.
  void find(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double threshold,
            double surplus, std::vector<Contact>& found);

  /// Treats the contacts of A and B within `threshold`, which are in ascending order of triangles. Contacts
  /// of the last kind above get a normal perpendicular to a face; their distances stay. Contacts of the other
  /// kinds are removed; the order stays. Missing contacts follow at the end. Contacts that push the long way
  /// are all removed. Of the others, the deepest stays, and at least one of each connected group. A contact
  /// whose triangles are apart also stays if it is connected to no contact whose triangles meet, because a
  /// thin sheet has two sides. Triangles face outward, and shared corners are equal to the last bit.
  /// `triangle_a(contact)` and `triangle_b(contact)` return the triangles in the frame of the contacts.
  /// Allocates nothing once warm.
  template <typename TriangleA, typename TriangleB>
  void filter(std::vector<Contact>& contacts, double threshold, TriangleA&& triangle_a,
              TriangleB&& triangle_b) {
    clear();
    for (const Contact& contact : contacts) {
      contacts_.push_back(
          {contact,
           {surfaces_.a.surface.add(contact.triangle_a, [&] { return triangle_a(contact); }),
            surfaces_.b.surface.add(contact.triangle_b, [&] { return triangle_b(contact); })}});
    }
    filter(threshold);
    contacts.assign(contacts_.begin(), contacts_.end());
  }

 private:
  void clear();
  void findMeetingGroups();
  void filter(double threshold);

  SurfacePair surfaces_;
  std::vector<PairedContact> contacts_;
  std::vector<NumberPair> skipped_;  // pairs whose contacts were not computed
  LongWays long_ways_;
  InnerContacts inner_contacts_;

  // Of find.
  std::vector<NearPair> near_;
  std::vector<NumberPair> of_near_;    // the pairs per near pair
  ConnectedPairs groups_;              // of the near pairs
  std::vector<bool> meets_;            // per group: whether triangles of it meet
  std::vector<std::uint32_t> wanted_;  // near pairs whose contacts are computed
};

}  // namespace octoblisk::detail
