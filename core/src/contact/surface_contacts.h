// Contacts of two surfaces, without those that they have only because they are cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/shared_corners.h"
#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Two triangles know nothing of the surfaces that they are of. Of two bodies that meet, the contacts of
/// their triangles hold such as neither body means:
/// - that push a triangle out of a face the long way, where it came over another that it is far less deep
///   below: as deep as the triangles are large, though the bodies hardly touch;
/// - of triangles that are past each other's faces, inside the other body, a hair's breadth apart: they would
///   keep the bodies in one another;
/// - that push askew from an edge or corner beyond which the surface goes on, nearer or deeper: the bodies
///   would bump against edges between triangles that lie flat.
class SurfaceContacts {
 public:
  /// Removes those from contacts of A and B; the order is kept, and so are, of what does not push the long
  /// way, the deepest of all and one of those that hang together. Triangles face outward. What is apart stays
  /// whichever way it faces, where it hangs together with nothing that meets: thin sheets have two sides.
  /// `triangle_a(contact)` and `triangle_b(contact)` tell the triangles in the contacts' frame, triangles
  /// that share a corner to the last bit. Once warm, allocates nothing.
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

  std::vector<Pair> pairs_;  // of each contact
  SharedCorners corners_;    // of the triangles of some contacts
  /// Why a contact is removed.
  enum class Removed : std::uint8_t { no, long_way, past, inner };
  std::vector<Removed> removed_;
  std::vector<std::uint32_t> by_a_, by_b_, parent_, shallowest_;
  std::vector<Face> faces_;  // that meet a triangle
  std::vector<bool> stays_;  // of a root: whether something of its group does
};

}  // namespace octoblisk::detail
