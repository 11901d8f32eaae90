// An external program that uses only the core: two tetrahedra, with answers known in closed form.
#include <octoblisk/clustered_octree.h>
#include <octoblisk/collide.h>
#include <octoblisk/distance.h>

#include <cmath>
#include <cstdio>

int main() {
  using namespace octoblisk;
  const auto mesh = std::make_shared<const TriangleMesh>(
      std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      std::vector<TriangleMesh::Indices>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  const Pose apart = {.translation = {3, 0, 0}}, within = {.translation = {0.5, 0, 0}};
  const double gap = distance(tree, tree, apart).distance;
  std::printf("gap %.17g\n", gap);
  return std::abs(gap - 2.0) < 1e-12 && !collide(tree, tree, apart) && collide(tree, tree, within) ? 0 : 1;
}
