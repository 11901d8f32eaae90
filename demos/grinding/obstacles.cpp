#include "grinding/obstacles.h"

#include <algorithm>
#include <utility>

#include "models/triangle_tree.h"

namespace octoblisk::demos {

Obstacle::Obstacle(const TriangleMesh& surroundings, std::vector<std::uint32_t> triangles)
    : triangle_of_all_(std::move(triangles)) {
  std::vector<TriangleMesh::Indices> kept;
  for (const std::uint32_t triangle : triangle_of_all_) kept.push_back(surroundings.triangles()[triangle]);
  tree_ = treeOfTriangles(surroundings, std::move(kept));
}

Obstacles::Obstacles(std::shared_ptr<const ClusteredOctree> blisk, std::span<const int> blade_of_triangle,
                     std::size_t parts, const VerdictRules& rules, std::span<const Fixture> fixtures) {
  const int blades = blade_of_triangle.empty() ? 0 : *std::ranges::max_element(blade_of_triangle);
  surroundings_ = surroundingsOf(blisk->sharedMesh(), blade_of_triangle, blades, fixtures);
  const auto bodies = static_cast<std::size_t>(blades) + 1 + fixtures.size();
  for (std::size_t part = 0; part < parts; ++part) {
    std::vector<bool> may_touch(bodies, false);  // fixtures stay false
    for (int blade = 0; blade <= blades; ++blade)
      may_touch[static_cast<std::size_t>(blade)] = rules.allows(part, blade);
    may_touch_any_.push_back(std::ranges::find(may_touch, true) != may_touch.end());
    auto [known, is_new] = by_blades_.try_emplace(may_touch);
    if (is_new && !may_touch_any_.back() && fixtures.empty()) {
      known->second = std::make_unique<const Obstacle>(blisk);
    } else if (is_new) {
      std::vector<std::uint32_t> forbidden;
      for (std::uint32_t triangle = 0; triangle < bodyOfTriangle().size(); ++triangle) {
        if (!may_touch[static_cast<std::size_t>(bodyOfTriangle()[triangle])]) forbidden.push_back(triangle);
      }
      if (!forbidden.empty()) {
        known->second = std::make_unique<const Obstacle>(*surroundings_.mesh, std::move(forbidden));
      }
    }
    of_part_.push_back(known->second.get());
    may_touch_.push_back(std::move(may_touch));
  }
}

}  // namespace octoblisk::demos
