#include "access/access_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace octoblisk::demos {
namespace {

/// The runs of free tilts at a lead; a run that continues past the last tilt is joined with the first.
std::vector<FreeRange> rangesOf(std::span<const PoseState> states, std::size_t lead,
                                const AccessOptions& options) {
  const int count = options.tilts;
  const auto is_free = [&](int tilt) { return !states[static_cast<std::size_t>(tilt)].obstacle; };
  std::vector<FreeRange> ranges;
  for (int tilt = 0; tilt < count; ++tilt) {
    if (!is_free(tilt)) continue;
    const int first = tilt;
    while (tilt + 1 < count && is_free(tilt + 1)) ++tilt;
    ranges.push_back({lead, options.tilt(first), options.tilt(tilt)});
  }
  const bool joins = ranges.size() > 1 && options.isFullTurn() && is_free(0) && is_free(count - 1);
  if (joins) {
    ranges.back().tilt_to = ranges.front().tilt_to + 360.0;
    ranges.erase(ranges.begin());
  }
  return ranges;
}

/// Each part and blade once, the most frequent first.
std::vector<ObstacleCount> countsOf(std::span<const PoseState> states) {
  std::map<std::pair<std::size_t, int>, ObstacleCount> known;
  for (const PoseState& state : states) {
    if (!state.obstacle) continue;
    const auto key = std::pair(state.obstacle->part, state.obstacle->blade);
    ++known.try_emplace(key, ObstacleCount{*state.obstacle, 0}).first->second.times;
  }
  std::vector<ObstacleCount> counts;
  for (const auto& [key, count] : known) counts.push_back(count);
  std::ranges::stable_sort(counts, std::ranges::greater{}, &ObstacleCount::times);
  return counts;
}

SiteAccess accessAt(std::span<const PoseState> states, const AccessOptions& options) {
  const auto tilts = static_cast<std::size_t>(options.tilts);
  SiteAccess access;
  for (std::size_t lead = 0; lead < options.leads.size(); ++lead) {
    for (const FreeRange& range : rangesOf(states.subspan(lead * tilts, tilts), lead, options)) {
      access.ranges.push_back(range);
    }
  }
  access.free = static_cast<std::size_t>(
      std::ranges::count_if(states, [](const PoseState& state) { return !state.obstacle; }));
  access.obstacles = countsOf(states);
  for (std::size_t k = 0; k < access.ranges.size(); ++k) {
    if (!access.widest || access.ranges[k].width() > access.ranges[*access.widest].width()) access.widest = k;
  }
  if (!access.widest) return access;

  const FreeRange& widest = access.ranges[*access.widest];
  const double middle = 0.5 * (widest.tilt_from + widest.tilt_to);
  const auto steps = static_cast<std::size_t>((middle - options.tilt_from) / options.tilt_step);
  const std::size_t tilt = steps % tilts;
  const auto is_free = [&](std::size_t lead) { return !states[lead * tilts + tilt].obstacle; };
  std::size_t first = widest.lead, last = widest.lead;
  while (first > 0 && is_free(first - 1)) --first;
  while (last + 1 < options.leads.size() && is_free(last + 1)) ++last;
  access.lead_from = options.leads[first];
  access.lead_to = options.leads[last];
  return access;
}

}  // namespace

bool AccessOptions::isFullTurn() const { return std::abs(tilts * tilt_step - 360.0) < 1e-9; }

std::vector<SiteAccess> accessOf(Judge& judge, std::span<const ContactSite> sites,
                                 const AccessOptions& options) {
  const std::size_t poses_of_site = options.leads.size() * static_cast<std::size_t>(options.tilts);
  std::vector<SiteAccess> found;
  std::vector<Pose> poses;
  for (std::size_t begin = 0; begin < sites.size(); begin += kSitesAtOnce) {
    const std::size_t end = std::min(sites.size(), begin + kSitesAtOnce);
    poses.clear();
    for (std::size_t s = begin; s < end; ++s) {
      for (const double lead : options.leads) {
        for (int tilt = 0; tilt < options.tilts; ++tilt) {
          poses.push_back(tiltedPose(sites[s], options.tilt(tilt), lead));
        }
      }
    }
    const std::vector<PoseState> states = judge.statesOf(poses);
    for (std::size_t s = begin; s < end; ++s) {
      found.push_back(
          accessAt(std::span(states).subspan((s - begin) * poses_of_site, poses_of_site), options));
    }
  }
  return found;
}

}  // namespace octoblisk::demos
