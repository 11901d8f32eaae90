#include "models/open_edges.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <vector>

#include "models/welded_surface.h"

namespace octoblisk::demos {

OpenEdges openEdges(const TriangleMesh& mesh) {
  struct Edge {
    std::array<std::uint32_t, 2> ends;
    std::uint32_t triangle;
  };
  const WeldedSurface surface(mesh);
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < surface.corners.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(surface.corners[t][k], surface.corners[t][(k + 1) % 3]);
      if (a != b) edges.push_back({{a, b}, t});
    }
  }
  std::ranges::stable_sort(edges, {}, &Edge::ends);
  OpenEdges open;
  std::uint32_t lowest = 0;
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::find_if(begin, edges.end(), [&](const Edge& e) { return e.ends != begin->ends; });
    if ((end - begin) % 2 == 1) {
      if (open.count++ == 0 || begin->triangle < lowest) {
        lowest = begin->triangle;
        open.first = {mesh.vertices()[begin->ends[0]], mesh.vertices()[begin->ends[1]]};
      }
    }
    begin = end;
  }
  return open;
}

std::string describe(const OpenEdges& edges) {
  std::ostringstream text;
  text << edges.count << (edges.count == 1 ? " of its edges is open," : " of its edges are open, the first");
  const char* before = " from (";
  for (const Vec3& end : edges.first) {
    text << before << end.x() << ' ' << end.y() << ' ' << end.z() << ')';
    before = " to (";
  }
  return text.str();
}

}  // namespace octoblisk::demos
