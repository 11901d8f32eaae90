// The paper's collision detection (section 3.3): finds the boxes of one body that overlap the box, or boxes,
// of another.
#pragma once

#include <cstddef>
#include <span>

#include "geometry/separating_axis.h"
#include "octoblisk/clustered_octree.h"
#include "paper/segmentation.h"

namespace octoblisk::demos {

/// The volume that remains to be examined after the box tests.
struct BoxesLeft {
  std::size_t tested = 0;  ///< pairs of boxes that were compared
  std::size_t leaves = 0;  ///< leaf boxes that overlap
  double volume = 0.0;     ///< of these leaf boxes, mm³

  bool isColliding() const { return leaves > 0; }
};

/// The leaf cells with points that overlap the box, found from the roots down. O_a of the test is the box:
/// `paper1` tests only its X axis.
BoxesLeft leavesNear(const Segmentation& blisk, const Obb& box, detail::SeparatingAxes axes);

/// Whether any leaf cell with points overlaps the box, tested on all fifteen axes.
bool anyLeafNear(const Segmentation& blisk, const Obb& box);

/// Whether a triangle of the body meets any leaf cell with points, treated as a solid.
bool anyLeafMeets(const Segmentation& blisk, const ClusteredOctree& body, const Pose& body_in_blisk);

/// Whether a triangle of the body meets the box around the points of any leaf, in the frame of its cell. The
/// clusters must be those from which the segmentation was made.
bool anyFittedBoxMeets(std::span<const Points> clusters, const Segmentation& blisk,
                       const ClusteredOctree& body, const Pose& body_in_blisk);

/// Whether a triangle of the body meets any leaf box, treated as a solid; the triangles in the boxes are not
/// tested.
bool anyLeafMeets(const ClusteredOctree& blisk, const ClusteredOctree& body, const Pose& body_in_blisk);

/// The leaf boxes of the clustered octree, which contain whole triangles, that overlap the box together with
/// all boxes above them. (A box contains the triangles of the boxes below it, but not all of these boxes.)
BoxesLeft leavesNear(const ClusteredOctree& blisk, const Obb& box);

/// The leaf boxes of the clustered octree that overlap a leaf box of the body, found in the same way from
/// both roots, each counted once.
BoxesLeft leavesNear(const ClusteredOctree& blisk, const ClusteredOctree& body, const Pose& body_in_blisk);

}  // namespace octoblisk::demos
