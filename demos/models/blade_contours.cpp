#include "models/blade_contours.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/disjoint_sets.h"
#include "models/require.h"
#include "models/welded_surface.h"

namespace octoblisk::demos {
namespace {

/// The cotangent of the angle at a corner, limited for slivers.
double cotangentAt(const Vec3& corner, const Vec3& a, const Vec3& b) {
  constexpr double kLeast = 0.01;
  constexpr double kGreatest = 100.0;
  const Vec3 to_a = a - corner;
  const Vec3 to_b = b - corner;
  const double sine = to_a.cross(to_b).norm();
  return sine > 0.0 ? std::clamp(to_a.dot(to_b) / sine, kLeast, kGreatest) : kLeast;
}

/// In both directions from the point of least z to that of greatest z.
BladeContour cutAtEdges(std::vector<ContourPoint> loop) {
  const auto by_z = [](const ContourPoint& a, const ContourPoint& b) {
    return a.position.z() < b.position.z();
  };
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), by_z), loop.end());
  const auto trailing = std::max_element(loop.begin(), loop.end(), by_z);
  std::vector<ContourPoint> there(loop.begin(), trailing + 1);
  std::vector<ContourPoint> back(trailing, loop.end());
  back.push_back(loop.front());
  std::reverse(back.begin(), back.end());
  double facing = 0.0;
  for (std::size_t k = 1; k < there.size(); ++k) {
    const Vec3& position = there[k].position;
    const double length = (position - there[k - 1].position).norm();
    facing += length * there[k].normal.dot(Vec3(-position.y(), position.x(), 0.0).normalized());
  }
  if (facing < 0.0) std::swap(there, back);
  return {std::move(there), std::move(back)};
}

}  // namespace

BladeContours::BladeContours(const TriangleMesh& blisk, const BladeSides& sides, int blade) : blade_(blade) {
  addTriangles(blisk, sides);
  linkTriangles();
  solveHeights();
}

void BladeContours::addTriangles(const TriangleMesh& blisk, const BladeSides& sides) {
  std::map<std::array<double, 3>, std::uint32_t> index_of_place;
  const auto indexOf = [&](const Vec3& place) {
    const auto [entry, is_new] = index_of_place.try_emplace({place.x(), place.y(), place.z()},
                                                            static_cast<std::uint32_t>(positions_.size()));
    if (is_new) {
      positions_.push_back(place);
      normals_.push_back(Vec3::Zero());
    }
    return entry->second;
  };
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    if (sides.blade_of_triangle[t] != blade_) continue;
    const BladePart part = sides.part_of_triangle[t];
    if (part != BladePart::forward && part != BladePart::backward) continue;
    const Triangle corners = blisk.triangle(t);
    const Corners indices = {indexOf(corners[0]), indexOf(corners[1]), indexOf(corners[2])};
    const auto [a, b, c] = indices;
    if (a == b || b == c || c == a) continue;
    const Vec3 normal = scaledNormal(corners) * (sides.faces_outward ? 1.0 : -1.0);
    for (const std::uint32_t index : indices) normals_[index] += normal;
    triangles_.push_back(indices);
  }
  for (Vec3& normal : normals_) normal.normalize();
}

void BladeContours::linkTriangles() {
  beside_.assign(triangles_.size(), {kNone, kNone, kNone});
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, int>>
      open;  // by the edge's ends
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto ends = std::minmax(triangles_[t][k], triangles_[t][(k + 1) % 3]);
      const auto [entry, is_new] = open.try_emplace({ends.first, ends.second}, t, k);
      if (is_new) continue;
      const auto [other, other_k] = entry->second;
      beside_[t][k] = other;
      beside_[other][other_k] = t;
      open.erase(entry);
    }
  }
}

