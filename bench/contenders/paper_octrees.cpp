// The paper's detection: octrees over the centroids of the blisk's triangles, the traditional one and the
// improved one. Their cells are tested against one box around the belt (section 3.3).
#include <algorithm>
#include <numeric>

#include "build/paper/octree.h"
#include "build/paper/part_clusters.h"
#include "build/paper/principal_box.h"
#include "geometry/separating_axis.h"
#include "models/blade_finder.h"
#include "octoblisk_trees.h"
#include "tree/tree.h"

namespace octoblisk::bench {

using namespace detail;

namespace {

constexpr std::size_t kFnop = 2, kClusters = 2;  // the paper's optimum

std::vector<Vec3> centroidsOf(const TriangleMesh& mesh) {
  std::vector<Vec3> centroids;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle triangle = mesh.triangle(t);
    centroids.push_back(centroidOf(triangle));
  }
  return centroids;
}

/// One octree of a cube over all points.
std::vector<Octree> traditional(const TriangleMesh& blisk) {
  return {Octree::build(centroidsOf(blisk), {.leaf_capacity = kFnop, .cubic = true})};
}

/// An octree for each cluster of each blade and of the hub, over the cluster's own box.
std::vector<Octree> improved(const TriangleMesh& blisk) {
  const std::vector<Vec3> centroids = centroidsOf(blisk);
  const PartClusterOptions options = {.clusters = kClusters,
                                      .part_of_triangle = demos::findBlades(blisk).blade_of_triangle};
  std::vector<Octree> octrees;
  for (const std::vector<TriangleSet>& part : partClusters(centroids, options)) {
    for (const TriangleSet& cluster : part) {
      std::vector<Vec3> points;
      for (const std::uint32_t t : cluster) points.push_back(centroids[t]);
      octrees.push_back(Octree::build(points, {.leaf_capacity = kFnop}));
    }
  }
  return octrees;
}

class PaperBoxes final : public BoxQuery {
 public:
  PaperBoxes(const Scene& scene, std::vector<Octree> octrees, SeparatingAxes axes)
      : octrees_(std::move(octrees)), belt_(principalBox(scene.belt->vertices())), axes_(axes) {}

  Left left(const Pose& belt_in_blisk) override {
    Left found;
    forEachCell(belt_in_blisk, [&](const Obb& cell) {
      ++found.leaves;
      found.volume += cell.volume();
      return true;
    });
    return found;
  }
  bool mayTouch(const Pose& belt_in_blisk) override {
    return !forEachCell(belt_in_blisk, [](const Obb&) { return false; });
  }
  double range() const override {
    return std::accumulate(octrees_.begin(), octrees_.end(), 0.0,
                           [](double sum, const Octree& octree) { return sum + octree.stats().root_volume; });
  }

 private:
  /// Calls `visit` with each leaf cell that meets the belt's box until it returns false. Returns whether it
  /// never did.
  template <typename Visit>
  bool forEachCell(const Pose& belt_in_blisk, Visit&& visit) const {
    const Obb belt = belt_in_blisk * belt_;
    return std::ranges::all_of(
        octrees_, [&](const Octree& octree) { return descend(octree, octree.nodes().front(), belt, visit); });
  }

  template <typename Visit>
  bool descend(const Octree& octree, const Octree::Node& node, const Obb& belt, Visit& visit) const {
    if (node.count() == 0) return true;
    const Obb cell = octree.cell(node);
    if (!overlaps(belt, cell, axes_)) return true;
    if (node.isLeaf()) return visit(cell);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if (!descend(octree, octree.nodes()[node.first_child + octant], belt, visit)) return false;
    }
    return true;
  }

  std::vector<Octree> octrees_;
  Obb belt_;
  SeparatingAxes axes_;
};

/// OctoBlisk's boxes of whole triangles against the same box around the belt.
class OurBoxes final : public BoxQuery {
 public:
  explicit OurBoxes(const Scene& scene)
      : blisk_(ClusteredOctree::build(scene.blisk)), belt_(principalBox(scene.belt->vertices())) {}

  Left left(const Pose& belt_in_blisk) override {
    Left found;
    descend(Tree::kRoot, belt_in_blisk * belt_, [&](const Obb& box) {
      ++found.leaves;
      found.volume += box.volume();
      return true;
    });
    return found;
  }
  bool mayTouch(const Pose& belt_in_blisk) override {
    return !descend(Tree::kRoot, belt_in_blisk * belt_, [](const Obb&) { return false; });
  }
  double range() const override { return blisk_.stats().root_volume; }

 private:
  /// Like PaperBoxes::descend.
  template <typename Visit>
  bool descend(Slot slot, const Obb& belt, const Visit& visit) const {
    const Tree& tree = treeOf(blisk_);
    const Obb box = tree.box(slot);
    if (!overlaps(belt, box)) return true;
    const Child child = tree.child(slot);
    if (child.isLeaf()) return visit(box);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!tree.child({child.node(), lane}).isEmpty() && !descend({child.node(), lane}, belt, visit))
        return false;
    }
    return true;
  }

  ClusteredOctree blisk_;
  Obb belt_;
};

/// OctoBlisk's own method: exact triangle tests on both sides. No boxes are left.
class OurTriangles final : public BoxQuery {
 public:
  explicit OurTriangles(const Scene& scene) : trees_(scene, built()) {}

  Left left(const Pose& belt_in_blisk) override {
    return {mayTouch(belt_in_blisk) ? std::size_t{1} : 0, 0.0};  // a triangle pair
  }
  bool mayTouch(const Pose& belt_in_blisk) override {
    return collide(trees_.blisk, trees_.belt, belt_in_blisk).has_value();
  }
  double range() const override { return trees_.blisk.stats().root_volume; }

 private:
  Trees trees_;
};

bool registerBoxes(const std::string& name, const Maker<BoxQuery>& make) {
  return registerContender({.name = name, .group = "paper", .boxes = make});
}

template <typename Answers>
Maker<BoxQuery> made() {
  return [](const Scene& scene) { return std::make_unique<Answers>(scene); };
}

Maker<BoxQuery> ofPaper(std::vector<Octree> (*octrees)(const TriangleMesh&), SeparatingAxes axes) {
  return [octrees, axes](const Scene& scene) {
    return std::make_unique<PaperBoxes>(scene, octrees(*scene.blisk), axes);
  };
}

const bool kRegistered = registerBoxes(kOurs, made<OurTriangles>()) &&
                         registerBoxes("octoblisk-boxes", made<OurBoxes>()) &&
                         registerBoxes("octree", ofPaper(traditional, SeparatingAxes::exact15)) &&
                         registerBoxes("octree-one-axis", ofPaper(traditional, SeparatingAxes::first_x)) &&
                         registerBoxes("octree-k2", ofPaper(improved, SeparatingAxes::exact15)) &&
                         registerBoxes("octree-k2-one-axis", ofPaper(improved, SeparatingAxes::first_x));

}  // namespace
}  // namespace octoblisk::bench
