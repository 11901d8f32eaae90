// The search of DepthQuery (octoblisk/depth.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/no_index.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"

namespace octoblisk::detail {

/// Branch and bound. The search starts with the triangles of B that meet A's surface. From their corners it
/// spreads to the triangles that are wholly inside. It divides these triangles until no part can be deeper
/// than the deepest point found by more than the tolerance. It skips triangles of B that lie flat on a
/// triangle of A, within the tolerance. Two bounds hold for a part. One comes from its distance to nearby
/// triangles of A: the signed distance grows by no more than the distance travelled. The other comes from
/// moving the whole part out of A.
class DepthSearch {
 public:
  /// As DepthQuery::deepest.
  GougeDepth deepest(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance,
                     const DepthsSought& sought);

 private:
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
  PointLocation located(const Vec3& point) const { return locate(*solid_a_, point); }
  bool boundsSolid(std::uint32_t triangle_a) const {
    return is_whole_ || solid_a_->role(solid_a_->sourceOf(triangle_a)) != TriangleRole::sheet;
  }
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
  bool isOutside(const Triangle& triangle) const;
  void gatherExtremes(const Part& part);
  double deepestSoFar() const { return std::max(best_.depth, sought_.above); }
  double limit() const { return deepestSoFar() + tolerance_; }
  bool isEnough() const { return best_.depth > sought_.enough; }
  Triangle triangleOf(const Part& part) const;

  const Surface* solid_a_ = nullptr;
  const Surface* a_ = nullptr;  // the boundary of solid A
  const Surface* b_ = nullptr;  // the boundary of B
  bool is_whole_ = true;        // whether A has no defects, so that all that enters it passes its triangles
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

}  // namespace octoblisk::detail
