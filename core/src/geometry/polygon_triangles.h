// Fills a polygon with triangles between its corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::detail {

using Vec2 = Eigen::Vector2d;

/// The corners of a polygon by their numbers.
using Ring = std::vector<std::uint32_t>;

/// Triangles that fill the ring `outer`, except what the rings in `holes` enclose. The inside is to the left
/// of every ring: `outer` turns left, the holes turn right. The triangles turn left, none has a corner on an
/// edge of another, and every corner of a ring is used. Ears are clipped (G. H. Meisters, Polygons have ears,
/// 1975), those with the shortest diagonal first; holes are joined to `outer` by a bridge (D. Eberly,
/// Triangulation by ear clipping, 2008). Exact predicates decide, so the result is right for every simple
/// polygon. Empty if a ring has no area, or if rings cross themselves or each other in a way that leaves no
/// ear.
std::vector<std::array<std::uint32_t, 3>> polygonTriangles(std::span<const Vec2> points, Ring outer,
                                                           std::vector<Ring> holes = {});

/// Whether a ring encloses a point, in whichever direction it turns. A point on the ring may be either.
bool encloses(std::span<const Vec2> ring, const Vec2& point);

}  // namespace octoblisk::detail
