// Contacts that a surface has only because it is cut into triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// A body that slides over a flat floor of triangles would bump against the edges between them: to the
/// triangle just ahead the shortest way out is back, not up. Such a contact tells nothing of the surface,
/// since on the triangle that shares the edge the body is deeper.
class InternalEdges {
 public:
  /// Removes the contacts of a mesh (A) and a convex body (B) that push askew to their triangle, from an edge
  /// or a corner of it, over a triangle that shares it (by its ends' positions), goes on smoothly from it,
  /// and has a deeper contact, square to itself or removed as well. The deepest of all stays, and what is
  /// pushed by a ridge; the order is kept. Contacts and mesh are in one frame. Once warm, allocates nothing.
  void removeFrom(std::vector<Contact>& contacts, const TriangleMesh& mesh);

 private:
  /// A corner of a contact's triangle.
  struct Corner {
    Vec3 position;
    std::uint32_t contact;
  };

  std::vector<Corner> corners_;       // by position, those of each contact's triangle
  std::vector<std::uint32_t> order_;  // of the contacts, the deepest first
  std::vector<char> is_internal_;
};

}  // namespace octoblisk::detail
