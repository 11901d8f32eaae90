#include "cell/part_depths.h"

#include <algorithm>
#include <map>
#include <utility>

#include "octoblisk/collide.h"
#include "octoblisk/parallel.h"

namespace octoblisk::demos {
namespace {

constexpr double kPartOfLimit = 0.01;
constexpr double kLeastTolerance = 1e-4;  // mm
constexpr double kFiner = 0.1;            // where the limit is between the bounds

}  // namespace

PartDepths::PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                       double limit, int threads)
    : blisk_(std::move(blisk)),
      parts_(std::move(parts)),
      limit_(limit),
      tolerance_(std::max(kPartOfLimit * limit, kLeastTolerance)),
      blisk_surface_(*blisk_),
      queries_(static_cast<std::size_t>(threadCount(threads))) {
  for (const ToolPart& part : parts_) part_surfaces_.emplace_back(*part.tree);
  if (!blisk_surface_.isClosed() || limit == 0.0) return;
  fine_ = fineFeatures(blisk_surface_, limit, threads);
  if (fine_.tree) fine_surface_.emplace(*fine_.tree);
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

/// Measured more closely while the limit is between the bounds.
GougeDepth PartDepths::settled(DepthQuery& query, const octoblisk::Surface& a, const octoblisk::Surface& b,
                               const Pose& b_in_a) const {
  const GougeDepth found = query.deepest(a, b, b_in_a, tolerance_);
  if (found.depth > limit_ || found.upper_bound <= limit_) return found;
  return query.deepest(a, b, b_in_a, kFiner * tolerance_);
}

/// The blisk's deepest point in a part, with its triangle's number in the blisk.
GougeDepth PartDepths::ofBlisk(DepthQuery& query, std::size_t part, const Pose& tool_in_blisk,
                               bool touches) const {
  const bool fine_suffice = touches && limit_ > 0.0;
  if (fine_suffice && !fine_surface_) return {};
  const octoblisk::Surface& blisk = fine_suffice ? *fine_surface_ : blisk_surface_;
  GougeDepth found = settled(query, part_surfaces_[part], blisk, tool_in_blisk.inverse());
  if (found.gouging == Gouging::found && fine_suffice) found.triangle_b = fine_.triangles[found.triangle_b];
  return found;
}

std::vector<PartDepth> PartDepths::measureAt(const Pose& tool_in_blisk, DepthQuery& query) const {
  std::vector<PartDepth> found;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (kindOf(part) == DepthKind::of_pairs) continue;
    const GougeDepth of_part = settled(query, blisk_surface_, part_surfaces_[part], tool_in_blisk);
    const bool touches = collide(*blisk_, *parts_[part].tree, tool_in_blisk).has_value();
    GougeDepth of_blisk;
    if (kindOf(part) == DepthKind::of_solids) of_blisk = ofBlisk(query, part, tool_in_blisk, touches);
    if (of_blisk.gouging == Gouging::found &&
        (of_blisk.depth > of_part.depth || of_part.gouging != Gouging::found)) {
      found.push_back(
          {part, of_blisk.depth, of_blisk.triangle_b, tool_in_blisk * of_blisk.point_on_b, !touches});
    } else if (of_part.gouging == Gouging::found) {
      found.push_back({part, of_part.depth, of_part.triangle_a, of_part.point_on_a, !touches});
    }
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
