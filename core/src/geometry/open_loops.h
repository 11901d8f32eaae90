// The open edges of a mesh as closed loops, and the triangles that close them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// An edge that triangles use once more from `from` to `to` than the other way. Corners are numbers.
struct OpenEdge {
  std::uint32_t from, to;
  std::uint32_t triangle;  // one that uses it this way
};

/// Edges around a gap. Where one ends, the next begins, or it begins at a corner close by.
using OpenLoop = std::vector<OpenEdge>;

/// Divides the open edges of a mesh into loops. At each corner as many open edges begin as end, because each
/// triangle is a loop itself. Where several begin, the sharpest turns back are taken first. A loop ends
/// where it comes close to its own beginning: closer than 1/64 of the edges there. So the loops of
/// T-junctions and cracks are as narrow as these are, and a crack does not join the holes at its ends.
/// Caps that fill the outlines of all loops close the mesh: between corners close by, there are loops of
/// their own.
std::vector<OpenLoop> openLoops(std::span<const OpenEdge> edges, std::span<const Vec3> positions);

/// The corners around a loop, also those that are close to each other.
std::vector<std::uint32_t> outlineOf(const OpenLoop& loop);

/// Triangles that fill an outline, in the direction that closes the surface.
std::vector<Triangle> capOf(std::span<const std::uint32_t> outline, std::span<const Vec3> positions);

}  // namespace octoblisk::detail
