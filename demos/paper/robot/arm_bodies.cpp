#include "paper/robot/arm_bodies.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "octoblisk/mass_properties.h"

namespace octoblisk::demos {
namespace {

constexpr std::uint32_t kSides = 16;

Mat3 pointInertia(double mass, const Vec3& at) {
  return mass * (at.squaredNorm() * Mat3::Identity() - at * at.transpose());
}

}  // namespace

std::array<LinkBody, 6> linkBodies(const SixAxisArm& arm) {
  // In frame 1 the floor is towards +y and axis 1 at −x; the upper arm ends at frame 2's origin; frame 3's z
  // is the forearm's axis, which in frame 4 is y; frame 6's z leads out of the flange.
  return {{{{-arm.shoulder_offset, 0.5 * arm.shoulder_height, 0.0}, {-30.0, 0.0, 0.0}, 190.0, 160.0},
           {{-arm.upper_arm, 0.0, 0.0}, {0.0, 0.0, 0.0}, 115.0, 110.0},
           {{-arm.elbow_offset, 0.0, 0.0}, {0.0, 0.0, 0.3 * arm.forearm}, 120.0, 80.0},
           {{0.0, -0.7 * arm.forearm, 0.0}, {0.0, -0.06 * arm.forearm, 0.0}, 85.0, 35.0},
           {{0.0, 0.0, -60.0}, {0.0, 0.0, 0.6 * arm.flange}, 70.0, 15.0},
           {{0.0, 0.0, -0.3 * arm.flange}, {0.0, 0.0, 30.0}, 62.0, 6.0}}};
}

TriangleMesh meshOf(const LinkBody& body) {
  const Vec3 along = (body.to - body.from).normalized();
  const Vec3 across = along.unitOrthogonal(), third = along.cross(across);
  std::vector<Vec3> vertices;
  for (const Vec3& end : {body.from, body.to}) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / kSides;
      vertices.push_back(end + body.radius * (std::cos(angle) * across + std::sin(angle) * third));
    }
  }
  std::vector<TriangleMesh::Indices> triangles;
  for (std::uint32_t side = 0; side < kSides; ++side) {
    const std::uint32_t next = (side + 1) % kSides;
    triangles.push_back({side, next, kSides + next});
    triangles.push_back({side, kSides + next, kSides + side});
    if (side + 2 >= kSides) continue;
    triangles.push_back({0, side + 2, side + 1});
    triangles.push_back({kSides, kSides + side + 1, kSides + side + 2});
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

MassOfBody massOf(const TriangleMesh& mesh, double mass) {
  const MassProperties properties = massProperties(mesh);
  return {mass, properties.center_of_mass, mass * properties.inertia};
}

MassOfBody operator*(const Pose& pose, const MassOfBody& body) {
  return {body.mass, pose * body.center, pose.rotation * body.inertia * pose.rotation.transpose()};
}

MassOfBody joined(std::span<const MassOfBody> bodies) {
  MassOfBody whole;
  for (const MassOfBody& body : bodies) {
    whole.mass += body.mass;
    whole.center += body.mass * body.center;
  }
  if (!(whole.mass > 0.0)) throw std::invalid_argument("bodies that are joined must have a mass");
  whole.center /= whole.mass;
  for (const MassOfBody& body : bodies) {
    whole.inertia += body.inertia + pointInertia(body.mass, body.center - whole.center);
  }
  return whole;
}

}  // namespace octoblisk::demos
