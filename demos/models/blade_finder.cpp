#include "models/blade_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace octoblisk::demos {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLowCuts = 100;
constexpr int kHighCuts = 32;
constexpr int kLeastRun = 5;  ///< cuts in a row that must show the same blades
constexpr int kRefinements = 16;

double radiusOf(const Vec3& point) { return std::hypot(point.x(), point.y()); }

/// A mesh whose vertices at equal coordinates are one, with the radii its triangles reach from and to.
struct Surface {
  const TriangleMesh& mesh;
  std::vector<TriangleMesh::Indices> corners;
  std::vector<double> low, high;         ///< least and greatest radius, one a triangle
  std::vector<std::uint32_t> outermost;  ///< triangles by `low`, greatest first

  explicit Surface(const TriangleMesh& source) : mesh(source), corners(source.triangles()) {
    const std::vector<Vec3>& vertices = mesh.vertices();
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t v) {
      return std::array{vertices[v].x(), vertices[v].y(), vertices[v].z()};
    };
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    std::vector<std::uint32_t> first(vertices.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const bool repeats = k > 0 && key(order[k]) == key(order[k - 1]);
      first[order[k]] = repeats ? first[order[k - 1]] : order[k];
    }
    for (TriangleMesh::Indices& triangle : corners) {
      const auto [a, b, c] = triangle;
      const auto [least, greatest] =
          std::minmax({radiusOf(vertices[a]), radiusOf(vertices[b]), radiusOf(vertices[c])});
      low.push_back(least);
      high.push_back(greatest);
      for (std::uint32_t& corner : triangle) corner = first[corner];
    }
    outermost.resize(corners.size());
    std::iota(outermost.begin(), outermost.end(), 0u);
    std::stable_sort(outermost.begin(), outermost.end(), [&](auto a, auto b) { return low[a] > low[b]; });
  }
};

/// Triangles that hang together by shared vertices.
struct Part {
  std::uint32_t root = 0;  ///< one of its vertices
  double area = 0.0;
  Vec3 centroid = Vec3::Zero();
};

/// The parts of the triangles added so far.
class GrowingParts {
 public:
  explicit GrowingParts(const Surface& surface)
      : surface_(surface),
        parent_(surface.mesh.vertices().size()),
        sums_(parent_.size()),
        seen_(parent_.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// Adds all triangles beyond a radius and below another; the first must not grow from call to call.
  void addBetween(double low, double high) {
    for (; next_ < surface_.outermost.size() && surface_.low[surface_.outermost[next_]] > low; ++next_) {
      const std::uint32_t triangle = surface_.outermost[next_];
      if (surface_.high[triangle] < high) add(triangle);
    }
  }

  std::uint32_t rootOf(std::uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }

  std::vector<Part> parts() {
    std::erase_if(roots_, [&](std::uint32_t vertex) { return parent_[vertex] != vertex; });
    std::vector<Part> result;
    for (const std::uint32_t root : roots_) {
      const Sums& sums = sums_[root];
      if (sums.area > 0.0) result.push_back({root, sums.area, sums.moment / sums.area});
    }
    return result;
  }

 private:
  struct Sums {
    double area = 0.0;
    Vec3 moment = Vec3::Zero();
  };

  void add(std::uint32_t triangle) {
    const TriangleMesh::Indices& corners = surface_.corners[triangle];
    for (const std::uint32_t corner : corners) {
      if (!seen_[corner]) roots_.push_back(corner);
      seen_[corner] = true;
      const std::uint32_t from = rootOf(corner);
      const std::uint32_t into = rootOf(corners[0]);
      if (from == into) continue;
      parent_[from] = into;
      sums_[into].area += sums_[from].area;
      sums_[into].moment += sums_[from].moment;
    }
    const Triangle t = surface_.mesh.triangle(triangle);
    const double area = 0.5 * scaledNormal(t).norm();
    Sums& sums = sums_[rootOf(corners[0])];
    sums.area += area;
    sums.moment += area * (t[0] + t[1] + t[2]) / 3.0;
  }

  const Surface& surface_;
  std::vector<std::uint32_t> parent_;
  std::vector<Sums> sums_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> roots_;  ///< and vertices that were roots
  std::size_t next_ = 0;
};

/// The parts of more than a crumb's size, if they are alike and equally spaced round the axis; else none.
std::vector<Part> bladesAmong(std::vector<Part> parts) {
  constexpr double kCrumb = 0.02;
  constexpr double kAlike = 1.5;      // greatest area over least
  constexpr double kOffPlace = 0.05;  // of the radius
  constexpr double kOffPitch = 0.25;  // of the pitch
  constexpr double kRound = 1e-6;
  double greatest = 0.0;
  for (const Part& part : parts) greatest = std::max(greatest, part.area);
  std::erase_if(parts, [&](const Part& part) { return part.area < kCrumb * greatest; });
  if (parts.size() < 2) return {};

  const double radius = radiusOf(parts[0].centroid);
  const bool goes_all_round = radius * radius < kRound * parts[0].area;
  if (goes_all_round) return {};
  std::vector<double> angles;
  for (const Part& part : parts) {
    const bool off_height = std::abs(part.centroid.z() - parts[0].centroid.z()) > kOffPlace * radius;
    const bool off_radius = std::abs(radiusOf(part.centroid) - radius) > kOffPlace * radius;
    if (kAlike * part.area < greatest || off_height || off_radius) return {};
    angles.push_back(std::atan2(part.centroid.y(), part.centroid.x()));
  }
  std::sort(angles.begin(), angles.end());
  angles.push_back(angles[0] + kTurn);
  const double pitch = kTurn / static_cast<double>(parts.size());
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
    if (std::abs(angles[k + 1] - angles[k] - pitch) > kOffPitch * pitch) return {};
  }
  return parts;
}

