#include "grinding/part_depths.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/parallel.h"
#include "grinding/depth_proof.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/containment.h"
#include "octoblisk/distance.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr double kPartOfLimit = 0.01;
constexpr double kMinTolerance = 1e-4;  // mm
constexpr double kFiner = 0.1;          // factor, if the limit is between the bounds

double toleranceFor(double limit) { return std::max(kPartOfLimit * limit, kMinTolerance); }

/// Measures more closely as long as the limit is between the bounds.
GougeDepth settled(DepthQuery& query, const octoblisk::Surface& a, const octoblisk::Surface& b,
                   const Pose& b_in_a, double limit, double known_depth = 0.0) {
  const double tolerance = toleranceFor(limit);
  const GougeDepth found = query.deepest(a, b, b_in_a, tolerance, {.above = known_depth});
  if (std::max(found.depth, known_depth) > limit || found.upper_bound <= limit) return found;
  return query.deepest(a, b, b_in_a, kFiner * tolerance, {.above = known_depth});
}

/// Whether B is deeper than the limit, or its depth is unknown; the same answer as by `settled`.
bool isDeeper(DepthQuery& query, const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a,
              double limit) {
  const double tolerance = toleranceFor(limit), beyond = limit + tolerance;
  const GougeDepth found =
      query.deepest(a, b, b_in_a, tolerance, {.above = limit - tolerance, .enough = beyond});
  if (found.depth > beyond || !found.is_known) return true;
  if (found.upper_bound <= limit) return false;
  const GougeDepth closer = settled(query, a, b, b_in_a, limit);
  return closer.depth > limit || !closer.is_known;
}

}  // namespace

PartDepths::PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                       double limit, int threads)
    : PartDepths(std::move(blisk), parts, std::vector<double>(parts.size(), limit), threads) {}

PartDepths::PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                       std::vector<double> limits, int threads, std::span<const Fixture> fixtures)
    : blisk_(std::move(blisk)),
      parts_(std::move(parts)),
      limits_(std::move(limits)),
      blisk_surface_(*blisk_, threads),
      queries_(static_cast<std::size_t>(threadCount(threads))) {
  for (const ToolPart& part : parts_) part_surfaces_.emplace_back(*part.tree, threads);
  for (const Fixture& fixture : fixtures) fixtures_.emplace_back(*fixture.tree, threads);
}

DepthKind PartDepths::kindOf(std::size_t part) const {
  return part_surfaces_[part].isClosed() ? DepthKind::of_solids : DepthKind::of_part;
}

double PartDepths::toleranceOf(std::size_t part) const { return toleranceFor(limits_[part]); }

std::vector<std::vector<PartDepth>> PartDepths::measure(std::span<const Pose> tool_in_blisk) {
  std::vector<std::size_t> parts;
  std::vector<Pose> places;
  for (const Pose& pose : tool_in_blisk) {
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      parts.push_back(part);
      places.push_back(pose);
    }
  }
  const auto depths = measure(parts, places);
  std::vector<std::vector<PartDepth>> found(tool_in_blisk.size());
  parallelFor(found.size(), static_cast<int>(queries_.size()), [&](std::size_t i, std::size_t) {
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      if (const auto& depth = depths[i * parts_.size() + part]) found[i].push_back(*depth);
    }
    addNested(tool_in_blisk[i], found[i]);
  });
  return found;
}

std::vector<std::optional<PartDepth>> PartDepths::measure(std::span<const std::size_t> parts,
                                                          std::span<const Pose> tool_in_blisk) {
  std::vector<std::optional<PartDepth>> found(parts.size());
  std::vector<std::size_t> unknown;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto known = remembers_ ? known_.find({parts[i], bitsOf(tool_in_blisk[i])}) : known_.end();
    if (known == known_.end()) {
      unknown.push_back(i);
    } else {
      found[i] = known->second;
    }
  }
  parallelFor(unknown.size(), static_cast<int>(queries_.size()), [&](std::size_t k, std::size_t worker) {
    const std::size_t i = unknown[k];
    found[i] = ofPart(parts[i], tool_in_blisk[i], queries_[worker]);
  });
  for (const std::size_t i : unknown) {
    if (remembers_) known_.try_emplace({parts[i], bitsOf(tool_in_blisk[i])}, found[i]);
  }
  return found;
}

PartDepths::PoseBits PartDepths::bitsOf(const Pose& pose) {
  PoseBits bits;
  for (std::size_t k = 0; k < bits.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    bits[k] = std::bit_cast<std::uint64_t>(k < 9 ? pose.rotation(at / 3, at % 3) : pose.translation(at - 9));
  }
  return bits;
}

/// Proves it by lifting the part off a triangle of the blisk; false: not proved.
bool PartDepths::staysWithin(std::size_t part, const Pose& tool_in_blisk,
                             std::uint32_t triangle_of_blisk) const {
  const Vec3 normal = scaledNormal(blisk_->mesh().triangle(triangle_of_blisk));
  return !normal.isZero() && partsWhenLifted(blisk_surface_, part_surfaces_[part], tool_in_blisk,
                                             normal.normalized(), limits_[part]);
}

