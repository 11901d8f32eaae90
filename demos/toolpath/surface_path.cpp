#include "toolpath/surface_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "models/radians.h"
#include "models/require.h"
#include "toolpath/ground_region.h"
#include "toolpath/path_steps.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// The pose in which the belt touches a point.
Pose poseTouching(const ContourPoint& point, const SurfacePathOptions& options) {
  const Vec3& normal = point.normal;
  const Vec3 up = armInSurface(options.arm, point.position, normal);
  const double towards_trailing = options.region == BladeRegion::backward ? -1.0 : 1.0;
  const double lead = radians(options.lead);
  const Vec3 in_surface = std::cos(lead) * up + towards_trailing * std::sin(lead) * up.cross(normal);
  return beltAt(point.position, normal, in_surface, radians(options.tilt),
                options.wheel_radius - options.depth);
}

/// The touching poses in order, each with its pass.
class Passes {
 public:
  explicit Passes(const SurfacePathOptions& options) : options_(options) {}

  void touch(const ContourPoint& point, int pass) {
    path_.motions.push_back({poseTouching(point, options_), options_.feed});
    path_.pass_of_motion.push_back(pass);
    normals_.push_back(point.normal);
  }

  void seat(const WheelSeat& seat) {
    parallelFor(normals_.size(), 0, [&](std::size_t i, std::size_t) {
      Pose& pose = path_.motions[i].tool_in_blisk;
      pose = seat.seated(pose, normals_[i], options_.depth);
    });
  }

  /// Adds the approach and the retraction.
  SurfacePath finished() const {
    SurfacePath whole;
    const int steps = stepsFor(options_.retract / options_.pose_step);
    const auto lift = [&](const Pose& pose, int k) {
      const double length = options_.retract * k / steps;
      whole.motions.push_back({{pose.rotation, pose.translation + length * pose.rotation.col(0)}, 0.0});
      whole.pass_of_motion.push_back(-1);
    };
    for (int k = steps; k > 0; --k) lift(path_.motions.front().tool_in_blisk, k);
    whole.motions.insert(whole.motions.end(), path_.motions.begin(), path_.motions.end());
    whole.pass_of_motion.insert(whole.pass_of_motion.end(), path_.pass_of_motion.begin(),
                                path_.pass_of_motion.end());
    for (int k = 1; k <= steps; ++k) lift(path_.motions.back().tool_in_blisk, k);
    return whole;
  }

 private:
  const SurfacePathOptions& options_;
  SurfacePath path_;
  std::vector<Vec3> normals_;  // of the surface at the contact points
};

constexpr int kLink = -1;

/// Back and forth along lines of equal height.
void addTransversal(const GroundRegion& region, const SurfacePathOptions& options, Passes& passes) {
  const RunningSum across = region.progress(distanceBetween);
  const int steps = stepsFor(across.whole() / options.step_over);
  const int links = steps > 0 ? stepsFor(across.whole() / steps / options.pose_step) : 0;
  for (int pass = 0; pass <= steps; ++pass) {
    const bool goes_back = pass % 2 == 1;
    const ContourLine line = region.lineAt(across, evenPart(pass, steps + 1));
    std::vector<double> parts = contactsOn(line, options);
    if (goes_back) std::reverse(parts.begin(), parts.end());
    for (const double part : parts) passes.touch(line.at(part), pass);
    for (int k = 1; pass < steps && k < links; ++k) {
      const double part = (pass + static_cast<double>(k) / links) / steps;
      passes.touch(region.lineAt(across, part).at(parts.back()), kLink);
    }
  }
}

/// Back and forth across the lines of equal height, inwards first.
void addLongitudinal(const GroundRegion& region, const SurfacePathOptions& options, Passes& passes) {
  const RunningSum along = region.progress(
      [&](const ContourPoint& a, const ContourPoint& b) { return stepsBetween(a, b, options); });
  const int rows = stepsFor(along.whole()) + 1;
  std::vector<ContourLine> lines;
  for (int row = 0; row < rows; ++row) {
    lines.push_back(region.lineAt(along, evenPart(row, rows)));
  }
  const int steps = stepsFor(region.greatestLength() / options.step_over);
  for (int pass = 0; pass <= steps; ++pass) {
    const bool goes_back = pass % 2 == 1;
    const double part = evenPart(pass, steps + 1);
    for (int row = 0; row < rows; ++row) passes.touch(lines[goes_back ? rows - 1 - row : row].at(part), pass);
    if (pass == steps) break;
    const double next = evenPart(pass + 1, steps + 1);
    const ContourLine& end = lines[goes_back ? 0 : rows - 1];
    for (const double at : contactsOn(end, options)) {
      if (at > part && at < next) passes.touch(end.at(at), kLink);
    }
  }
}

void requireOptions(const SurfacePathOptions& options) {
  const auto isAbove0 = [](double value) { return std::isfinite(value) && value > 0.0; };
  require(isAbove0(options.step_over), "the step-over must be above 0 mm");
  require(isAbove0(options.pose_step), "the distance from pose to pose must be above 0 mm");
  require(isAbove0(options.greatest_turn), "the greatest turn must be above 0 degrees");
  require(isAbove0(options.feed), "the feed must be above 0 mm/min");
  require(std::abs(options.tilt) < 90.0, "the tilt must be within 90 degrees");
  require(std::abs(options.lead) < 90.0, "the lead must be within 90 degrees");
  for (const double height : {options.height_from, options.height_to}) {
    require(height >= 0.0 && height <= 1.0, "the fractions of the height must be from 0 to 1");
  }
  require(options.height_from <= options.height_to,
          "the lower end of the height must not be above the upper end");
  require(options.edge_margin >= 0.0, "the margin along the edges must be at least 0 mm");
  require(isAbove0(options.edge_reach), "the reach around an edge must be above 0 mm");
  require(isAbove0(options.wheel_radius), "the wheel radius must be above 0 mm");
  require(std::abs(options.depth) < options.wheel_radius, "the depth must be below the wheel radius");
  require(std::isfinite(options.retract) && options.retract >= 0.0, "the retraction must be at least 0 mm");
}

}  // namespace

SurfacePath makeSurfacePath(const BladeContours& blade, const SurfacePathOptions& options,
                            const WheelSeat* seat) {
  requireOptions(options);
  const GroundRegion region(blade, options);
  Passes passes(options);
  if (options.pattern == PathPattern::transversal) {
    addTransversal(region, options, passes);
  } else {
    addLongitudinal(region, options, passes);
  }
  if (seat) passes.seat(*seat);
  return passes.finished();
}

}  // namespace octoblisk::demos
