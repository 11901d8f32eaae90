// The winding number of triangles around a point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The share of all directions in which a point sees triangles: positive for those seen from the back,
/// negative for those seen from the front. For a surface without open edges, this is the winding number (A.
/// Jacobson, L. Kavan, O. Sorkine-Hornung, Robust inside-outside segmentation using generalized winding
/// numbers, ACM TOG 32 (4), 2013).
///
/// A tree of boxes holds the triangles. From afar, the triangles of a box count as one dipole (G. Barill, N.
/// Dickson, R. Schmidt, D. Levin, A. Jacobson, Fast winding numbers for soups and clouds, ACM TOG 37 (4),
/// 2018).
class WindingShare {
 public:
  /// Caps as capOf makes them: the first triangle halves the outline, the next ones fill one half, and the
  /// last ones the other. The tree follows these halves. In any other order, shares are the same up to
  /// rounding, but take longer.
  explicit WindingShare(std::vector<std::vector<Triangle>> caps);

  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// The share, up to rounding, which is large beside a triangle that is much thinner than it is long. A
  /// point in the plane of a triangle is on the side given by sideInPlane.
  double at(const Vec3& point, const Pose& triangles_in_a = {}) const;
  /// The share, rounded. Asks no more triangles than it needs to. Allocates nothing.
  int roundedAt(const Vec3& point, const Pose& triangles_in_a = {}) const;
  /// Whether the share or its negative exceeds a limit.
  bool exceeds(double limit, const Vec3& point) const;

 private:
  /// The triangles [begin, end), and how to replace them from afar. Of two children, the first one follows
  /// the node. The triangles before those of the children belong to the node alone.
  struct Node {
    Vec3 center = Vec3::Zero();        // the mean over the area
    Vec3 half_extents = Vec3::Zero();  // of the box around it that contains the triangles
    double area = 0.0;                 // the sum of all areas
    Vec3 area_vector = Vec3::Zero();
    double first_moment = 0.0;   // at most ∫ |n - mean n| |x - center| over the area, for unit normals n
    double second_moment = 0.0;  // ∫ |x - center|² over the area
    std::uint32_t begin = 0, end = 0;
    std::uint32_t second_child = 0;  // 0: no children
  };

  Node nodeOver(std::uint32_t begin, std::uint32_t end) const;
  void divide(std::span<std::vector<Triangle>> caps);
  void halve(std::uint32_t begin, std::uint32_t end);
  double sumOf(std::uint32_t begin, std::uint32_t end, const Vec3& point, const Pose& triangles_in_a) const;
  template <typename IsEnough>
  double refined(const Vec3& point, const Pose& triangles_in_a, const IsEnough& is_enough) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;  // a parent precedes its children
};

}  // namespace octoblisk::detail
