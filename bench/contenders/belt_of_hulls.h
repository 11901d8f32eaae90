// The belt as a compound of 128 convex hulls. Except with GImpact, Bullet makes no contacts between two
// concave meshes.
#pragma once

#include <memory>
#include <vector>

#include "bullet_world.h"

namespace octoblisk::bench {

/// The belt in slices of a few stations each. Neighbouring slices share a station. All margins are 0.
class BeltOfHulls {
 public:
  explicit BeltOfHulls(const Scene& scene) {
    constexpr std::size_t kSlices = 128;
    const auto stations = static_cast<std::size_t>(scene.stations);
    const auto points = static_cast<std::size_t>(scene.points_per_station);
    for (std::size_t slice = 0; slice < kSlices; ++slice) {
      auto hull = std::make_unique<btConvexHullShape>();
      hull->setMargin(0);
      for (std::size_t station = slice * stations / kSlices; station <= (slice + 1) * stations / kSlices;
           ++station) {
        for (std::size_t point = 0; point < points; ++point) {
          hull->addPoint(toBullet(scene.belt->vertices()[station % stations * points + point]), false);
        }
      }
      hull->optimizeConvexHull();
      hull->recalcLocalAabb();
      whole_.addChildShape(btTransform::getIdentity(), hull.get());
      hulls_.push_back(std::move(hull));
    }
    whole_.setMargin(0);
  }

  btCompoundShape* shape() { return &whole_; }

 private:
  std::vector<std::unique_ptr<btConvexHullShape>> hulls_;
  btCompoundShape whole_;
};

}  // namespace octoblisk::bench
