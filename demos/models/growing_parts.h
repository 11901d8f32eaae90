// Tracks connected parts while triangles are added from the outside in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/disjoint_sets.h"
#include "models/welded_surface.h"

namespace octoblisk::demos {

/// Triangles connected by shared vertices.
struct Part {
  std::uint32_t root = 0;  ///< one of its vertices
  double area = 0.0;
  Vec3 centroid = Vec3::Zero();
};

/// The parts of the triangles added so far. A copy grows on by itself.
class GrowingParts {
 public:
  /// The surface must outlive the parts.
  explicit GrowingParts(const WeldedSurface& surface);

  /// Adds all triangles beyond `low` and below `high`; `low` must not grow from call to call.
  void addBetween(double low, double high);

  /// The vertex that stands for all of its part.
  std::uint32_t rootOf(std::uint32_t vertex) { return connected_.rootOf(vertex); }

  /// The parts that have an area.
  std::vector<Part> parts();

 private:
  struct Sums {
    double area = 0.0;
    Vec3 moment = Vec3::Zero();
  };

  void add(std::uint32_t triangle);

  const WeldedSurface* surface_;
  detail::DisjointSets connected_;
  std::vector<Sums> sums_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> roots_;  ///< includes vertices that used to be roots
  std::size_t next_ = 0;
};

}  // namespace octoblisk::demos
