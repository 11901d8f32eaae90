// A proof that a part stays within a depth of the blisk all along a move.
#pragma once

#include <memory>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/motion.h"
#include "octoblisk/solid_boundary.h"
#include "octoblisk/surface.h"

namespace octoblisk::demos {

class DepthProof {
 public:
  /// The surfaces must outlive it; the blisk's boundary must be whole.
  DepthProof(const SolidBoundary& blisk, const octoblisk::Surface& part);

  /// True: at no fraction of the move from `begin` to `end` is any point of the part deeper than `limit` (mm)
  /// in the blisk, or of the blisk in the part. For the part, lifted by the limit along `up` (of unit length,
  /// in the blisk's frame), keeps off the blisk all the way (lift.h): its distance at some fractions is more
  /// than any of its points goes to the next. False: not proved.
  bool holds(const Motion& move, double begin, double end, const Vec3& up, double limit) const;

 private:
  /// The part's triangles that are about as far from its origin: those near it go a shorter way in a turn.
  using Shell = std::shared_ptr<const ClusteredOctree>;

  const SolidBoundary& blisk_;
  const octoblisk::Surface& part_;
  std::vector<Shell> shells_;
};

}  // namespace octoblisk::demos
