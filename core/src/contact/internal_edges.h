// Removes contacts that exist only because a surface is divided into triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// A body that slides over a flat floor of triangles would bump against the edges between them: for the
/// triangle just ahead, the shortest way out is back, not up. Such a contact says nothing about the surface,
/// because the body is deeper in the triangle that shares the edge.
class InternalEdges {
 public:
  /// Removes contacts of a mesh (A) and a convex body (B) at internal edges. Such a contact is at an edge or
  /// corner of its triangle, and pushes at an angle to the triangle, over a neighbour: another triangle that
  /// shares this edge or corner (by positions). The neighbour has a deeper contact that
  /// - is perpendicular to the neighbour, or
  /// - is also removed, and the surface is smooth between the two triangles.
  /// The deepest contact stays, and so do contacts at ridges. The order is kept. Contacts and mesh are in one
  /// frame. Allocates nothing once warm.
  void removeFrom(std::vector<Contact>& contacts, const TriangleMesh& mesh);

 private:
  /// The position of a contact on its triangle.
  struct Place {
    Triangle triangle;
    Vec3 normal;            // scaledNormal
    unsigned feature;       // triangle_feature.h; all corners if perpendicular
    bool is_perpendicular;  // whether the contact's normal is perpendicular to the triangle
    bool is_internal;
  };

  /// A corner of the triangle of a contact.
  struct Corner {
    Vec3 position;
    std::uint32_t contact;
  };

  std::vector<Place> places_;               // per contact
  std::vector<Corner> corners_;             // of the triangles of the contacts, by position
  std::vector<std::uint32_t> at_an_angle_;  // contacts that push so from an edge or a corner, deepest first
};

}  // namespace octoblisk::detail
