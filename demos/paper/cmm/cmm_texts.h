// Names and numbers in the report's section on Table 5.
#pragma once

#include <string>

#include "io/number_text.h"
#include "paper/cmm/blade_strip.h"

namespace octoblisk::demos {

inline constexpr double kProfileTolerance = 0.05;  ///< mm to either side; assumed

/// "0.0238": an error in mm.
inline std::string mm(double value) { return fixedText(value, 4); }

/// "A leading edge"
inline std::string areaName(BladeArea area) {
  const std::string letter = letterOf(area);
  switch (area) {
    case BladeArea::leading_edge:
      return letter + " leading edge";
    case BladeArea::convex:
      return letter + " convex";
    case BladeArea::trailing_edge:
      return letter + " trailing edge";
    case BladeArea::concave:
      return letter + " concave";
  }
  return letter;
}

}  // namespace octoblisk::demos
