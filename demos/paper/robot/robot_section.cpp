#include "paper/robot/robot_section.h"

#include <algorithm>
#include <span>
#include <string>

#include "io/number_text.h"
#include "paper/comparison_table.h"
#include "paper/published.h"
#include "paper/robot/robot_tables.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

std::string setUp(const RobotReport& report) {
  const RobotRunOptions& options = report.runs.front().options;
  return "The paper's robot experiment, in a Bullet world: a six-axis arm (btMultiBody, joint motors, "
         "gravity) carries belt, wheels and arm of the grinder, of our shape, along the " +
         std::to_string(report.path_poses) + " poses of the grinding path over " + report.blisk_name + ", " +
         fixedText(report.runs.front().duration, 1) + " s at " + fixedText(options.speed, 0) +
         " mm/s, with inverse kinematics in closed form. At each tick of " +
         milliseconds(options.control_period) +
         " ms every method checks the pose that the encoders give, which differs slightly from the true pose "
         "of the tool; the exact triangles at the true pose give the truth. The paper names neither the "
         "robot nor its control; the assumptions are listed below. This is a simulation: it shows whether "
         "detection fits into such a loop, not how a particular robot behaves.";
}

std::string rangeVerdict(const RobotReport& report) {
  const RobotRun& run = report.runs.front();
  const double traditional = run.of(RobotMethod::traditional).range,
               improved = run.of(RobotMethod::improved).range, ours = run.of(RobotMethod::exact).range;
  return "Range: parts and clusters change it by " + changeText(traditional, improved) + " here, and by " +
         changeText(kPublishedTraditionalRange, kPublishedImprovedRange) +
         " in the paper. It does not depend on the robot, so the paper's Table 4 repeats its Table 3. The "
         "boxes that our broadphase tests first have a volume of " +
         rangeText(ours) + " · 10⁴ mm³, " + changeText(traditional, ours) + ".";
}

std::string timeVerdict(const RobotReport& report) {
  const RobotTotals traditional = totalsOf(report.runs, RobotMethod::traditional),
                    improved = totalsOf(report.runs, RobotMethod::improved),
                    verdict = totalsOf(report.runs, RobotMethod::yes_or_no),
                    exact = totalsOf(report.runs, RobotMethod::exact),
                    margin = totalsOf(report.runs, RobotMethod::margin);
  const RobotRunOptions& options = report.runs.front().options;
  return "Time: a tick takes " + microseconds(traditional.mean_seconds) +
         " µs with the traditional octree and " + microseconds(improved.mean_seconds) +
         " µs with the improved one (" + changeText(traditional.mean_seconds, improved.mean_seconds) +
         "; the paper: " +
         changeText(spreadOf(kPublishedTable4.traditional.seconds).median,
                    spreadOf(kPublishedTable4.improved.seconds).median) +
         ", with hundreds of seconds for a path of unknown length). The exact yes or no on the triangles "
         "takes " +
         microseconds(verdict.mean_seconds) +
         " µs; all contacts of all parts and of the arm in Bullet take " + microseconds(exact.mean_seconds) +
         " µs, and those up to " + fixedText(options.margin, 2) + " mm away " +
         microseconds(margin.mean_seconds) + " µs. For these three, 99.9 % of the ticks stay within " +
         milliseconds(verdict.usual_seconds) + ", " + milliseconds(exact.usual_seconds) + " and " +
         milliseconds(margin.usual_seconds) + " ms; the control period is " +
         milliseconds(options.control_period) + " ms; the worst took " + milliseconds(verdict.worst_seconds) +
         ", " + milliseconds(exact.worst_seconds) + " and " + milliseconds(margin.worst_seconds) +
         " ms. This is processor time, including interrupts of the machine. By the clock, this machine, "
         "which is not a real-time system and does other work too, took up to " +
         milliseconds(
             std::max({verdict.worst_clock_seconds, exact.worst_clock_seconds, margin.worst_clock_seconds})) +
         " ms.";
}

std::string alarmVerdict(const RobotReport& report) {
  const std::span lifted(&report.lifted, 1);
  const auto falsely = [&](RobotMethod method) {
    const RobotTotals sum = totalsOf(lifted, method);
    return partText(sum.touch.false_alarms, sum.ticks - sum.touching);
  };
  const RobotTotals exact = totalsOf(report.runs, RobotMethod::exact),
                    margin = totalsOf(report.runs, RobotMethod::margin);
  const RobotRun& first = report.runs.front();
  return "Alarms: lifted " + fixedText(report.lift, 0) +
         " mm off the blade, the traditional boxes raise false alarms at " +
         falsely(RobotMethod::traditional) +
         " of the ticks without a touch, the boxes of parts and clusters at " +
         falsely(RobotMethod::improved) + ", the triangles at " + falsely(RobotMethod::exact) +
         ". Exact detection is as good as its pose: the tool is measured " +
         fixedText(first.mean_sensing_error, 3) + " mm off on average. Over the " +
         std::to_string(report.runs.size()) +
         " runs along the blade, into which the belt should be pressed by " +
         fixedText(GrindingPathOptions{}.depth, 2) + " mm, exact detection misses " +
         partText(exact.touch.missed, exact.touching) + " touches and gives " +
         partText(exact.touch.false_alarms, exact.ticks - exact.touching) +
         " false alarms. With a margin of " + fixedText(first.options.margin, 2) + " mm it misses " +
         partText(margin.touch.missed, margin.touching) + ", but gives " +
         partText(margin.touch.false_alarms, margin.ticks - margin.touching) +
         " alarms for near places that do not touch. Of the ticks with a forbidden touch, " +
         partText(exact.wrong.missed, exact.forbidden) + " are missed without a margin, " +
         partText(margin.wrong.missed, margin.forbidden) + " with it. The loop does not measure depths.";
}

std::string armVerdict(const RobotReport& report) {
  std::size_t found = report.lifted.arm.ticks, truly = report.lifted.arm.true_ticks, unreached = 0;
  for (const RobotRun& run : report.runs) {
    found += run.arm.ticks;
    truly += run.arm.true_ticks;
    unreached += run.unreached_ticks;
  }
  return "Arm: its own links meet the blisk at " + countedText(found, "tick", "ticks") +
         " according to Bullet, and at " + std::to_string(truly) + " by exact queries at the true joints; " +
         countedText(unreached, "tick", "ticks") +
         " had a pose out of reach. The tool deviates from its path by " +
         fixedText(report.runs.front().mean_position_error, 3) + " mm on average and " +
         fixedText(report.runs.front().worst_position_error, 3) +
         " mm at most; the lag of the servos alone, (1 − feedforward) · speed / position gain, is " +
         fixedText((1.0 - report.servo.feedforward) * report.runs.front().options.speed /
                       report.servo.position_gain,
                   3) +
         " mm.";
}

}  // namespace

std::vector<Claim> robotClaims(const RobotReport& report) {
  return seedsClaims("Table 4", report.seeds, kPublishedTable4);
}

Section robotSection(const RobotReport& report) {
  return {.title = "Table 4: detection in the control loop of a robot",
          .paragraphs = {setUp(report), rangeVerdict(report), timeVerdict(report), seedsVerdict(report.seeds),
                         alarmVerdict(report), armVerdict(report)},
          .tables = robotTables(report)};
}

}  // namespace octoblisk::demos