void BladeContours::solveHeights() {
  // The borders: vertices connected by edges of a single triangle.
  detail::DisjointSets connected(positions_.size());
  struct Border {
    double length = 0.0, moment = 0.0;  ///< moment: of the radius
  };
  const auto forBorderEdges = [&](auto visit) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (beside_[t][k] == kNone) visit(triangles_[t][k], triangles_[t][(k + 1) % 3]);
      }
    }
  };
  forBorderEdges([&](std::uint32_t a, std::uint32_t b) { connected.join(a, b); });
  std::map<std::uint32_t, Border> borders;
  forBorderEdges([&](std::uint32_t a, std::uint32_t b) {
    const double length = (positions_[a] - positions_[b]).norm();
    Border& border = borders[connected.rootOf(a)];
    border.length += length;
    border.moment += length * 0.5 * (radiusOf(positions_[a]) + radiusOf(positions_[b]));
  });
  std::vector<std::pair<std::uint32_t, Border>> longest(borders.begin(), borders.end());
  std::stable_sort(longest.begin(), longest.end(),
                   [](const auto& a, const auto& b) { return a.second.length > b.second.length; });
  const auto refusal = "blade " + std::to_string(blade_) + ": its sides do not end in a root and a tip";
  constexpr double kMinPart = 0.5;  // of the greater border's length
  require(longest.size() >= 2 && longest[1].second.length > kMinPart * longest[0].second.length, refusal);
  const auto meanRadius = [&](int k) { return longest[k].second.moment / longest[k].second.length; };
  const int tip = meanRadius(0) > meanRadius(1) ? 0 : 1;

  constexpr int kFree = -1;
  std::vector<int> unknown_of(positions_.size(), kFree);
  heights_.assign(positions_.size(), 0.0);
  int unknowns = 0;
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    const std::uint32_t root = connected.rootOf(v);
    const bool at_tip = root == longest[tip].first;
    const bool at_root = root == longest[1 - tip].first;
    if (at_tip) heights_[v] = 1.0;
    if (!at_tip && !at_root) unknown_of[v] = unknowns++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
  const auto couple = [&](std::uint32_t from, std::uint32_t to, double weight) {
    if (unknown_of[from] == kFree) return;
    entries.emplace_back(unknown_of[from], unknown_of[from], weight);
    if (unknown_of[to] == kFree) {
      right[unknown_of[from]] += weight * heights_[to];
    } else {
      entries.emplace_back(unknown_of[from], unknown_of[to], -weight);
    }
  };
  for (const Corners& corners : triangles_) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[(k + 1) % 3];
      const std::uint32_t b = corners[(k + 2) % 3];
      const double weight = cotangentAt(positions_[corners[k]], positions_[a], positions_[b]);
      couple(a, b, weight);
      couple(b, a, weight);
    }
  }
  if (unknowns == 0) return;
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  require(solver.info() == Eigen::Success, refusal);
  const Eigen::VectorXd solution = solver.solve(right);
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    if (unknown_of[v] != kFree) heights_[v] = solution[unknown_of[v]];
  }
}

std::vector<ContourPoint> BladeContours::loopFrom(std::uint32_t triangle, double height,
                                                  std::vector<bool>& seen) const {
  std::vector<ContourPoint> loop;
  std::uint32_t came_from = kNone;
  while (triangle != kNone && !seen[triangle]) {
    seen[triangle] = true;
    const Corners& corners = triangles_[triangle];
    std::uint32_t next = kNone;
    bool found = false;
    for (int k = 0; k < 3 && !found; ++k) {
      const std::uint32_t from = corners[k];
      const std::uint32_t to = corners[(k + 1) % 3];
      if (!crosses(from, to, height)) continue;
      if (came_from != kNone && beside_[triangle][k] == came_from) continue;
      found = true;
      next = beside_[triangle][k];
      // The point must be the same, bit by bit, from both triangles of the edge.
      const auto [a, b] = std::minmax(from, to);
      const double part = (height - heights_[a]) / (heights_[b] - heights_[a]);
      const Vec3 normal = (1.0 - part) * normals_[a] + part * normals_[b];
      loop.push_back({positions_[a] + part * (positions_[b] - positions_[a]), normal.normalized()});
    }
    came_from = triangle;
    triangle = next;
  }
  if (triangle == kNone) loop.clear();  // the line ended at a border
  return loop;
}

BladeContour BladeContours::at(double height) const {
  constexpr double kNearBorder = 1e-9;
  const double within = std::clamp(height, kNearBorder, 1.0 - kNearBorder);
  std::vector<bool> seen(triangles_.size(), false);
  std::vector<ContourPoint> longest;
  double greatest = 0.0;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const auto [a, b, c] = triangles_[t];
    if (seen[t] || !(crosses(a, b, within) || crosses(b, c, within))) continue;
    std::vector<ContourPoint> loop = loopFrom(t, within, seen);
    double length = 0.0;
    for (std::size_t k = 1; k < loop.size(); ++k) length += (loop[k].position - loop[k - 1].position).norm();
    if (length <= greatest) continue;
    greatest = length;
    longest = std::move(loop);
  }
  if (longest.size() < 3) {
    throw std::invalid_argument("blade " + std::to_string(blade_) + ": no closed line runs around it at " +
                                std::to_string(height) + " of its height: check the mesh for holes there");
  }
  return cutAtEdges(std::move(longest));
}

}  // namespace octoblisk::demos
