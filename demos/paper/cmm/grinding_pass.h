// A pass of the belt over a strip of a blade: computes its removal, and plans the dwells for a wanted
// removal.
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
  /// N on a flat: the value set for a turbine blade in doi 10.1177/1687814017700827.
  double set_force = 20.0;
  double belt_speed = 10'000;  ///< v, mm/s, along the blade's height; assumed

  /// K_p of dh = K_p p v dt (F. W. Preston, 1927), mm²/N; assumed: 20 N then remove 1 mm³/s. Its value
  /// cancels out in a planned pass, except for its error and the limits of the feed.
  double preston = 5e-6;
  double step_over = 1.5;        ///< greatest distance between strokes, mm; assumed
  double least_feed = 1.0;       ///< mm/s along the section; assumed
  double greatest_feed = 200.0;  ///< mm/s; assumed
};

/// The deviations of the pass from its plan.
struct ProcessErrors {
  double preston_factor = 0.9;  ///< the true K_p divided by the planned one; assumed: a slightly worn belt
  double force_factor = 20.4 / 20;  ///< mean force reached divided by force set: doi 10.1177/1687814017700827
  double force_noise = 0.05;        ///< standard deviation of the force, as a fraction of it; assumed
  double force_correlation = 5.0;   ///< mm of a stroke over which the correlation falls to 1/e; assumed
  std::uint64_t seed = 2;
};

/// Strokes along the sections, one step-over apart, from the bottom up; a stroke visits every station of its
/// row. The wheel presses everywhere as hard as the set force presses on a flat, so the force decreases where
/// the surface curves away or the wheel overhangs an edge.
///
/// The removal is linear in the dwells and the force. The errors, about 20 µm, are neglected beside the
/// indentation of about 0.6 mm: they do not change the pressure.
class GrindingPass {
 public:
  /// The grid must outlive it. Finds the contact at every pose. Throws std::invalid_argument with a one-line
  /// message naming a parameter that is not above 0.
  GrindingPass(const SectionGrid& grid, const GrindingProcess& process);

  std::size_t poses() const { return poses_.size(); }
  const std::vector<std::size_t>& strokeRows() const { return stroke_rows_; }

  /// The force (N) at a pose, stroke by stroke, station by station.
  double force(std::size_t pose) const { return poses_[pose].force; }

  /// The time (s) that an even feed (mm/s) spends at each pose.
  std::vector<double> dwellsOfFeed(double feed) const;

  /// The mean removal (mm, over each point's cell) for dwells (s) at the poses. `loads`, if not empty, are
  /// the forces divided by the planned ones.
  std::vector<double> removal(std::span<const double> dwells, std::span<const double> loads = {}) const;

  /// Dwells (s) that remove approximately the wanted depths (mm; negative ones count as 0) in the model,
  /// within the limits of the feed: the least-squares solution with dwells >= 0, by repeated multiplication
  /// with (Hᵀ wanted) / (Hᵀ H dwells) (M. E. Daube-Witherspoon, G. Muehllehner, 1986), where H is the removal
  /// of one second at each pose.
  std::vector<double> plan(std::span<const double> wanted, int rounds = 30) const;

  /// The actual removal, with the errors.
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
  /// Hᵀ: for each pose, its removal at each point, weighted with the point's value.
  std::vector<double> weighted(std::span<const double> values) const;

  const SectionGrid& grid_;
  GrindingProcess process_;
  std::vector<std::size_t> stroke_rows_;
  std::vector<Pose> poses_;
  std::vector<Removal> removals_;
  std::vector<ContactSlice> slices_;
};

}  // namespace octoblisk::demos
