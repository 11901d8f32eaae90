// The contact of a belt's wheel with a section of a surface: Hertz's line contact, slice by slice.
#pragma once

#include <cstdint>
#include <vector>

#include "models/belt_grinder.h"
#include "paper/cmm/section_grid.h"

namespace octoblisk::demos {

/// A wheel with a rubber cover. Its axis lies along the section; it is as round as `radius` across it.
struct ContactWheel {
  /// Outer, with the belt (mm): of the grinder of the paths. Assumed.
  double radius = BeltParameters{}.contact_wheel_radius + BeltParameters{}.thickness;
  double width = BeltParameters{}.width;  ///< mm; assumed
  double shore_a = 40.0;                  ///< of the cover; assumed
  double poissons_ratio = 0.49;           ///< of the cover: rubber hardly changes its volume
  double blade_modulus = 114e3;           ///< MPa: Ti-6Al-4V, a blisk's usual alloy; the paper names none
  double blade_poissons_ratio = 0.34;

  double contactModulus()
      const;  ///< E* of cover and blade, MPa (hertz.h); the belt's own stiffness is left out
};

/// How deep a force (N) presses the wheel into a flat: d = 4F / (πE*L), for L the width (mm).
double indentationOnFlat(const ContactWheel& wheel, double force);

/// The part of the contact on a station's cell.
struct ContactSlice {
  std::uint32_t station = 0;
  double covered = 0.0;        ///< part of the cell's width under the wheel, 0..1
  double half_width = 0.0;     ///< b, across the section, mm
  double peak_pressure = 0.0;  ///< p₀, MPa; p = p₀ √(1 - y²/b²)
};

/// Pressed along the normal of a station so that it is `indentation` (mm) deep where it first touches.
///
/// At x along the section's tangent there, let g be the depth of the surface under the tangent and φ the
/// angle of its normal. Each slice of the wheel is a line contact pressed in by d(x) = (indentation - g +
/// least g) cos φ, with a force per length q = πE*d/4, hence b = √(Rd) and p₀ = (E*/2) √(d/R) (V. L. Popov,
/// Contact Mechanics and Friction, 2010, the method of dimensionality reduction for cylinders). On a flat
/// this is Hertz's line contact, exactly; a slice does not feel its neighbours, and the rims press no harder.
/// So it holds on flat, concave, convex and sharply rounded places, and where the wheel overhangs an edge.
/// The surface is taken as straight across the section, where the wheel is far rounder.
///
/// Replaces `slices`, whose memory is used again; by ascending distance in either direction.
void findContact(const SectionGrid& grid, std::size_t row, std::size_t station, const ContactWheel& wheel,
                 double indentation, std::vector<ContactSlice>& slices);

/// The force of a contact along the normal of each slice, summed (N): Σ (π/2) p₀ b · width.
double forceOf(const std::vector<ContactSlice>& slices, const SectionGrid& grid, std::size_t row);

}  // namespace octoblisk::demos
