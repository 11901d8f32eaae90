#include "models/blisk.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "models/blade_surface.h"
#include "models/length_limit.h"
#include "models/require.h"
#include "models/ring.h"
#include "models/sector_mesh.h"

namespace octoblisk::demos {
namespace {

using enum BladeSide;

constexpr int kMaxBlades = 10'000;
constexpr std::size_t kMaxTriangles = 10'000'000;

std::string mm(double value) { return std::to_string(value) + " mm"; }

/// The fineness of a sector's mesh.
struct Resolution {
  double spacing;  ///< mm
  int chord_cells, span_cells, passage_cells;

  Resolution(double edge, double chord, double span, double passage)
      : spacing(edge),
        chord_cells(cellsOf(chord, 0.8 * edge, 6)),  // finer along the chord, where the blade curves
        span_cells(cellsOf(span, 1.25 * edge, 2)),
        passage_cells(cellsOf(passage, edge, 2)) {}

  static int cellsOf(double length, double edge, int least) {
    constexpr double kMaxCells = 1e8;  // more than any mesh has, but convertible to an integer
    return static_cast<int>(std::lround(std::clamp<double>(length / edge, least, kMaxCells)));
  }

  double trianglesInSector(const std::vector<Ring>& rings) const {
    double count = 4.0 * chord_cells * span_cells;
    if (rings.size() == 1) count += 2.0 * chord_cells - 2.0;  // the tip's cap
    for (const Ring& ring : rings) {
      double rows = chord_cells;
      for (const MeridianLeg& leg : ring.band) rows += leg.cells(spacing);
      count += 2.0 * passage_cells * rows;
    }
    return count;
  }
};

/// The resolution whose number of triangles comes nearest to the target.
Resolution chooseResolution(const BladeGrid& probe, const std::vector<Ring>& rings,
                            const BliskOptions& options) {
  const auto length = [&](auto pointAt, int cells) {
    double sum = 0.0;
    for (int k = 0; k < cells; ++k) sum += (toCartesian(pointAt(k + 1)) - toCartesian(pointAt(k))).norm();
    return sum;
  };
  const int middle_row = probe.spanCells() / 2;
  const int middle_station = probe.chordCells() / 2;
  const double chord = length([&](int k) { return probe.at(forward, middle_row, k); }, probe.chordCells());
  const double span = length([&](int k) { return probe.at(forward, k, middle_station); }, probe.spanCells());
  const double passage =
      SectorMesh(options.blade_count).pitch() * probe.at(forward, middle_row, middle_station).radius;

  const double target = static_cast<double>(options.target_triangles) / options.blade_count;
  const auto resolution = [&](double spacing) { return Resolution(spacing, chord, span, passage); };
  const auto count = [&](double spacing) { return resolution(spacing).trianglesInSector(rings); };
  double fine = 1e-6 * chord;
  double coarse = 10.0 * (chord + span + passage);
  if (count(coarse) > 1.15 * target) {
    throw std::invalid_argument(std::to_string(options.blade_count) + " blades need at least " +
                                std::to_string(static_cast<long>(count(coarse) * options.blade_count)) +
                                " triangles; the target is " + std::to_string(options.target_triangles));
  }
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = std::sqrt(fine * coarse);
    (count(middle) > target ? fine : coarse) = middle;
  }
  return resolution(count(fine) - target < target - count(coarse) ? fine : coarse);
}

/// Twice the area of a triangle in (angle, z), positive if counter-clockwise seen from outside.
double unrolledArea(const CylindricalPoint& a, const CylindricalPoint& b, const CylindricalPoint& c) {
  return (b.angle - a.angle) * (c.z - a.z) - (b.z - a.z) * (c.angle - a.angle);
}

/// A four-cornered cell in (angle, z).
struct UnrolledCell {
  CylindricalPoint a, b, c, d;

