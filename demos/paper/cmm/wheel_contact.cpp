#include "paper/cmm/wheel_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octoblisk::demos {
namespace {

using std::numbers::pi;

/// Slices steeper than this against the wheel carry almost nothing; around a thin edge they face away.
constexpr double kMinCosine = 0.05;

/// A station, relative to the wheel.
struct Reached {
  std::size_t station;
  double from, to;  ///< of its cell, along the tangent
  double depth;     ///< under the tangent
  double cosine;
};

}  // namespace

double contactModulus(const ElasticSolid& a, const ElasticSolid& b) {
  const auto compliance = [](const ElasticSolid& solid) {
    return (1.0 - solid.poissons_ratio * solid.poissons_ratio) / solid.youngs_modulus;
  };
  return 1.0 / (compliance(a) + compliance(b));
}

double rubberModulus(double shore_a) {
  return 0.0981 * (56.0 + 7.62336 * shore_a) / (0.137505 * (254.0 - 2.54 * shore_a));
}

double ContactWheel::contactModulus() const {
  return demos::contactModulus({rubberModulus(shore_a), poissons_ratio},
                               {blade_modulus, blade_poissons_ratio});
}

double indentationOnFlat(const ContactWheel& wheel, double force) {
  return 4.0 * force / (pi * wheel.contactModulus() * wheel.width);
}

void findContact(const SectionGrid& grid, std::size_t row, std::size_t station, const ContactWheel& wheel,
                 double indentation, std::vector<ContactSlice>& slices) {
  slices.clear();
  if (indentation <= 0.0) return;
  const SectionGrid::Point& touched = grid.at(row, station);
  const Vec2 normal = touched.flat_normal;
  const Vec2 tangent(normal.y(), -normal.x());
  const auto along = [&](std::size_t k) { return (grid.at(row, k).flat - touched.flat).dot(tangent); };
  const std::size_t count = grid.stations();

  std::vector<Reached> reached;
  const auto walk = [&](bool forwards) {
    std::size_t at = station;
    for (std::size_t steps = 0; steps < count; ++steps) {
      const bool at_end = !grid.closed() && at == (forwards ? count - 1 : 0);
      const std::size_t next = at_end ? at : (forwards ? (at + 1) % count : (at + count - 1) % count);
      const bool at_start = !grid.closed() && at == (forwards ? 0 : count - 1);
      const std::size_t before = at_start ? at : (forwards ? (at + count - 1) % count : (at + 1) % count);
      const SectionGrid::Point& point = grid.at(row, at);
      const double cosine = point.flat_normal.dot(normal);
      const double here = along(at);
      if (cosine < kMinCosine) return;
      const double one = 0.5 * (here + along(before));
      const double other = 0.5 * (here + along(next));
      const auto [from, to] = std::minmax({one, other});
      if (std::min(std::abs(from), std::abs(to)) > 0.5 * wheel.width && from * to > 0.0) return;
      if (steps > 0 || forwards) {
        reached.push_back({at, from, to, (touched.flat - point.flat).dot(normal), cosine});
      }
      if (at_end) return;
      at = next;
    }
  };
  walk(true);
  walk(false);

  double first_touch = reached.front().depth;
  for (const Reached& place : reached) first_touch = std::min(first_touch, place.depth);
  const double modulus = wheel.contactModulus();
  for (const Reached& place : reached) {
    const double pressed_in = (indentation - place.depth + first_touch) * place.cosine;
    const double under_wheel =
        std::min(place.to, 0.5 * wheel.width) - std::max(place.from, -0.5 * wheel.width);
    if (pressed_in <= 0.0 || under_wheel <= 0.0) continue;
    slices.push_back({static_cast<std::uint32_t>(place.station), under_wheel / (place.to - place.from),
                      std::sqrt(wheel.radius * pressed_in),
                      0.5 * modulus * std::sqrt(pressed_in / wheel.radius)});
  }
}

double forceOf(const std::vector<ContactSlice>& slices, const SectionGrid& grid, std::size_t row) {
  double force = 0.0;
  for (const ContactSlice& slice : slices) {
    const double width = slice.covered * grid.at(row, slice.station).width;
    force += 0.5 * pi * slice.peak_pressure * slice.half_width * width;
  }
  return force;
}

}  // namespace octoblisk::demos
