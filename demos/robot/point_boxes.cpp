#include "robot/point_boxes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "octoblisk/k_means.h"
#include "octoblisk/separating_axis.h"

namespace octoblisk::demos {
namespace {

Octree octreeOf(std::span<const Vec3> points, std::size_t leaf_capacity, const Mat3& axes) {
  OctreeOptions options;
  options.leaf_capacity = leaf_capacity;
  options.axes = axes;
  return Octree::build(points, options);
}

/// The points of the hub (and shroud), then of each blade; a vertex of a blade's triangle is the blade's.
std::vector<std::vector<Vec3>> partsOf(const TriangleMesh& blisk, const BladesFound& blades) {
  std::vector<int> blade_of_vertex(blisk.vertices().size(), -1);
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    for (const std::uint32_t vertex : blisk.triangles()[t]) {
      blade_of_vertex[vertex] = std::max(blade_of_vertex[vertex], blades.blade_of_triangle[t]);
    }
  }
  std::vector<std::vector<Vec3>> parts(static_cast<std::size_t>(blades.count) + 1);
  for (std::size_t vertex = 0; vertex < blade_of_vertex.size(); ++vertex) {
    if (blade_of_vertex[vertex] < 0) continue;
    parts[static_cast<std::size_t>(blade_of_vertex[vertex])].push_back(blisk.vertices()[vertex]);
  }
  return parts;
}

/// x from the z axis to the middle of the points.
Mat3 radialAxes(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points) sum += point;
  return Eigen::AngleAxisd(std::atan2(sum.y(), sum.x()), Vec3::UnitZ()).toRotationMatrix();
}

std::vector<std::vector<Vec3>> clustersOf(std::span<const Vec3> points, std::size_t clusters) {
  KMeansOptions options;
  options.k = points.size() < clusters ? 1 : clusters;
  const Clustering clustering = kMeans(points, options);
  std::vector<std::vector<Vec3>> found(options.k);
  for (std::size_t i = 0; i < points.size(); ++i) {
    found[clustering.cluster_of_point[i]].push_back(points[i]);
  }
  return found;
}

}  // namespace

PointBoxes PointBoxes::traditional(const TriangleMesh& blisk, std::size_t leaf_capacity) {
  PointBoxes boxes;
  boxes.trees_.push_back(octreeOf(blisk.vertices(), leaf_capacity, Mat3::Identity()));
  return boxes;
}

PointBoxes PointBoxes::improved(const TriangleMesh& blisk, const BladesFound& blades, std::size_t clusters,
                                std::size_t leaf_capacity) {
  if (blades.blade_of_triangle.size() != blisk.triangleCount()) {
    throw std::invalid_argument("the blades are not those of this mesh");
  }
  PointBoxes boxes;
  const std::vector<std::vector<Vec3>> parts = partsOf(blisk, blades);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (parts[part].empty()) continue;
    const Mat3 axes = part == 0 ? Mat3(Mat3::Identity()) : radialAxes(parts[part]);
    for (const std::vector<Vec3>& cluster : clustersOf(parts[part], clusters)) {
      if (!cluster.empty()) boxes.trees_.push_back(octreeOf(cluster, leaf_capacity, axes));
    }
  }
  return boxes;
}

double PointBoxes::range() const {
  double volume = 0.0;
  for (const Octree& tree : trees_) volume += tree.stats().root_volume;
  return volume;
}

std::size_t PointBoxes::nodes() const {
  std::size_t count = 0;
  for (const Octree& tree : trees_) count += tree.stats().total_nodes;
  return count;
}

std::size_t PointBoxes::leavesMet(const Obb& box_in_blisk) const {
  std::size_t met = 0;
  std::vector<std::uint32_t> open;
  for (const Octree& tree : trees_) {
    open.assign(1, 0);
    while (!open.empty()) {
      const Octree::Node& node = tree.nodes()[open.back()];
      open.pop_back();
      if (node.count() == 0 || !overlaps(box_in_blisk, tree.cell(node))) continue;
      if (node.isLeaf()) {
        ++met;
        continue;
      }
      for (std::uint32_t child = 0; child < 8; ++child) open.push_back(node.first_child + child);
    }
  }
  return met;
}

}  // namespace octoblisk::demos
