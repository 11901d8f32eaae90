// Contacts of two surfaces, without those that exist only because the surfaces are divided into triangles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "contact/local_surface.h"
#include "geometry/intersection_curve.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"
#include "query/near_pair.h"

namespace octoblisk::detail {

/// A pair of triangles ignores the surfaces around it. If two bodies meet, the contacts of their triangles
/// include some that are wrong for the bodies:
/// - Contacts that push a triangle out of a face the long way, although it came in over another face and is
///   far less deep below that one. They are as deep as the triangles are large, even if the bodies barely
///   touch.
/// - Contacts between triangles that are past each other's faces, inside the other body and barely apart.
///   They would hold the bodies inside each other.
/// - Contacts that push at an angle from an edge or corner beyond which the surface continues, nearer or
///   deeper. The bodies would bump against internal edges of flat surfaces.
/// - Contacts of edges and corners between two faces that lie on each other. The smallest shift of the bodies
///   tilts their normals, each in its own direction.
/// And some are missing: a pair has one contact, so a tetrahedron that lies on a face has two at its three
/// corners.
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
  /// kinds are removed; the order stays. Missing contacts follow at the end. Of the contacts that do not push
  /// the long way, the deepest of all stays, and at least one of each connected group. A contact whose
  /// triangles are apart also stays if it is connected to no contact whose triangles meet, because a thin
  /// sheet has two sides. Triangles face outward, and shared corners are equal to the last bit.
  /// `triangle_a(contact)` and `triangle_b(contact)` return the triangles in the frame of the contacts.
  /// Allocates nothing once warm.
  template <typename TriangleA, typename TriangleB>
  void filter(std::vector<Contact>& contacts, double threshold, TriangleA&& triangle_a,
              TriangleB&& triangle_b) {
    clear();
    for (const Contact& contact : contacts) {
      pairs_.push_back({a_.surface.add(contact.triangle_a, [&] { return triangle_a(contact); }),
                        b_.surface.add(contact.triangle_b, [&] { return triangle_b(contact); })});
    }
    filter(contacts, threshold);
  }

  /// Where two solids cross, like two bars, the triangles at the sides are as deep as those at the top, and
  /// push in opposite directions. Such contacts hold the solids inside each other. This function takes the
  /// contacts of the last find or filter, and keeps their order. At each crossing, it removes contacts that
  /// push across or against the way out of the intersection (wayOut): those that another contact opposes, or
  /// all if no contact pushes out. Contacts of triangles that face each other stay. The deepest of the
  /// removable contacts also stays. It then pushes out, at the middle of the curve in which the surfaces
  /// meet. It is as deep as this curve extends on the way out; if no other contact pushes out, at least as
  /// deep as its triangles. Surfaces that lie along each other, as the walls of nested cups do, keep their
  /// contacts. Allocates nothing once warm.
  void openPinches(std::vector<Contact>& contacts);

 private:
  /// The numbers of two triangles on sides A and B.
  struct Pair {
    std::uint32_t a, b;
  };
  /// One of the two surfaces, and its members in a pair and in a contact.
  struct Side {
    std::uint32_t Pair::*number;
    std::uint32_t Contact::*index;
    Vec3 Contact::*point;
    double outward;  ///< 1 if the normals of contacts point outward from this surface, or else -1
    LocalSurface surface;

    const Triangle& triangle(const Pair& pair) const { return surface.triangle(pair.*number); }
    /// scaledNormal of the triangle.
    const Vec3& facing(const Pair& pair) const { return surface.normal(pair.*number); }
    bool isPerpendicularTo(const Contact& contact, const Pair& pair) const {
      return isPerpendicular(facing(pair), contact.normal);
    }
    /// Whether a contact pushes perpendicularly on the outside of the triangle.
    bool isPushedBy(const Contact& contact, const Pair& pair) const {
      return isPerpendicularTo(contact, pair) && outward * facing(pair).dot(contact.normal) > 0.0;
    }
  };
  struct Face {
    Triangle triangle;
    Vec3 facing;  ///< unit
    double contact_distance;

    double depthOf(const Vec3& point) const { return facing.dot(triangle[0] - point); }
  };
  using Members = std::span<const std::uint32_t>;

  void clear();
  /// Slack for the rounding of distances between two triangles, and between their neighbours.
  double roundingOf(const Pair& pair) const {
    return std::max(a_.surface.rounding(pair.a), b_.surface.rounding(pair.b));
  }
  void findMeetingGroups();
  bool isSurelyInner(const ClosestFeatures& features, const Pair& pair, double threshold,
                     bool group_meets) const;
  void filter(std::vector<Contact>& contacts, double threshold);
  void removeWrong(std::vector<Contact>& contacts);
  void addCorners(std::vector<Contact>& contacts, double threshold);
  void alignWithFaces(std::vector<Contact>& contacts) const;
  void dropRemoved(std::vector<Contact>& contacts);
  void removeLongWays(std::vector<Contact>& contacts);
  void sortByTriangle(const Side& side);
  void markLongWays(const std::vector<Contact>& contacts, Members opposite_one, const Side& own,
                    const Side& opposite);
  void findFaces(const std::vector<Contact>& contacts, Members opposite_one, const Side& own);
  static bool isConvex(const Face& face, const Face& other);
  void findGroups(std::initializer_list<const std::vector<Pair>*> of);
  void findDeepest(const std::vector<Contact>& contacts);
  std::uint32_t groupOf(const Pair& pair) { return groups_.rootOf(pair.a); }
  void keepDeepest(const std::vector<Contact>& contacts);
  bool areFacing(const Contact& contact, const Pair& pair) const;
  void openPinch(std::vector<Contact>& contacts, Members members, std::uint32_t group);
  void markPast(const std::vector<Contact>& contacts);
  void markInner(const std::vector<Contact>& contacts);
  bool isInner(const std::vector<Contact>& contacts, std::uint32_t c, const Side& own,
               const Side& opposite) const;

  Side a_{&Pair::a, &Contact::triangle_a, &Contact::point_on_a, -1.0, {}};
  Side b_{&Pair::b, &Contact::triangle_b, &Contact::point_on_b, 1.0, {}};
  std::vector<NearPair> near_;
  std::vector<Pair> pairs_;        // per near pair, then per contact
  std::vector<Pair> of_contacts_;  // the pairs per contact while they are computed
  std::vector<Pair> skipped_;      // pairs whose contacts were not computed
  std::vector<Pair> meeting_;      // pairs that meet
  std::vector<CurveSegment> curve_;
  std::vector<Pair> of_segments_;       // the pairs per segment of the curve
  std::vector<CurveSegment> crossing_;  // the part of the curve of one group
  /// Why a contact was removed.
  enum class Removed : std::uint8_t { no, long_way, past, inner, pinches };
  std::vector<Removed> removed_;
  std::vector<std::uint32_t> wanted_;       // near pairs whose contacts are computed
  std::vector<std::uint32_t> by_triangle_;  // contacts, by the triangle of a side
  std::vector<std::uint32_t> first_;        // per triangle: where its contacts begin in by_triangle_
  std::vector<std::uint32_t> shallowest_;   // contacts with one triangle
  std::vector<std::uint32_t> pinching_;     // contacts that may pinch
  std::vector<Face> faces_;                 // faces that meet a triangle
  DisjointSets groups_;                     // of the triangles of A, then of B
  std::vector<std::uint32_t> deepest_;      // per root: the deepest contact of the group
  std::vector<bool> meets_;                 // per root: whether triangles of its group meet
  std::vector<bool> stays_;                 // per root: whether a contact of its group stays
};

}  // namespace octoblisk::detail
