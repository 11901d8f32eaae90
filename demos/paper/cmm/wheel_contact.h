// The contact of a belt's wheel with a section of a surface: Hertz's line contact, slice by slice.
#pragma once

#include <cstdint>
#include <vector>

#include "models/belt_grinder.h"
#include "paper/cmm/section_grid.h"

namespace octoblisk::demos {

struct ElasticSolid {
  double youngs_modulus = 0.0;  ///< MPa
  double poissons_ratio = 0.0;
};

/// E* of two solids: 1/E* = (1-ν₁²)/E₁ + (1-ν₂²)/E₂ (MPa).
double contactModulus(const ElasticSolid& a, const ElasticSolid& b);

/// The modulus of rubber (MPa) with a Shore A hardness S in (0, 100), after A. N. Gent (1958), "On the
/// relation between indentation hardness and Young's modulus": 0.0981 (56 + 7.62336 S) / (0.137505 (254
/// - 2.54 S)).
double rubberModulus(double shore_a);

/// A wheel with a rubber cover. Its axis lies along the section; across the section it is as round as
/// `radius`.
struct ContactWheel {
  /// Outer radius with the belt (mm), the same as for the grinding paths. Assumed.
  double radius = BeltParameters{}.contact_wheel_radius + BeltParameters{}.thickness;
  double width = BeltParameters{}.width;  ///< mm; assumed
  double shore_a = 40.0;                  ///< of the cover; assumed
  double poissons_ratio = 0.49;           ///< of the cover: rubber hardly changes its volume
  double blade_modulus = 114e3;           ///< MPa: Ti-6Al-4V, a blisk's usual alloy; the paper names none
  double blade_poissons_ratio = 0.34;

  double contactModulus() const;  ///< E* of cover and blade, MPa; the belt's own stiffness is left out
};

/// The depth to which a force (N) presses the wheel into a flat: d = 4F / (πE*L), where L is the width (mm).
double indentationOnFlat(const ContactWheel& wheel, double force);

/// The contact on one station's cell.
struct ContactSlice {
  std::uint32_t station = 0;
  double covered = 0.0;        ///< fraction of the cell's width under the wheel, 0..1
  double half_width = 0.0;     ///< b, across the section, mm
  double peak_pressure = 0.0;  ///< p₀, MPa; p = p₀ √(1 - y²/b²)
};

/// The wheel is pressed along the normal of a station until it is `indentation` (mm) deep where it first
/// touches.
///
/// At x along the section's tangent there, let g be the depth of the surface below the tangent and φ the
/// angle of its normal. Each slice of the wheel is a line contact with the indentation d(x) = (indentation -
/// g + least g) cos φ and a force per length q = πE*d/4, and so b = √(Rd) and p₀ = (E*/2) √(d/R) (V. L.
/// Popov, Contact Mechanics and Friction, 2010, the method of dimensionality reduction for cylinders). On a
/// flat this is exactly Hertz's line contact. A slice does not interact with its neighbours, and the rims
/// press no harder. So the model holds on flat, concave, convex and sharply rounded places, and where the
/// wheel overhangs an edge. The surface is treated as straight across the section, where the wheel is far
/// rounder.
///
/// Overwrites `slices` and reuses its memory; they are ordered by ascending distance in either direction.
void findContact(const SectionGrid& grid, std::size_t row, std::size_t station, const ContactWheel& wheel,
                 double indentation, std::vector<ContactSlice>& slices);

/// The force of a contact: the sum over its slices along their normals (N), Σ (π/2) p₀ b · width.
double forceOf(const std::vector<ContactSlice>& slices, const SectionGrid& grid, std::size_t row);

}  // namespace octoblisk::demos
