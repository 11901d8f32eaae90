#include "models/belt_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octoblisk::demos {

using std::numbers::pi;

BeltPath::BeltPath(const BeltParameters& p)
    : parameters_(p), slope_(std::asin((p.drive_wheel_radius - p.contact_wheel_radius) / p.wheel_distance)) {
  const double strand = p.wheel_distance * std::cos(slope_);
  const double half_contact_turn = 0.5 * pi - slope_;
  const double drive_turn = pi + 2.0 * slope_;
  pieces_ = {{{half_contact_turn * p.contact_wheel_radius, half_contact_turn},
              {strand, 0.0},
              {drive_turn * p.drive_wheel_radius, drive_turn},
              {strand, 0.0},
              {half_contact_turn * p.contact_wheel_radius, half_contact_turn}}};
  for (const Piece& piece : pieces_) length_ += piece.length;
}

BeltPath::Station BeltPath::at(double fraction) const {
  return stationAt(fraction, [this](const Piece& piece) { return share(piece); });
}

BeltPath::Station BeltPath::atLength(double length) const {
  return stationAt(length, [](const Piece& piece) { return piece.length; });
}

template <typename Measure>
BeltPath::Station BeltPath::stationAt(double rest, const Measure& measure) const {
  double turned = 0.0;
  std::size_t piece = 0;
  for (; piece + 1 < pieces_.size() && rest > measure(pieces_[piece]); ++piece) {
    rest -= measure(pieces_[piece]);
    turned += pieces_[piece].turn;
  }
  return onPiece(piece, rest / measure(pieces_[piece]), turned);
}

BeltPath::Station BeltPath::onPiece(std::size_t piece, double part, double turned) const {
  const double angle = pi - turned - part * pieces_[piece].turn;
  const Vec3 normal(std::cos(angle), std::sin(angle), 0.0);
  const Vec3 ahead(normal.y(), -normal.x(), 0.0);
  const Vec3 drive_centre(parameters_.wheel_distance, 0.0, 0.0);
  const Vec3 on_contact_wheel = parameters_.contact_wheel_radius * normal;
  const Vec3 on_drive_wheel = drive_centre + parameters_.drive_wheel_radius * normal;
  switch (piece) {
    case 1:
      return {on_contact_wheel + part * pieces_[1].length * ahead, normal};
    case 2:
      return {on_drive_wheel, normal};
    case 3:
      return {on_drive_wheel + part * pieces_[3].length * ahead, normal};
    default:
      return {on_contact_wheel, normal};
  }
}

double BeltPath::halfGap(double x) const {
  return (parameters_.contact_wheel_radius + x * std::sin(slope_)) / std::cos(slope_);
}

double BeltPath::greatestTurn() const {
  const double least_radius = std::min(parameters_.contact_wheel_radius, parameters_.drive_wheel_radius);
  return 1.0 / (parameters_.stations * (0.5 * least_radius / length_ + 0.25 / pi));
}

double BeltPath::share(const Piece& piece) const {
  return 0.5 * piece.length / length_ + 0.25 * piece.turn / pi;
}

}  // namespace octoblisk::demos