/// Between these radii the mesh falls into `count` blades.
struct Cut {
  double low = 0.0, high = kInfinity;
  std::size_t count = 0;
  int run = 0;  ///< of how many cuts in a row it is the lowest
};

/// The count that holds over most low cuts, at its lowest one.
Cut widestCut(const Surface& surface, const std::vector<double>& falling_cuts, double high) {
  GrowingParts growing(surface);
  Cut best, current;
  for (const double low : falling_cuts) {
    growing.addBetween(low, high);
    const std::size_t count = bladesAmong(growing.parts()).size();
    current = {low, high, count, count == current.count ? current.run + 1 : 1};
    if (count > 0 && current.run > best.run) best = current;
  }
  return best;
}

std::size_t countBetween(const Surface& surface, double low, double high) {
  GrowingParts growing(surface);
  growing.addBetween(low, high);
  return bladesAmong(growing.parts()).size();
}

/// Moves the cuts closer to hub and shroud, by up to a step between cuts.
Cut refine(const Surface& surface, Cut cut, double low_step, double high_step) {
  for (int k = 0; k < kRefinements; ++k) {
    low_step *= 0.5;
    if (countBetween(surface, cut.low - low_step, cut.high) == cut.count) cut.low -= low_step;
    if (std::isinf(cut.high)) continue;
    high_step *= 0.5;
    if (countBetween(surface, cut.low, cut.high + high_step) == cut.count) cut.high += high_step;
  }
  return cut;
}

Cut findCut(const Surface& surface) {
  const double least = *std::min_element(surface.low.begin(), surface.low.end());
  const double greatest = *std::max_element(surface.high.begin(), surface.high.end());
  const double low_step = (greatest - least) / kLowCuts;
  const double high_step = (greatest - least) / kHighCuts;
  std::vector<double> falling_cuts;
  for (int k = kLowCuts - 1; k >= 0; --k) falling_cuts.push_back(least + k * low_step);

  Cut best = widestCut(surface, falling_cuts, kInfinity);
  for (int k = kHighCuts - 1; k > 0 && best.run < kLeastRun; --k) {
    const Cut below_shroud = widestCut(surface, falling_cuts, least + k * high_step);
    if (below_shroud.run > best.run) best = below_shroud;
  }
  if (best.run < kLeastRun) return {};
  return refine(surface, best, low_step, high_step);
}

/// The triangles beside each triangle, over its three edges. Where more than two share an edge, they are all
/// beside each other in a row.
std::vector<std::vector<std::uint32_t>> neighbours(const Surface& surface) {
  struct Edge {
    std::array<std::uint32_t, 2> ends;
    std::uint32_t triangle;
  };
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < surface.corners.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(surface.corners[t][k], surface.corners[t][(k + 1) % 3]);
      edges.push_back({{a, b}, t});
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  std::vector<std::vector<std::uint32_t>> result(surface.corners.size());
  for (std::size_t k = 1; k < edges.size(); ++k) {
    if (edges[k].ends != edges[k - 1].ends) continue;
    result[edges[k].triangle].push_back(edges[k - 1].triangle);
    result[edges[k - 1].triangle].push_back(edges[k].triangle);
  }
  return result;
}

