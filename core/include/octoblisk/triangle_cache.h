// The triangles near a convex body that moves little from one question to the next.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/convex.h"

namespace octoblisk {

namespace detail {
struct TriangleBundle;
}  // namespace detail

/// Keeps the triangles that are a little farther away than was asked for, until the body has moved as far:
/// most questions then need no tree. What is handed out may differ by triangles that are not near.
class TriangleCache {
 public:
  TriangleCache();
  TriangleCache(TriangleCache&&) noexcept;
  TriangleCache& operator=(TriangleCache&&) noexcept;
  ~TriangleCache();

  /// Every triangle that may be within `reach` of the body, and some that are not, until the next call.
  /// Allocates nothing once it has had the room.
  std::span<const std::uint32_t> find(const ClusteredOctree& tree, const Convex& convex,
                                      const Pose& convex_in_tree, double reach);

  /// To be called where a tree at the same address has other triangles.
  void forget() {
    kept_reach_ = kNothing;
    last_at_.reset();
  }

 private:
  static constexpr double kNothing = -1.0;

  double wayTo(const Pose& pose, const Pose& from) const;
  double reserveFor(const Pose& convex_in_tree, double radius) const;
  void gather(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_tree, double reach,
              double reserve);

  const ClusteredOctree* tree_ = nullptr;
  std::vector<Vec3> core_;        ///< points whose hull holds the body's core
  Aabb bounds_;                   ///< of them
  double kept_reach_ = kNothing;  ///< from the core
  Pose kept_at_;
  std::optional<Pose> last_at_;  ///< of the last question
  std::vector<detail::TriangleBundle> kept_;
  std::vector<std::uint32_t> found_;
};

}  // namespace octoblisk
