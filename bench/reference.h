// The answers that contenders are held to: exact, found without any tree.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"
#include "scene.h"

namespace octoblisk::bench {

/// Where a way meets a triangle, as a part of the way; 1 where it does not (T. Möller and B. Trumbore, Fast,
/// minimum storage ray–triangle intersection, 1997).
double hitOf(const Triangle& triangle, const Segment& way);

/// The triangles of a mesh in the cells of a uniform grid. What its boxes may meet is then tested exactly.
class Reference {
 public:
  explicit Reference(const TriangleMesh& blisk, double cell_size = 2.0);

  /// The pairs of triangles that meet, exactly, of the blisk and the posed belt.
  std::size_t touchingPairs(const TriangleMesh& belt, const Pose& belt_in_blisk) const;

  /// The part of the way, 0 to 1, at which a triangle is met first; 1 where none is. In double precision.
  double firstHit(const Segment& way) const;

  /// The distance of a point to the nearest triangle, where that is no more than `farthest`; else infinity.
  double distanceTo(const Vec3& point, double farthest) const;

  /// The part of the way, 0 to 1, that a ball's middle has gone when the ball comes within 1e-4 mm of a
  /// triangle, by steps no longer than the distance; 1 where it does not.
  double firstTouch(const Segment& way, double radius) const;

  /// Whether some two triangles are no farther apart than `reach`.
  bool within(double reach, const TriangleMesh& belt, const Pose& belt_in_blisk) const;

  /// The least distance of two triangles of two bodies that do not touch, by all pairs near enough to matter;
  /// none where it is above `farthest`.
  std::optional<double> distance(double farthest, const TriangleMesh& belt, const Pose& belt_in_blisk) const;

 private:
  using Cell = Eigen::Vector3i;

  Cell cellOf(const Vec3& point) const;
  std::size_t indexOf(const Cell& cell) const;

  /// Visits each pair of triangles whose boxes, grown by `reach`, meet, once. Stops where `visit` says true.
  void forEachPair(double reach, const TriangleMesh& belt, const Pose& belt_in_blisk,
                   const std::function<bool(const Triangle&, const Triangle&)>& visit) const;

  const TriangleMesh& blisk_;
  double cell_size_;
  Vec3 lowest_;
  Cell cells_;
  std::vector<std::uint32_t> begin_;      // of each cell's triangles
  std::vector<std::uint32_t> triangles_;  // cell by cell
};

/// The exact answers at some poses.
struct Truth {
  std::vector<std::size_t> touching_pairs;  ///< at each pose
  double hit_rate = 0.0;                    ///< of the poses that touch
  double near_rate = 0.0;                   ///< of those apart, but no farther than 0.5 mm
};

/// Found at the first call for these poses, and kept. `poses` must be those of a scene that is kept.
const Truth& truthOf(const Scene& scene, const std::vector<Pose>& poses);

/// The poses at which a primitive touches a small mesh.
struct PrimitiveTruth {
  std::vector<Pose> poses;        ///< of the path, without those within 1e-4 of touching; cylinder: 1e-3
  std::vector<bool> touches;      ///< at each pose
  std::vector<double> distances;  ///< from sphere to mesh at each pose, below 0: the depth; others: empty
  std::size_t hits = 0;           ///< poses that touch
};

/// Found at the first call, and kept. The scene must be kept. All in double precision, by all triangles near
/// the primitive.
const PrimitiveTruth& truthOf(const Scene& scene, Primitive primitive);

}  // namespace octoblisk::bench
