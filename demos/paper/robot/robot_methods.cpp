#include "paper/robot/robot_methods.h"

#include <chrono>

#include "build/paper/principal_box.h"
#include "octoblisk/collide.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "paper/box_detection.h"
#include "paper/stopwatch.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

class TickWatch {
 public:
  TimeTaken taken() const {
    const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - start_;
    return {clock.count(), processor_.seconds()};
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Stopwatch processor_;
};

/// The volume of the boxes that the broadphase tests first.
double boxVolume(const ClusteredOctree& tree) {
  double volume = 0.0;
  for (const Obb& box : tree.boxes(ClusteredOctreeBroadphase::kDefaultDepth)) volume += box.volume();
  return volume;
}

}  // namespace

RobotMethods::RobotMethods(const RobotScene& scene, const RobotRunOptions& options, RobotCell& cell)
    : scene_(scene),
      options_(options),
      cell_(cell),
      belt_(principalBox(scene.tool.front().tree->mesh().vertices())),
      octrees_(scene.clouds, options.k_means, options.leaf_capacity) {}

double RobotMethods::range(RobotMethod method) const {
  switch (method) {
    case RobotMethod::traditional:
      return octrees_.traditional.rootVolume();
    case RobotMethod::improved:
      return octrees_.improved.rootVolume();
    default:
      return boxVolume(*scene_.blisk);
  }
}

RobotAnswer RobotMethods::ask(RobotMethod method, const StateEstimate& estimate) const {
  switch (method) {
    case RobotMethod::traditional:
      return askBoxes(octrees_.traditional, estimate);
    case RobotMethod::improved:
      return askBoxes(octrees_.improved, estimate);
    case RobotMethod::yes_or_no:
      return askTriangles(estimate);
    case RobotMethod::exact:
      return askBullet(estimate, 0.0);
    default:
      return askBullet(estimate, options_.margin);
  }
}

RobotAnswer RobotMethods::askBoxes(const Segmentation& boxes, const StateEstimate& estimate) const {
  const TickWatch watch;
  RobotAnswer answer;
  answer.touch =
      leavesNear(boxes, cell_.toolInBlisk(estimate) * belt_, SeparatingAxes::exact15).isColliding();
  answer.taken = watch.taken();
  return answer;
}

RobotAnswer RobotMethods::askTriangles(const StateEstimate& estimate) const {
  const TickWatch watch;
  RobotAnswer answer;
  answer.touch = collide(*scene_.blisk, *scene_.tool.front().tree, cell_.toolInBlisk(estimate)).has_value();
  answer.taken = watch.taken();
  return answer;
}

RobotAnswer RobotMethods::askBullet(const StateEstimate& estimate, double reach) const {
  const TickWatch watch;
  const std::span<const CellContact> contacts = cell_.detect(estimate, reach);
  RobotAnswer answer;
  answer.taken = watch.taken();
  for (const CellContact& contact : contacts) {
    if (contact.body < RobotCell::kLinks) {
      answer.arm = true;
      continue;
    }
    const bool is_belt = contact.body == RobotCell::kLinks;
    answer.touch |= is_belt;
    answer.forbidden |=
        !is_belt || scene_.blades.blade_of_triangle[contact.triangle] != options_.ground_blade;
  }
  return answer;
}

}  // namespace octoblisk::demos
