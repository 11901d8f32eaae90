// Links the runs of a path with motions through free space.
#pragma once

#include <vector>

#include "grinding/judge.h"

namespace octoblisk::demos {

/// Successive contacts, with the surface's normals at the first and the last one.
struct Run {
  std::vector<Pose> poses;
  Vec3 off_first, off_last;
};

/// A path from home through runs and back home.
struct LinkedPath {
  std::vector<Pose> poses;
  std::vector<bool> grinds;       ///< per pose: whether it belongs to a run
  std::vector<std::size_t> lost;  ///< indices of the runs that no free link reaches
};

/// Homes of the tool: all poses in which the tool, however it is turned, is away from blisk and fixtures.
class Home {
 public:
  explicit Home(const Judge& judge);

  /// The pose, retracted along the arm until it is a home.
  Pose of(const Pose& pose) const;
  /// The homes between two homes, on the way around the blisk.
  std::vector<Pose> between(const Pose& from, const Pose& to) const;

 private:
  Vec3 center_;
  double distance_;  // of the tool's origin from the centre
};

/// Each link is the shortest free one of a few: off the surface along the normal, then along the arm, across,
/// and back in the same way. If none is free, the tool goes home between the runs. Runs that cannot be
/// reached even so are left out. The judge proves all motions of links.
LinkedPath linkRuns(Judge& judge, const Home& home, const std::vector<Run>& runs);

}  // namespace octoblisk::demos
