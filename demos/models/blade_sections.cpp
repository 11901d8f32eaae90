#include "models/blade_sections.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>

#include "io/csv_table.h"
#include "models/length_limit.h"
#include "models/require.h"

namespace octoblisk::demos {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr std::size_t kMinLoopPoints = 8;
constexpr int kMaxSections = 1000;
constexpr int kMaxPointsPerSide = 10'000;

void requirePositive(double value, const std::string& name) {
  require(std::isfinite(value) && value > 0.0, "the " + name + " must be above 0");
}

void requireUsable(const BladeParameters& p) {
  requirePositive(p.hub_radius, "hub radius");
  requirePositive(p.tip_radius, "tip radius");
  require(p.tip_radius > p.hub_radius, "the tip radius must be above the hub radius");
  requirePositive(p.chord_hub, "chord at the hub");
  requirePositive(p.chord_tip, "chord at the tip");
  requirePositive(p.thickness_hub, "thickness at the hub");
  requirePositive(p.thickness_tip, "thickness at the tip");
  requirePositive(p.edge_radius, "edge radius");
  require(2.0 * p.edge_radius <= std::min(p.thickness_hub, p.thickness_tip),
          "the edge radius must be at most half the thickness");
  require(std::max(p.thickness_hub / p.chord_hub, p.thickness_tip / p.chord_tip) < 0.5,
          "the thickness must be below half the chord");
  require(std::abs(p.stagger_hub) < 80.0 && std::abs(p.stagger_tip) < 80.0,
          "the stagger must be between -80 and 80 degrees");
  require(std::isfinite(p.camber_hub) && std::isfinite(p.camber_tip) && std::isfinite(p.lean),
          "the camber and the lean must be finite");
  require(p.section_count >= 2 && p.section_count <= kMaxSections,
          "the number of sections must be from 2 to " + std::to_string(kMaxSections));
  require(p.points_per_side >= 8 && p.points_per_side <= kMaxPointsPerSide,
          "the number of points per side must be from 8 to " + std::to_string(kMaxPointsPerSide));
}

/// An airfoil on a cylinder, traced by an angle: 0 at the trailing edge of the chord, then the side towards
/// greater polar angles, π at the leading edge, and back along the other side.
struct Airfoil {
  double radius, chord, stagger, thickness, camber, edge_radius, lean;  // mm and radians

  /// z, and the polar angle about Z.
  std::pair<double, double> at(double trace) const {
    const double x = 0.5 * (1.0 + std::cos(trace));
    const double side = std::sin(trace) >= 0.0 ? 1.0 : -1.0;
    const double along = (x - 0.5) * chord;
    // The camber line is shifted so that the section's middle stays near the radial line through the chord's
    // middle.
    const double across = camber * (4.0 * x * (1.0 - x) - 0.6) + side * halfThickness(x);
    const double z = along * std::cos(stagger) - across * std::sin(stagger);
    const double arc = along * std::sin(stagger) + across * std::cos(stagger);
    return {z, lean + arc / radius};
  }

  double halfThickness(double x) const {
    const double round_part = edge_radius / chord;
    const auto cap = [&](double from_end) {
      const double depth = std::min(from_end / round_part, 1.0);
      return std::sqrt(std::max(0.0, depth * (2.0 - depth)));
    };
    const double four_digit =
        0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1036)));
    return edge_radius * cap(x) * cap(1.0 - x) + 5.0 * (thickness - 2.0 * edge_radius) * four_digit;
  }

  /// The trace angle of extreme z near the given one: direction -1 for the least, +1 for the greatest.
  double extreme(double near, double direction) const {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    double low = near - 1.0;
    double high = near + 1.0;
    for (int step = 0; step < 60; ++step) {
      const double inner_low = high - golden * (high - low);
      const double inner_high = low + golden * (high - low);
      const bool rises = direction * at(inner_low).first < direction * at(inner_high).first;
      (rises ? low : high) = rises ? inner_low : inner_high;
    }
    return 0.5 * (low + high);
  }
};

/// Whether a name comes before another; runs of digits are compared as numbers.
bool naturallyBefore(const std::string& a, const std::string& b) {
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto nextNumber = [&](const std::string& text, std::size_t& at) {
      const std::size_t significant = std::min(text.find_first_not_of('0', at), text.size());
      at = significant;
      while (at < text.size() && isDigit(text[at])) ++at;
      return text.substr(significant, at - significant);
    };
    const std::string left = nextNumber(a, i);
    const std::string right = nextNumber(b, j);
    if (left.size() != right.size()) return left.size() < right.size();
    if (left != right) return left < right;
  }
  return a.size() - i < b.size() - j || (a.size() - i == b.size() - j && a < b);
}

