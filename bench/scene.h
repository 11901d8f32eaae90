// The scenes of the queries: a blisk, the belt, and the poses of a grinding path.
#pragma once

#include <compare>
#include <memory>
#include <string>
#include <vector>

#include "octoblisk/triangle_mesh.h"
#include "shapes/threads.h"

namespace octoblisk::bench {

/// A straight segment from one point to another.
struct Segment {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
};

/// Bullet's convex primitives, of half extents about 0.1.
enum class Primitive { sphere, box, capsule, cylinder, hull };

/// A primitive is all points within `margin` of a convex core, like Bullet's default shapes. The cylinder's
/// core is a prism with many sides.
struct RoundedCore {
  std::shared_ptr<const TriangleMesh> core;
  double margin = 0.0;
};
RoundedCore roundedCore(Primitive primitive);

/// The nut that runs down a bolt, in the scene and in the worlds.
inline const shapes::Thread kNutThread = shapes::coarseThread(16, 192);
inline constexpr int kNutPitches = 4;  ///< over the head of the bolt at the start

/// Lengths are in mm, or in any unit for small meshes. All coordinates of meshes and segments are
/// representable in single precision, so contenders of both precisions get the same input.
struct Scene {
  std::string name;
  std::shared_ptr<const TriangleMesh> blisk;
  std::shared_ptr<const TriangleMesh> belt;
  int stations = 0, points_per_station = 0;  ///< of the belt, whose vertices are ordered by station
  std::vector<Pose> path;                    ///< belt_in_blisk, in driving order
  std::vector<Pose> shuffled;     ///< the same poses, each rotated to a random blade, in random order
  std::vector<Segment> segments;  ///< between random points of a box slightly larger than the blisk
  std::size_t bodies = 200;       ///< that fall onto the blisk
  Primitive primitive = Primitive::sphere;  ///< that touches a small mesh
};

/// Limits the size of a scene.
struct SceneSize {
  std::size_t poses = 0;  ///< approximate number of the path's poses, in runs of twenty; 0: all
  bool quick = false;     ///< fewer segments too

  auto operator<=>(const SceneSize&) const = default;
};

/// Returns a scene, which is made at the first call and cached:
///   300k          the default belt over the default blisk of about 300 thousand triangles
///   belt-20k      a belt of about 20 thousand triangles over the blisk of 300k
///   1000-bodies   1000 bodies over the blisk of 50k
///   500-triangles a torus of 500 triangles and radii 1 and 0.35 in place of the blisk. No belt. The path is
///                 2,000 random poses of a primitive. The origin of the primitive is outside the torus, 0.05
///                 to 0.19 from the surface
///   nut-on-bolt   a bolt in place of the blisk, a nut in place of the belt. The path is where the nut is
///                 after each of 144 steps of 1/240 s by the closed form, but lowered onto the flanks of the
///                 bolt, and 2 µm into them
/// The path of the belt is the same for all blisks. It runs there and back over both sides of a blade in
/// steps of about 1 mm, with approach and retraction. The belt is pressed in and lifted off by seeded, smooth
/// amounts. Throws std::invalid_argument for any other name.
const Scene& sceneNamed(const std::string& name, const SceneSize& size = {});

/// The blisk after a smooth deformation that moves vertices by up to 0.5 mm, for refits.
std::shared_ptr<const TriangleMesh> bent(const TriangleMesh& blisk);

}  // namespace octoblisk::bench
