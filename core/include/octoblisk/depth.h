// How deep one surface reaches into a solid: the depth of a gouge.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/containment.h"
#include "octoblisk/solid_boundary.h"
#include "octoblisk/surface.h"

namespace octoblisk {

enum class Gouging {
  none,     ///< no point of B's surface is in A: A and B are apart, or A is wholly inside B
  found,    ///< B's surface touches A's, or reaches into A
  unknown,  ///< A's surface is open, so it has no inside
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
  /// False if B meets A's surface, or is nearest to it, where the surface bounds no solid (solid_boundary.h).
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
/// A must be closed (containment.h defines its inside); B may be open. If B is wholly inside A, the depth is
/// that of B's innermost point. If A is wholly inside B, no point of B's surface is in A.
///
/// Branch and bound. The search starts with the triangles of B that meet A's surface. From their corners it
/// spreads to the triangles that are wholly inside. It divides these triangles until no part can be deeper
/// than the deepest point found by more than the tolerance. It skips triangles of B that lie flat on a
/// triangle of A, within the tolerance. The bound of a part comes from its distance to nearby triangles of A,
/// because the signed distance grows by no more than the distance travelled, and from moving the part out of
/// A as a whole.
///
/// Holds the working memory of the query: use one object per thread. Warm queries allocate nothing.
class DepthQuery {
 public:
  /// The tolerance is a length > 0; values below 1e-12 of the meshes' sizes are raised to it. Up to rounding
  /// (1e-15 of the coordinates) the answer is between `depth` and `upper_bound`.
  GougeDepth deepest(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance,
                     const DepthsSought& sought = {});

  /// The same for a surface A that may have holes, be doubled, or meet itself. Holes elsewhere do not change
  /// the answer.
  GougeDepth deepest(const SolidBoundary& a, const Surface& b, const Pose& b_in_a, double tolerance,
                     const DepthsSought& sought = {});

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  enum class Mark : std::uint8_t { none, flat, crossing, inside };

  /// A corner of B's mesh, or of a part of one of its triangles.
  struct Corner {
    Vec3 point = Vec3::Zero();
    Vec3 foot = Vec3::Zero();  // the closest point on the nearest triangle of A found so far
    double distance = std::numeric_limits<double>::infinity();  // to the foot
    std::uint32_t nearest = kNoTriangle;
    bool is_exact = false;                       // no triangle of A is nearer
    std::optional<PointLocation> location = {};  // where it is in A, once asked
  };

  /// A part of a triangle of B, and the triangles of A that meet it: met_[met_begin .. met_end).
  struct Part {
    std::array<std::uint32_t, 3> corner;
    std::uint32_t triangle;
    std::uint32_t met_begin, met_end;
    std::uint32_t generation;
    double bound;  // no point of it inside A is deeper
  };

  struct Cut {
    std::size_t edge;  // from corner `edge` to the next
    double at;         // 0..1
  };

  void prepare(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance,
               const DepthsSought& sought);
  GougeDepth run();
  PointLocation located(const Vec3& point) const;
  PointLocation located(Corner& corner);
  bool boundsSolid(std::uint32_t triangle_a) const { return !boundary_ || boundary_->has(triangle_a); }
  void findCrossings();
  bool findCopy();
  void findTouch();
  bool meet(TrianglePair pair) const;
  bool liesOn(TrianglePair pair);
  void noteBarrier(std::uint32_t triangle_b);
  bool isBarrier(std::uint32_t triangle_b) const;
  bool isReachable(std::uint32_t corner_of_b) const;
  void findInside();
  void spread(std::uint32_t from);
  void search();
  void addTriangle(std::uint32_t triangle, std::uint32_t met_begin, std::uint32_t met_end);

  std::uint32_t addCorner(std::uint32_t corner_of_b);
  void considerNear(Corner& corner, std::uint32_t triangle) const;
  void measure(Corner& corner) const;
  void findNearest(Corner& corner) const;
  PointLocation locationOf(Corner& corner);
  void keepDeeper(Corner& corner, std::uint32_t triangle_b);
  void keepCrossing(TrianglePair pair);
  void add(Part part);
  void divide(const Part& part);
  Cut cutOf(const Part& part) const;
  double boundOf(const Part& part);
  double boundByMovingOut(const Part& part);
  Vec3 outwards(std::uint32_t triangle_a) const;
  bool isOutside(const Triangle& triangle) const;
  void gatherExtremes(const Part& part);
  double deepestSoFar() const { return std::max(best_.depth, sought_.above); }
  double limit() const { return deepestSoFar() + tolerance_; }
  bool isEnough() const { return best_.depth > sought_.enough; }
  Triangle triangleOf(const Part& part) const;

  const Surface* a_ = nullptr;
  const Surface* b_ = nullptr;
  const SolidBoundary* boundary_ = nullptr;  // A's boundary, if A does not bound a solid everywhere
  Pose b_in_a_;
  double tolerance_ = 0.0;
  DepthsSought sought_;
  GougeDepth best_;
  double greatest_dropped_ = 0.0;  // the greatest bound among discarded parts
  std::uint32_t last_nearest_ = kNoTriangle;

  std::vector<TrianglePair> undecided_;  // pairs that may meet
  std::vector<TrianglePair> flat_;       // triangles of B, each with the triangle of A that it lies on
  std::vector<TrianglePair> crossings_;  // by ascending triangle of B
  std::optional<TrianglePair> touch_;    // two triangles that meet, if any do
  std::vector<Mark> mark_;               // per triangle of B
  std::vector<std::uint32_t> marked_;
  std::vector<std::uint32_t> index_of_corner_;  // per corner of B: its index in corners_, or none
  std::vector<std::uint32_t> indexed_;          // the corners of B that have an index
  std::vector<bool> component_crosses_;         // per component of B's surface
  std::vector<std::uint32_t> open_;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> met_;
  std::vector<Vec3> extremes_;
  std::vector<std::uint32_t> candidates_;
  std::vector<double> distances_;  // of each candidate to each extreme
  std::vector<Part> parts_;        // a heap: greatest bound first
};

}  // namespace octoblisk
