#include "paper/robot_section.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <span>

#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "paper/number_text.h"
#include "paper/published.h"
#include "robot/arm_bodies.h"

namespace octoblisk::demos {
namespace {

constexpr std::size_t kRuns = 3;  // as in the paper

constexpr std::array<const char*, kRobotMethods> kNames = {
    "traditional octree, the belt one box", "the paper's improved, the belt one box",
    "exact, belt and blisk: yes or no", "exact, all contacts in Bullet", "exact, all contacts in Bullet"};

std::string nameOf(RobotMethod method, const RobotRunOptions& options) {
  const std::string name = kNames[static_cast<std::size_t>(method)];
  return method == RobotMethod::margin ? name + " up to " + fixedText(options.margin, 2) + " mm" : name;
}

std::string rangeText(double volume) { return fixedText(1e-4 * volume, 2); }
std::string microseconds(double seconds) { return fixedText(1e6 * seconds, 1); }
std::string milliseconds(double seconds) { return fixedText(1e3 * seconds, 2); }
std::string degrees(double angle, int digits) { return fixedText(angle * 180.0 / std::numbers::pi, digits); }

/// "3 of 40 (7.5 %)"
std::string ofTicks(std::size_t count, std::size_t ticks) {
  const std::string text = std::to_string(count) + " of " + std::to_string(ticks);
  if (ticks == 0) return text;
  return text + " (" + shareText(static_cast<double>(count), static_cast<double>(ticks)) + ")";
}

/// Of the whole path.
double detectionSeconds(const RobotRun& run, RobotMethod method) {
  return run.of(method).mean_seconds * static_cast<double>(run.ticks.size());
}

double mean(const std::array<double, kRuns>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// In the paper's form, with the paper's numbers beside it.
Table paperTable(const RobotReport& report) {
  Table table{
      .name = "table4_paper",
      .caption =
          "Table 4 in the paper's form: traditional and improved octrees in the loop of the simulated "
          "robot, and in the paper. The time is the processor's, of all ticks of the path together",
      .columns = {"attribute", "run", "traditional, here", "improved, here", "change, here",
                  "traditional, paper", "improved, paper", "change, paper"},
      .rows = {}};
  const auto add = [&](const std::string& attribute, const std::string& run, double here,
                       double here_improved, double paper, double paper_improved, int digits) {
    table.rows.push_back({attribute, run, fixedText(here, digits), fixedText(here_improved, digits),
                          changeText(here, here_improved, 2), fixedText(paper, 2),
                          fixedText(paper_improved, 2), changeText(paper, paper_improved, 2)});
  };
  const RobotRun& first = report.runs.front();
  add("range (10⁴ mm³)", "all", 1e-4 * first.of(RobotMethod::traditional).range,
      1e-4 * first.of(RobotMethod::improved).range, kPublishedTraditionalRange, kPublishedImprovedRange, 2);
  std::array<double, kRuns> traditional{}, improved{};
  for (std::size_t k = 0; k < kRuns; ++k) {
    traditional[k] = detectionSeconds(report.runs[k], RobotMethod::traditional);
    improved[k] = detectionSeconds(report.runs[k], RobotMethod::improved);
    add("time (s)", std::to_string(k + 1), traditional[k], improved[k], kPublishedRobotTraditionalSeconds[k],
        kPublishedRobotImprovedSeconds[k], 3);
  }
  add("time (s)", "average", mean(traditional), mean(improved), mean(kPublishedRobotTraditionalSeconds),
      mean(kPublishedRobotImprovedSeconds), 3);
  return table;
}

/// Of all runs along the path together.
struct Together {
  std::size_t ticks = 0, touching = 0, forbidden = 0;
  double mean_seconds = 0.0, usual_seconds = 0.0, worst_seconds = 0.0, worst_clock_seconds = 0.0;
  std::size_t late = 0;
  RobotAlarms touch, wrong;
};

void add(RobotAlarms& sum, const RobotAlarms& alarms) {
  sum.alarms += alarms.alarms;
  sum.missed += alarms.missed;
  sum.false_alarms += alarms.false_alarms;
}

Together together(std::span<const RobotRun> runs, RobotMethod method) {
  Together sum;
  for (const RobotRun& run : runs) {
    const RobotMethodResult& result = run.of(method);
    sum.ticks += run.ticks.size();
    sum.touching += run.touching_ticks;
    sum.forbidden += run.forbidden_ticks;
    sum.mean_seconds += result.mean_seconds / static_cast<double>(runs.size());
    sum.usual_seconds = std::max(sum.usual_seconds, result.usual_seconds);
    sum.worst_clock_seconds = std::max(sum.worst_clock_seconds, result.worst_clock_seconds);
    sum.worst_seconds = std::max(sum.worst_seconds, result.worst_seconds);
    sum.late += result.late_ticks;
    add(sum.touch, result.touch);
    for (const RobotAlarms& forbidden : result.forbidden) add(sum.wrong, forbidden);
  }
  return sum;
}

Table timesTable(const RobotReport& report) {
  const RobotRunOptions& options = report.runs.front().options;
  Table table{
      .name = "table4_times",
      .caption = "Range and time of each method in the loop, over the " + std::to_string(kRuns) +
                 " runs, in the processor's time and by the clock, which other work on the machine "
                 "delays; the control period is " +
                 milliseconds(options.control_period) + " ms",
      .columns = {"method", "range (10⁴ mm³)", "mean tick (µs)", "99.9 % of ticks within (ms)",
                  "worst tick (ms)", "worst tick by the clock (ms)", "ticks beyond the period by the clock"},
      .rows = {}};
  for (std::size_t m = 0; m < kRobotMethods; ++m) {
    const auto method = static_cast<RobotMethod>(m);
    const Together sum = together(report.runs, method);
    table.rows.push_back({nameOf(method, options), rangeText(report.runs.front().of(method).range),
                          microseconds(sum.mean_seconds), milliseconds(sum.usual_seconds),
                          milliseconds(sum.worst_seconds), milliseconds(sum.worst_clock_seconds),
                          ofTicks(sum.late, sum.ticks)});
  }
  return table;
}

Table alarmsTable(const RobotReport& report) {
  Table table{.name = "table4_alarms",
              .caption =
                  "Alarms against the exact triangles at the true pose: of the belt touching the blisk "
                  "at all, and of what must not touch (the belt another blade or the hub, another part "
                  "anything)",
              .columns = {"path", "method", "missed touches", "false alarms", "missed interference",
                          "false alarms of interference"},
              .rows = {}};
  const auto add_path = [&](const std::string& path, std::span<const RobotRun> runs) {
    for (std::size_t m = 0; m < kRobotMethods; ++m) {
      const auto method = static_cast<RobotMethod>(m);
      const Together sum = together(runs, method);
      const bool tells = !runs.front().of(method).forbidden.empty();
      table.rows.push_back({path, nameOf(method, runs.front().options),
                            ofTicks(sum.touch.missed, sum.touching),
                            ofTicks(sum.touch.false_alarms, sum.ticks - sum.touching),
                            tells ? ofTicks(sum.wrong.missed, sum.forbidden) : "–",
                            tells ? ofTicks(sum.wrong.false_alarms, sum.ticks - sum.forbidden) : "–"});
    }
  };
  add_path("as ground", report.runs);
  add_path("held " + fixedText(report.lift, 0) + " mm off", std::span(&report.lifted, 1));
  return table;
}

Table robotTable(const RobotReport& report) {
  Table table{.name = "table4_robot",
              .caption =
                  "The simulated robot along the path: where the contact wheel's centre is against where "
                  "it is to be, and where it is measured to be",
              .columns = {"run", "ticks", "duration (s)", "tracking error, mean (mm)",
                          "tracking error, worst (mm)", "turn off, worst (°)", "sensing error, mean (mm)",
                          "sensing error, worst (mm)", "least way to a joint's limit (°)",
                          "poses out of reach", "ticks with arm and blisk in collision, found / true"},
              .rows = {}};
  const auto add_run = [&](const std::string& name, const RobotRun& run) {
    table.rows.push_back({name, std::to_string(run.ticks.size()), fixedText(run.duration, 1),
                          fixedText(run.mean_position_error, 4), fixedText(run.worst_position_error, 4),
                          degrees(run.worst_direction_error, 4), fixedText(run.mean_sensing_error, 4),
                          fixedText(run.worst_sensing_error, 4), degrees(run.least_margin_to_limits, 1),
                          std::to_string(run.unreached_ticks),
                          std::to_string(run.arm.ticks) + " / " + std::to_string(run.arm.true_ticks)});
  };
  for (std::size_t k = 0; k < report.runs.size(); ++k) add_run(std::to_string(k + 1), report.runs[k]);
  add_run("held " + fixedText(report.lift, 0) + " mm off", report.lifted);
  return table;
}

std::string listOf(const Joints& joints, const auto& text) {
  std::string list;
  for (const double joint : joints) list += (list.empty() ? "" : ", ") + text(joint);
  return list;
}

Table assumptionsTable(const RobotReport& report) {
  const RobotRunOptions& options = report.runs.front().options;
  const SixAxisArm& arm = report.arm;
  const auto in_degrees = [](double joint) { return degrees(joint, 0); };
  const auto plain = [](double value) { return fixedText(value, 0); };
  std::string masses;
  for (const LinkBody& body : linkBodies(arm)) masses += (masses.empty() ? "" : ", ") + plain(body.mass);
  const std::string slamani =
      "measured of an ABB IRB 1600: M. Slamani, A. Nubiola, I. Bonev, Industrial Robot "
      "39 (1), 2012; taken as three standard deviations";
  return {
      .name = "table4_assumed",
      .caption = "What the paper does not say of its robot, and what is taken here",
      .columns = {"parameter", "value", "from"},
      .rows = {
          {"control period", milliseconds(options.control_period) + " ms",
           "ABB's Externally Guided Motion reads and writes positions every 4 ms"},
          {"path speed", fixedText(options.speed, 0) + " mm/s", "assumed"},
          {"repeatability of the tool's place, along each axis, one draw a run",
           fixedText(3e3 * options.noise.position, 0) + " µm", slamani},
          {"repeatability of its direction, about each axis, one draw a run",
           fixedText(3e6 * options.noise.direction, 0) + " µrad", slamani},
          {"noise of each encoder, standard deviation, at each tick",
           fixedText(1e6 * options.noise.encoder, 0) + " µrad", "assumed"},
          {"servos: position gain, feedforward of the rate",
           fixedText(report.servo.position_gain, 0) + " 1/s, " + fixedText(report.servo.feedforward, 2),
           "assumed"},
          {"motors: greatest torques", listOf(report.servo.torque, plain) + " N m", "assumed"},
          {"arm: d1, a1, a2, a3, d4, d6",
           plain(arm.shoulder_height) + ", " + plain(arm.shoulder_offset) + ", " + plain(arm.upper_arm) +
               ", " + plain(arm.elbow_offset) + ", " + plain(arm.forearm) + ", " + plain(arm.flange) + " mm",
           "assumed, of the size of an industrial arm with 2 m of reach"},
          {"joint limits", listOf(arm.least, in_degrees) + " to " + listOf(arm.greatest, in_degrees) + " °",
           "assumed"},
          {"masses of the links, of the grinder", masses + ", " + plain(RobotCellSetup{}.tool_mass) + " kg",
           "assumed"},
          {"blisk's centre before the arm; turntable's angle",
           plain(report.stand.center.x()) + ", " + plain(report.stand.center.y()) + ", " +
               plain(report.stand.center.z()) + " mm; " +
               degrees(report.runs.front().layout.turntable_angle, 0) + "°",
           "place assumed; angle chosen for the greatest margin of the joints"},
          {"grinder, from the flange to the contact wheel's centre", plain(report.stand.tool_length) + " mm",
           "assumed"},
          {"gravity", "9810 mm/s²", ""},
          {"force of grinding", "none", "left out: contacts are seen and not felt"}}};
}

std::string setUp(const RobotReport& report) {
  const RobotRunOptions& options = report.runs.front().options;
  return "The paper's robot experiment, in a Bullet world: a six-axis arm (btMultiBody, joint motors, "
         "gravity) "
         "carries belt, wheels and arm of the grinder, of our shape, along the " +
         std::to_string(report.path_poses) + " poses of the grinding path over " + report.blisk_name + ", " +
         fixedText(report.runs.front().duration, 1) + " s at " + fixedText(options.speed, 0) +
         " mm/s, with inverse kinematics in closed form. At each tick of " +
         milliseconds(options.control_period) +
         " ms every method is asked about the pose that the encoders give, which is not quite the pose where "
         "the "
         "tool is; what is true is said by the exact triangles there. The paper names neither robot nor "
         "control: "
         "what is assumed is listed below. It is a simulation, and shows whether detection fits into such a "
         "loop, "
         "not how a certain robot behaves.";
}

std::string rangeVerdict(const RobotReport& report) {
  const RobotRun& run = report.runs.front();
  const double traditional = run.of(RobotMethod::traditional).range,
               improved = run.of(RobotMethod::improved).range, ours = run.of(RobotMethod::exact).range;
  return "Range: parts and clusters change it by " + changeText(traditional, improved) + " here, by " +
         changeText(kPublishedTraditionalRange, kPublishedImprovedRange) +
         " in the paper. It does not depend on the robot, so the paper's Table 4 repeats its Table 3. The "
         "boxes "
         "that our broadphase looks at first hold " +
         rangeText(ours) + " · 10⁴ mm³, " + changeText(traditional, ours) + ".";
}

std::string timeVerdict(const RobotReport& report) {
  const Together traditional = together(report.runs, RobotMethod::traditional),
                 improved = together(report.runs, RobotMethod::improved),
                 verdict = together(report.runs, RobotMethod::yes_or_no),
                 exact = together(report.runs, RobotMethod::exact),
                 margin = together(report.runs, RobotMethod::margin);
  const RobotRunOptions& options = report.runs.front().options;
  return "Time: a tick takes " + microseconds(traditional.mean_seconds) +
         " µs with the traditional octree and " + microseconds(improved.mean_seconds) +
         " µs with the improved one (" + changeText(traditional.mean_seconds, improved.mean_seconds) +
         "; the paper: " +
         changeText(mean(kPublishedRobotTraditionalSeconds), mean(kPublishedRobotImprovedSeconds)) +
         ", of hundreds of seconds for a path of unknown length). Exactly, on the triangles, yes or no "
         "takes " +
         microseconds(verdict.mean_seconds) + " µs, all contacts of all parts and of the arm in Bullet " +
         microseconds(exact.mean_seconds) + " µs, up to " + fixedText(options.margin, 2) + " mm away " +
         microseconds(margin.mean_seconds) + " µs. Of these 99.9 % of the ticks stay within " +
         milliseconds(verdict.usual_seconds) + ", " + milliseconds(exact.usual_seconds) + " and " +
         milliseconds(margin.usual_seconds) + " ms, of a period of " + milliseconds(options.control_period) +
         " ms; the worst took " + milliseconds(verdict.worst_seconds) + ", " +
         milliseconds(exact.worst_seconds) + " and " + milliseconds(margin.worst_seconds) +
         " ms. That is the processor's time, interrupts of the machine included; by the clock this machine, "
         "which is "
         "no real-time system and does other work too, took up to " +
         milliseconds(
             std::max({verdict.worst_clock_seconds, exact.worst_clock_seconds, margin.worst_clock_seconds})) +
         " ms.";
}

std::string alarmVerdict(const RobotReport& report) {
  const std::span lifted(&report.lifted, 1);
  const auto falsely = [&](RobotMethod method) {
    const Together sum = together(lifted, method);
    return ofTicks(sum.touch.false_alarms, sum.ticks - sum.touching);
  };
  const Together exact = together(report.runs, RobotMethod::exact),
                 margin = together(report.runs, RobotMethod::margin);
  const RobotRun& first = report.runs.front();
  return "Alarms: held " + fixedText(report.lift, 0) + " mm off the blade, boxes raise false alarms at " +
         falsely(RobotMethod::traditional) +
         " of the ticks without a touch, divided into parts and clusters at " +
         falsely(RobotMethod::improved) + ", the triangles at " + falsely(RobotMethod::exact) +
         ". Exact detection is as good as the pose it is given: the tool is measured " +
         fixedText(first.mean_sensing_error, 3) + " mm off on average, and over the " +
         std::to_string(kRuns) +
         " runs along the blade, into which the belt is to be pressed by 0.02 mm, it misses " +
         ofTicks(exact.touch.missed, exact.touching) + " touches and gives " +
         ofTicks(exact.touch.false_alarms, exact.ticks - exact.touching) +
         " false alarms. With a margin of " + fixedText(first.options.margin, 2) + " mm it misses " +
         ofTicks(margin.touch.missed, margin.touching) + ", at the price of " +
         ofTicks(margin.touch.false_alarms, margin.ticks - margin.touching) +
         " alarms of what is near and does not touch. Of the ticks at which something touches that must "
         "not, " +
         ofTicks(exact.wrong.missed, exact.forbidden) + " are missed without a margin, " +
         ofTicks(margin.wrong.missed, margin.forbidden) +
         " with it. How deep a touch is, is not asked in the loop.";
}

std::string armVerdict(const RobotReport& report) {
  std::size_t found = report.lifted.arm.ticks, truly = report.lifted.arm.true_ticks, unreached = 0;
  for (const RobotRun& run : report.runs) {
    found += run.arm.ticks;
    truly += run.arm.true_ticks;
    unreached += run.unreached_ticks;
  }
  return "Arm: its own links meet the blisk at " + countedText(found, "tick", "ticks") + " by Bullet, at " +
         std::to_string(truly) + " by exact queries at the true joints; " +
         countedText(unreached, "pose", "poses") +
         " of the path were out of reach. The tool strays from its path by " +
         fixedText(report.runs.front().mean_position_error, 3) + " mm on average and " +
         fixedText(report.runs.front().worst_position_error, 3) +
         " mm at most; the servos' lag alone, (1 − feedforward) · speed / position gain, is " +
         fixedText((1.0 - report.servo.feedforward) * report.runs.front().options.speed /
                       report.servo.position_gain,
                   3) +
         " mm.";
}

}  // namespace

RobotScene robotScene(const PaperModel& blisk, std::vector<Points> clouds, std::vector<Pose> path) {
  RobotScene scene;
  scene.blisk = treeOf(blisk.mesh);
  scene.blades = blisk.blades;
  for (EmbeddedPart& part : embeddedBeltGrinder()) {
    scene.tool.push_back({std::move(part.name), treeOf(std::move(part.mesh))});
  }
  scene.clouds = std::move(clouds);
  scene.path = std::move(path);
  return scene;
}

RobotReport runRobotExperiment(const RobotScene& scene, std::string blisk_name,
                               const std::vector<Pose>& lifted_path, double lift,
                               const RobotRunOptions& options, const Progress& progress) {
  RobotReport report;
  report.blisk_name = std::move(blisk_name);
  report.path_poses = scene.path.size();
  report.lift = lift;
  const CellLayout layout = chooseLayout(report.arm, scene.path, scene.blisk->mesh().bounds(), report.stand);
  const auto stretch = [&](std::size_t run) {
    constexpr double kShare = 1.0 / (kRuns + 1);
    return stretchOf(progress, kShare * static_cast<double>(run), kShare * static_cast<double>(run + 1));
  };
  RobotRunOptions of_run = options;
  for (std::size_t run = 0; run < kRuns; ++run) {
    of_run.noise.seed = options.noise.seed + run;
    report.runs.push_back(runRobot(scene, layout, of_run, report.arm, report.servo, stretch(run)));
  }
  RobotScene lifted = scene;
  lifted.path = lifted_path;
  of_run.noise.seed = options.noise.seed + kRuns;
  report.lifted = runRobot(lifted, layout, of_run, report.arm, report.servo, stretch(kRuns));
  return report;
}

Section robotSection(const RobotReport& report) {
  return {.title = "Table 4: detection in the loop of a robot",
          .paragraphs = {setUp(report), rangeVerdict(report), timeVerdict(report), alarmVerdict(report),
                         armVerdict(report)},
          .tables = {paperTable(report), timesTable(report), alarmsTable(report), robotTable(report),
                     assumptionsTable(report)}};
}

}  // namespace octoblisk::demos
