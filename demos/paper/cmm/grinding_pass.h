// A pass of the belt over a strip of a blade: what it removes, and how long to dwell to remove what is
// wanted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paper/cmm/section_grid.h"
#include "paper/cmm/wheel_contact.h"

namespace octoblisk::demos {

/// Units: mm, s, N.
struct GrindingProcess {
  ContactWheel wheel;
  double set_force = 20.0;     ///< N on a flat: set on a turbine blade in doi 10.1177/1687814017700827
  double belt_speed = 10'000;  ///< v, mm/s, along the blade's height; assumed
  /// K_p of dh = K_p p v dt (F. W. Preston, 1927), mm²/N; assumed: 20 N then remove 1 mm³/s. A planned pass
  /// divides it out again, but for its error and the limits of the feed.
  double preston = 5e-6;
  double step_over = 1.5;        ///< mm between strokes, at most; assumed
  double least_feed = 1.0;       ///< mm/s along the section; assumed
  double greatest_feed = 200.0;  ///< mm/s; assumed
};

/// What the pass does unlike its plan.
struct ProcessErrors {
  double preston_factor = 0.9;      ///< the true K_p over the one planned with; assumed: a belt somewhat worn
  double force_factor = 20.4 / 20;  ///< the mean force reached over the one set: doi 10.1177/1687814017700827
  double force_noise = 0.05;        ///< standard deviation of the force, as a part of it; assumed
  double force_correlation = 5.0;   ///< mm of a stroke over which it falls to 1/e; assumed
  std::uint64_t seed = 2;
};

/// Strokes along the sections, a step-over apart, from below to above; a stroke visits every station of its
/// row. Everywhere the wheel presses as hard as the set force does on a flat: so the force falls where the
/// surface curves away or the wheel overhangs an edge.
///
/// The removal is linear in the dwells and the force. The errors, some 20 µm, are taken as nothing beside the
/// indentation, about 0.6 mm: they do not change the pressure.
class GrindingPass {
 public:
  /// The grid must outlive it. Finds the contact at every pose.
  /// Throws std::invalid_argument in one line naming a parameter that is not above 0.
  GrindingPass(const SectionGrid& grid, const GrindingProcess& process);

  std::size_t poses() const { return poses_.size(); }
  const std::vector<std::size_t>& strokeRows() const { return stroke_rows_; }

  /// The force (N) at a pose, stroke by stroke, station by station.
  double force(std::size_t pose) const { return poses_[pose].force; }

  /// The time (s) that an even feed (mm/s) spends at each pose.
  std::vector<double> dwellsOfFeed(double feed) const;

  /// The mean removal (mm, over each point's cell) for dwells (s) at the poses. `loads`, where there are any,
  /// are the forces over those planned.
  std::vector<double> removal(std::span<const double> dwells, std::span<const double> loads = {}) const;

  /// Dwells (s) that remove about the wanted depths (mm; below 0 counts as 0) by the model, within the limits
  /// of the feed: the least squares over dwells >= 0, by multiplication with (Hᵀ wanted) / (Hᵀ H dwells) time
  /// and again (M. E. Daube-Witherspoon, G. Muehllehner, 1986), for H the removals of one second at each
  /// pose.
  std::vector<double> plan(std::span<const double> wanted, int rounds = 30) const;

  /// The removal as it turns out.
  std::vector<double> grind(std::span<const double> dwells, const ProcessErrors& errors) const;

 private:
  struct Removal {
    std::uint32_t point;
    double rate;  ///< mm/s
  };
  struct Pose {
    std::size_t first, end;  ///< of its removals
    double step;             ///< of the stroke, mm
    double force;
  };

  void addPose(std::size_t row, std::size_t station);
  /// Hᵀ: for each pose what it would remove of each point, weighed by the point's value.
  std::vector<double> weighed(std::span<const double> values) const;

  const SectionGrid& grid_;
  GrindingProcess process_;
  std::vector<std::size_t> stroke_rows_;
  std::vector<Pose> poses_;
  std::vector<Removal> removals_;
  std::vector<ContactSlice> slices_;
};

}  // namespace octoblisk::demos
