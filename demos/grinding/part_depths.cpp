#include "grinding/part_depths.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/parallel.h"
#include "grinding/lift.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/containment.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr double kPartOfLimit = 0.01;
constexpr double kLeastTolerance = 1e-4;  // mm
constexpr double kLeastFine = 0.01;       // mm
constexpr double kFiner = 0.1;            // where the limit is between the bounds
constexpr double kCoarse = 0.5;           // part of the limit, of a first question

}  // namespace

PartDepths::PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                       double limit, int threads)
    : PartDepths(std::move(blisk), parts, std::vector<double>(parts.size(), limit), threads) {}

PartDepths::PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                       std::vector<double> limits, int threads)
    : blisk_(std::move(blisk)),
      parts_(std::move(parts)),
      limits_(std::move(limits)),
      blisk_surface_(*blisk_),
      queries_(static_cast<std::size_t>(threadCount(threads))) {
  for (const ToolPart& part : parts_) part_surfaces_.emplace_back(*part.tree);
  if (!blisk_surface_.isClosed()) return;
  for (const double limit : limits_) {
    const auto [known, is_new] = fine_.try_emplace(limit);
    if (!is_new) continue;
    known->second.resize(blisk_->mesh().triangleCount(), 0);
    for (const std::uint32_t triangle : fineFeatures(blisk_surface_, std::max(limit, kLeastFine), threads)) {
      known->second[triangle] = 1;
    }
  }
}

DepthKind PartDepths::kindOf(std::size_t part) const {
  if (!blisk_surface_.isClosed()) return DepthKind::of_pairs;
  return part_surfaces_[part].isClosed() ? DepthKind::of_solids : DepthKind::of_part;
}

std::vector<std::vector<PartDepth>> PartDepths::measure(std::span<const Pose> tool_in_blisk) {
  std::vector<std::vector<PartDepth>> found(tool_in_blisk.size());
  parallelFor(found.size(), static_cast<int>(queries_.size()), [&](std::size_t i, std::size_t worker) {
    found[i] = measureAt(tool_in_blisk[i], queries_[worker]);
  });
  return found;
}

std::vector<std::optional<PartDepth>> PartDepths::measure(std::span<const std::size_t> parts,
                                                          std::span<const Pose> tool_in_blisk) {
  std::vector<std::optional<PartDepth>> found(parts.size());
  parallelFor(found.size(), static_cast<int>(queries_.size()), [&](std::size_t i, std::size_t worker) {
    found[i] = kindOf(parts[i]) == DepthKind::of_pairs ? ofPairs(parts[i], tool_in_blisk[i])
                                                       : ofPart(parts[i], tool_in_blisk[i], queries_[worker]);
  });
  return found;
}

/// Measured more closely while the limit is between the bounds.
GougeDepth PartDepths::settled(DepthQuery& query, const octoblisk::Surface& a, const octoblisk::Surface& b,
                               const Pose& b_in_a, double limit) const {
  const double tolerance = std::max(kPartOfLimit * limit, kLeastTolerance);
  const GougeDepth found = query.deepest(a, b, b_in_a, tolerance);
  if (found.depth > limit || found.upper_bound <= limit) return found;
  return query.deepest(a, b, b_in_a, kFiner * tolerance);
}

/// The blisk's fine features that have a point in the part, and maybe some that have none.
std::vector<std::uint32_t> PartDepths::fineInside(std::size_t part, const Pose& tool_in_blisk,
                                                  DepthQuery& query) const {
  std::vector<std::uint32_t> triangles;
  query.meetingOrInside(part_surfaces_[part], blisk_surface_, tool_in_blisk.inverse(), triangles);
  const std::vector<char>& fine = fine_.at(limits_[part]);
  std::erase_if(triangles, [&](std::uint32_t triangle) { return !fine[triangle]; });
  std::ranges::sort(triangles);
  return triangles;
}

/// The deepest point of these in the part, if it is beyond the limit.
std::optional<DeepPoint> PartDepths::fineBeyond(std::size_t part, const Pose& tool_in_blisk,
                                                DepthQuery& query) const {
  return deepestBeyond(blisk_->mesh(), fineInside(part, tool_in_blisk, query), part_surfaces_[part],
                       tool_in_blisk.inverse(), std::max(limits_[part], kLeastFine));
}

