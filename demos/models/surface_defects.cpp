#include "models/surface_defects.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <sstream>
#include <vector>

#include "models/welded_surface.h"

namespace octoblisk::demos {
namespace {

struct Edge {
  std::array<std::uint32_t, 2> ends;
  std::uint32_t triangle;
};

std::vector<Edge> sortedEdges(const WeldedSurface& surface) {
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < surface.corners.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(surface.corners[t][k], surface.corners[t][(k + 1) % 3]);
      if (a != b) edges.push_back({{a, b}, t});
    }
  }
  std::ranges::stable_sort(edges, {}, &Edge::ends);
  return edges;
}

void findDuplicates(const WeldedSurface& surface, SurfaceDefects& found) {
  std::vector<std::pair<TriangleMesh::Indices, std::uint32_t>> triangles;
  for (std::uint32_t t = 0; t < surface.corners.size(); ++t) {
    TriangleMesh::Indices corners = surface.corners[t];
    std::ranges::sort(corners);
    triangles.emplace_back(corners, t);
  }
  std::ranges::sort(triangles);
  for (std::size_t i = 1; i < triangles.size(); ++i) {
    if (triangles[i].first != triangles[i - 1].first) continue;
    const std::size_t triangle = triangles[i].second;
    found.first_duplicate = found.duplicates == 0 ? triangle : std::min(found.first_duplicate, triangle);
    ++found.duplicates;
  }
}

void describe(const FaultyEdges& edges, const char* fault, std::ostream& text) {
  text << edges.count << (edges.count == 1 ? " of its edges is " : " of its edges are ") << fault
       << (edges.count == 1 ? "," : ", the first");
  const char* before = " from (";
  for (const Vec3& end : edges.first) {
    text << before << end.x() << ' ' << end.y() << ' ' << end.z() << ')';
    before = " to (";
  }
}

}  // namespace

SurfaceDefects defectsOf(const TriangleMesh& mesh) {
  const WeldedSurface surface(mesh);
  const std::vector<Edge> edges = sortedEdges(surface);
  SurfaceDefects found;
  std::map<FaultyEdges*, std::uint32_t> lowest;
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::find_if(begin, edges.end(), [&](const Edge& e) { return e.ends != begin->ends; });
    const auto triangles = end - begin;
    if (triangles % 2 == 1) found.is_closed = false;
    if (triangles != 2) {
      FaultyEdges& faulty = triangles == 1 ? found.open : found.non_manifold;
      const auto [known, is_first] = lowest.try_emplace(&faulty, begin->triangle);
      if (is_first || begin->triangle < known->second) {
        known->second = begin->triangle;
        faulty.first = {mesh.vertices()[begin->ends[0]], mesh.vertices()[begin->ends[1]]};
      }
      ++faulty.count;
    }
    begin = end;
  }
  findDuplicates(surface, found);
  return found;
}

std::string describe(const SurfaceDefects& defects) {
  std::ostringstream text;
  const char* separator = "";
  const auto next = [&]() -> std::ostream& {
    text << separator;
    separator = "; ";
    return text;
  };
  if (defects.open.count > 0) describe(defects.open, "open", next());
  if (defects.non_manifold.count > 0) describe(defects.non_manifold, "non-manifold", next());
  if (defects.duplicates > 0) {
    next() << defects.duplicates << " of its triangles "
           << (defects.duplicates == 1 ? "is a duplicate, number " : "are duplicates, the first number ")
           << defects.first_duplicate;
  }
  return text.str();
}

}  // namespace octoblisk::demos
