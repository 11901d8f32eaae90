// The paper's detection: octrees over a blisk's points, whose boxes are compared with one box of the belt.
#pragma once

#include <span>
#include <vector>

#include "models/blade_finder.h"
#include "octoblisk/octree.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Octrees over the vertices of a blisk. Boxes of points do not hold the surface between them (erratum 14).
class PointBoxes {
 public:
  /// One octree over all points in the blisk's frame: "traditional". `leaf_capacity`: the paper's FNOP.
  static PointBoxes traditional(const TriangleMesh& blisk, std::size_t leaf_capacity);

  /// The paper's improvement (section 3.2): the blisk is divided into its blades and the rest, each of these
  /// into `clusters` by k-means, with an octree each; a blade's boxes lie along the radius through its middle
  /// and the z axis. A part with fewer points than clusters is left whole. Throws std::invalid_argument where
  /// the blades are not those of this mesh.
  static PointBoxes improved(const TriangleMesh& blisk, const BladesFound& blades, std::size_t clusters,
                             std::size_t leaf_capacity);

  /// The detection range: the volume of the boxes that are to be examined, that is of all root boxes
  /// (mm³).
  double range() const;

  std::size_t nodes() const;  ///< as the paper counts them (TNON): k + 8 · splits

  /// How many leaves with points overlap a box in the blisk's frame, by all fifteen separating axes.
  std::size_t leavesMet(const Obb& box_in_blisk) const;

 private:
  std::vector<Octree> trees_;
};

}  // namespace octoblisk::demos
