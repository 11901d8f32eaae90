// The closed sections of a blade, from hub to tip.
#pragma once

#include <filesystem>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// A closed loop around the blade: points in mm, axis of rotation Z, the first point not repeated at the end.
using SectionLoop = std::vector<Vec3>;

/// Sections of one blade from hub to tip, at least two. A blisk repeats the blade about Z.
struct BladeSections {
  std::vector<SectionLoop> loops;
};

/// A blade with an airfoil like NACA's four-digit series, wrapped on cylinders about Z.
///
/// Lengths are in mm, angles in degrees. Parameters with a hub and a tip value vary linearly between the two.
/// The half thickness over the chord x = 0..1 is
///   y(x) = e·cap(x)·cap(1−x) + 5(t−2e)·(0.2969√x − 0.1260x − 0.3516x² + 0.2843x³ − 0.1036x⁴),
/// a four-digit shape that closes at the trailing edge over a core of half thickness e with round ends.
struct BladeParameters {
  double hub_radius = 128.0;
  double tip_radius = 240.0;
  double chord_hub = 125.0;
  double chord_tip = 112.0;
  double stagger_hub = 25.0;  ///< degrees from the axis to the chord; hub and tip differ by the twist
  double stagger_tip = 52.0;
  double thickness_hub = 5.0;  ///< greatest, across the chord
  double thickness_tip = 2.6;
  double camber_hub = 9.0;  ///< greatest rise of the parabolic camber line above the chord
  double camber_tip = 3.5;
  double edge_radius = 0.4;  ///< e: half thickness of the rounded leading and trailing edges
  double lean = 1.1;         ///< degrees about Z by which the tip leads the hub
  int section_count = 15;
  int points_per_side = 160;
};

/// The sections of a parametric blade, on equally spaced cylinders from hub to tip. Each loop contains the
/// exact points of least and greatest z; the tip's leading edge (least z) is at y = 0, x = tip_radius. Throws
/// std::invalid_argument naming a parameter that does not make a blade.
BladeSections makeBladeSections(const BladeParameters& parameters);

/// Reads every .csv file of a folder as one section, hub to tip in the natural order of their names
/// (section_2 before section_10). Each file has the header `x,y,z` and the points of a closed loop in mm; the
/// last may repeat the first. Throws std::runtime_error naming the file and line: for a missing folder, fewer
/// than two sections, too few points, wrong columns, a value that is not a finite number or is beyond
/// kMaxLength, or a section that is not farther out than the previous one.
BladeSections readBladeSections(const std::filesystem::path& folder);

}  // namespace octoblisk::demos
