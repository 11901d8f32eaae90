#include "toolpath/surface_path.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

#include "models/require.h"
#include "octoblisk/parallel.h"

namespace octoblisk::demos {
namespace {

constexpr int kProbeRows = 121;  // of the region, to measure it
constexpr int kProbeColumns = 17;
constexpr double kMostSteps = 1e6;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Part k of count: 0 for the first, 1 for the last.
double partOf(int k, int count) { return count > 1 ? static_cast<double>(k) / (count - 1) : 0.0; }

double turnBetween(const ContourPoint& a, const ContourPoint& b) {
  return std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
}

ContourPoint between(const ContourPoint& a, const ContourPoint& b, double part) {
  return {a.position + part * (b.position - a.position),
          (a.normal + part * (b.normal - a.normal)).normalized()};
}

/// A growing sum over equal or unequal steps, and where it reaches a part of its whole.
class Progress {
 public:
  void add(double step) { sums_.push_back(sums_.back() + step); }
  double whole() const { return sums_.back(); }

  /// The place, in steps, at which the sum is this part of the whole.
  double placeOf(double part) const {
    const double wanted = part * whole();
    const auto after = std::lower_bound(sums_.begin() + 1, sums_.end() - 1, wanted);
    const double before = *std::prev(after);
    const double step = *after - before;
    const double fraction = step > 0.0 ? std::clamp((wanted - before) / step, 0.0, 1.0) : 0.0;
    return static_cast<double>(std::prev(after) - sums_.begin()) + fraction;
  }

 private:
  std::vector<double> sums_ = {0.0};
};

/// How many equal steps of at most 1 a sum takes; at least one where it is above 0.
int stepsFor(double whole) {
  constexpr double kRounding = 1e-9;
  require(whole <= kMostSteps, "the path would have more than 1,000,000 passes or poses a pass");
  return static_cast<int>(std::ceil(whole - kRounding));
}

/// The part of a contour that is in the region.
class Line {
 public:
  explicit Line(std::vector<ContourPoint> points) : points_(std::move(points)) {
    for (std::size_t k = 1; k < points_.size(); ++k) {
      lengths_.add((points_[k].position - points_[k - 1].position).norm());
    }
  }

  double length() const { return lengths_.whole(); }

  /// At a part 0..1 of the length.
  ContourPoint at(double part) const {
    const double place = lengths_.placeOf(part);
    const auto first = std::min(static_cast<std::size_t>(place), points_.size() - 2);
    return between(points_[first], points_[first + 1], place - static_cast<double>(first));
  }

  /// The points between two lengths, with those at the lengths.
  std::vector<ContourPoint> cut(double from, double to) const {
    std::vector<ContourPoint> result = {at(from / length())};
    double length_here = 0.0;
    for (std::size_t k = 1; k + 1 < points_.size(); ++k) {
      length_here += (points_[k].position - points_[k - 1].position).norm();
      if (length_here > from && length_here < to) result.push_back(points_[k]);
    }
    result.push_back(at(to / length()));
    return result;
  }

  /// Parts of the length at which to touch, from 0 to 1.
  std::vector<double> contacts(const SurfacePathOptions& options) const {
    Progress effort;
    for (std::size_t k = 1; k < points_.size(); ++k) {
      const double way = (points_[k].position - points_[k - 1].position).norm() / options.pose_step;
      effort.add(std::max(way, turnBetween(points_[k - 1], points_[k]) / radians(options.greatest_turn)));
    }
    const int steps = stepsFor(effort.whole());
    std::vector<double> parts;
    for (int k = 0; k <= steps; ++k) {
      const double place = effort.placeOf(partOf(k, steps + 1));
      const auto first = std::min(static_cast<std::size_t>(place), points_.size() - 2);
      double length_here = 0.0;
      for (std::size_t j = 1; j <= first; ++j)
        length_here += (points_[j].position - points_[j - 1].position).norm();
      const double step = (points_[first + 1].position - points_[first].position).norm();
      parts.push_back((length_here + (place - static_cast<double>(first)) * step) / length());
    }
    return parts;
  }

 private:
  std::vector<ContourPoint> points_;
  Progress lengths_;
};

/// The part of the blade's surface that is ground, as lines of equal height.
class Region {
 public:
  Region(const BladeContours& blade, const SurfacePathOptions& options) : blade_(blade), options_(options) {
    for (int row = 0; row < kProbeRows; ++row) probes_.push_back(line(heightAt(partOf(row, kProbeRows))));
  }

  /// Heights go from the tip inwards.
  double heightAt(double part) const { return std::lerp(options_.height_to, options_.height_from, part); }

