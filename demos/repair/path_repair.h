// Frees a path of the grinder from interference with the smallest smooth change of its poses.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "grinding/judge.h"
#include "grinding/run_watch.h"
#include "repair/change_grid.h"

namespace octoblisk::demos {

struct PoseRepair {
  Change change;
  PoseState before, after;            ///< of the original and of the repaired pose
  std::optional<Obstruction> motion;  ///< blocks the motion from the previous pose
  bool works = false;                 ///< the grinding part touches the ground blade in the original pose
  std::size_t asked = 0;              ///< number of judged changes
};

struct PathRepair {
  std::vector<Pose> path;         ///< the repaired path
  std::vector<PoseRepair> poses;  ///< one per pose of the path
  bool is_partial = false;        ///< stopped: more might be repaired, and the last motions were not checked

  std::size_t interferedBefore() const;
  std::size_t posesLeft() const;    ///< poses of the repaired path that are not free
  std::size_t motionsLeft() const;  ///< motions between free poses that are not free
  std::size_t changed() const;
  bool isFree() const { return !is_partial && posesLeft() + motionsLeft() == 0; }
  std::size_t working() const;
  /// Whether a working pose is free and no longer touches the blade.
  bool hasLostContact(std::size_t pose) const;
  std::size_t contactsLost() const;  ///< number of poses
};

/// Chooses for each pose a change on the grid so that as few poses as possible are left interfering, and
/// among those choices the one of least cost (change_grid.h). From a pose to the next, the change stays
/// within the limits. With `keep_contact`, as few working poses as possible lose their contact, among changes
/// with a retraction of up to kLift. Poses are judged only when the cheapest route (layered_search.h) leads
/// through them; if one is blocked, the next cheapest are judged with it, twice as many each time. If a
/// motion is blocked, other changes are tried at its ends, and every other time the ends are retracted
/// farther than would be cheapest; after a few dozen tries the obstacle is left.
///
/// The answer does not depend on the number of threads. `off_surface` is the unit direction of the lift, per
/// pose. The watch gets the number of poses that have a valid change so far; if stopped, the best route so
/// far is taken. Throws std::invalid_argument for an empty path, a wrong number of directions, or a limit out
/// of range.
PathRepair repairPath(Judge& judge, std::span<const Pose> path, std::span<const Vec3> off_surface,
                      const ChangeLimits& limits, bool keep_contact = true, const RunWatch& watch = {});

/// For each pose, the direction from the ground blade's nearest point to the tool's origin; along the arm if
/// no blade is ground.
std::vector<Vec3> directionsOffSurface(const Judge& judge, std::span<const Pose> path);

}  // namespace octoblisk::demos
