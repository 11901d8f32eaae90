#include "paper/robot_experiment.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <span>
#include <stdexcept>

#include "octoblisk/collide.h"
#include "octoblisk/obb.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "paper/box_detection.h"
#include "paper/segmentation.h"
#include "paper/stopwatch.h"
#include "paper/true_touch.h"
#include "robot/timed_path.h"

namespace octoblisk::demos {
namespace {

constexpr std::uint64_t kClusterSeed = 1;  // of k-means

void requireUsable(const RobotScene& scene, const RobotRunOptions& options) {
  const auto require = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(message);
  };
  require(scene.blisk != nullptr, "a robot's run needs a blisk");
  require(!scene.tool.empty(), "a robot's run needs a tool");
  require(!scene.clouds.empty(), "a robot's run needs clouds of the blisk's parts");
  require(scene.blades.blade_of_triangle.size() == scene.blisk->mesh().triangleCount(),
          "the blades are not those of this blisk");
  require(options.control_period > 0.0, "the control period must be above 0 s");
  require(options.steps_a_tick > 0, "a tick needs a step of the world");
  require(options.margin >= 0.0, "the margin must be at least 0 mm");
  require(options.clusters > 0 && options.leaf_capacity > 0,
          "the numbers of clusters and of points a leaf must be above 0");
  require(options.noise.encoder >= 0.0 && options.noise.position >= 0.0 && options.noise.direction >= 0.0,
          "standard deviations of noise must be at least 0");
}

/// In seconds: by the clock, and of this thread's processor time.
struct TimeTaken {
  double clock = 0.0, processor = 0.0;
};

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

class Noise {
 public:
  explicit Noise(const NoiseOptions& options) : options_(options), random_(options.seed) {
    const Vec3 turn = options.direction * draw3();
    tool_error_.translation = options.position * draw3();
    if (turn.norm() > 0.0) {
      tool_error_.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
  }

  const Pose& toolError() const { return tool_error_; }  ///< of the whole run

  Joints encoderError() {
    Joints error;
    for (double& joint : error) joint = options_.encoder * normal_(random_);
    return error;
  }

 private:
  Vec3 draw3() {
    Vec3 drawn;
    for (double& each : drawn) each = normal_(random_);
    return drawn;
  }

  NoiseOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose tool_error_;
};

Segmentation traditionalOf(const RobotScene& scene, const RobotRunOptions& options) {
  Points whole;
  for (const Points& part : scene.clouds) whole.insert(whole.end(), part.begin(), part.end());
  return Segmentation(std::span(&whole, 1), options.leaf_capacity, CellFrame::box);
}

Segmentation improvedOf(const RobotScene& scene, const RobotRunOptions& options) {
  std::vector<Points> clusters;
  for (const Points& part : scene.clouds) {
    for (Points& cluster : clustersOf(part, options.clusters, kClusterSeed)) {
      clusters.push_back(std::move(cluster));
    }
  }
  return Segmentation(clusters, options.leaf_capacity, CellFrame::box);
}

double boxVolume(const ClusteredOctree& tree) {
  double volume = 0.0;
  for (const Obb& box : tree.boxes(ClusteredOctreeBroadphase::kDefaultDepth)) volume += box.volume();
  return volume;
}

/// The methods that are compared, each asked in turn at a tick and timed.
class Methods {
 public:
  Methods(const RobotScene& scene, const RobotRunOptions& options, RobotCell& cell)
      : scene_(scene),
        options_(options),
        cell_(cell),
        belt_(principalBox(scene.tool.front().tree->mesh().vertices())),
        traditional_(traditionalOf(scene, options)),
        improved_(improvedOf(scene, options)) {}

  double range(RobotMethod method) const {
    switch (method) {
      case RobotMethod::traditional:
        return traditional_.rootVolume();
      case RobotMethod::improved:
        return improved_.rootVolume();
      default:
        return boxVolume(*scene_.blisk);
    }
  }

  struct Answer {
    bool touch = false, forbidden = false;
    std::set<std::size_t> links;  ///< of the arm
    TimeTaken taken;
  };

  Answer ask(RobotMethod method, const Belief& belief) const {
    switch (method) {
      case RobotMethod::traditional:
        return askBoxes(traditional_, belief);
      case RobotMethod::improved:
        return askBoxes(improved_, belief);
      case RobotMethod::yes_or_no:
        return askTriangles(belief);
      case RobotMethod::exact:
        return askBullet(belief, 0.0);
      default:
        return askBullet(belief, options_.margin);
    }
  }

