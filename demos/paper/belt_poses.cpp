#include "paper/belt_poses.h"

#include <cmath>
#include <numbers>
#include <random>

#include "octoblisk/path_query.h"
#include "paper/uniform.h"

namespace octoblisk::demos {
namespace {

/// After K. Shoemake, Uniform random rotations, 1992.
Mat3 randomRotation(std::mt19937_64& random) {
  const double split = uniform(random);
  const double first = 2.0 * std::numbers::pi * uniform(random);
  const double second = 2.0 * std::numbers::pi * uniform(random);
  const double a = std::sqrt(1.0 - split), b = std::sqrt(split);
  return Eigen::Quaterniond(b * std::cos(second), a * std::sin(first), a * std::cos(first),
                            b * std::sin(second))
      .toRotationMatrix();
}

const Vec3& randomVertex(const TriangleMesh& mesh, std::mt19937_64& random) {
  return mesh.vertices()[random() % mesh.vertices().size()];
}

}  // namespace

std::vector<BeltPose> judged(const ClusteredOctree& mesh, const ClusteredOctree& belt,
                             const std::vector<Pose>& path) {
  PathQuery query(mesh, belt);
  std::vector<BeltPose> poses;
  for (const Pose& pose : path) poses.push_back({pose, query.collide(pose).has_value()});
  return poses;
}

std::vector<BeltPose> posesAbout(const ClusteredOctree& body, const ClusteredOctree& belt, std::size_t count,
                                 double reach, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const Mat3 rotation = randomRotation(random);
    Vec3 offset;
    for (double& coordinate : offset) coordinate = reach * (2.0 * uniform(random) - 1.0);
    const Vec3 there = randomVertex(body.mesh(), random) + offset;
    poses.push_back({rotation, there - rotation * randomVertex(belt.mesh(), random)});
  }
  return judged(body, belt, poses);
}

}  // namespace octoblisk::demos
