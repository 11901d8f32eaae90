// Boxes around the two sides of a split, turned about their thinnest axes to the least area: seven turns at
// once. Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_BUILD_SIDE_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_BUILD_SIDE_BOXES_INL_H
#undef OCTOBLISK_BUILD_SIDE_BOXES_INL_H
#else
#define OCTOBLISK_BUILD_SIDE_BOXES_INL_H
#endif

#include <limits>

#include "build/split_search.h"
#include "simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

constexpr int kTurns = kLanes - 1;

/// Turns of a box. The eighth lane is not a turn, but the third axis.
struct Turns {
  float cosine[kLanes], sine[kLanes];
};

/// In steps of a seventh of 90°.
constexpr Turns kCoarseTurns = {
    {1.0f, 0.9749279122f, 0.9009688679f, 0.7818314825f, 0.6234898019f, 0.4338837391f, 0.2225209340f, 0.0f},
    {0.0f, 0.2225209340f, 0.4338837391f, 0.6234898019f, 0.7818314825f, 0.9009688679f, 0.9749279122f, 0.0f}};
/// In steps of a quarter of that, in both directions.
constexpr Turns kFineTurns = {
    {1.0f, 0.9984268150f, 0.9984268150f, 0.9937122099f, 0.9937122099f, 0.9858710183f, 0.9858710183f, 0.0f},
    {0.0f, 0.0560704472f, -0.0560704472f, 0.1119644763f, -0.1119644763f, 0.1675062233f, -0.1675062233f,
     0.0f}};
constexpr float kThirdAxis[kLanes] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f};

HWY_INLINE void listSides(SplitSearch& search, int candidate, int counts[2]) {
  int lows = 0, highs = 0;
  std::uint16_t *low = search.side[0].data(), *high = search.side[1].data();
  const float* is_low = search.is_low[candidate].data();
  for (int i = 0; i < search.count; ++i) {
    low[lows] = high[highs] = static_cast<std::uint16_t>(i);
    const int step = is_low[i] > 0.0f;
    lows += step;
    highs += 1 - step;
  }
  counts[0] = lows;
  counts[1] = highs;
}

/// The bounds of triangles along seven turns of the first two axes about the third (lanes 0 to 6) and along
/// the third axis (lane 7).
struct TurnedBounds {
  Float8 least_u, greatest_u, least_v, greatest_v;
};

HWY_INLINE TurnedBounds turnedBounds(const SplitSearch& search, int side, int count, const float axes[3][3],
                                     const Turns& turns) {
  const Float8 cosine = Float8::load(turns.cosine), sine = Float8::load(turns.sine),
               third = Float8::load(kThirdAxis);
  Float8 u[3], v[3];
  for (int i = 0; i < 3; ++i) {
    const Float8 x(axes[0][i]), y(axes[1][i]), z(axes[2][i]);
    u[i] = cosine * x + sine * y + third * z;
    v[i] = cosine * y - sine * x + third * z;
  }
  const Float8 huge(std::numeric_limits<float>::infinity()), least(-std::numeric_limits<float>::infinity());
  TurnedBounds bounds = {huge, least, huge, least};
  const std::uint16_t* member = search.side[side].data();
  for (int m = 0; m < count; ++m) {
    const TriangleBlock& block = search.blocks[member[m] / kLanes];
    const int lane = member[m] % kLanes;
    for (const auto& corner : block.corner) {
      const Float8 x(corner[0][lane]), y(corner[1][lane]), z(corner[2][lane]);
      const Float8 along_u = u[0] * x + u[1] * y + u[2] * z, along_v = v[0] * x + v[1] * y + v[2] * z;
      bounds.least_u = min(bounds.least_u, along_u);
      bounds.greatest_u = max(bounds.greatest_u, along_u);
      bounds.least_v = min(bounds.least_v, along_v);
      bounds.greatest_v = max(bounds.greatest_v, along_v);
    }
  }
  return bounds;
}

/// Turns a side's axes to the least area, writes the bounds along them and returns their volume.
HWY_INLINE float applyBestTurn(const TurnedBounds& bounds, const Turns& turns, float slack,
                               SplitSearch::Side& side) {
  float least_u[kLanes], greatest_u[kLanes], least_v[kLanes], greatest_v[kLanes], area[kLanes];
  bounds.least_u.store(least_u);
  bounds.greatest_u.store(greatest_u);
  bounds.least_v.store(least_v);
  bounds.greatest_v.store(greatest_v);
  const Float8 edge(slack);
  ((bounds.greatest_u - bounds.least_u + edge) * (bounds.greatest_v - bounds.least_v + edge)).store(area);
  int best = 0;
  for (int turn = 1; turn < kTurns; ++turn) best = area[turn] < area[best] ? turn : best;
  for (int i = 0; i < 3; ++i) {
    const float u = side.axes[0][i], v = side.axes[1][i];
    side.axes[0][i] = turns.cosine[best] * u + turns.sine[best] * v;
    side.axes[1][i] = turns.cosine[best] * v - turns.sine[best] * u;
  }
  side.low[0] = least_u[best];
  side.low[1] = least_v[best];
  side.low[2] = least_u[kTurns];
  side.high[0] = greatest_u[best];
  side.high[1] = greatest_v[best];
  side.high[2] = greatest_u[kTurns];
  return area[best] * (side.high[2] - side.low[2] + slack);
}

/// Turns the boxes of a candidate's listed sides and returns their volume.
HWY_INLINE float turnBoxes(const SplitSearch& search, SplitSearch::Candidate& candidate, const int counts[2],
                           const Turns& turns) {
  float volume = 0.0f;
  for (int s = 0; s < 2; ++s) {
    SplitSearch::Side& side = candidate.sides[s];
    const TurnedBounds bounds = turnedBounds(search, s, counts[s], side.axes, turns);
    volume += applyBestTurn(bounds, turns, search.slack, side);
  }
  return volume;
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
