#include "dynamics/scenes.h"

namespace octoblisk::bench {

const std::vector<DynamicsEntry>& dynamicsEntries() {
  using enum ShapeKind;
  static const std::vector<DynamicsEntry> all = {
      {"trefoil-pile",
       "100 trefoil knots in a pit",
       {octoblisk, gimpact},
       {100, 900},
       {8, 60},
       makeTrefoilPile,
       true},
      {"jack-pile",
       "100 jacks in a pit",
       {octoblisk, gimpact, hulls},
       {100, 900},
       {8, 60},
       makeJackPile,
       true},
      {"teddy-pile", "100 teddies in a pit", {octoblisk, gimpact}, {100, 900}, {8, 60}, makeTeddyPile, true},
      {"mixed-pile",
       "64 bodies on a concave floor",
       {octoblisk, gimpact},
       {64, 900},
       {8, 60},
       makeMixedPile,
       true},
      {"towers", "eight towers of ten cylinders", {octoblisk, bvh, plane}, {80, 1200}, {10, 60}, makeTowers},
      {"chain", "ten linked tori", {octoblisk, gimpact}, {10, 1200}, {3, 60}, makeChain},
      {"channel",
       "60 bodies in a channel",
       {octoblisk, bvh, gimpact, hulls},
       {60, 900},
       {8, 60},
       makeChannel},
      {"nuts", "two nuts that run down bolts", {octoblisk, gimpact}, {2, 400}, {1, 60}, makeNuts},
      {"pegs", "eight pegs that drop into holes", {octoblisk, bvh, gimpact}, {8, 1200}, {2, 60}, makePegs},
      {"blisk",
       "1,000 hulls on the blisk",
       {octoblisk, bvh, gimpact},
       {1000, 720},
       {40, 60},
       makeHullsOnBlisk},
  };
  return all;
}

}  // namespace octoblisk::bench