/// Proved by a lift off a triangle of the blisk; false: not proved.
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
  const bool has_inside = kindOf(part) == DepthKind::of_solids;
  const GougeDepth of_part = settled(query, blisk_surface_, surface, tool_in_blisk, limit);
  if (of_part.gouging != Gouging::found) {  // no surfaces meet: the blisk may be inside the part
    if (!has_inside) return std::nullopt;
    const GougeDepth of_blisk = settled(query, surface, blisk_surface_, tool_in_blisk.inverse(), limit);
    if (of_blisk.gouging != Gouging::found) return std::nullopt;
    return PartDepth{part, of_blisk.depth, of_blisk.triangle_b, tool_in_blisk * of_blisk.point_on_b, true};
  }
  const bool touches = collide(*blisk_, *parts_[part].tree, tool_in_blisk).has_value();
  const bool may_be_deeper = touches && has_inside && of_part.depth <= limit;
  if (may_be_deeper && !staysWithin(part, tool_in_blisk, of_part.triangle_a)) {
    const auto of_blisk = fineBeyond(part, tool_in_blisk, query);
    if (of_blisk) return PartDepth{part, of_blisk->depth, of_blisk->triangle, of_blisk->point, false};
  }
  return PartDepth{part, of_part.depth, of_part.triangle_a, of_part.point_on_a, !touches};
}

std::optional<PartDepth> PartDepths::ofPairs(std::size_t part, const Pose& tool_in_blisk) const {
  std::vector<Contact> touches;
  contacts(*blisk_, *parts_[part].tree, tool_in_blisk, 0.0, touches);
  std::vector<PartContact> of_part;
  for (const Contact& contact : touches) of_part.push_back({part, contact});
  const std::vector<PartDepth> deepest = depthsOfPairs(of_part);
  return deepest.empty() ? std::nullopt : std::optional(deepest.front());
}

bool PartDepths::isBeyond(std::size_t part, const Pose& tool_in_blisk, const TrianglePair& touch,
                          std::optional<std::uint32_t>& deep_corner, std::size_t thread) {
  const double limit = limits_[part];
  if (kindOf(part) == DepthKind::of_pairs) {
    const auto deepest = ofPairs(part, tool_in_blisk);
    return deepest && deepest->depth > limit;
  }
  if (staysWithin(part, tool_in_blisk, touch.a)) return false;
  const double tolerance = std::max(kPartOfLimit * limit, kLeastTolerance);
  const double beyond = limit + tolerance;
  if (deep_corner && depthOfCorner(part, tool_in_blisk, *deep_corner) > beyond) return true;
  if (const auto corner = cornerBeyond(part, tool_in_blisk, touch.b, beyond)) {
    deep_corner = corner;
    return true;
  }
  DepthQuery& query = queries_[thread];
  const octoblisk::Surface& surface = part_surfaces_[part];
  const double coarse = std::max(kCoarse * limit, kLeastTolerance);
  const GougeDepth guess = query.deepest(blisk_surface_, surface, tool_in_blisk, coarse);
  if (guess.depth > beyond) return true;
  if (guess.upper_bound > limit &&
      settled(query, blisk_surface_, surface, tool_in_blisk, limit).depth > limit) {
    return true;
  }
  if (kindOf(part) != DepthKind::of_solids) return false;
  // No fine feature is deeper than the blisk's deepest point.
  const GougeDepth of_blisk = query.deepest(surface, blisk_surface_, tool_in_blisk.inverse(), coarse);
  return of_blisk.upper_bound > std::max(limit, kLeastFine) &&
         fineBeyond(part, tool_in_blisk, query).has_value();
}

double PartDepths::depthOfCorner(std::size_t part, const Pose& tool_in_blisk, std::uint32_t corner) const {
  const Vec3 point = tool_in_blisk * part_surfaces_[part].position(corner);
  if (locate(blisk_surface_, point) != PointLocation::inside) return 0.0;
  return closestPoint(*blisk_, point).value().distance;
}

/// Climbs from a triangle that touches, corner by corner, to where the part is deeper. None: not known.
std::optional<std::uint32_t> PartDepths::cornerBeyond(std::size_t part, const Pose& tool_in_blisk,
                                                      std::uint32_t touching_triangle, double depth) const {
  constexpr int kMostSteps = 32;
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
  for (int step = 0; risen && deepest <= depth && step < kMostSteps; ++step) {
    risen = std::ranges::any_of(surface.star(at), rises);
  }
  return deepest > depth ? std::optional(at) : std::nullopt;
}

std::vector<PartDepth> PartDepths::measureAt(const Pose& tool_in_blisk, DepthQuery& query) const {
  std::vector<PartDepth> found;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (kindOf(part) == DepthKind::of_pairs) continue;
    if (const auto depth = ofPart(part, tool_in_blisk, query)) found.push_back(*depth);
  }
  return found;
}

std::vector<PartDepth> depthsOfPairs(std::span<const PartContact> contacts) {
  std::map<std::size_t, PartDepth> deepest;
  for (const auto& [part, contact] : contacts) {
    if (contact.distance > 0.0) continue;
    const PartDepth here{part, -contact.distance, contact.triangle_a, contact.point_on_a, false};
    const auto [known, is_new] = deepest.try_emplace(part, here);
    if (!is_new && here.depth > known->second.depth) known->second = here;
  }
  std::vector<PartDepth> found;
  for (const auto& [part, depth] : deepest) found.push_back(depth);
  return found;
}

}  // namespace octoblisk::demos
