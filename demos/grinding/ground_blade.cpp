#include "grinding/ground_blade.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "base/parallel.h"
#include "octoblisk/collide.h"

namespace octoblisk::demos {

using namespace detail;

std::optional<int> bladeTouchedMost(const ClusteredOctree& blisk, const ClusteredOctree& belt,
                                    std::span<const int> blade_of_triangle, std::span<const Pose> path,
                                    int threads, const RunWatch& watch) {
  constexpr std::size_t kTouchesAtOnce = 256;
  std::vector<std::set<int>> touched(path.size());
  for (std::size_t begin = 0; begin < path.size(); begin += kTouchesAtOnce) {
    if (watch.isStopped()) return std::nullopt;
    const std::size_t end = std::min(path.size(), begin + kTouchesAtOnce);
    parallelFor(end - begin, threads, [&](std::size_t i, std::size_t) {
      std::vector<TrianglePair> pairs;
      touchingPairs(blisk, belt, path[begin + i], pairs);
      for (const TrianglePair& pair : pairs) touched[begin + i].insert(blade_of_triangle[pair.a]);
    });
    watch.report("which blade is ground", end);
  }
  std::map<int, int> poses_of_blade;
  for (const std::set<int>& blades : touched) {
    for (const int blade : blades) {
      if (blade != 0) ++poses_of_blade[blade];
    }
  }
  const auto most =
      std::ranges::max_element(poses_of_blade, {}, [](const auto& entry) { return entry.second; });
  return most == poses_of_blade.end() ? 0 : most->first;
}

}  // namespace octoblisk::demos
