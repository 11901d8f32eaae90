// Finds the tilts and leads at which the tool is free at each contact point.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "access/contact_site.h"
#include "grinding/judge.h"

namespace octoblisk::demos {

/// Sites that are answered together. If several obstacles block a site, the one named may depend on the sites
/// before it in the same group.
inline constexpr std::size_t kSitesAtOnce = 8;

/// In degrees.
struct AccessOptions {
  double tilt_from = -180.0;
  double tilt_step = 1.0;
  int tilts = 360;
  std::vector<double> leads = {0.0};  ///< ascending

  double tilt(int index) const { return tilt_from + index * tilt_step; }
  /// True if the first tilt follows the last one in the circle.
  bool isFullTurn() const;
};

/// A run of consecutive free tilts, both ends included; the last may be beyond a full turn.
struct FreeRange {
  std::size_t lead = 0;  ///< index of AccessOptions::leads
  double tilt_from = 0.0, tilt_to = 0.0;

  double width() const { return tilt_to - tilt_from; }
};

/// How often a part is blocked by a blade, whatever the reason; the first reason found is kept.
struct ObstacleCount {
  Obstruction obstacle;
  std::size_t times = 0;
};

struct SiteAccess {
  std::size_t free = 0;                   ///< number of free combinations of tilt and lead
  std::vector<FreeRange> ranges;          ///< by lead, then by tilt
  std::optional<std::size_t> widest;      ///< index of the widest range, the first if several are
  double lead_from = 0.0, lead_to = 0.0;  ///< the leads around the widest range's that are free at its
                                          ///< middle tilt
  std::vector<ObstacleCount> obstacles;   ///< each part and blade once, the most frequent first
};

/// Tries every tilt at every lead of every site; the answer does not depend on the judge's threads.
std::vector<SiteAccess> accessOf(Judge& judge, std::span<const ContactSite> sites,
                                 const AccessOptions& options);

}  // namespace octoblisk::demos
