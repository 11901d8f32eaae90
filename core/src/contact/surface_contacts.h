// Contacts of two surfaces, without those that exist only because the surfaces are divided into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/shared_corners.h"
#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

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
class SurfaceContacts {
 public:
  /// Makes normals that are slightly tilted perpendicular to a face; distances stay. Removes the
  /// other kinds from the contacts of A and B and keeps the order. Of the contacts that do not
  /// push the long way, it keeps the deepest of all and at least one of each connected group. Triangles face
  /// outward. A contact whose triangles are apart stays, whichever way they face, if it is connected to no
  /// contact whose triangles meet: thin sheets have two sides. `triangle_a(contact)` and
  /// `triangle_b(contact)` return the triangles in the frame of the contacts. Shared corners must be equal to
  /// the last bit. Allocates nothing once warm.
  template <typename TriangleA, typename TriangleB>
  void filter(std::vector<Contact>& contacts, TriangleA&& triangle_a, TriangleB&& triangle_b) {
    pairs_.clear();
    for (const Contact& contact : contacts) pairs_.push_back({triangle_a(contact), triangle_b(contact)});
    filter(contacts);
  }

 private:
  struct Pair {
    Triangle a, b;
  };
  struct Face {
    Face(const Triangle& of, double contact);
    double depthOf(const Vec3& point) const { return facing.dot(triangle[0] - point); }

    Triangle triangle;
    Vec3 facing;
    double contact_distance;
  };
  using Members = std::span<const std::uint32_t>;

  void filter(std::vector<Contact>& contacts);
  void alignWithFaces(std::vector<Contact>& contacts) const;
  void reset(std::size_t contacts);
  void dropRemoved(std::vector<Contact>& contacts);
  void removeLongWays(std::vector<Contact>& contacts);
  void markLongWays(const std::vector<Contact>& contacts, Members opposite_one, bool of_a);
  void findFaces(const std::vector<Contact>& contacts, Members opposite_one, bool of_a);
  static bool isConvex(const Face& face, const Face& other);
  void join(const std::vector<Contact>& contacts);
  void keepDeepest(const std::vector<Contact>& contacts);
  void markPast(const std::vector<Contact>& contacts);
  void markInner(const std::vector<Contact>& contacts, Members opposite_one, bool of_a);

  std::vector<Pair> pairs_;  // per contact
  SharedCorners corners_;    // of the triangles of some contacts
  /// Why a contact was removed.
  enum class Removed : std::uint8_t { no, long_way, past, inner };
  std::vector<Removed> removed_;
  std::vector<std::uint32_t> by_a_, by_b_, parent_, shallowest_;
  std::vector<Face> faces_;  // faces that meet a triangle
  std::vector<bool> stays_;  // per root: whether a contact of its group stays
};

}  // namespace octoblisk::detail
