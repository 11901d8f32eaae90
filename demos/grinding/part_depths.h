// Penetration depths of the tool's parts and the blisk as solids, whatever triangles they consist of.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "grinding/fixture.h"
#include "octoblisk/depth.h"
#include "octoblisk/surface.h"

namespace octoblisk::demos {

/// The deepest place of a part that touches the blisk or lies in it.
struct PartDepth {
  std::size_t part = 0;
  double depth = 0.0;  ///< mm
  /// Of the deepest point if it is on the blisk, otherwise the nearest one to it.
  std::uint32_t triangle_of_blisk = 0;
  Vec3 point_on_blisk = Vec3::Zero();  ///< on that triangle
  bool is_inside = false;              ///< the surfaces do not meet: one lies wholly in the other
  /// False if the part is at a sheet of the blisk (octoblisk/surface.h), for example at a hole: it may be
  /// deeper, or not in the blisk at all.
  bool is_known = true;
  int blade = 0;  ///< of the triangle (BodyNames); Judge sets it
};

/// The meaning of a part's depth.
enum class DepthKind {
  of_solids,  ///< the greater of the two depths; see PartDepths
  of_part,    ///< the part is open: only its own points inside the blisk count
};

/// Measures depths with DepthQuery (octoblisk/depth.h), poses in parallel; the answers do not depend on the
/// number of threads.
class PartDepths {
 public:
  /// `limit` (mm) is the depth that the verdict compares with. The depth is the greater of two: that of the
  /// part's deepest point in the blisk, and that of the blisk's deepest point in the part. Each is measured
  /// to within 1 % of the limit, or 0.1 µm if that is more; to 0.1 % if it may lie on either side of the
  /// limit.
  PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts, double limit,
             int threads = 0);

  /// The same with a limit for each part. The fixtures must outlive it.
  PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
             std::vector<double> limits, int threads = 0, std::span<const Fixture> fixtures = {});

  /// Keeps every depth measured from now on: a part at the same pose is not measured again. For paths that
  /// have many poses and motions in common.
  void remember() { remembers_ = true; }

  DepthKind kindOf(std::size_t part) const;
  /// No point is deeper than a measured depth and this, mm.
  double toleranceOf(std::size_t part) const;
  const octoblisk::Surface& blisk() const { return blisk_surface_; }
  const octoblisk::Surface& partSurface(std::size_t part) const { return part_surfaces_[part]; }

  /// For each pose, in the order of the parts: the parts that touch the blisk, contain it or lie inside it.
  /// After these, the parts that contain a fixture or lie inside it without touching it: their depth is 0,
  /// and the triangle is one of the surroundings (fixture.h).
  std::vector<std::vector<PartDepth>> measure(std::span<const Pose> tool_in_blisk);

  /// The same for single parts: parts[i] at tool_in_blisk[i].
  std::vector<std::optional<PartDepth>> measure(std::span<const std::size_t> parts,
                                                std::span<const Pose> tool_in_blisk);

  /// For a part that touches the blisk with a triangle pair (`touch.a` on the blisk): whether it is deeper
  /// than its limit, or its depth is unknown. Gives the same answer as measure, but tries cheaper checks
  /// first. `deep_corner` is memory from pose to pose: a corner of the part that was too deep. Each thread
  /// (numbered from 0) may call it only once at a time.
  bool isBeyond(std::size_t part, const Pose& tool_in_blisk, const TrianglePair& touch,
                std::optional<std::uint32_t>& deep_corner, std::size_t thread);

  /// For a part that does not touch a fixture: whether it lies wholly inside it or contains it. An open
  /// fixture contains nothing.
  bool isInFixture(std::size_t part, const Pose& tool_in_blisk) const;

 private:
  using PoseBits = std::array<std::uint64_t, 12>;

  static PoseBits bitsOf(const Pose& pose);
  bool isNested(std::size_t part, const octoblisk::Surface& fixture, const Pose& tool_in_blisk) const;
  void addNested(const Pose& tool_in_blisk, std::vector<PartDepth>& found) const;
  std::optional<PartDepth> ofPart(std::size_t part, const Pose& tool_in_blisk, DepthQuery& query) const;
  bool staysWithin(std::size_t part, const Pose& tool_in_blisk, std::uint32_t triangle_of_blisk) const;
  double depthOfCorner(std::size_t part, const Pose& tool_in_blisk, std::uint32_t corner) const;
  std::optional<std::uint32_t> cornerBeyond(std::size_t part, const Pose& tool_in_blisk,
                                            std::uint32_t touching_triangle, double depth) const;

  std::shared_ptr<const ClusteredOctree> blisk_;
  std::vector<ToolPart> parts_;
  std::vector<double> limits_;  // per part
  octoblisk::Surface blisk_surface_;
  std::vector<octoblisk::Surface> fixtures_;
  std::vector<octoblisk::Surface> part_surfaces_;
  std::vector<DepthQuery> queries_;  // one per thread
  bool remembers_ = false;
  std::map<std::pair<std::size_t, PoseBits>, std::optional<PartDepth>> known_;  // part and pose
};

}  // namespace octoblisk::demos
