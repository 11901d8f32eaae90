// Shows an accessibility map as a replay: the tool at each point, at the middle of its widest free range.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "access/access_table.h"
#include "models/blade_finder.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// A complete map of at least one point.
struct AccessMap {
  AccessQuestion question;
  std::vector<ContactSite> sites;
  std::vector<SiteAccess> access;  ///< per site
  std::vector<ToolPart> parts;
  int blade_count = 0;
  std::vector<Fixture> fixtures = {};

  std::size_t nowhereFree() const;
  double freeFraction() const;  ///< over all tilts and leads of all sites
};

/// `blisk_name` is shown as it is.
Replay accessReplay(const AccessMap& map, std::shared_ptr<const ClusteredOctree> blisk,
                    const BladesFound& blades, const std::string& blisk_name);

}  // namespace octoblisk::demos