  Line line(double height) const {
    const BladeContour contour = blade_.at(height);
    if (options_.region == PathRegion::kLeadingEdge) return roundTheEdge(contour);
    const Line whole(options_.region == PathRegion::kForward ? contour.forward : contour.backward);
    require(2.0 * options_.edge_margin < whole.length(),
            "the margins along the edges leave nothing of the side, which is " +
                std::to_string(whole.length()) + " mm wide");
    return Line(whole.cut(options_.edge_margin, whole.length() - options_.edge_margin));
  }

  double greatestLength() const {
    double greatest = 0.0;
    for (const Line& probe : probes_) greatest = std::max(greatest, probe.length());
    return greatest;
  }

  /// The steps of height between the probes, each the greatest over the lines of a measure of two points.
  template <typename Measure>
  Progress progress(Measure measure) const {
    Progress result;
    for (std::size_t row = 1; row < probes_.size(); ++row) {
      double greatest = 0.0;
      for (int column = 0; column < kProbeColumns; ++column) {
        const double part = partOf(column, kProbeColumns);
        greatest = std::max(greatest, measure(probes_[row - 1].at(part), probes_[row].at(part)));
      }
      result.add(greatest);
    }
    return result;
  }

 private:
  Line roundTheEdge(const BladeContour& contour) const {
    const auto fromEdge = [&](const std::vector<ContourPoint>& half) {
      const Line whole(half);
      require(options_.edge_reach <= whole.length(),
              "the reach round the leading edge is beyond the side, which is " +
                  std::to_string(whole.length()) + " mm wide");
      return whole.cut(0.0, options_.edge_reach);
    };
    std::vector<ContourPoint> points = fromEdge(contour.backward);
    std::reverse(points.begin(), points.end());
    const std::vector<ContourPoint> forward = fromEdge(contour.forward);
    points.insert(points.end(), forward.begin() + 1, forward.end());
    return Line(std::move(points));
  }

  const BladeContours& blade_;
  const SurfacePathOptions& options_;
  std::vector<Line> probes_;
};

double distanceBetween(const ContourPoint& a, const ContourPoint& b) {
  return (b.position - a.position).norm();
}

/// The pose of the belt that touches a point.
Pose poseTouching(const ContourPoint& point, const SurfacePathOptions& options) {
  const Vec3& normal = point.normal;
  const Vec3 up = armInSurface(options.arm, point.position, normal);
  const double towards_trailing = options.region == PathRegion::kBackward ? -1.0 : 1.0;
  const double lead = radians(options.lead);
  const double tilt = radians(options.tilt);
  const Vec3 in_surface = std::cos(lead) * up + towards_trailing * std::sin(lead) * up.cross(normal);
  const Vec3 arm = std::cos(tilt) * in_surface + std::sin(tilt) * normal;
  const Vec3 wheel_axis = in_surface.cross(normal);
  Pose belt_in_blisk;
  belt_in_blisk.rotation << arm, wheel_axis.cross(arm), wheel_axis;
  belt_in_blisk.translation = point.position + (options.wheel_radius - options.depth) * normal;
  return belt_in_blisk;
}

/// The touching poses in their order, with the passes that they are of.
class Passes {
 public:
  explicit Passes(const SurfacePathOptions& options) : options_(options) {}

  void touch(const ContourPoint& point, int pass) {
    path_.moves.push_back({poseTouching(point, options_), options_.feed});
    path_.pass_of_move.push_back(pass);
    normals_.push_back(point.normal);
  }

  void seat(const WheelSeat& seat) {
    parallelFor(normals_.size(), threadCount(0), [&](std::size_t i, std::size_t) {
      Pose& pose = path_.moves[i].tool_in_blisk;
      pose = seat.seated(pose, normals_[i], options_.depth);
    });
  }

  /// With approach and retraction.
  SurfacePath finished() const {
    SurfacePath whole;
    const int steps = stepsFor(options_.retract / options_.pose_step);
    const auto lift = [&](const Pose& pose, int k) {
      const double length = options_.retract * k / steps;
      whole.moves.push_back({{pose.rotation, pose.translation + length * pose.rotation.col(0)}, 0.0});
      whole.pass_of_move.push_back(-1);
    };
    for (int k = steps; k > 0; --k) lift(path_.moves.front().tool_in_blisk, k);
    whole.moves.insert(whole.moves.end(), path_.moves.begin(), path_.moves.end());
    whole.pass_of_move.insert(whole.pass_of_move.end(), path_.pass_of_move.begin(), path_.pass_of_move.end());
    for (int k = 1; k <= steps; ++k) lift(path_.moves.back().tool_in_blisk, k);
    return whole;
  }

