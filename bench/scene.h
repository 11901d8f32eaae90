// What the contenders are asked about: a blisk, the belt, and the poses of a grinding path.
#pragma once

#include <compare>
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

/// Bullet's convex primitives, of half extents about 0.1.
enum class Primitive { sphere, box, capsule, cylinder, hull };

/// A primitive is all points within `margin` of a convex core, as Bullet has it by default. The cylinder's
/// core is a prism of many sides.
struct RoundedCore {
  std::shared_ptr<const TriangleMesh> core;
  double margin = 0.0;
};
RoundedCore roundedCore(Primitive primitive);

/// Lengths in mm; those of small meshes in any unit. All coordinates of the meshes and ways are representable
/// in single precision, so that contenders of either precision see the same.
struct Scene {
  std::string name;
  std::shared_ptr<const TriangleMesh> blisk;
  std::shared_ptr<const TriangleMesh> belt;
  int stations = 0, points_per_station = 0;  ///< of the belt: its vertices, station by station
  std::vector<Pose> path;                    ///< belt_in_blisk, in the order they are driven through
  std::vector<Pose> shuffled;                ///< the same, each turned to a random blade, in random order
  std::vector<Segment> ways;  ///< from anywhere to anywhere in a box a little larger than the blisk
  std::size_t bodies = 200;   ///< that fall onto the blisk
  Primitive primitive = Primitive::sphere;  ///< that touches a small mesh
};

/// How much of a scene is asked for.
struct SceneSize {
  std::size_t poses = 0;  ///< about how many of the path, in stretches of twenty; 0: all
  bool quick = false;     ///< fewer ways too

  auto operator<=>(const SceneSize&) const = default;
};

/// A scene, made at the first call and kept:
///   300k          the default belt over the default blisk of about so many thousand triangles
///   belt-20k      a belt of about so many thousand triangles over the blisk of 300k
///   1000-bodies   so many bodies over the blisk of 50k
///   500-triangles a small mesh of so many triangles in place of the blisk: a torus of radii 1 and 0.35. No
///                 belt. The path is 2,000 random poses of a primitive. The origin of the primitive is
///                 outside the torus, 0.05 to 0.19 from the surface
/// The path is the same for all blisks: there and back over both sides of a blade in steps of about 1 mm,
/// approach and retraction, the belt pressed in and lifted off by seeded, smooth amounts. Throws
/// std::invalid_argument for another name.
const Scene& sceneNamed(const std::string& name, const SceneSize& size = {});

/// The blisk with every vertex moved by up to 0.5 mm, smoothly: what a refit is for.
std::shared_ptr<const TriangleMesh> bent(const TriangleMesh& blisk);

}  // namespace octoblisk::bench
