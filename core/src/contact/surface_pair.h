// Two surfaces near each other, and the contacts of their triangles.
#pragma once

#include <algorithm>
#include <cstdint>

#include "contact/local_surface.h"
#include "geometry/triangle_feature.h"
#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// A triangle of each surface, by its number there.
struct NumberPair {
  std::uint32_t a, b;
};

struct PairedContact : Contact {
  NumberPair pair;
  bool is_removed = false;
};

/// One of the two surfaces, and its members in a pair and in a contact.
struct SurfaceSide {
  std::uint32_t NumberPair::*number;
  std::uint32_t Contact::*index;
  Vec3 Contact::*point;
  double outward;  ///< 1 if the normals of contacts point outward from this surface, or else -1
  LocalSurface surface;

  const Triangle& triangle(const NumberPair& pair) const { return surface.triangle(pair.*number); }
  /// scaledNormal of the triangle.
  const Vec3& facing(const NumberPair& pair) const { return surface.normal(pair.*number); }
  bool isPerpendicularTo(const PairedContact& contact) const {
    return isPerpendicular(facing(contact.pair), contact.normal);
  }
  /// Whether a contact pushes perpendicularly on the outside of its triangle.
  bool isPushedBy(const PairedContact& contact) const {
    return isPerpendicularTo(contact) && outward * facing(contact.pair).dot(contact.normal) > 0.0;
  }
};

struct SurfacePair {
  SurfaceSide a{&NumberPair::a, &Contact::triangle_a, &Contact::point_on_a, -1.0, {}};
  SurfaceSide b{&NumberPair::b, &Contact::triangle_b, &Contact::point_on_b, 1.0, {}};

  void clear() {
    a.surface.clear();
    b.surface.clear();
  }

  /// Slack for the rounding of distances between two triangles, and between their neighbours.
  double roundingOf(const NumberPair& pair) const {
    return std::max(a.surface.rounding(pair.a), b.surface.rounding(pair.b));
  }
};

}  // namespace octoblisk::detail