 private:
  const SurfacePathOptions& options_;
  SurfacePath path_;
  std::vector<Vec3> normals_;  // of the surface where the poses touch
};

constexpr int kLink = -1;

/// Along lines of equal height, there and back.
void addTransversal(const Region& region, const SurfacePathOptions& options, Passes& passes) {
  const Progress across = region.progress(distanceBetween);
  const int steps = stepsFor(across.whole() / options.step_over);
  const auto lineAt = [&](double part) {
    return region.line(region.heightAt(across.placeOf(part) / (kProbeRows - 1)));
  };
  const int links = steps > 0 ? stepsFor(across.whole() / steps / options.pose_step) : 0;
  for (int pass = 0; pass <= steps; ++pass) {
    const bool goes_back = pass % 2 == 1;
    const Line line = lineAt(partOf(pass, steps + 1));
    std::vector<double> parts = line.contacts(options);
    if (goes_back) std::reverse(parts.begin(), parts.end());
    for (const double part : parts) passes.touch(line.at(part), pass);
    for (int k = 1; pass < steps && k < links; ++k) {
      passes.touch(lineAt((pass + static_cast<double>(k) / links) / steps).at(parts.back()), kLink);
    }
  }
}

/// Across the lines of equal height, inwards and out again.
void addLongitudinal(const Region& region, const SurfacePathOptions& options, Passes& passes) {
  const Progress along = region.progress([&](const ContourPoint& a, const ContourPoint& b) {
    return std::max(distanceBetween(a, b) / options.pose_step,
                    turnBetween(a, b) / radians(options.greatest_turn));
  });
  const int rows = stepsFor(along.whole()) + 1;
  std::vector<Line> lines;
  for (int row = 0; row < rows; ++row) {
    lines.push_back(region.line(region.heightAt(along.placeOf(partOf(row, rows)) / (kProbeRows - 1))));
  }
  const int steps = stepsFor(region.greatestLength() / options.step_over);
  for (int pass = 0; pass <= steps; ++pass) {
    const bool goes_back = pass % 2 == 1;
    const double part = partOf(pass, steps + 1);
    for (int row = 0; row < rows; ++row) passes.touch(lines[goes_back ? rows - 1 - row : row].at(part), pass);
    if (pass == steps) break;
    const double next = partOf(pass + 1, steps + 1);
    const Line& end = lines[goes_back ? 0 : rows - 1];
    for (const double at : end.contacts(options)) {
      if (at > part && at < next) passes.touch(end.at(at), kLink);
    }
  }
}

void requireOptions(const SurfacePathOptions& options) {
  const auto isAbove0 = [](double value) { return std::isfinite(value) && value > 0.0; };
  require(isAbove0(options.step_over), "the step-over must be above 0 mm");
  require(isAbove0(options.pose_step), "the step from pose to pose must be above 0 mm");
  require(isAbove0(options.greatest_turn), "the greatest turn must be above 0 degrees");
  require(isAbove0(options.feed), "the feed must be above 0 mm/min");
  require(std::abs(options.tilt) < 90.0, "the tilt must be within 90 degrees");
  require(std::abs(options.lead) < 90.0, "the lead must be within 90 degrees");
  for (const double height : {options.height_from, options.height_to}) {
    require(height >= 0.0 && height <= 1.0, "the parts of the height must be from 0 to 1");
  }
  require(options.height_from <= options.height_to,
          "the height to begin at must not be above that to end at");
  require(options.edge_margin >= 0.0, "the margin along the edges must be at least 0 mm");
  require(isAbove0(options.edge_reach), "the reach round the leading edge must be above 0 mm");
  require(isAbove0(options.wheel_radius), "the wheel radius must be above 0 mm");
  require(std::abs(options.depth) < options.wheel_radius, "the depth must be below the wheel radius");
  require(std::isfinite(options.retract) && options.retract >= 0.0, "the retraction must be at least 0 mm");
}

}  // namespace

SurfacePath makeSurfacePath(const BladeContours& blade, const SurfacePathOptions& options,
                            const WheelSeat* seat) {
  requireOptions(options);
  const Region region(blade, options);
  Passes passes(options);
  if (options.pattern == PathPattern::kTransversal) {
    addTransversal(region, options, passes);
  } else {
    addLongitudinal(region, options, passes);
  }
  if (seat) passes.seat(*seat);
  return passes.finished();
}

}  // namespace octoblisk::demos
