// How deep one surface reaches into a solid: the depth of a gouge.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "octoblisk/contact.h"
#include "octoblisk/surface.h"

namespace octoblisk {

namespace detail {
class DepthSearch;
}  // namespace detail

enum class Gouging {
  none,   ///< no point of B's surface is in A: A and B are apart, or A is wholly inside B
  found,  ///< B's surface touches A's, or reaches into A
};

/// The deepest point found; points are in the frame of A.
struct GougeDepth {
  Gouging gouging = Gouging::none;
  double depth = 0.0;              ///< the distance between the two points: B reaches at least this deep
  double upper_bound = 0.0;        ///< B reaches no deeper; at most depth + tolerance, but see DepthsSought
  Vec3 point_on_b = Vec3::Zero();  ///< inside A, or on it
  Vec3 point_on_a = Vec3::Zero();  ///< the point of A's surface that is closest to point_on_b
  std::uint32_t triangle_a = kNoTriangle;
  std::uint32_t triangle_b = kNoTriangle;
  /// False if B meets A's surface, or is nearest to it, where its triangles are sheets (surface.h).
  /// Then B may reach deeper than the upper bound, or may not be in A at all. If B meets such a part of A's
  /// surface, the depth is not measured.
  bool is_known = true;
};

/// The depths that matter to a caller of DepthQuery. The fewer, the faster the search.
struct DepthsSought {
  /// The search ignores points whose depth is at most `above` + tolerance. The upper bound is at most the
  /// greater of `above` and the depth, plus the tolerance.
  double above = 0.0;
  /// The search ends when it has found a greater depth. The upper bound is then infinite.
  double enough = std::numeric_limits<double>::infinity();
};

/// Finds the greatest distance to A's surface among the points of B's surface that are in the solid A:
///     depth = max { dist(x, ∂A) : x ∈ ∂B ∩ A }.
/// containment.h defines what is in A. Neither what lies inside of A counts as its surface, nor what lies
/// inside of B as B's (Surface::boundary). If B is wholly inside A, the depth is that of B's innermost point.
/// If A is wholly inside B, no point of B's surface is in A.
///
/// Holds the working memory of the query: use one object per thread. Warm queries allocate nothing.
class DepthQuery {
 public:
  DepthQuery();
  DepthQuery(const DepthQuery&);  ///< the copy gets its own memory
  DepthQuery& operator=(const DepthQuery&);
  DepthQuery(DepthQuery&&) noexcept;
  DepthQuery& operator=(DepthQuery&&) noexcept;
  ~DepthQuery();

  /// The tolerance is a length > 0. Values below 1e-12 of the meshes' sizes are raised to that. Up to
  /// rounding (1e-15 of the coordinates) the answer is between `depth` and `upper_bound`.
  GougeDepth deepest(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance,
                     const DepthsSought& sought = {});

 private:
  detail::DepthSearch& search();

  std::unique_ptr<detail::DepthSearch> search_;  // made by the first query
};

}  // namespace octoblisk
