// Makes a path of the grinder free: a smooth change of its poses, as small as can be.
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
  PoseState before, after;        ///< of the path's own pose, and of the repaired one
  std::optional<Hindrance> move;  ///< what is in the way of the move from the pose before
  bool works = false;             ///< in the path's own pose the grinding part touches the ground blade
  std::size_t asked = 0;          ///< changes that were judged
};

struct PathRepair {
  std::vector<Pose> path;         ///< the repaired one
  std::vector<PoseRepair> poses;  ///< as many
  bool is_partial = false;        ///< stopped: more might be repaired, and no moves were asked at last

  std::size_t interferedBefore() const;
  std::size_t posesLeft() const;  ///< poses of the repaired path that are not free
  std::size_t movesLeft() const;  ///< moves from a free pose to a free one that are not free
  std::size_t changed() const;
  bool isFree() const { return !is_partial && posesLeft() + movesLeft() == 0; }
  std::size_t working() const;
  /// Whether a working pose is free and touches nothing any more.
  bool hasLostContact(std::size_t pose) const;
  std::size_t contactsLost() const;  ///< poses
};

/// For each pose a change on the grid so that as few poses as can be are left interfering, and among those
/// ways the one of least cost (change_grid.h), with no more change from a pose to the next than the limits
/// say. With `keep_contact`, as few working poses as can be lose their contact for it, of changes with a
/// retraction of up to kLift. Poses are judged only when the cheapest way (layered_search.h) leads through
/// them; where one is blocked, the next cheapest are judged with it, each time twice as many. Where a move is
/// blocked, other changes are tried at its ends, and every other time they are retracted farther than would
/// be cheapest; after a few dozen tries what is in its way is left there.
///
/// The answer is the same for any number of threads. `off_surface`: for each pose the unit direction of a
/// lift. The watch is told how many poses have a change that holds so far; stopped, the best way so far is
/// taken.
/// Throws std::invalid_argument for an empty path, another number of directions, or a limit out of its range.
PathRepair repairPath(Judge& judge, std::span<const Pose> path, std::span<const Vec3> off_surface,
                      const ChangeLimits& limits, bool keep_contact = true, const RunWatch& watch = {});

/// For each pose the direction from the ground blade's nearest point to the tool's origin; where no blade is
/// ground, along the arm.
std::vector<Vec3> directionsOffSurface(const Judge& judge, std::span<const Pose> path);

}  // namespace octoblisk::demos
