// What is told of an accessibility map: tables and a picture.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "access/access_map.h"
#include "report/image.h"

namespace octoblisk::demos {

/// "belt on blade 2", "arm on hub or shroud", "belt too deep in blade 1", "arm wholly inside".
std::string describe(const Hindrance& obstacle, std::span<const ToolPart> parts);

/// A finished map, as the reports need it.
struct AccessRun {
  bool of_path = false;  ///< the sites are a path's poses
  std::vector<ToolPart> parts;
  ReachRules rules;
  AccessOptions options;
  std::vector<ContactSite> sites;
  std::vector<SiteAccess> access;  ///< of each site

  std::size_t nowhereFree() const;
  double freeFraction() const;  ///< of all tilts and leads of all sites
};

/// points.csv: a row for each point. Throws std::runtime_error naming a file that can't be written.
void writePoints(const AccessRun& run, const std::filesystem::path& file);

/// ranges.csv: a row for each free range of tilt. Throws as above.
void writeRanges(const AccessRun& run, const std::filesystem::path& file);

/// The blade's side unrolled, height over arc length, each point's cell in the colour of its widest free
/// range of tilt. Points without an arc length are left out.
Image accessPicture(const AccessRun& run, int width = 1600, int height = 1200);

}  // namespace octoblisk::demos
