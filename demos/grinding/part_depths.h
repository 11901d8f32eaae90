// How deep the tool's parts and the blisk lie in each other: as solids, whatever triangles they are made of.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "grinding/fixture.h"
#include "grinding/grinding_cell.h"
#include "octoblisk/depth.h"
#include "octoblisk/solid_boundary.h"

namespace octoblisk::demos {

/// The deepest place of a part that touches the blisk, or that lies in it.
struct PartDepth {
  std::size_t part = 0;
  double depth = 0.0;                   ///< mm
  std::uint32_t triangle_of_blisk = 0;  ///< of the deepest point if it is the blisk's, else the nearest to it
  Vec3 point_on_blisk = Vec3::Zero();   ///< on that triangle
  bool is_inside = false;               ///< no surfaces meet: one lies wholly in the other
  /// False: the part is where the blisk's surface bounds no solid (octoblisk/solid_boundary.h), at a hole,
  /// say; it may be deeper, or not in the blisk at all.
  bool is_known = true;
};

/// What a part's depth is.
enum class DepthKind {
  of_solids,  ///< the greater of both ways; see PartDepths
  of_part,    ///< the part is open: only its own points inside the blisk count
};

/// Measures depths by DepthQuery (octoblisk/depth.h), pose by pose over threads; the answers do not depend on
/// their number.
class PartDepths {
 public:
  /// `limit` (mm): the depth that the verdict compares with. The depth is the greater of two: of the part's
  /// deepest point in the blisk, and of the blisk's deepest point in the part. Each is measured to within 1 %
  /// of the limit, or 0.1 µm if that is more; if it may lie on either side of the limit, to 0.1 %.
  PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts, double limit,
             int threads = 0);

  /// The same with a limit for each part.
  /// The fixtures must outlive it.
  PartDepths(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
             std::vector<double> limits, int threads = 0, std::span<const Fixture> fixtures = {});

  DepthKind kindOf(std::size_t part) const;
  const SolidBoundary& blisk() const { return blisk_boundary_; }
  const octoblisk::Surface& partSurface(std::size_t part) const { return part_surfaces_[part]; }

  /// For each pose, in the order of the parts: the parts that touch the blisk, contain
  /// it or lie inside it. After these, the parts that contain a fixture, or lie inside it, without touching
  /// it: their depth is 0, and the triangle is one of the surroundings (fixture.h).
  std::vector<std::vector<PartDepth>> measure(std::span<const Pose> tool_in_blisk);

  /// The same for single parts: parts[i] at tool_in_blisk[i].
  std::vector<std::optional<PartDepth>> measure(std::span<const std::size_t> parts,
                                                std::span<const Pose> tool_in_blisk);

  /// Whether a part, a pair of whose triangles touches the blisk (`touch.a` of the blisk), is deeper than its
  /// limit, or its depth is not known: as measure says, but by cheaper questions first. `deep_corner` is
  /// memory from pose to pose: a corner of the part that was too deep. Calls of one thread at a time
  /// (numbered from 0).
  bool isBeyond(std::size_t part, const Pose& tool_in_blisk, const TrianglePair& touch,
                std::optional<std::uint32_t>& deep_corner, std::size_t thread);

  /// Whether a part that does not touch a fixture lies wholly inside it, or contains it, or whether that is
  /// unknown. An open fixture contains nothing.
  bool isInFixture(std::size_t part, const Pose& tool_in_blisk) const;

 private:
  /// A fixture as a solid.
  struct FixedSolid {
    explicit FixedSolid(const ClusteredOctree& tree, int threads)
        : surface(tree), boundary(surface, threads) {}
    octoblisk::Surface surface;
    SolidBoundary boundary;
  };

  bool isNested(std::size_t part, const FixedSolid& fixture, const Pose& tool_in_blisk) const;
  std::vector<PartDepth> measureAt(const Pose& tool_in_blisk, DepthQuery& query) const;
  std::optional<PartDepth> ofPart(std::size_t part, const Pose& tool_in_blisk, DepthQuery& query) const;
  bool staysWithin(std::size_t part, const Pose& tool_in_blisk, std::uint32_t triangle_of_blisk) const;
  double depthOfCorner(std::size_t part, const Pose& tool_in_blisk, std::uint32_t corner) const;
  std::optional<std::uint32_t> cornerBeyond(std::size_t part, const Pose& tool_in_blisk,
                                            std::uint32_t touching_triangle, double depth) const;

  std::shared_ptr<const ClusteredOctree> blisk_;
  std::vector<ToolPart> parts_;
  std::vector<double> limits_;  // of each part
  octoblisk::Surface blisk_surface_;
  SolidBoundary blisk_boundary_;
  std::vector<std::unique_ptr<const FixedSolid>> fixtures_;
  std::vector<octoblisk::Surface> part_surfaces_;
  std::vector<DepthQuery> queries_;  // one a thread
};

}  // namespace octoblisk::demos
