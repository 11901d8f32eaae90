#include "models/blade_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "models/welded_surface.h"

namespace octoblisk::demos {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Points joined by segments; each point of a closed curve has two neighbours.
struct Crossings {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> neighbours;
};

double lengthOf(const std::vector<Vec3>& loop) {
  double length = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k) length += (loop[(k + 1) % loop.size()] - loop[k]).norm();
  return length;
}

/// The longest chain that returns to its start; none: no points.
std::vector<Vec3> longestLoop(const Crossings& crossings) {
  std::vector<bool> seen(crossings.points.size(), false);
  std::vector<Vec3> longest;
  for (std::uint32_t start = 0; start < crossings.points.size(); ++start) {
    if (seen[start]) continue;
    std::vector<Vec3> loop;
    bool closed = true;
    std::uint32_t at = start;
    for (bool goes_on = true; goes_on;) {
      seen[at] = true;
      loop.push_back(crossings.points[at]);
      if (crossings.neighbours[at].size() != 2) closed = false;
      goes_on = false;
      for (const std::uint32_t next : crossings.neighbours[at]) {
        if (seen[next]) continue;
        at = next;
        goes_on = true;
        break;
      }
    }
    if (closed && loop.size() > 2 && lengthOf(loop) > lengthOf(longest)) longest = std::move(loop);
  }
  return longest;
}

/// The mean over a side's length of its offset to the left of its chord.
double meanOffset(const std::vector<SectionPoint>& side) {
  const Vec2 from = side.front().flat;
  const Vec2 along = (side.back().flat - from).normalized();
  double sum = 0.0;
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < side.size(); ++k) {
    const Vec2 middle = 0.5 * (side[k].flat + side[k + 1].flat) - from;
    const double step = (side[k + 1].flat - side[k].flat).norm();
    sum += step * (along.x() * middle.y() - along.y() * middle.x());
    length += step;
  }
  return sum / length;
}

}  // namespace

BladeCutter::BladeCutter(const TriangleMesh& blisk, const BladesFound& blades, int blade) : blade_(blade) {
  if (blade < 1 || blade > blades.count) {
    throw std::invalid_argument("there is no blade " + std::to_string(blade));
  }
  if (blades.blade_of_triangle.size() != blisk.triangleCount()) {
    throw std::invalid_argument("the blade numbers are not for this mesh");
  }
  const WeldedSurface surface(blisk);
  Vec3 middle = Vec3::Zero();
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    if (blades.blade_of_triangle[t] != blade) continue;
    facets_.push_back({surface.corners[t], blisk.triangle(t)});
    for (const Vec3& corner : facets_.back().places) middle += corner;
  }
  angle_ = std::atan2(middle.y(), middle.x());
}

BladeSection BladeCutter::at(double radius) const {
  Crossings crossings;
  std::map<Edge, std::uint32_t> point_on_edge;
  const auto pointOn = [&](const Facet& facet, int from, int to) {
    // The same edge must give the same bits from both of its triangles.
    if (facet.corners[from] > facet.corners[to]) std::swap(from, to);
    const Edge edge{facet.corners[from], facet.corners[to]};
    const auto [entry, is_new] = point_on_edge.try_emplace(edge, crossings.points.size());
    if (is_new) {
      const double below = radiusOf(facet.places[from]) - radius;
      const double above = radiusOf(facet.places[to]) - radius;
      const double part = below / (below - above);
      crossings.points.push_back((1.0 - part) * facet.places[from] + part * facet.places[to]);
      crossings.neighbours.emplace_back();
    }
    return entry->second;
  };
  for (const Facet& facet : facets_) {
    std::array<bool, 3> below;
    for (int k = 0; k < 3; ++k) below[k] = radiusOf(facet.places[k]) < radius;
    std::vector<std::uint32_t> ends;
    for (int k = 0; k < 3; ++k) {
      if (below[k] != below[(k + 1) % 3]) ends.push_back(pointOn(facet, k, (k + 1) % 3));
    }
    if (ends.size() != 2) continue;
    crossings.neighbours[ends[0]].push_back(ends[1]);
    crossings.neighbours[ends[1]].push_back(ends[0]);
  }

  std::vector<SectionPoint> loop;
  const double sine = std::sin(angle_);
  const double cosine = std::cos(angle_);
  for (const Vec3& point : longestLoop(crossings)) {
    const double along = cosine * point.x() + sine * point.y();
    const double across = cosine * point.y() - sine * point.x();
    const Vec2 flat(point.z(), radius * std::atan2(across, along));
    if (loop.empty() || (flat - loop.back().flat).norm() > 1e-9 * radius) loop.push_back({point, flat});
  }
  if (loop.size() < 8) {
    throw std::invalid_argument("blade " + std::to_string(blade_) + " has no closed section at the radius " +
                                std::to_string(radius));
  }
  const auto by_z = [](const SectionPoint& a, const SectionPoint& b) { return a.flat.x() < b.flat.x(); };
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), by_z), loop.end());
  const auto trailing = std::max_element(loop.begin(), loop.end(), by_z);
  BladeSection section;
  section.forward.assign(loop.begin(), trailing + 1);
  section.backward.assign(trailing, loop.end());
  section.backward.push_back(loop.front());
  std::reverse(section.backward.begin(), section.backward.end());
  if (meanOffset(section.forward) < meanOffset(section.backward)) {
    std::swap(section.forward, section.backward);
  }
  return section;
}

bool convexIsForward(const BladeSection& section) {
  return meanOffset(section.forward) + meanOffset(section.backward) >= 0.0;
}

}  // namespace octoblisk::demos
