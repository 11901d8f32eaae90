// The triangles near a convex body that moves little between queries.
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

/// Searches a slightly larger neighbourhood than requested and keeps its triangles. Until the body has moved
/// by the difference, queries do not search the tree. A result may therefore contain triangles that are not
/// near the body; these depend on earlier queries.
class TriangleCache {
 public:
  TriangleCache();
  TriangleCache(TriangleCache&&) noexcept;
  TriangleCache& operator=(TriangleCache&&) noexcept;
  ~TriangleCache();

  /// Every triangle that may be within `reach` of the body, and some others. The result is valid until the
  /// next call. Allocates nothing once its buffers are large enough.
  std::span<const std::uint32_t> find(const ClusteredOctree& tree, const Convex& convex,
                                      const Pose& convex_in_tree, double reach);

  /// Call this if a tree at the same address gets other triangles.
  void forget() {
    kept_reach_ = kNothing;
    last_at_.reset();
  }

 private:
  static constexpr double kNothing = -1.0;

  double displacementBound(const Pose& pose, const Pose& from) const;
  double reserveFor(const Pose& convex_in_tree, double radius) const;
  void gather(const ClusteredOctree& tree, const Convex& convex, std::span<const Vec3> core,
              const Pose& convex_in_tree, double reach, double reserve);

  const ClusteredOctree* tree_ = nullptr;
  std::vector<Vec3> core_;        ///< points whose hull contains the body's core, for the kept triangles
  Aabb bounds_;                   ///< of these points at the last query
  double kept_reach_ = kNothing;  ///< from the core
  Pose kept_at_;
  std::optional<Pose> last_at_;  ///< at the last query
  std::vector<detail::TriangleBundle> kept_;
  std::vector<std::uint32_t> found_;
};

}  // namespace octoblisk