std::optional<PartDepth> PartDepths::ofPart(std::size_t part, const Pose& tool_in_blisk,
                                            DepthQuery& query) const {
  const octoblisk::Surface& surface = part_surfaces_[part];
  const double limit = limits_[part];
  const GougeDepth of_part = settled(query, blisk_surface_, surface, tool_in_blisk, limit);
  if (of_part.gouging != Gouging::found && !of_part.is_known) {
    const Clearance nearest = distance(*blisk_, *parts_[part].tree, tool_in_blisk);
    return PartDepth{part, 0.0, nearest.triangle_a, nearest.point_on_a, true, false};
  }
  GougeDepth of_blisk;
  if (kindOf(part) == DepthKind::of_solids) {
    of_blisk = settled(query, surface, blisk_surface_, tool_in_blisk.inverse(), limit, of_part.depth);
  }
  if (of_part.gouging != Gouging::found && of_blisk.gouging != Gouging::found) return std::nullopt;
  const bool is_inside = !collide(*blisk_, *parts_[part].tree, tool_in_blisk);
  if (of_part.gouging != Gouging::found || of_blisk.depth > of_part.depth) {
    return PartDepth{part,      of_blisk.depth,  of_blisk.triangle_b, tool_in_blisk * of_blisk.point_on_b,
                     is_inside, of_part.is_known};
  }
  return PartDepth{part, of_part.depth, of_part.triangle_a, of_part.point_on_a, is_inside, of_part.is_known};
}

bool PartDepths::isBeyond(std::size_t part, const Pose& tool_in_blisk, const TrianglePair& touch,
                          std::optional<std::uint32_t>& deep_corner, std::size_t thread) {
  const double limit = limits_[part];
  if (blisk_surface_.role(touch.a) == TriangleRole::sheet) return true;
  // A lift proves nothing where a surface does not bound a solid.
  if (blisk_surface_.isWhole() && staysWithin(part, tool_in_blisk, touch.a)) return false;
  const double beyond = limit + toleranceFor(limit);
  if (deep_corner && depthOfCorner(part, tool_in_blisk, *deep_corner) > beyond) return true;
  if (const auto corner = cornerBeyond(part, tool_in_blisk, touch.b, beyond)) {
    deep_corner = corner;
    return true;
  }
  DepthQuery& query = queries_[thread];
  const octoblisk::Surface& surface = part_surfaces_[part];
  return isDeeper(query, blisk_surface_, surface, tool_in_blisk, limit) ||
         (kindOf(part) == DepthKind::of_solids &&
          isDeeper(query, surface, blisk_surface_, tool_in_blisk.inverse(), limit));
}

double PartDepths::depthOfCorner(std::size_t part, const Pose& tool_in_blisk, std::uint32_t corner) const {
  const Vec3 point = tool_in_blisk * part_surfaces_[part].position(corner);
  const ClosestPoint nearest = closestPoint(*blisk_, point).value();
  return locate(blisk_surface_, point, nearest) == PointLocation::inside ? nearest.distance : 0.0;
}

/// Climbs from a touching triangle, corner by corner, to a place that is deeper than the limit. None: not
/// known.
std::optional<std::uint32_t> PartDepths::cornerBeyond(std::size_t part, const Pose& tool_in_blisk,
                                                      std::uint32_t touching_triangle, double depth) const {
  constexpr int kMaxSteps = 32;
  const octoblisk::Surface& surface = part_surfaces_[part];
  double deepest = -1.0;
  std::uint32_t at = 0;
  const auto rises = [&](std::uint32_t triangle) {
    bool risen = false;
    for (const std::uint32_t corner : surface.corners(triangle)) {
      if (corner == at && deepest >= 0.0) continue;
      const double here = depthOfCorner(part, tool_in_blisk, corner);
      if (here <= deepest) continue;
      deepest = here;
      at = corner;
      risen = true;
    }
    return risen;
  };
  bool risen = rises(touching_triangle);
  for (int step = 0; risen && deepest <= depth && step < kMaxSteps; ++step) {
    risen = std::ranges::any_of(surface.star(at), rises);
  }
  return deepest > depth ? std::optional(at) : std::nullopt;
}

/// Adds the parts that contain a fixture or lie inside it.
void PartDepths::addNested(const Pose& tool_in_blisk, std::vector<PartDepth>& found) const {
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    auto first = static_cast<std::uint32_t>(blisk_->mesh().triangleCount());
    for (const octoblisk::Surface& fixture : fixtures_) {
      const ClusteredOctree& tree = fixture.tree();
      if (isNested(part, fixture, tool_in_blisk)) {
        const Clearance nearest = distance(tree, *parts_[part].tree, tool_in_blisk);
        found.push_back({part, 0.0, first + nearest.triangle_a, nearest.point_on_a, true});
      }
      first += static_cast<std::uint32_t>(tree.mesh().triangleCount());
    }
  }
}

bool PartDepths::isInFixture(std::size_t part, const Pose& tool_in_blisk) const {
  return std::ranges::any_of(fixtures_,
                             [&](const auto& fixture) { return isNested(part, fixture, tool_in_blisk); });
}

bool PartDepths::isNested(std::size_t part, const octoblisk::Surface& fixed,
                          const Pose& tool_in_blisk) const {
  const octoblisk::Surface& surface = part_surfaces_[part];
  if (collide(fixed.tree(), surface.tree(), tool_in_blisk)) return false;
  if (fixed.isClosed()) return areNested(fixed, surface, tool_in_blisk);
  for (std::size_t k = 0; surface.isClosed() && k < fixed.componentCount(); ++k) {
    const Vec3& corner = fixed.position(fixed.cornerOfComponent(k));
    if (locate(surface, corner, tool_in_blisk) == PointLocation::inside) return true;
  }
  return false;
}

}  // namespace octoblisk::demos