SectionLoop readLoop(const std::filesystem::path& file) {
  SectionLoop loop;
  std::size_t last_line = 1;
  for (const CsvRow& row : readCsv(file, "x,y,z")) {
    loop.emplace_back(row.values[0], row.values[1], row.values[2]);
    if (loop.back().cwiseAbs().maxCoeff() > kMaxLength) {
      throw std::runtime_error(atLine(file, row.line, "a coordinate exceeds 100,000 mm"));
    }
    last_line = row.line;
  }
  if (loop.size() > 1 && loop.back() == loop.front()) loop.pop_back();
  if (loop.size() < kMinLoopPoints) {
    throw std::runtime_error(
        atLine(file, last_line,
               std::to_string(loop.size()) + " points; a section needs " + std::to_string(kMinLoopPoints)));
  }
  return loop;
}

double meanRadius(const SectionLoop& loop) {
  double sum = 0.0;
  for (const Vec3& point : loop) sum += std::hypot(point.x(), point.y());
  return sum / static_cast<double>(loop.size());
}

void requireFartherOut(const SectionLoop& section, const std::filesystem::path& file,
                       const SectionLoop& before, const std::filesystem::path& file_before) {
  const double radius = meanRadius(section), radius_before = meanRadius(before);
  if (radius > radius_before) return;
  throw std::runtime_error(
      file.string() +
      ": the section must lie farther out than the previous one in name order: its mean radius is " +
      std::to_string(radius) + " mm, that of " + file_before.filename().string() + " " +
      std::to_string(radius_before) + " mm");
}

}  // namespace

BladeSections makeBladeSections(const BladeParameters& p) {
  requireUsable(p);
  const auto airfoilAt = [&](double span) {
    return Airfoil{std::lerp(p.hub_radius, p.tip_radius, span),
                   std::lerp(p.chord_hub, p.chord_tip, span),
                   std::lerp(p.stagger_hub, p.stagger_tip, span) * kRadiansPerDegree,
                   std::lerp(p.thickness_hub, p.thickness_tip, span),
                   std::lerp(p.camber_hub, p.camber_tip, span),
                   p.edge_radius,
                   p.lean * kRadiansPerDegree * span};
  };
  const Airfoil tip = airfoilAt(1.0);
  const double tip_leading_angle = tip.at(tip.extreme(std::numbers::pi, -1.0)).second;

  BladeSections sections;
  for (int s = 0; s < p.section_count; ++s) {
    const Airfoil airfoil = airfoilAt(static_cast<double>(s) / (p.section_count - 1));
    const double trailing = airfoil.extreme(0.0, 1.0);
    const double leading = airfoil.extreme(std::numbers::pi, -1.0);
    SectionLoop& loop = sections.loops.emplace_back();
    for (int k = 0; k < 2 * p.points_per_side; ++k) {
      const bool first_side = k < p.points_per_side;
      const double fraction = static_cast<double>(k % p.points_per_side) / p.points_per_side;
      const double trace = first_side ? std::lerp(trailing, leading, fraction)
                                      : std::lerp(leading, trailing + 2.0 * std::numbers::pi, fraction);
      const auto [z, angle] = airfoil.at(trace);
      const double turned = angle - tip_leading_angle;
      loop.emplace_back(airfoil.radius * std::cos(turned), airfoil.radius * std::sin(turned), z);
    }
  }
  return sections;
}

BladeSections readBladeSections(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(folder.string() +
                             ": no such folder; --sections needs a folder with one CSV file per section");
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  if (files.size() < 2) {
    throw std::runtime_error(folder.string() + ": " + std::to_string(files.size()) +
                             " .csv files; a blade needs at least two sections, one per file");
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return naturallyBefore(a.filename().string(), b.filename().string());
  });

  BladeSections sections;
  for (std::size_t s = 0; s < files.size(); ++s) {
    sections.loops.push_back(readLoop(files[s]));
    if (s > 0) requireFartherOut(sections.loops[s], files[s], sections.loops[s - 1], files[s - 1]);
  }
  return sections;
}

}  // namespace octoblisk::demos
