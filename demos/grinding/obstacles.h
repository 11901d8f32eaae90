// The obstacles of each part of the tool: the fixtures, and the blisk without the blades that the part may
// touch.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "grinding/fixture.h"
#include "grinding/verdict.h"
#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// Some of the surroundings' triangles (fixture.h), with a tree of their own.
class Obstacle {
 public:
  /// All of the blisk's triangles, in its own tree.
  explicit Obstacle(std::shared_ptr<const ClusteredOctree> blisk) : tree_(std::move(blisk)) {}
  /// Only `triangles` of the surroundings, ascending; at least one.
  Obstacle(const TriangleMesh& surroundings, std::vector<std::uint32_t> triangles);

  const ClusteredOctree& tree() const { return *tree_; }
  std::shared_ptr<const ClusteredOctree> sharedTree() const { return tree_; }
  /// The number of a tree's triangle in the surroundings; for the blisk this is its number in the blisk's
  /// mesh.
  std::uint32_t triangleOfAll(std::uint32_t triangle) const {
    return triangle_of_all_.empty() ? triangle : triangle_of_all_[triangle];
  }

 private:
  std::shared_ptr<const ClusteredOctree> tree_;
  std::vector<std::uint32_t> triangle_of_all_;
};

class Obstacles {
 public:
  Obstacles(std::shared_ptr<const ClusteredOctree> blisk, std::span<const int> blade_of_triangle,
            std::size_t parts, const VerdictRules& rules, std::span<const Fixture> fixtures = {});

  /// Null if the part may touch everything.
  const Obstacle* of(std::size_t part) const { return of_part_[part]; }
  bool mayTouchAny(std::size_t part) const { return may_touch_any_[part]; }
  /// For each triangle of the surroundings, its body (BodyNames).
  std::span<const int> bodyOfTriangle() const { return surroundings_.body_of_triangle; }
  /// For a triangle of the blisk.
  bool mayTouch(std::size_t part, std::uint32_t triangle) const {
    return may_touch_[part][static_cast<std::size_t>(bodyOfTriangle()[triangle])];
  }

 private:
  Surroundings surroundings_;
  std::map<std::vector<bool>, std::unique_ptr<const Obstacle>> by_blades_;  // keyed by the touchable bodies
  std::vector<const Obstacle*> of_part_;
  std::vector<bool> may_touch_any_;
  std::vector<std::vector<bool>> may_touch_;  // per part and body
};

}  // namespace octoblisk::demos
