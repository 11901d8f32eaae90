// Triangle pairs that are hard to judge: touching, nearly touching, flat, thin, tiny, huge, far away.
#pragma once

#include <random>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

enum class PairKind {
  random,        ///< of similar size, at random
  grid,          ///< few distinct integer coordinates, so every kind of touch occurs
  coplanar,      ///< exactly in one skew plane
  sharedVertex,  ///< one corner in common
  sharedEdge,    ///< one edge in common
  edgeOnEdge,    ///< an edge of each through one point, up to rounding
  vertexOnFace,  ///< a corner of one on the face of the other, up to rounding
  slivers,       ///< thin as rounding, across each other
  degenerate,    ///< at least one is a segment or a point
};
inline constexpr int kPairKinds = 9;
const char* nameOf(PairKind kind);

struct TrianglePairSample {
  Triangle a, b;
  PairKind kind = PairKind::random;
};

/// A pair of the kind, with a size from denormal to 1e11. Some pairs are far from the origin, and some have
/// coordinates moved by an ulp. The corners and the triangles are in random order.
TrianglePairSample hardPair(std::mt19937_64& random, PairKind kind);

/// The same without the change of size and position: corners of magnitude up to about 4.
TrianglePairSample hardPairOfUnitSize(std::mt19937_64& random, PairKind kind);

}  // namespace octoblisk::testing
