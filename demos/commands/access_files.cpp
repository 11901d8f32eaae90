#include "commands/access_files.h"

#include <iostream>
#include <vector>

#include "access/access_picture.h"
#include "access/access_summary.h"
#include "io/whole_files.h"
#include "render/annotation.h"

namespace octoblisk::demos {

void finishAccess(const std::filesystem::path& points, const AccessQuestion& question, bool picture) {
  const std::filesystem::path out = points.parent_path();
  const std::vector<AccessRow> rows = readAccessTable(points);
  WholeFiles files;
  writeRanges(rows, files.add(out / "ranges.csv"));
  if (picture) writePng(accessPicture(rows, question), files.add(out / "map.png").string());
  files.finish();
  std::cout << reachText(rows) << '\n';
  std::cout << "Tables: " << points.string() << ", " << (out / "ranges.csv").string() << '\n';
  if (picture) std::cout << "Picture: " << (out / "map.png").string() << '\n';
}

int printAccess(std::span<const std::string> tallies, const AccessQuestion& question, std::ostream& words) {
  AccessSummary summary;
  for (const std::string& tally : tallies) summary.add(accessSummaryOfTally(tally));
  words << summaryText(summary, question);
  return summary.nowhere_free > 0 ? 1 : 0;
}

}  // namespace octoblisk::demos
