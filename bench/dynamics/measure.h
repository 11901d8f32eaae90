// A scene run to its end, and what is measured of it.
#pragma once

#include "dynamics/dynamics_scene.h"
#include "report/rows.h"

namespace octoblisk::bench {

/// The row's figures: step_ms (processor time, mean over the run), asleep_after_steps (null where not all
/// fell asleep), late_energy_j (median of the last 100 steps), depth_m, points, manifolds, lost, asleep,
/// those of the scene; and over time time_s, energy_j and depth_over_time_m.
Row measured(DynamicsScene& scene, int steps);

}  // namespace octoblisk::bench
