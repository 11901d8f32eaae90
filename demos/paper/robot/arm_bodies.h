// The bodies of the arm's links: convex for collisions and pictures, with masses for their dynamics.
#pragma once

#include <array>
#include <span>

#include "octoblisk/triangle_mesh.h"
#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

/// A round bar in a link's own frame (mm), with its mass in kg spread evenly in it.
struct LinkBody {
  Vec3 from, to;
  double radius;
  double mass;
};

/// One per link; they follow the arm's dimensions. Radii and masses are assumed.
std::array<LinkBody, 6> linkBodies(const SixAxisArm& arm);

/// The bar as a closed mesh, oriented outward: a prism of 16 sides around it.
TriangleMesh meshOf(const LinkBody& body);

/// Mass, centre of mass, and inertia about the centre of mass along the frame's axes: kg, mm, kg mm².
struct MassOfBody {
  double mass = 0.0;
  Vec3 center = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

MassOfBody massOf(const TriangleMesh& mesh, double mass);

/// The same in another frame.
MassOfBody operator*(const Pose& pose, const MassOfBody& body);

/// Joins bodies to one rigid body. Throws std::invalid_argument if they have no mass.
MassOfBody joined(std::span<const MassOfBody> bodies);

}  // namespace octoblisk::demos
