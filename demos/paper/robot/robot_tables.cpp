#include "paper/robot/robot_tables.h"

#include <array>
#include <numbers>
#include <span>

#include "io/number_text.h"
#include "paper/comparison_table.h"
#include "paper/robot/arm_bodies.h"

namespace octoblisk::demos {
namespace {

constexpr std::array<const char*, kRobotMethods> kMethodNames = {
    "traditional octree, belt as one box", "paper's improved octrees, belt as one box",
    "exact, belt and blisk: yes or no", "exact, all contacts in Bullet", "exact, all contacts in Bullet"};

std::string nameOf(RobotMethod method, const RobotRunOptions& options) {
  const std::string name = kMethodNames[static_cast<std::size_t>(method)];
  return method == RobotMethod::margin ? name + " up to " + fixedText(options.margin, 2) + " mm" : name;
}

std::string degrees(double angle, int digits) { return fixedText(angle * 180.0 / std::numbers::pi, digits); }

/// Times are totals over the whole path.
DetectionNumbers numbersOf(const std::vector<RobotRun>& runs, RobotMethod method) {
  DetectionNumbers numbers{.range = runs.front().of(method).range, .seconds = {}};
  for (const RobotRun& run : runs) {
    numbers.seconds.push_back(run.of(method).mean_seconds * static_cast<double>(run.ticks.size()));
  }
  return numbers;
}

Table paperTable(const RobotReport& report) {
  return comparisonTable(
      "table4_paper",
      "Table 4 in the paper's form: traditional and improved octrees in the loop of the simulated robot, and "
      "in the paper. Our times are processor times, summed over all ticks of the path",
      {numbersOf(report.runs, RobotMethod::traditional), numbersOf(report.runs, RobotMethod::improved)},
      kPublishedTable4, 3);
}

Table timesTable(const RobotReport& report) {
  const RobotRunOptions& options = report.runs.front().options;
  Table table{
      .name = "table4_times",
      .caption = "Range and time of each method in the loop, over the " + std::to_string(report.runs.size()) +
                 " runs, in processor time and by the clock, which includes other work of the machine; the "
                 "control period is " +
                 milliseconds(options.control_period) + " ms",
      .columns = {"method", "range (10⁴ mm³)", "mean tick (µs)", "99.9 % of ticks within (ms)",
                  "worst tick (ms)", "worst tick by the clock (ms)", "ticks beyond the period by the clock"},
      .rows = {}};
  for (std::size_t m = 0; m < kRobotMethods; ++m) {
    const auto method = static_cast<RobotMethod>(m);
    const RobotTotals sum = totalsOf(report.runs, method);
    table.rows.push_back({nameOf(method, options), rangeText(report.runs.front().of(method).range),
                          microseconds(sum.mean_seconds), milliseconds(sum.usual_seconds),
                          milliseconds(sum.worst_seconds), milliseconds(sum.worst_clock_seconds),
                          partText(sum.late, sum.ticks)});
  }
  return table;
}

Table alarmsTable(const RobotReport& report) {
  Table table{
      .name = "table4_alarms",
      .caption =
          "Alarms compared with the exact triangles at the true pose: for any touch of the belt with the "
          "blisk, and for forbidden touches (the belt on another blade or the hub, another part on anything)",
      .columns = {"path", "method", "missed touches", "false alarms", "missed interference",
                  "false alarms of interference"},
      .rows = {}};
  const auto add_path = [&](const std::string& path, std::span<const RobotRun> runs) {
    for (std::size_t m = 0; m < kRobotMethods; ++m) {
      const auto method = static_cast<RobotMethod>(m);
      const RobotTotals sum = totalsOf(runs, method);
      const bool counts_forbidden = runs.front().of(method).forbidden.has_value();
      table.rows.push_back(
          {path, nameOf(method, runs.front().options), partText(sum.touch.missed, sum.touching),
           partText(sum.touch.false_alarms, sum.ticks - sum.touching),
           counts_forbidden ? partText(sum.wrong.missed, sum.forbidden) : "–",
           counts_forbidden ? partText(sum.wrong.false_alarms, sum.ticks - sum.forbidden) : "–"});
    }
  };
  add_path("ground", report.runs);
  add_path("lifted " + fixedText(report.lift, 0) + " mm", std::span(&report.lifted, 1));
  return table;
}

Table robotTable(const RobotReport& report) {
  Table table{
      .name = "table4_robot",
      .caption =
          "The simulated robot along the path: errors of the contact wheel's centre from its target "
          "(tracking), and of its measurement (sensing)",
      .columns = {"run", "ticks", "duration (s)", "tracking error, mean (mm)", "tracking error, worst (mm)",
                  "direction error, worst (°)", "sensing error, mean (mm)", "sensing error, worst (mm)",
                  "least distance to a joint limit (°)", "ticks with a pose out of reach",
                  "ticks with arm and blisk in collision, found / true"},
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
  add_run("lifted " + fixedText(report.lift, 0) + " mm", report.lifted);
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
      "measured for an ABB IRB 1600: M. Slamani, A. Nubiola, I. Bonev, Industrial Robot 39 (1), 2012; "
      "treated as three standard deviations";
  return {
      .name = "table4_assumed",
      .caption = "Values that the paper does not give for its robot, and the values used here",
      .columns = {"parameter", "value", "from"},
      .rows = {
          {"control period", milliseconds(options.control_period) + " ms",
           "ABB's Externally Guided Motion reads and writes positions every 4 ms"},
          {"path speed; greatest turn rate",
           plain(options.speed) + " mm/s; " + fixedText(options.turn_rate, 1) + " rad/s", "assumed"},
          {"steps of the Bullet world at each tick", std::to_string(options.steps_per_tick), "assumed"},
          {"margin of the last method", fixedText(options.margin, 2) + " mm", "assumed"},
          {"octrees of the paper's methods: k per part, FNOP",
           std::to_string(options.k_means.k) + ", " + std::to_string(options.leaf_capacity),
           "the paper's optimum in Table 1"},
          {"repeatability of the tool's position, along each axis, drawn once per run",
           fixedText(3e3 * options.noise.position, 0) + " µm", slamani},
          {"repeatability of its direction, about each axis, drawn once per run",
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
           "assumed, typical of an industrial arm with 2 m of reach"},
          {"joint limits", listOf(arm.least, in_degrees) + " to " + listOf(arm.greatest, in_degrees) + " °",
           "assumed"},
          {"masses of the links; of the grinder", masses + ", " + plain(RobotCellSetup{}.tool_mass) + " kg",
           "assumed"},
          {"blisk's centre in front of the arm; turntable's angle",
           plain(report.stand.center.x()) + ", " + plain(report.stand.center.y()) + ", " +
               plain(report.stand.center.z()) + " mm; " +
               degrees(report.runs.front().layout.turntable_angle, 0) + "°",
           "position assumed; angle chosen for the greatest margin of the joints"},
          {"grinder, from the flange to the contact wheel's centre", plain(report.stand.tool_length) + " mm",
           "assumed"},
          {"gravity", "9810 mm/s²", ""},
          {"force of grinding", "none", "not modelled: contacts are detected but have no effect"}}};
}

}  // namespace

std::string microseconds(double seconds) { return fixedText(1e6 * seconds, 1); }
std::string milliseconds(double seconds) { return fixedText(1e3 * seconds, 2); }

std::vector<Table> robotTables(const RobotReport& report) {
  return {paperTable(report), seedsTable("table4_seeds", "Table 4", report.seeds),
          timesTable(report), alarmsTable(report),
          robotTable(report), assumptionsTable(report)};
}

}  // namespace octoblisk::demos
