// How deep one surface reaches into a solid: the depth of a gouge.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/containment.h"
#include "octoblisk/detail/candidate_pair.h"
#include "octoblisk/solid_boundary.h"
#include "octoblisk/surface.h"

namespace octoblisk {

enum class Gouging {
  none,     ///< no point of B's surface is in A: the two are apart, or A is wholly inside B
  found,    ///< B's surface touches A's, or reaches into A
  unknown,  ///< A's surface is open: there is nothing to be inside of
};

/// The deepest point found; points are in the frame of A.
struct GougeDepth {
  Gouging gouging = Gouging::none;
  double depth = 0.0;              ///< the distance of the two points: that deep B does reach
  double upper_bound = 0.0;        ///< no deeper; at most the tolerance above the depth
  Vec3 point_on_b = Vec3::Zero();  ///< inside A, or on it
  Vec3 point_on_a = Vec3::Zero();  ///< on A's surface: the closest to the point on B
  std::uint32_t triangle_a = kNoTriangle;
  std::uint32_t triangle_b = kNoTriangle;
  /// False: B meets A's surface, or lies nearest to it, where that bounds no solid (solid_boundary.h). Then B
  /// may reach deeper than the upper bound, or may not be in A at all; where it meets such a triangle,
  /// nothing is measured.
  bool is_known = true;
};

/// Finds the greatest distance to A's surface among those points of B's surface that are in the solid A:
///     depth = max { dist(x, ∂A) : x ∈ ∂B ∩ A }.
/// A must be closed (containment.h says what its inside is), B may be open. Where B is wholly inside A, that
/// is the distance of B's innermost point. Where A is wholly inside B, no point of B's surface is in A.
///
/// Branch and bound: first the triangles of B that meet A's surface, and from their corners those that are
/// wholly inside; these are divided until no part may be deeper than the deepest point found by more than the
/// tolerance. Triangles of B that lie flat on one of A, within the tolerance, are left out. A part is bounded
/// by its distance to triangles of A near it, because the signed distance grows by no more than the way, and
/// by moving it out of A as a whole.
///
/// Holds the working memory of the query: one object a thread. Warm queries allocate nothing.
class DepthQuery {
 public:
  /// The tolerance is a length > 0; one below 1e-12 of the meshes' sizes is raised to it. Up to rounding
  /// (1e-15 of the coordinates) the answer is between `depth` and `upper_bound`.
  GougeDepth deepest(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance);

  /// The same where A's surface may have holes, be doubled, or meet itself: holes elsewhere change nothing.
  GougeDepth deepest(const SolidBoundary& a, const Surface& b, const Pose& b_in_a, double tolerance);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  enum class Side : std::uint8_t { unknown, outside, inside, on_surface, undecided };
  enum class Mark : std::uint8_t { none, flat, crossing, inside };

  /// A corner of B's mesh, or of a part of one of its triangles.
  struct Corner {
    Vec3 point = Vec3::Zero();
    Vec3 foot = Vec3::Zero();  // of the point on the nearest triangle of A known so far
    double distance = std::numeric_limits<double>::infinity();  // to the foot
    std::uint32_t nearest = kNoTriangle;
    bool is_exact = false;  // no triangle is nearer
    Side side = Side::unknown;
  };

  /// A part of a triangle of B, and those triangles of A that meet it: met_[begin .. end).
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

  void prepare(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance);
  GougeDepth searched();
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
  bool hasOpenWay(std::uint32_t corner_of_b) const;
  void findInside();
  void spread(std::uint32_t from);
  void search();
  void addTriangle(std::uint32_t triangle, std::uint32_t met_begin, std::uint32_t met_end);

  std::uint32_t addCorner(std::uint32_t corner_of_b);
  void considerNear(Corner& corner, std::uint32_t triangle) const;
  void measure(Corner& corner) const;
  void findNearest(Corner& corner) const;
  Side sideOf(Corner& corner);
  void keepDeeper(Corner& corner, std::uint32_t triangle_b);
  void keepCrossing(TrianglePair pair);
  void add(Part part);
  void divide(const Part& part);
  Cut cutOf(const Part& part) const;
  double boundOf(const Part& part);
  double boundByWayOut(const Part& part);
  Vec3 outwards(std::uint32_t triangle_a) const;
  bool isOutside(const Triangle& triangle) const;
  void gatherExtremes(const Part& part);
  double limit() const { return best_.depth + tolerance_; }
  Triangle triangleOf(const Part& part) const;

  const Surface* a_ = nullptr;
  const Surface* b_ = nullptr;
  const SolidBoundary* boundary_ = nullptr;  // of A, where it does not bound a solid everywhere
  Pose b_in_a_;
  double tolerance_ = 0.0;
  double flatness_ = 0.0;  // within it, a triangle of B lies flat on one of A
  GougeDepth best_;
  double greatest_dropped_ = 0.0;  // of the bounds of parts that were let go
  std::uint32_t last_nearest_ = kNoTriangle;

  std::vector<detail::CandidatePair> candidate_pairs_;
  std::vector<TrianglePair> flat_;       // triangles of B, each with the one of A that it lies on
  std::vector<TrianglePair> crossings_;  // by ascending triangle of B
  std::optional<TrianglePair> touch_;    // two that meet, if any do
  std::vector<Mark> mark_;               // of B's triangles
  std::vector<std::uint32_t> marked_;
  std::vector<std::uint32_t> corner_of_b_;  // of B's corners: an index in corners_, or none
  std::vector<std::uint32_t> known_;        // the corners of B that have one
  std::vector<bool> part_crosses_;          // of the parts of B's surface
  std::vector<std::uint32_t> open_;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> met_;
  std::vector<Vec3> extremes_;
  std::vector<std::uint32_t> candidates_;
  std::vector<double> distances_;  // of each candidate to each extreme
  std::vector<Part> parts_;        // a heap: the greatest bound first
};

}  // namespace octoblisk
