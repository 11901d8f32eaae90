#include "models/blade_finder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "models/welded_surface.h"

namespace octoblisk::demos {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Triangles connected by shared vertices.
struct Part {
  std::uint32_t root = 0;  ///< one of its vertices
  double area = 0.0;
  Vec3 centroid = Vec3::Zero();
};

/// The parts of the triangles added so far. A copy grows on by itself.
class GrowingParts {
 public:
  /// The surface must outlive the parts.
  explicit GrowingParts(const WeldedSurface& surface);

  /// Adds all triangles beyond `low` and below `high`; `low` must not grow from call to call.
  void addBetween(double low, double high);

  /// The vertex that stands for all of its part.
  std::uint32_t rootOf(std::uint32_t vertex) { return connected_.rootOf(vertex); }

  /// The parts that have an area.
  std::vector<Part> parts();

 private:
  struct Sums {
    double area = 0.0;
    Vec3 moment = Vec3::Zero();
  };

  void add(std::uint32_t triangle);

  const WeldedSurface* surface_;
  detail::DisjointSets connected_;
  std::vector<Sums> sums_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> roots_;  ///< includes vertices that used to be roots
  std::size_t next_ = 0;
};

GrowingParts::GrowingParts(const WeldedSurface& surface)
    : surface_(&surface),
      connected_(surface.mesh.vertices().size()),
      sums_(connected_.size()),
      seen_(connected_.size()) {}

void GrowingParts::addBetween(double low, double high) {
  for (; next_ < surface_->outermost.size() && surface_->low[surface_->outermost[next_]] > low; ++next_) {
    const std::uint32_t triangle = surface_->outermost[next_];
    if (surface_->high[triangle] < high) add(triangle);
  }
}

std::vector<Part> GrowingParts::parts() {
  std::erase_if(roots_, [&](std::uint32_t vertex) { return !connected_.isRoot(vertex); });
  std::vector<Part> result;
  for (const std::uint32_t root : roots_) {
    const Sums& sums = sums_[root];
    if (sums.area > 0.0) result.push_back({root, sums.area, sums.moment / sums.area});
  }
  return result;
}

void GrowingParts::add(std::uint32_t triangle) {
  const TriangleMesh::Indices& corners = surface_->corners[triangle];
  for (const std::uint32_t corner : corners) {
    if (!seen_[corner]) roots_.push_back(corner);
    seen_[corner] = true;
    const std::uint32_t from = rootOf(corner);
    const std::uint32_t into = rootOf(corners[0]);
    if (from == into) continue;
    connected_.join(from, into);
    sums_[into].area += sums_[from].area;
    sums_[into].moment += sums_[from].moment;
  }
  const Triangle t = surface_->mesh.triangle(triangle);
  const double area = 0.5 * scaledNormal(t).norm();
  Sums& sums = sums_[rootOf(corners[0])];
  sums.area += area;
  sums.moment += area * (t[0] + t[1] + t[2]) / 3.0;
}

/// The parts larger than a crumb, if they are alike and equally spaced around the axis; otherwise none.
std::vector<Part> bladesAmong(std::vector<Part> parts) {
  constexpr double kCrumb = 0.02;
  constexpr double kAlike = 1.5;      // greatest area divided by least
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

/// The mesh falls into `count` blades between these radii.
struct BladeCut {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  int run = 0;  ///< number of successive cuts; this cut is the lowest
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLowCuts = 100;
constexpr int kHighCuts = 32;
constexpr int kMinRun = 5;  ///< successive cuts that must show the same blades
constexpr int kRefinements = 16;

/// The count that most low cuts agree on, at the lowest of them.
BladeCut widestCut(const WeldedSurface& surface, const std::vector<double>& falling_cuts, double high) {
  GrowingParts growing(surface);
  BladeCut best, current;
  for (const double low : falling_cuts) {
    growing.addBetween(low, high);
    const std::size_t count = bladesAmong(growing.parts()).size();
    current = {low, high, count, count == current.count ? current.run + 1 : 1};
    if (count > 0 && current.run > best.run) best = current;
  }
  return best;
}

GrowingParts grownBetween(const WeldedSurface& surface, double low, double high) {
  GrowingParts growing(surface);
  growing.addBetween(low, high);
  return growing;
}

/// Moves the cuts closer to hub and shroud, by at most one step between cuts.
BladeCut refine(const WeldedSurface& surface, BladeCut cut, double low_step, double high_step) {
  GrowingParts at_cut = grownBetween(surface, cut.low, cut.high);
  const auto keepIfSame = [&](GrowingParts&& moved) {
    if (bladesAmong(moved.parts()).size() != cut.count) return false;
    at_cut = std::move(moved);
    return true;
  };
  for (int k = 0; k < kRefinements; ++k) {
    low_step *= 0.5;
    GrowingParts lower = at_cut;  // has all triangles but those between the two cuts
    lower.addBetween(cut.low - low_step, cut.high);
    if (keepIfSame(std::move(lower))) cut.low -= low_step;
    if (std::isinf(cut.high)) continue;
    high_step *= 0.5;
    if (keepIfSame(grownBetween(surface, cut.low, cut.high + high_step))) cut.high += high_step;
  }
  return cut;
}

/// The cut whose count of blades holds over the widest range of radii; count 0 if none holds over 5 % of
/// them.
BladeCut findBladeCut(const WeldedSurface& surface) {
  const double least = *std::min_element(surface.low.begin(), surface.low.end());
  const double greatest = *std::max_element(surface.high.begin(), surface.high.end());
  const double low_step = (greatest - least) / kLowCuts;
  const double high_step = (greatest - least) / kHighCuts;
  std::vector<double> falling_cuts;
  for (int k = kLowCuts - 1; k >= 0; --k) falling_cuts.push_back(least + k * low_step);

  BladeCut best = widestCut(surface, falling_cuts, kInfinity);
  for (int k = kHighCuts - 1; k > 0 && best.run < kMinRun; --k) {
    const BladeCut below_shroud = widestCut(surface, falling_cuts, least + k * high_step);
    if (below_shroud.run > best.run) best = below_shroud;
  }
  if (best.run < kMinRun) return {};
  return refine(surface, best, low_step, high_step);
}

/// Whether a triangle may be a facet of a surface of revolution about Z. A large facet's normal may be off by
/// the angle that the facet spans.
bool isOfRevolution(const Triangle& t) {
  constexpr double kTolerance = 0.05;
  const Vec3 centroid = centroidOf(t);
  const Vec3 e_theta = Vec3(-centroid.y(), centroid.x(), 0.0).normalized();
  double half_width = 0.0;
  for (const Vec3& corner : t) half_width = std::max(half_width, std::abs(corner.dot(e_theta)));
  const double tolerance = std::max(kTolerance, half_width / radiusOf(centroid));
  return std::abs(unitNormal(t).dot(e_theta)) <= tolerance;
}

/// Grows the blades down to the hub and up to the shroud.
void flood(const WeldedSurface& surface, std::vector<int>& blade_of_triangle) {
  const auto beside = surface.neighbours();
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
std::vector<double> tipAngles(const WeldedSurface& surface, const BladesFound& found) {
  constexpr double kTipPart = 0.02;  // of the blade's height
  const double tip_from = found.tip_radius - kTipPart * (found.tip_radius - found.root_radius);
  std::vector<Vec3> foremost(found.count, Vec3(0.0, 0.0, std::numeric_limits<double>::infinity()));
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
void renumber(const WeldedSurface& surface, BladesFound& found) {
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

/// Height divided by mean thickness, over all blades together. The field radius · angle · e_theta has the
/// divergence 1 and does not flow through a surface of revolution; a blade's open root counts as one. So its
/// outflow is the volume.
double slenderness(const TriangleMesh& mesh, const BladesFound& found) {
  std::vector<double> volume(found.count, 0.0), first_angle(found.count, kTurn);
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const int blade = found.blade_of_triangle[t];
    if (blade == 0) continue;
    const Triangle corners = mesh.triangle(t);
    const Vec3 centroid = centroidOf(corners);
    const double angle = std::atan2(centroid.y(), centroid.x());
    if (first_angle[blade - 1] == kTurn) first_angle[blade - 1] = angle;
    const double turn = std::remainder(angle - first_angle[blade - 1], kTurn);
    const Vec3 normal = 0.5 * scaledNormal(corners);  // its length is the triangle's area
    volume[blade - 1] += turn * (centroid.x() * normal.y() - centroid.y() * normal.x());
    area += normal.norm();
  }
  double whole = 0.0;
  for (const double each : volume) whole += std::abs(each);  // the mesh may face inward
  return (found.tip_radius - found.root_radius) * 0.5 * area / whole;
}

}  // namespace

BladesFound findBlades(const TriangleMesh& mesh) {
  BladesFound found;
  found.blade_of_triangle.assign(mesh.triangleCount(), 0);
  const WeldedSurface surface(mesh);
  const BladeCut cut = findBladeCut(surface);
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
  constexpr double kMinSlenderness = 3.0;
  if (!(slenderness(mesh, found) >= kMinSlenderness)) {
    BladesFound none;
    none.blade_of_triangle.assign(mesh.triangleCount(), 0);
    return none;
  }
  found.shrouded = std::isfinite(cut.high);
  renumber(surface, found);
  return found;
}

}  // namespace octoblisk::demos
