// The closed curve in which a cylinder about the axis cuts a blade of any blisk's mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "models/blade_finder.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

using Vec2 = Eigen::Vector2d;

/// A place of a section: in space, and on the cylinder unrolled, x = z and y = radius · angle (mm).
struct SectionPoint {
  Vec3 position = Vec3::Zero();
  Vec2 flat = Vec2::Zero();
};

/// The two sides of a section, each from the leading edge (least z) to the trailing edge (greatest z), both
/// points included.
struct BladeSection {
  std::vector<SectionPoint> forward;   ///< the side towards greater angles
  std::vector<SectionPoint> backward;  ///< and towards lesser ones
};

/// Cuts one blade at many radii.
class BladeCutter {
 public:
  /// Throws std::invalid_argument: no such blade, or numbers that are not of this mesh.
  BladeCutter(const TriangleMesh& blisk, const BladesFound& blades, int blade);

  /// The longest closed curve at a radius. Its points lie on the mesh's edges, and so on the cylinder but
  /// for the sag of an edge. Throws std::invalid_argument where there is none.
  BladeSection at(double radius) const;

 private:
  struct Facet {
    TriangleMesh::Indices corners;  ///< vertices at one place have one number
    Triangle places;
  };

  int blade_;
  double angle_ = 0.0;  ///< of the blade's middle; the unrolled sections count angles from it
  std::vector<Facet> facets_;
};

/// Whether the convex (suction) side is the forward one: the side towards which the section's middle line
/// bulges from its chord. A section without camber has its forward side called convex.
bool convexIsForward(const BladeSection& section);

}  // namespace octoblisk::demos
