#include "paper/robot/robot_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "models/require.h"
#include "paper/robot/robot_noise.h"
#include "paper/robot/robot_scene.h"
#include "paper/robot/timed_path.h"

namespace octoblisk::demos {
namespace {

void requireUsable(const RobotScene& scene, const RobotRunOptions& options) {
  require(scene.blisk != nullptr, "a robot's run needs a blisk");
  require(!scene.tool.empty(), "a robot's run needs a tool");
  require(!scene.clouds.empty(), "a robot's run needs clouds of the blisk's parts");
  require(scene.blades.blade_of_triangle.size() == scene.blisk->mesh().triangleCount(),
          "the blade numbers are not for this blisk");
  require(options.control_period > 0.0, "the control period must be above 0 s");
  require(options.steps_per_tick > 0, "a tick needs at least one step of the world");
  require(options.margin >= 0.0, "the margin must be at least 0 mm");
  require(options.k_means.k > 0 && options.leaf_capacity > 0,
          "the numbers of clusters and of points per leaf must be above 0");
  require(options.noise.encoder >= 0.0 && options.noise.position >= 0.0 && options.noise.direction >= 0.0,
          "standard deviations of noise must be at least 0");
}

void add(const RobotAnswer& answer, const Touches& truth, double period, RobotMethodResult& sum) {
  const auto [clock, processor] = answer.taken;
  sum.mean_seconds += processor;  // the sum, until finished
  sum.worst_seconds = std::max(sum.worst_seconds, processor);
  sum.worst_clock_seconds = std::max(sum.worst_clock_seconds, clock);
  sum.late_ticks += clock > period;
  sum.touch.count(answer.touch, truth.belt);
  if (sum.forbidden) sum.forbidden->count(answer.forbidden, truth.forbidden);
}

double angleBetween(const Mat3& a, const Mat3& b) { return Eigen::AngleAxisd(a.transpose() * b).angle(); }

RobotCellSetup setupOf(const RobotScene& scene, const CellLayout& layout, const SixAxisArm& arm,
                       const ServoOptions& servo) {
  return {.arm = arm,
          .servo = servo,
          .blisk = scene.blisk,
          .tool = scene.tool,
          .blisk_in_base = layout.blisk_in_base,
          .tool_in_flange = layout.tool_in_flange};
}

/// Frames of the links in the blisk's frame, from Bullet.
std::array<Pose, 6> linksInBlisk(const RobotCell& cell) {
  const Pose base_in_blisk = cell.setup().blisk_in_base.inverse();
  std::array<Pose, 6> links;
  for (std::size_t link = 0; link < links.size(); ++link) links[link] = base_in_blisk * cell.linkFrame(link);
  return links;
}

/// The time that 99.9 % of the ticks do not exceed.
double usualSeconds(const RobotRun& run, std::size_t method) {
  std::vector<float> seconds;
  for (const RobotTick& tick : run.ticks) seconds.push_back(tick.seconds[method]);
  std::ranges::sort(seconds);
  return static_cast<double>(seconds[(seconds.size() - 1) * 999 / 1000]);
}

void summarize(RobotRun& run) {
  const auto ticks = static_cast<double>(run.ticks.size());
  for (std::size_t m = 0; m < kRobotMethods; ++m) {
    run.methods[m].mean_seconds /= ticks;
    run.methods[m].usual_seconds = usualSeconds(run, m);
  }
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

/// One run, tick by tick.
class RobotLoop {
 public:
  RobotLoop(const RobotScene& scene, const CellLayout& layout, const RobotRunOptions& options,
            const SixAxisArm& arm, const ServoOptions& servo)
      : layout_(layout),
        options_(options),
        arm_(arm),
        path_(scene.path, options.speed, options.turn_rate),
        cell_(setupOf(scene, layout, arm, servo)),
        methods_(scene, options, cell_),
        truth_(scene, options.ground_blade, arm),
        noise_(options.noise),
        commanded_(layout.start) {
    run_.options = options;
    run_.layout = layout;
    run_.duration = path_.duration();
    run_.least_margin_to_limits = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < kRobotMethods; ++m) {
      run_.methods[m].range = methods_.range(static_cast<RobotMethod>(m));
      if (m >= static_cast<std::size_t>(RobotMethod::exact)) run_.methods[m].forbidden.emplace();
    }
  }
  RobotLoop(const RobotLoop&) = delete;
  RobotLoop& operator=(const RobotLoop&) = delete;

  RobotRun follow(const Progress& progress) {
    const auto ticks = static_cast<std::size_t>(std::ceil(path_.duration() / options_.control_period)) + 1;
    for (std::size_t k = 0; k < ticks; ++k) {
      RobotTick tick;
      tick.time = static_cast<double>(k) * options_.control_period;
      const Pose wanted = path_.at(tick.time);
      moveTo(wanted);
      if (k == ticks / 2) run_.joints_halfway = cell_.joints();
      askAll(k, sense(wanted, tick), tick);
      run_.ticks.push_back(tick);
      if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(ticks));
    }
    summarize(run_);
    return std::move(run_);
  }

