#include "repair/change_grid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "models/radians.h"
#include "models/require.h"

namespace octoblisk::demos {
namespace {

constexpr double kTiltCost = 1.0;      // per degree
constexpr double kSlideCost = 1.0;     // per mm
constexpr double kRetractCost = 20.0;  // per mm
constexpr double kStepPart = 0.25;     // fraction of these, for a change from pose to pose

/// 0 and multiples of the spacing in both directions.
std::vector<double> bothSigns(double most, double spacing) {
  const auto steps = static_cast<int>(std::floor(most / spacing + kGridRounding));
  std::vector<double> values;
  for (int k = -steps; k <= steps; ++k) values.push_back(k * spacing);
  return values;
}

/// 0 up to the greatest: ten steps of the spacing, then wider and wider ones, up to the greatest step from
/// pose to pose.
std::vector<double> wideningSteps(double most, double spacing, double widest) {
  constexpr int kEven = 10;
  constexpr double kGrowth = 1.25;
  std::vector<double> values = {0.0};
  double step = spacing;
  while (values.back() + step <= most + kGridRounding) {
    values.push_back(values.back() + step);
    if (static_cast<int>(values.size()) > kEven) step = std::min(kGrowth * step, widest);
  }
  return values;
}

}  // namespace

Pose changedPose(const Pose& tool_in_blisk, const Vec3& off_surface, const Change& change) {
  const Mat3 tilt = Eigen::AngleAxisd(radians(change.tilt), Vec3::UnitZ()).toRotationMatrix();
  const double lift = std::min(change.retract, kLift);
  const Vec3 shift = change.slide * tool_in_blisk.rotation.col(2) + lift * off_surface +
                     (change.retract - lift) * tool_in_blisk.rotation.col(0);
  return {tool_in_blisk.rotation * tilt, tool_in_blisk.translation + shift};
}

ChangeGrid::ChangeGrid(const ChangeLimits& limits) : limits_(limits) {
  const std::pair<double, const char*> lengths[] = {{limits.tilt, "greatest tilt"},
                                                    {limits.slide, "greatest slide"},
                                                    {limits.retract, "greatest retraction"}};
  for (const auto& [length, name] : lengths) {
    require(std::isfinite(length) && length >= 0.0, std::string("the ") + name + " must be at least 0");
  }
  const std::pair<std::pair<double, double>, const char*> spacings[] = {
      {{limits.tilt_grid, limits.tilt_per_pose}, "tilt"},
      {{limits.slide_grid, limits.slide_per_pose}, "slide"},
      {{limits.retract_grid, limits.retract_per_pose}, "retraction"}};
  for (const auto& [values, name] : spacings) {
    require(
        std::isfinite(values.first) && values.first > 0.0 && values.first <= values.second + kGridRounding,
        std::string("the spacing of the ") + name +
            " must be above 0 and must not exceed its change from pose to pose");
  }
  const double expected = (2.0 * limits.tilt / limits.tilt_grid + 1.0) *
                          (2.0 * limits.slide / limits.slide_grid + 1.0) *
                          (limits.retract / limits.retract_per_pose + 1.0);
  const std::string too_many =
      "there are too many combinations of changes: widen a spacing or narrow a range";
  require(expected < static_cast<double>(kMaxNodes), too_many);
  tilts_ = bothSigns(limits.tilt, limits.tilt_grid);
  slides_ = bothSigns(limits.slide, limits.slide_grid);
  retracts_ = wideningSteps(limits.retract, limits.retract_grid, limits.retract_per_pose);
  require(size() <= kMaxNodes, too_many);
  no_change_ = node(tilts_.size() / 2, slides_.size() / 2, 0);
}

Change ChangeGrid::change(std::uint32_t node) const {
  const std::size_t retract = node % retracts_.size();
  const std::size_t rest = node / retracts_.size();
  return {tilts_[rest / slides_.size()], slides_[rest % slides_.size()], retracts_[retract]};
}

double ChangeGrid::cost(const Change& change) const {
  return kTiltCost * std::abs(change.tilt) + kSlideCost * std::abs(change.slide) +
         kRetractCost * change.retract;
}

double ChangeGrid::tiltStepCost(double degrees) const { return kStepPart * kTiltCost * std::abs(degrees); }
double ChangeGrid::slideStepCost(double length) const { return kStepPart * kSlideCost * std::abs(length); }
double ChangeGrid::retractStepCost(double length) const {
  return kStepPart * kRetractCost * std::abs(length);
}

}  // namespace octoblisk::demos
