// What the arm's links are made of: convex bodies for collisions and pictures, masses for their motion.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"
#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

/// A round bar in a link's own frame (mm), its mass in kg spread evenly in it.
struct LinkBody {
  Vec3 from, to;
  double radius;
  double mass;
};

/// One for each link; they follow the arm's dimensions. Radii and masses are assumed.
std::array<LinkBody, 6> linkBodies(const SixAxisArm& arm);

/// The bar as a closed surface, outward oriented: a prism of 16 sides about it.
TriangleMesh meshOf(const LinkBody& body);

/// Mass, centre of mass and inertia about it, along the axes of the frame it is given in: kg, mm, kg mm².
struct MassOfBody {
  double mass = 0.0;
  Vec3 center = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

MassOfBody massOf(const TriangleMesh& mesh, double mass);

/// The same in another frame.
MassOfBody operator*(const Pose& pose, const MassOfBody& body);

/// Bodies that move as one. Throws std::invalid_argument where they have no mass.
MassOfBody joined(std::span<const MassOfBody> bodies);

}  // namespace octoblisk::demos