 private:
  /// Commands the arm for a tick, starting from the last command; the first call places it.
  void moveTo(const Pose& wanted) {
    const Pose flange_in_base = layout_.blisk_in_base * wanted * layout_.tool_in_flange.inverse();
    const Posture posture = inverseKinematics(arm_, flange_in_base, commanded_);
    const bool reached = posture.reach == Reach::reached;
    run_.unreached_ticks += !reached;
    const Joints next = reached ? posture.joints : commanded_;
    if (run_.ticks.empty()) {
      cell_.place(next);
    } else {
      cell_.drive(commanded_, next, options_.control_period, options_.steps_per_tick, encoder_error_);
    }
    commanded_ = next;
  }

  /// Measures the tool's pose, and records the errors of the arm and of the measurement.
  StateEstimate sense(const Pose& wanted, RobotTick& tick) {
    const Joints joints = cell_.joints();
    const Pose tool_in_blisk = cell_.toolInBlisk();
    encoder_error_ = noise_.encoderError();
    const StateEstimate estimate{joints + encoder_error_, noise_.toolError()};
    tick.position_error = (tool_in_blisk.translation - wanted.translation).norm();
    tick.direction_error = angleBetween(tool_in_blisk.rotation, wanted.rotation);
    tick.tool_in_blisk = cell_.toolInBlisk(estimate);
    tick.sensing_error = (tick.tool_in_blisk.translation - tool_in_blisk.translation).norm();
    run_.least_margin_to_limits = std::min(
        {run_.least_margin_to_limits, (joints - arm_.least).minCoeff(), (arm_.greatest - joints).minCoeff()});
    return estimate;
  }

  void askAll(std::size_t k, const StateEstimate& estimate, RobotTick& tick) {
    const Touches touches = truth_.of(cell_.toolInBlisk());
    tick.touch = touches.belt;
    tick.forbidden = touches.forbidden;
    run_.arm.true_ticks += truth_.ofArm(linksInBlisk(cell_));
    for (std::size_t turn = 0; turn < kRobotMethods; ++turn) {
      // Rotates, because the first method finds cold caches.
      const std::size_t m = (k + turn) % kRobotMethods;
      const auto method = static_cast<RobotMethod>(m);
      const RobotAnswer answer = methods_.ask(method, estimate);
      add(answer, touches, options_.control_period, run_.methods[m]);
      tick.seconds[m] = static_cast<float>(answer.taken.processor);
      tick.alarm[m] = answer.touch;
      if (method == RobotMethod::exact) run_.arm.ticks += answer.arm;
    }
  }

  const CellLayout& layout_;
  const RobotRunOptions& options_;
  const SixAxisArm& arm_;
  const TimedPath path_;
  RobotCell cell_;
  const RobotMethods methods_;
  TrueTouch truth_;
  RobotNoise noise_;
  Joints commanded_, encoder_error_ = Joints::Zero();
  RobotRun run_;
};

}  // namespace

void RobotAlarms::count(bool alarm, bool truth) {
  alarms += alarm;
  missed += truth && !alarm;
  false_alarms += alarm && !truth;
}

RobotRun runRobot(const RobotScene& scene, const CellLayout& layout, const RobotRunOptions& options,
                  const SixAxisArm& arm, const ServoOptions& servo, const Progress& progress) {
  requireUsable(scene, options);
  return RobotLoop(scene, layout, options, arm, servo).follow(progress);
}

}  // namespace octoblisk::demos
