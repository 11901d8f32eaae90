// What the contenders are asked about: a blisk, the belt, and the poses of a grinding path.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::bench {

/// A straight way from one point to another.
struct Segment {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
};

/// Lengths in mm. All coordinates of the meshes and ways are representable in single precision, so that
/// contenders of either precision see the same.
struct Scene {
  std::string name;
  std::shared_ptr<const TriangleMesh> blisk;
  std::shared_ptr<const TriangleMesh> belt;
  std::vector<Pose> path;      ///< belt_in_blisk, in the order they are driven through
  std::vector<Pose> shuffled;  ///< the same, each turned to a random blade, in random order
  std::vector<Segment> ways;   ///< from anywhere to anywhere in a box a little larger than the blisk
};

inline constexpr const char* kSceneNames[] = {"50k", "300k", "1500k"};

/// The default belt over the default blisk of 50,000, 300,000 or 1,500,000 triangles, made at the first call
/// and kept. The path is the same for all: there and back over both sides of a blade in steps of about 1 mm,
/// approach and retraction, the belt pressed in and lifted off by seeded, smooth amounts.
/// `poses` above 0 keeps about that many, in stretches of twenty.
/// Throws std::invalid_argument for another name.
const Scene& sceneNamed(const std::string& name, std::size_t poses = 0);

}  // namespace octoblisk::bench
