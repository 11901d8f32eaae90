#include "models/blade_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace octoblisk::demos {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLowCuts = 100;
constexpr int kHighCuts = 32;
constexpr int kMinRun = 5;  ///< successive cuts that must show the same blades
constexpr int kRefinements = 16;

/// The count that most low cuts agree on, at the lowest of them.
BladeCut widestCut(const WeldedSurface& surface, const std::vector<double>& falling_cuts, double high) {
  GrowingParts growing(surface);
  BladeCut best, current;
  for (const double low : falling_cuts) {
    growing.addBetween(low, high);
    const std::size_t count = bladesAmong(growing.parts()).size();
    current = {low, high, count, count == current.count ? current.run + 1 : 1};
    if (count > 0 && current.run > best.run) best = current;
  }
  return best;
}

GrowingParts grownBetween(const WeldedSurface& surface, double low, double high) {
  GrowingParts growing(surface);
  growing.addBetween(low, high);
  return growing;
}

/// Moves the cuts closer to hub and shroud, by at most one step between cuts.
BladeCut refine(const WeldedSurface& surface, BladeCut cut, double low_step, double high_step) {
  GrowingParts at_cut = grownBetween(surface, cut.low, cut.high);
  const auto keepIfSame = [&](GrowingParts&& moved) {
    if (bladesAmong(moved.parts()).size() != cut.count) return false;
    at_cut = std::move(moved);
    return true;
  };
  for (int k = 0; k < kRefinements; ++k) {
    low_step *= 0.5;
    GrowingParts lower = at_cut;  // has all triangles but those between the two cuts
    lower.addBetween(cut.low - low_step, cut.high);
    if (keepIfSame(std::move(lower))) cut.low -= low_step;
    if (std::isinf(cut.high)) continue;
    high_step *= 0.5;
    if (keepIfSame(grownBetween(surface, cut.low, cut.high + high_step))) cut.high += high_step;
  }
  return cut;
}

}  // namespace

std::vector<Part> bladesAmong(std::vector<Part> parts) {
  constexpr double kCrumb = 0.02;
  constexpr double kAlike = 1.5;      // greatest area divided by least
  constexpr double kOffPlace = 0.05;  // of the radius
  constexpr double kOffPitch = 0.25;  // of the pitch
  constexpr double kRound = 1e-6;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  double greatest = 0.0;
  for (const Part& part : parts) greatest = std::max(greatest, part.area);
  std::erase_if(parts, [&](const Part& part) { return part.area < kCrumb * greatest; });
  if (parts.size() < 2) return {};

  const double radius = radiusOf(parts[0].centroid);
  const bool goes_all_round = radius * radius < kRound * parts[0].area;
  if (goes_all_round) return {};
  std::vector<double> angles;
  for (const Part& part : parts) {
    const bool off_height = std::abs(part.centroid.z() - parts[0].centroid.z()) > kOffPlace * radius;
    const bool off_radius = std::abs(radiusOf(part.centroid) - radius) > kOffPlace * radius;
    if (kAlike * part.area < greatest || off_height || off_radius) return {};
    angles.push_back(std::atan2(part.centroid.y(), part.centroid.x()));
  }
  std::sort(angles.begin(), angles.end());
  angles.push_back(angles[0] + kTurn);
  const double pitch = kTurn / static_cast<double>(parts.size());
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
    if (std::abs(angles[k + 1] - angles[k] - pitch) > kOffPitch * pitch) return {};
  }
  return parts;
}

BladeCut findBladeCut(const WeldedSurface& surface) {
  const double least = *std::min_element(surface.low.begin(), surface.low.end());
  const double greatest = *std::max_element(surface.high.begin(), surface.high.end());
  const double low_step = (greatest - least) / kLowCuts;
  const double high_step = (greatest - least) / kHighCuts;
  std::vector<double> falling_cuts;
  for (int k = kLowCuts - 1; k >= 0; --k) falling_cuts.push_back(least + k * low_step);

  BladeCut best = widestCut(surface, falling_cuts, kInfinity);
  for (int k = kHighCuts - 1; k > 0 && best.run < kMinRun; --k) {
    const BladeCut below_shroud = widestCut(surface, falling_cuts, least + k * high_step);
    if (below_shroud.run > best.run) best = below_shroud;
  }
  if (best.run < kMinRun) return {};
  return refine(surface, best, low_step, high_step);
}

}  // namespace octoblisk::demos