 private:
  Answer askBoxes(const Segmentation& boxes, const Belief& belief) const {
    const TickWatch watch;
    Answer answer;
    answer.touch =
        leavesNear(boxes, cell_.toolInBlisk(belief) * belt_, SeparatingAxes::exact15).isColliding();
    answer.taken = watch.taken();
    return answer;
  }

  Answer askTriangles(const Belief& belief) const {
    const TickWatch watch;
    Answer answer;
    answer.touch = collide(*scene_.blisk, *scene_.tool.front().tree, cell_.toolInBlisk(belief)).has_value();
    answer.taken = watch.taken();
    return answer;
  }

  Answer askBullet(const Belief& belief, double reach) const {
    const TickWatch watch;
    const std::span<const CellContact> contacts = cell_.detect(belief, reach);
    Answer answer;
    answer.taken = watch.taken();
    for (const CellContact& contact : contacts) {
      if (contact.body < RobotCell::kLinks) {
        answer.links.insert(contact.body);
        continue;
      }
      const bool is_belt = contact.body == RobotCell::kLinks;
      answer.touch |= is_belt;
      answer.forbidden |=
          !is_belt || scene_.blades.blade_of_triangle[contact.triangle] != options_.ground_blade;
    }
    return answer;
  }

  const RobotScene& scene_;
  const RobotRunOptions& options_;
  RobotCell& cell_;
  Obb belt_;  // in the belt's frame
  Segmentation traditional_, improved_;
};

/// Sums what each tick says of a method.
class Tally {
 public:
  Tally(RobotMethodResult& result, double period, bool tells_forbidden) : result_(result), period_(period) {
    if (tells_forbidden) result_.forbidden.emplace_back();
  }

  void add(const Methods::Answer& answer, const Touches& truth) {
    const auto [clock, processor] = answer.taken;
    result_.mean_seconds += processor;  // their sum, until finished
    result_.worst_seconds = std::max(result_.worst_seconds, processor);
    result_.worst_clock_seconds = std::max(result_.worst_clock_seconds, clock);
    result_.late_ticks += clock > period_;
    result_.touch.count(answer.touch, truth.belt);
    for (RobotAlarms& forbidden : result_.forbidden) forbidden.count(answer.forbidden, truth.forbidden);
  }

  void finish(std::size_t ticks) { result_.mean_seconds /= static_cast<double>(ticks); }

