// Rules for pairs of a tool's part and a blade: which pairs may touch, and the margin that the others must
// keep.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

namespace octoblisk::demos {

/// No part of the tool.
inline constexpr std::size_t kNoPart = std::numeric_limits<std::size_t>::max();

/// The blades that a row of a rule table is about.
struct BladeChoice {
  enum class Kind {
    any,     ///< all blades, hub and shroud
    hub,     ///< hub and shroud: blade 0
    ground,  ///< the ground blade, whichever it is
    number,
  };
  Kind kind = Kind::any;
  int number = 0;  ///< from 1, if the kind is a number

  bool includes(int blade, int ground_blade) const {
    if (kind == Kind::ground) return blade != 0 && blade == ground_blade;
    return kind == Kind::any || blade == (kind == Kind::hub ? 0 : number);
  }
};

/// A part that may touch some blades; without a part: every part.
struct AllowedPair {
  std::optional<std::size_t> part;
  BladeChoice blade;
};

/// The clearance below which a part is a near miss of some blades.
struct PairMargin {
  std::optional<std::size_t> part;  ///< none: every part
  BladeChoice blade;
  double near_miss = 0.0;  ///< mm
};

}  // namespace octoblisk::demos
