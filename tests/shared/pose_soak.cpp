#include "shared/pose_soak.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "shared/brute_force.h"
#include "shared/cgal_shapes.h"
#include "shared/solids.h"

namespace octoblisk::testing {
namespace {

constexpr std::size_t kMaxFindings = 10;
constexpr int kPosesADistance = 8;

struct TreeKind {
  const char* name;
  BuildOptions options;
  bool refitted = false;
};

const std::array<TreeKind, 5>& treeKinds() {
  static const std::array<TreeKind, 5> kinds = {{
      {"standard", {.threads = 1}},
      {"compact", {.threads = 1, .storage = Storage::compact}},
      {"fast to build", {.quality = BuildQuality::low, .threads = 1}},
      {"the paper's", {.partition = PartitionKind::paper, .leaf_capacity = 4, .threads = 1, .clusters = 3}},
      {"refitted", {.threads = 1}, true},
  }};
  return kinds;
}

/// A number with a uniform logarithm.
double scaleBetween(std::mt19937_64& random, double low, double high) {
  return std::pow(10.0, uniform(random, std::log10(low), std::log10(high)));
}

std::mt19937_64 randomOf(std::uint64_t scene_number) {
  return std::mt19937_64(0x9E3779B97F4A7C15u * (scene_number + 1));
}

SoakScene drawScene(std::uint64_t number, std::mt19937_64& random) {
  SoakScene scene{};
  scene.a = static_cast<MeshKind>(number % kMeshKinds);
  scene.b = static_cast<MeshKind>(number / kMeshKinds % kMeshKinds);
  scene.tree = treeKinds()[number % treeKinds().size()].name;
  scene.scale = scaleBetween(random, 1e-6, 1e6);
  scene.ratio = random() % 4 == 0 ? scaleBetween(random, 1e-3, 1.0) : 1.0;
  scene.far = random() % 2 == 0 ? 0.0 : scaleBetween(random, 1.0, 1e6);
  return scene;
}

ClusteredOctree treeOf(const SharedMesh& mesh, const TreeKind& kind) {
  if (!kind.refitted) return ClusteredOctree::build(mesh, kind.options);
  const SharedMesh longer = scaledAndMoved(mesh, 1.25, Vec3::Zero());
  return ClusteredOctree::build(longer, kind.options).refitted(mesh, 1);
}

/// A point of a triangle: a corner, or on an edge, or inside it.
Vec3 pointOf(const Triangle& t, std::mt19937_64& random) {
  const double u = uniform(random, 0.0, 1.0), v = uniform(random, 0.0, 1.0 - u);
  switch (random() % 4) {
    case 0:
      return t[0];
    case 1:
      return t[0] + u * (t[1] - t[0]);
    default:
      return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
  }
}

/// A rotation by right angles, so that planes and edges coincide.
Mat3 rightAngled(std::mt19937_64& random) {
  std::array<int, 3> axis = {0, 1, 2};
  std::swap(axis[0], axis[random() % 3]);
  std::swap(axis[1], axis[1 + random() % 2]);
  Mat3 rotation = Mat3::Zero();
  for (int k = 0; k < 3; ++k) rotation(axis[static_cast<std::size_t>(k)], k) = random() % 2 == 0 ? 1.0 : -1.0;
  if (rotation.determinant() < 0.0) rotation.col(0) = -rotation.col(0);
  return rotation;
}

/// Moves a point of B onto a point of A, or up to B's size away from it.
Pose nearPose(const TriangleMesh& a, const TriangleMesh& b, double size_of_b, std::mt19937_64& random) {
  Pose pose;
  pose.rotation = random() % 3 == 0 ? rightAngled(random) : randomRotation(random);
  const Vec3 on_a = pointOf(a.triangle(random() % a.triangleCount()), random),
             on_b = pointOf(b.triangle(random() % b.triangleCount()), random);
  const double gap = random() % 4 == 0 ? 0.0 : size_of_b * uniform(random, 0.0, 4.0);
  const Vec3 direction = (on_a - a.bounds().center()).normalized();
  pose.translation = on_a + gap * direction - pose.rotation * on_b;
  return pose;
}

}  // namespace

SoakTally& SoakTally::operator+=(const SoakTally& more) {
  poses += more.poses;
  hits += more.hits;
  pairs += more.pairs;
  missed += more.missed;
  wrong += more.wrong;
  distances += more.distances;
  wrong_distances += more.wrong_distances;
  for (const std::string& finding : more.findings) {
    if (findings.size() < kMaxFindings) findings.push_back(finding);
  }
  return *this;
}

SoakScene soakScene(std::uint64_t number) {
  std::mt19937_64 random = randomOf(number);
  return drawScene(number, random);
}

SoakTally soak(std::uint64_t scene_number, int poses) {
  std::mt19937_64 random = randomOf(scene_number);
  const SoakScene scene = drawScene(scene_number, random);
  const double size_of_b = scene.scale * scene.ratio;
  const Vec3 direction = randomRotation(random).col(0);
  const SharedMesh mesh_a =
      scaledAndMoved(hardMesh(random, scene.a), scene.scale, scene.scale * scene.far * direction);
  // B may also lie far from its own origin.
  const double far_of_b = random() % 2 == 0 ? 0.0 : size_of_b * scene.far;
  const SharedMesh mesh_b = scaledAndMoved(hardMesh(random, scene.b), size_of_b, far_of_b * direction);
  const TreeKind& kind = treeKinds()[scene_number % treeKinds().size()];
  const ClusteredOctree a = treeOf(mesh_a, kind), b = treeOf(mesh_b, kind);

  SoakTally tally;
  std::vector<TrianglePair> found, difference;
  for (int k = 0; k < poses; ++k, ++tally.poses) {
    const Pose b_in_a = nearPose(*mesh_a, *mesh_b, size_of_b, random);
    const std::vector<TrianglePair> expected = exactPairs(*mesh_a, *mesh_b, b_in_a);
    tally.hits += !expected.empty();
    tally.pairs += expected.size();
    const auto count = [&](const auto& of, const auto& without) {
      difference.clear();
      std::ranges::set_difference(of, without, std::back_inserter(difference));
      return difference.size();
    };
    touchingPairs(a, b, b_in_a, found);
    std::uint64_t missed = count(expected, found), wrong = count(found, expected);
    const auto verdict = collide(a, b, b_in_a);
    missed += !verdict && !expected.empty();
    wrong += verdict && !std::ranges::binary_search(expected, *verdict);
    std::uint64_t wrong_distances = 0;
    if (expected.empty() && k % kPosesADistance == 0) {
      ++tally.distances;
      const double least = bruteForceDistance(*mesh_a, *mesh_b, b_in_a);
      // Relative to the distance of the triangles, plus the rounding of coordinates.
      const double rounding = 1e-12 * (least + scene.scale * (1.0 + scene.far));
      wrong_distances = !(std::abs(distance(a, b, b_in_a).distance - least) <= rounding);
    }
    if (missed + wrong + wrong_distances > 0 && tally.findings.size() < kMaxFindings) {
      tally.findings.push_back("scene " + std::to_string(scene_number) + ", pose " + std::to_string(k) +
                               ": " + std::to_string(missed) + " missed, " + std::to_string(wrong) +
                               " wrong, " + std::to_string(wrong_distances) + " wrong distances");
    }
    tally.missed += missed;
    tally.wrong += wrong;
    tally.wrong_distances += wrong_distances;
  }
  return tally;
}

}  // namespace octoblisk::testing
