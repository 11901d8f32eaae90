// Runs a scene to its end and measures it.
#pragma once

#include "dynamics/dynamics_scene.h"
#include "report/rows.h"

namespace octoblisk::bench {

/// The row has these figures: step_ms (processor time, mean over the run), awake_step_ms (the same, over the
/// steps until all bodies sleep), asleep_after_steps (null if some body is still awake), late_energy_j
/// (median of the last 100 steps), depth_m, points, manifolds, lost, asleep, and the scene's own figures. It
/// also has the samples over time: time_s, energy_j and depth_over_time_m.
Row measured(DynamicsScene& scene, int steps);

/// The number of steps after which all bodies are asleep; null if some body is still awake.
Row stepsUntilAsleep(DynamicsScene& scene, int steps);

}  // namespace octoblisk::bench
