// The reference answers. They are exact and use no tree.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"
#include "scene.h"

namespace octoblisk::bench {

/// The fraction of the segment at which it meets the triangle; 1 if it does not meet it (T. Möller and B.
/// Trumbore, Fast, minimum storage ray–triangle intersection, 1997).
double hitOf(const Triangle& triangle, const Segment& segment);

/// The triangles of a mesh in the cells of a uniform grid. Triangles whose boxes may meet are then tested
/// exactly.
class Reference {
 public:
  explicit Reference(const TriangleMesh& blisk, double cell_size = 2.0);

  /// The exact number of triangle pairs of the blisk and the posed belt that touch.
  std::size_t touchingPairs(const TriangleMesh& belt, const Pose& belt_in_blisk) const;

  /// The fraction of the segment, 0 to 1, before the first hit; 1 if it hits no triangle. In double
  /// precision.
  double firstHit(const Segment& segment) const;

  /// The distance of a point to the nearest triangle, or infinity if that exceeds `farthest`.
  double distanceTo(const Vec3& point, double farthest) const;

  /// The fraction of the segment, 0 to 1, at which a ball that moves along it first comes within 1e-4 mm of a
  /// triangle; 1 if it never does. The ball advances in steps no longer than the distance.
  double firstTouch(const Segment& segment, double radius) const;

  /// Whether any triangle pair is no farther apart than `reach`.
  bool within(double reach, const TriangleMesh& belt, const Pose& belt_in_blisk) const;

  /// The distance of two bodies that do not touch, by all triangle pairs near enough to matter. Empty if it
  /// exceeds `farthest`.
  std::optional<double> distance(double farthest, const TriangleMesh& belt, const Pose& belt_in_blisk) const;

 private:
  using Cell = Eigen::Vector3i;

  Cell cellOf(const Vec3& point) const;
  std::size_t indexOf(const Cell& cell) const;

  /// Visits each triangle pair once if the boxes, grown by `reach`, overlap. Stops when `visit` returns true.
  void forEachPair(double reach, const TriangleMesh& belt, const Pose& belt_in_blisk,
                   const std::function<bool(const Triangle&, const Triangle&)>& visit) const;

  const TriangleMesh& blisk_;
  double cell_size_;
  Vec3 lowest_;
  Cell cells_;
  std::vector<std::uint32_t> begin_;      // where each cell's triangles start
  std::vector<std::uint32_t> triangles_;  // cell by cell
};

/// The exact answers at some poses.
struct Truth {
  std::vector<std::size_t> touching_pairs;  ///< at each pose
  double hit_rate = 0.0;                    ///< of the poses that touch
  double near_rate = 0.0;                   ///< of the poses that are apart by no more than 0.5 mm
};

/// Computed at the first call for these poses and cached. `poses` must belong to a cached scene.
const Truth& truthOf(const Scene& scene, const std::vector<Pose>& poses);

/// The poses at which a primitive touches a small mesh.
struct PrimitiveTruth {
  std::vector<Pose> poses;        ///< of the path, except those within 1e-4 of touching (cylinder: 1e-3)
  std::vector<bool> touches;      ///< at each pose
  std::vector<double> distances;  ///< sphere to mesh at each pose; depth below 0; others: empty
  std::size_t hits = 0;           ///< poses that touch
};

/// Computed at the first call and cached. The scene must be cached too. Everything is computed in double
/// precision from all triangles near the primitive.
const PrimitiveTruth& truthOf(const Scene& scene, Primitive primitive);

}  // namespace octoblisk::bench
