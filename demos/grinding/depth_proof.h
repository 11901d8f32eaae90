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

}  // namespace octoblisk::demos
