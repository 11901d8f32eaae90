// Checks each pose of one mesh against another: touch, clearance, depth, and the motion between poses.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "octoblisk/depth.h"
#include "octoblisk/signed_distance.h"
#include "octoblisk/sweep.h"

namespace octoblisk::demos {

struct PoseCheckOptions {
  bool clearance = false;
  bool depth = false;
  bool signed_distance = false;
  bool continuous = false;
  double tolerance = 1e-3;  ///< mesh units, > 0: of depths, and the distance that motions must keep
  int threads = 0;          ///< 0: as many as the machine runs at once; the answers do not depend on it
};

struct PoseAnswer {
  std::optional<TrianglePair> touching;  ///< a triangle pair that meets, of the fixed and the moving mesh
  std::optional<double> clearance;       ///< if asked for: the least distance, 0 where they touch
  std::optional<double> depth;           ///< if asked for: the penetration depth
  std::optional<SignedDistance> signed_distance;  ///< if asked for, with its derivative
  std::optional<TimeOfImpact> hit_on_motion;  ///< if asked for: the hit on the motion from the previous pose
};

/// Answers for poses of the moving mesh in the fixed mesh's frame, in parallel.
class PoseCheck {
 public:
  /// The trees must outlive it. Throws std::invalid_argument if depths are asked for and the fixed mesh is
  /// open, or if signed distances are asked for and both meshes are open.
  PoseCheck(const ClusteredOctree& fixed, const ClusteredOctree& moving, const PoseCheckOptions& options);
  ~PoseCheck();

  /// Whether a mesh whose inside matters to the answers is closed; true if no inside matters.
  bool isFixedSolid() const { return !fixed_surface_ || fixed_surface_->isClosed(); }
  bool isMovingSolid() const { return !moving_surface_ || moving_surface_->isClosed(); }
  /// What faces inward in a mesh that faces outward elsewhere, in words; empty if nothing does, or if no mesh
  /// is treated as a solid.
  std::string inwardPartsOfFixed() const;
  std::string inwardPartsOfMoving() const;

  /// For the poses [begin, end); the motion to `begin` starts at the previous pose, if there is one.
  std::vector<PoseAnswer> answer(std::span<const Pose> poses, std::size_t begin, std::size_t end);

 private:
  void requireClosed() const;
  double depthAt(const Pose& moving_in_fixed, std::size_t worker);

  const ClusteredOctree &fixed_, &moving_;
  const PoseCheckOptions options_;
  std::unique_ptr<const Surface> fixed_surface_, moving_surface_;
  std::vector<DepthQuery> depth_queries_;  // one per thread
};

}  // namespace octoblisk::demos
