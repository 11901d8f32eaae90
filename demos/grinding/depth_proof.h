// Proves that a part stays within a depth of the blisk during a whole motion.
#pragma once

#include <memory>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/motion.h"
#include "octoblisk/surface.h"

namespace octoblisk::demos {

class DepthProof {
 public:
  /// The surfaces must outlive it.
  DepthProof(const octoblisk::Surface& blisk, const octoblisk::Surface& part);

  /// True if at no fraction of the motion from `begin` to `end` is any point of the part deeper than `limit`
  /// (mm) in the blisk, or any point of the blisk in the part. The proof: the part, lifted by the limit along
  /// `up` (of unit length, in the blisk's frame), keeps off the blisk during the whole motion (lift.h),
  /// because its distance at sampled fractions exceeds the path of every point to the next sample. The part
  /// itself keeps farther than the limit off the caps of the blisk's gaps. False if this is not proved.
  bool holds(const Motion& motion, double begin, double end, const Vec3& up, double limit) const;

 private:
  /// The part's triangles at about the same distance from its origin: a turn moves the nearer ones less.
  using Shell = std::shared_ptr<const ClusteredOctree>;

  const octoblisk::Surface& blisk_;
  const octoblisk::Surface& part_;
  std::vector<Shell> shells_;
};

/// For two surfaces that do not meet: true if any part of one lies in the other. An open B contains nothing.
bool areNested(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a);

/// The same if caps close the gaps of A, and B does not meet these either.
bool areNestedIfCapped(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a);

/// True if the part is farther than `depth` (mm) from the caps of the solid's gaps, and if the part, shifted
/// by `depth` along `up` (of unit length) or in one of four directions 17° off it, does not meet the solid,
/// lie in it or contain it. Then no point of either is deeper in the other than `depth`: around a deeper
/// point there is a ball of its depth inside the solid, and the shift does not leave that ball.
bool partsWhenLifted(const octoblisk::Surface& solid, const octoblisk::Surface& part,
                     const Pose& part_in_solid, const Vec3& up, double depth);

}  // namespace octoblisk::demos
