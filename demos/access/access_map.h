// Where the tool may stand at each contact point: which tilts and leads are free.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "access/contact_site.h"
#include "grinding/judge.h"

namespace octoblisk::demos {

/// Sites that are asked for together: which of several obstacles is named may depend on those before in the
/// same group.
inline constexpr std::size_t kSitesAtOnce = 8;

/// Degrees.
struct AccessOptions {
  double tilt_from = -180.0;
  double tilt_step = 1.0;
  int tilts = 360;
  std::vector<double> leads = {0.0};  ///< ascending

  double tilt(int index) const { return tilt_from + index * tilt_step; }
  /// Whether the last tilt is followed by the first.
  bool goesRound() const;
};

/// Tilts that are free one after another, both ends among them; the last may be beyond a full turn.
struct FreeRange {
  std::size_t lead = 0;  ///< index of AccessOptions::leads
  double tilt_from = 0.0, tilt_to = 0.0;

  double width() const { return tilt_to - tilt_from; }
};

/// How often a part is in the way of a blade; of several kinds of being so, the first found.
struct ObstacleCount {
  Hindrance obstacle;
  std::size_t times = 0;
};

struct SiteAccess {
  std::size_t free = 0;                   ///< of all tilts and leads
  std::vector<FreeRange> ranges;          ///< by lead, then by tilt
  std::optional<std::size_t> widest;      ///< of the ranges: the first of the widest
  double lead_from = 0.0, lead_to = 0.0;  ///< the leads round the widest range's that are free at its
                                          ///< middle tilt
  std::vector<ObstacleCount> in_the_way;  ///< each part and blade once, the most often first
};

/// Asks for every tilt at every lead of every site; the answer does not depend on the judge's threads.
/// `progress` is told how many sites are done.
std::vector<SiteAccess> accessOf(Judge& judge, std::span<const ContactSite> sites,
                                 const AccessOptions& options,
                                 const std::function<void(std::size_t)>& progress = {});

}  // namespace octoblisk::demos
