// The collision detection of the paper: which boxes of one body overlap the box, or boxes, of another
// (section 3.3).
#pragma once

#include <cstddef>
#include <span>

#include "geometry/separating_axis.h"
#include "octoblisk/clustered_octree.h"
#include "paper/segmentation.h"

namespace octoblisk::demos {

/// What is left to be examined after the boxes were.
struct BoxesLeft {
  std::size_t tested = 0;  ///< pairs of boxes that were compared
  std::size_t leaves = 0;  ///< leaf boxes that overlap
  double volume = 0.0;     ///< of them, mm³

  bool isColliding() const { return leaves > 0; }
};

/// The leaf cells with points that overlap the box, found from the roots down. O_a of the test is the box:
/// with `paper1` only its X axis is looked at.
BoxesLeft leavesNear(const Segmentation& blisk, const Obb& box, detail::SeparatingAxes axes);

/// Whether any leaf cell with points overlaps the box, by all fifteen axes.
bool anyLeafNear(const Segmentation& blisk, const Obb& box);

/// Whether a triangle of the body meets any leaf cell with points, as a solid.
bool anyLeafMeets(const Segmentation& blisk, const ClusteredOctree& body, const Pose& body_in_blisk);

/// Whether a triangle of the body meets the box round the points of any leaf, in the frame of its cell. The
/// clusters are those that the segmentation was made of.
bool anyFittedBoxMeets(std::span<const Points> clusters, const Segmentation& blisk,
                       const ClusteredOctree& body, const Pose& body_in_blisk);

/// Whether a triangle of the body meets any leaf box, as a solid; the triangles in the boxes are not asked.
bool anyLeafMeets(const ClusteredOctree& blisk, const ClusteredOctree& body, const Pose& body_in_blisk);

/// The leaf boxes of the clustered octree, which hold whole triangles, that overlap the box, and so do all
/// boxes round them. (A box holds the triangles of those below it, not all of their boxes.)
BoxesLeft leavesNear(const ClusteredOctree& blisk, const Obb& box);

/// The leaf boxes of the clustered octree that overlap a leaf box of the body, found in the same way from
/// both roots, each counted once.
BoxesLeft leavesNear(const ClusteredOctree& blisk, const ClusteredOctree& body, const Pose& body_in_blisk);

}  // namespace octoblisk::demos
