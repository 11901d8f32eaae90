// Contacts that a surface has only because it is cut into triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/shared_corners.h"
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
  /// Where a contact is on its triangle.
  struct Place {
    Triangle triangle;
    Vec3 normal;       // scaledNormal
    unsigned feature;  // triangle_feature.h
    bool is_square;    // its normal to the triangle
    bool isAskew() const { return !is_square && feature != 0b111u && feature != 0; }
  };

  std::vector<Place> places_;         // of each contact
  SharedCorners corners_;             // of their triangles
  std::vector<std::uint32_t> order_;  // of the contacts, the deepest first
  std::vector<char> is_internal_;
};

}  // namespace octoblisk::detail
