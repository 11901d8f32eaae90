// Removes contacts that push a triangle out of a body the long way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/surface_pair.h"

namespace octoblisk::detail {

/// If a triangle came in over one face of a body, its contacts with the body's other faces may be as deep as
/// the triangle is large, although it is far less deep below that face.
class LongWays {
 public:
  /// Removes such contacts; the order stays. Allocates nothing once warm.
  void removeFrom(std::vector<PairedContact>& contacts, const SurfacePair& surfaces);

 private:
  using Members = std::span<const std::uint32_t>;
  struct Face {
    Triangle triangle;
    Vec3 facing;  ///< unit
    double contact_distance;

    double depthOf(const Vec3& point) const { return facing.dot(triangle[0] - point); }
  };

  void sortByTriangle(const std::vector<PairedContact>& contacts, const SurfaceSide& side);
  void mark(std::vector<PairedContact>& contacts, Members opposite_one, const SurfaceSide& own,
            const SurfaceSide& opposite);
  void findFaces(const std::vector<PairedContact>& contacts, Members opposite_one, const SurfaceSide& own);
  static bool isConvex(const Face& face, const Face& other);

  std::vector<std::uint32_t> by_triangle_;  // contacts, by the triangle of a side
  std::vector<std::uint32_t> first_;        // per triangle: where its contacts begin in by_triangle_
  std::vector<std::uint32_t> shallowest_;   // contacts with one triangle
  std::vector<Face> faces_;                 // faces that meet a triangle
};

}  // namespace octoblisk::detail
