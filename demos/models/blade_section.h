// The closed curve in which a cylinder about the axis cuts a blade of any blisk mesh.
#pragma once

#include <vector>

#include "models/blade_finder.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

using Vec2 = Eigen::Vector2d;

/// A point of a section: in space, and on the unrolled cylinder with x = z and y = radius · angle (mm).
struct SectionPoint {
  Vec3 position = Vec3::Zero();
  Vec2 flat = Vec2::Zero();
};

/// The two sides of a section, each from the leading edge (least z) to the trailing edge (greatest z), both
/// points included.
struct BladeSection {
  std::vector<SectionPoint> forward;   ///< the side towards greater angles
  std::vector<SectionPoint> backward;  ///< the side towards lesser angles
};

/// Cuts one blade at many radii.
class BladeCutter {
 public:
  /// Throws std::invalid_argument if the blade does not exist or the blade numbers are not for this mesh.
  BladeCutter(const TriangleMesh& blisk, const BladesFound& blades, int blade);

  /// The longest closed curve at a radius. Its points lie on the mesh's edges, and so on the cylinder except
  /// for the sag of an edge. Throws std::invalid_argument if the section is not closed.
  BladeSection at(double radius) const;

 private:
  struct Facet {
    TriangleMesh::Indices corners;  ///< vertices at one place have the same number
    Triangle places;
  };

  int blade_;
  double angle_ = 0.0;  ///< of the blade's middle; angles of the unrolled sections are relative to it
  std::vector<Facet> facets_;
};

/// Whether the convex (suction) side is the forward one: the section's middle line bulges towards the convex
/// side from its chord. For a section without camber the forward side is called convex.
bool convexIsForward(const BladeSection& section);

}  // namespace octoblisk::demos
