// The line that a belt follows around its two wheels.
#pragma once

#include <array>
#include <cstddef>

#include "models/belt_grinder.h"
#include "octoblisk/types.h"

namespace octoblisk::demos {

/// The line of the belt's inner surface in the x–y plane: clockwise from -x over the contact wheel, along the
/// upper strand, around the drive wheel and back. Lengths in mm. The wheels must not overlap.
class BeltPath {
 public:
  explicit BeltPath(const BeltParameters& parameters);

  struct Station {
    Vec3 point;   ///< on the inner surface, z = 0
    Vec3 normal;  ///< outwards
  };

  /// The station at a fraction 0..1 of the line, measured half by length and half by turn.
  Station at(double fraction) const;

  /// The station at a length 0..length() along the line.
  Station atLength(double length) const;

  double length() const { return length_; }

  /// The angle of the strands against the x axis, radians; positive if they diverge towards the drive wheel.
  double slope() const { return slope_; }

  /// Half the distance between the strands at an x between the wheels.
  double halfGap(double x) const;

  /// The greatest turn between two of the belt's stations, radians, on either wheel.
  double greatestTurn() const;

 private:
  struct Piece {
    double length, turn;
  };

  /// The piece's share of the measure that `at` uses.
  double share(const Piece& piece) const;

  /// The station after a part of the line, given the measure of a piece.
  template <typename Measure>
  Station stationAt(double rest, const Measure& measure) const;

  /// At a fraction 0..1 of a piece; the pieces before it have turned by `turned`.
  Station onPiece(std::size_t piece, double part, double turned) const;

  BeltParameters parameters_;
  double slope_;
  std::array<Piece, 5> pieces_;
  double length_ = 0.0;
};

}  // namespace octoblisk::demos