/// Whether a triangle may be a facet of a surface of revolution about Z. A large facet's normal is off by up
/// to the angle the facet takes.
bool isOfRevolution(const Triangle& t) {
  constexpr double kTolerance = 0.05;
  const Vec3 centroid = (t[0] + t[1] + t[2]) / 3.0;
  const Vec3 e_theta = Vec3(-centroid.y(), centroid.x(), 0.0).normalized();
  double half_width = 0.0;
  for (const Vec3& corner : t) half_width = std::max(half_width, std::abs(corner.dot(e_theta)));
  const double tolerance = std::max(kTolerance, half_width / radiusOf(centroid));
  return std::abs(scaledNormal(t).normalized().dot(e_theta)) <= tolerance;
}

/// Lets the blades grow down to the hub and up to the shroud.
void flood(const Surface& surface, std::vector<int>& blade_of_triangle) {
  const auto beside = neighbours(surface);
  std::vector<std::uint32_t> front;
  for (std::uint32_t t = 0; t < blade_of_triangle.size(); ++t) {
    if (blade_of_triangle[t] != 0) front.push_back(t);
  }
  for (std::size_t k = 0; k < front.size(); ++k) {
    const int blade = blade_of_triangle[front[k]];
    for (const std::uint32_t t : beside[front[k]]) {
      if (blade_of_triangle[t] != 0 || isOfRevolution(surface.mesh.triangle(t))) continue;
      blade_of_triangle[t] = blade;
      front.push_back(t);
    }
  }
}

/// The angle of each blade's leading edge at the tip, in [0, 2π).
std::vector<double> tipAngles(const Surface& surface, const BladesFound& found) {
  constexpr double kTipPart = 0.02;  // of the blade's height
  const double tip_from = found.tip_radius - kTipPart * (found.tip_radius - found.root_radius);
  std::vector<Vec3> foremost(found.count, Vec3(0.0, 0.0, kInfinity));
  for (std::size_t t = 0; t < surface.corners.size(); ++t) {
    const int blade = found.blade_of_triangle[t];
    if (blade == 0) continue;
    for (const Vec3& corner : surface.mesh.triangle(t)) {
      if (radiusOf(corner) >= tip_from && corner.z() < foremost[blade - 1].z()) foremost[blade - 1] = corner;
    }
  }
  std::vector<double> angles;
  for (const Vec3& point : foremost) {
    const double angle = std::atan2(point.y(), point.x());
    angles.push_back(angle < 0.0 ? angle + kTurn : angle);
  }
  return angles;
}

/// Numbers the blades in the order of their tips, from the one nearest to angle 0.
void renumber(const Surface& surface, BladesFound& found) {
  const std::vector<double> angles = tipAngles(surface, found);
  const auto from_zero = [&](int k) { return std::min(angles[k], kTurn - angles[k]); };
  std::vector<int> order(found.count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return angles[a] < angles[b]; });
  const auto nearest =
      std::min_element(order.begin(), order.end(), [&](int a, int b) { return from_zero(a) < from_zero(b); });
  std::rotate(order.begin(), nearest, order.end());
  std::vector<int> number(found.count + 1, 0);
  for (int k = 0; k < found.count; ++k) number[order[k] + 1] = k + 1;
  for (int& blade : found.blade_of_triangle) blade = number[blade];
}

}  // namespace

BladesFound findBlades(const TriangleMesh& mesh) {
  BladesFound found;
  found.blade_of_triangle.assign(mesh.triangleCount(), 0);
  const Surface surface(mesh);
  const Cut cut = findCut(surface);
  if (cut.count == 0) return found;

  GrowingParts growing(surface);
  growing.addBetween(cut.low, cut.high);
  std::map<std::uint32_t, int> blade_of_root;
  for (const Part& part : bladesAmong(growing.parts())) blade_of_root[part.root] = ++found.count;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!(surface.low[t] > cut.low && surface.high[t] < cut.high)) continue;
    const auto blade = blade_of_root.find(growing.rootOf(surface.corners[t][0]));
    if (blade != blade_of_root.end()) found.blade_of_triangle[t] = blade->second;
  }
  flood(surface, found.blade_of_triangle);

  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const bool of_blade = found.blade_of_triangle[t] != 0;
    const bool of_hub = !of_blade && surface.low[t] <= cut.low;
    if (of_blade) found.tip_radius = std::max(found.tip_radius, surface.high[t]);
    if (of_hub) found.root_radius = std::max(found.root_radius, surface.high[t]);
  }
  const bool has_hub = found.root_radius > 0.0;
  if (!has_hub) found.root_radius = cut.low;
  renumber(surface, found);
  return found;
}

}  // namespace octoblisk::demos