  bool isSimple() const {
    const bool along_ac = std::min(unrolledArea(a, b, c), unrolledArea(a, c, d)) >= 0.0;
    const bool along_bd = std::min(unrolledArea(a, b, d), unrolledArea(b, c, d)) >= 0.0;
    return (along_ac || along_bd) && unrolledArea(a, b, c) + unrolledArea(a, c, d) > 0.0;
  }
  bool isConvex() const {
    return std::min({unrolledArea(d, a, b), unrolledArea(a, b, c), unrolledArea(b, c, d),
                     unrolledArea(c, d, a)}) > 0.0;
  }
};

/// In each row, the cells across the blade and across the passage cover the turn: if none is folded, neither
/// the blade nor its neighbour crosses it. On a ring they must also be convex, because they are divided
/// further.
void requireClearPassages(const BladeGrid& blade, double pitch, bool shrouded) {
  for (int row = 0; row <= blade.spanCells(); ++row) {
    const bool on_ring = row == 0 || (shrouded && row == blade.spanCells());
    for (int station = 0; station < blade.chordCells(); ++station) {
      const CylindricalPoint& forward = blade.at(BladeSide::forward, row, station);
      const CylindricalPoint& forward_after = blade.at(BladeSide::forward, row, station + 1);
      const CylindricalPoint& backward = blade.at(BladeSide::backward, row, station);
      const CylindricalPoint& backward_after = blade.at(BladeSide::backward, row, station + 1);
      CylindricalPoint next = backward;
      CylindricalPoint next_after = backward_after;
      next.angle += pitch;
      next_after.angle += pitch;
      const std::string place = " near radius " + mm(forward.radius) + ", z " + mm(forward.z);
      if (!UnrolledCell{backward, forward, forward_after, backward_after}.isSimple()) {
        throw std::invalid_argument("the blade's sides cross" + place + ": make the blade thicker there");
      }
      const UnrolledCell passage{forward, next, next_after, forward_after};
      if (!passage.isSimple())
        throw std::invalid_argument("adjacent blades touch" + place + ": use fewer or thinner blades");
      if (on_ring && !passage.isConvex()) {
        throw std::invalid_argument("the blades leave no regular passage" + place +
                                    ": use fewer or thinner blades");
      }
    }
  }
}

void requireUsable(const BliskOptions& options, const RadiusProfile& hub) {
  require(options.blade_count >= 2 && options.blade_count <= kMaxBlades,
          "the number of blades must be from 2 to " + std::to_string(kMaxBlades));
  require(options.bore_radius > 0.0, "the bore radius must be above 0 mm");
  require(options.bore_radius < hub.minRadius(), "the bore radius must be below the hub radius");
  require(options.target_triangles > 0 && options.target_triangles <= kMaxTriangles,
          "the target of triangles must be from 1 to " + std::to_string(kMaxTriangles));
  if (!options.shroud) return;
  const auto isSize = [](double size) { return size > 0.0 && size <= kMaxLength; };
  require(isSize(options.shroud_thickness), "the shroud thickness must be above 0 and at most 100,000 mm");
  require(isSize(options.shroud_overhang), "the shroud overhang must be above 0 and at most 100,000 mm");
}

}  // namespace

Blisk makeBlisk(const BladeSections& sections, const RadiusProfile& hub, const BliskOptions& options) {
  requireUsable(options, hub);
  constexpr int kProbeChordCells = 40;
  constexpr int kProbeSpanCells = 10;
  BladeGrid probe = sampleBlade(sections, hub, nullptr, kProbeChordCells, kProbeSpanCells);
  std::optional<RadiusProfile> shroud;
  if (options.shroud) {
    shroud = tipProfile(probe);
    probe = sampleBlade(sections, hub, &*shroud, kProbeChordCells, kProbeSpanCells);
  }
  const auto edgeZ = [&](int row, int station) { return probe.at(forward, row, station).z; };
  const double root_leading = edgeZ(0, 0);
  const double root_trailing = edgeZ(0, kProbeChordCells);
  if (root_leading <= hub.zMin() || root_trailing >= hub.zMax()) {
    throw std::invalid_argument("the blades' roots, z " + mm(root_leading) + " to " + mm(root_trailing) +
                                ", reach beyond the hub, z " + mm(hub.zMin()) + " to " + mm(hub.zMax()));
  }
  const auto rings = [&](int tip_row) {
    std::vector<Ring> result{{hub, hubBand(hub, options.bore_radius, root_leading, root_trailing), 0, false}};
    if (shroud) {
      const double tip_leading = edgeZ(kProbeSpanCells, 0);
      const double tip_trailing = edgeZ(kProbeSpanCells, kProbeChordCells);
      result.push_back({*shroud, shroudBand(*shroud, options, tip_leading, tip_trailing), tip_row, true});
    }
    return result;
  };

  const Resolution resolution = chooseResolution(probe, rings(0), options);
  const BladeGrid blade =
      sampleBlade(sections, hub, shroud ? &*shroud : nullptr, resolution.chord_cells, resolution.span_cells);
  SectorMesh sector(options.blade_count);
  requireClearPassages(blade, sector.pitch(), options.shroud);

  SectorBuilder builder(blade, resolution.passage_cells, sector);
  builder.addBlade();
  if (!shroud) builder.addTipCap();
  for (const Ring& ring : rings(resolution.span_cells)) builder.addRing(ring, resolution.spacing);
  return sector.repeat();
}

Blisk makeDefaultBlisk(std::size_t target_triangles) {
  constexpr double kHalfLength = 100.0;  // mm
  BliskOptions options;
  options.target_triangles = target_triangles;
  const BladeParameters blade;
  return makeBlisk(makeBladeSections(blade), cylinderProfile(blade.hub_radius, kHalfLength), options);
}

}  // namespace octoblisk::demos