 private:
  RobotMethodResult& result_;
  double period_;
};

double angleBetween(const Mat3& a, const Mat3& b) { return Eigen::AngleAxisd(a.transpose() * b).angle(); }

RobotCellSetup setupOf(const RobotScene& scene, const CellLayout& layout, const SixAxisArm& arm,
                       const ServoOptions& servo) {
  RobotCellSetup setup;
  setup.arm = arm;
  setup.servo = servo;
  setup.blisk = scene.blisk;
  setup.tool = scene.tool;
  setup.blisk_in_base = layout.blisk_in_base;
  setup.tool_in_flange = layout.tool_in_flange;
  return setup;
}

/// Frames of the links in the blisk's, as Bullet has them.
std::array<Pose, 6> linksInBlisk(const RobotCell& cell) {
  const Pose base_in_blisk = cell.setup().blisk_in_base.inverse();
  std::array<Pose, 6> links;
  for (std::size_t link = 0; link < links.size(); ++link) links[link] = base_in_blisk * cell.linkFrame(link);
  return links;
}

/// Which 99.9 % of the ticks do not exceed.
double usualSeconds(const RobotRun& run, std::size_t method) {
  std::vector<float> seconds;
  for (const RobotTick& tick : run.ticks) seconds.push_back(tick.seconds[method]);
  std::ranges::sort(seconds);
  return static_cast<double>(seconds[(seconds.size() - 1) * 999 / 1000]);
}

void summarize(RobotRun& run) {
  for (std::size_t m = 0; m < kRobotMethods; ++m) run.methods[m].usual_seconds = usualSeconds(run, m);
  const auto ticks = static_cast<double>(run.ticks.size());
  for (const RobotTick& tick : run.ticks) {
    run.mean_position_error += tick.position_error / ticks;
    run.worst_position_error = std::max(run.worst_position_error, tick.position_error);
    run.worst_direction_error = std::max(run.worst_direction_error, tick.direction_error);
    run.mean_sensing_error += tick.sensing_error / ticks;
    run.worst_sensing_error = std::max(run.worst_sensing_error, tick.sensing_error);
    run.touching_ticks += tick.touch;
    run.forbidden_ticks += tick.forbidden;
  }
}

}  // namespace

void RobotAlarms::count(bool alarm, bool truth) {
  alarms += alarm;
  missed += truth && !alarm;
  false_alarms += alarm && !truth;
}

RobotRun runRobot(const RobotScene& scene, const CellLayout& layout, const RobotRunOptions& options,
                  const SixAxisArm& arm, const ServoOptions& servo, const Progress& progress) {
  requireUsable(scene, options);
  const TimedPath path(scene.path, options.speed, options.turn_rate);
  RobotCell cell(setupOf(scene, layout, arm, servo));
  const Methods methods(scene, options, cell);
  TrueTouch truth(scene, options.ground_blade, arm);
  Noise noise(options.noise);

  RobotRun run;
  run.options = options;
  run.layout = layout;
  run.duration = path.duration();
  run.least_margin_to_limits = std::numeric_limits<double>::infinity();
  std::vector<Tally> tallies;
  for (std::size_t m = 0; m < kRobotMethods; ++m) {
    run.methods[m].range = methods.range(static_cast<RobotMethod>(m));
    tallies.emplace_back(run.methods[m], options.control_period,
                         m >= static_cast<std::size_t>(RobotMethod::exact));
  }
  std::set<std::size_t> links_hit;

  const Pose flange_in_tool = layout.tool_in_flange.inverse();
  const auto tick_count = static_cast<std::size_t>(std::ceil(path.duration() / options.control_period)) + 1;
  Joints commanded = layout.start;
  Joints encoder_error = Joints::Zero();
  for (std::size_t k = 0; k < tick_count; ++k) {
    RobotTick tick;
    tick.time = static_cast<double>(k) * options.control_period;
    const Pose wanted = path.at(tick.time);
    const Posture posture = inverseKinematics(arm, layout.blisk_in_base * wanted * flange_in_tool, commanded);
    const Joints next = posture.reach == Reach::reached ? posture.joints : commanded;
    run.unreached_ticks += posture.reach != Reach::reached;
    if (k == 0) {
      cell.place(next);
    } else {
      cell.drive(commanded, next, options.control_period, options.steps_a_tick, encoder_error);
    }
    commanded = next;

    const Joints joints = cell.joints();
    if (k == tick_count / 2) run.joints_half_way = joints;
    const Pose tool_in_blisk = cell.toolInBlisk();
    encoder_error = noise.encoderError();
    const Belief belief{joints + encoder_error, noise.toolError()};
    tick.position_error = (tool_in_blisk.translation - wanted.translation).norm();
    tick.direction_error = angleBetween(tool_in_blisk.rotation, wanted.rotation);
    tick.sensing_error = (cell.toolInBlisk(belief).translation - tool_in_blisk.translation).norm();
    run.least_margin_to_limits = std::min(
        {run.least_margin_to_limits, (joints - arm.least).minCoeff(), (arm.greatest - joints).minCoeff()});

    const Touches touches = truth.of(tool_in_blisk);
    tick.touch = touches.belt;
    tick.forbidden = touches.forbidden;
    run.arm.true_ticks += truth.ofArm(linksInBlisk(cell));
    for (std::size_t turn = 0; turn < kRobotMethods; ++turn) {
      const std::size_t m = (k + turn) % kRobotMethods;  // the first finds the caches cold: each in turn
      const auto method = static_cast<RobotMethod>(m);
      const Methods::Answer answer = methods.ask(method, belief);
      tallies[m].add(answer, touches);
      tick.seconds[m] = static_cast<float>(answer.taken.processor);
      tick.alarm[m] = answer.touch;
      if (method != RobotMethod::exact) continue;
      run.arm.ticks += !answer.links.empty();
      links_hit.insert(answer.links.begin(), answer.links.end());
    }
    run.ticks.push_back(tick);
    if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(tick_count));
  }
  for (Tally& tally : tallies) tally.finish(tick_count);
  for (const std::size_t link : links_hit) run.arm.links.push_back(cell.nameOfBody(link));
  summarize(run);
  return run;
}

}  // namespace octoblisk::demos
