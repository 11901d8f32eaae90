#include "reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "geometry/triangle_pair.h"
#include "shared/solids.h"

namespace octoblisk::bench {

using namespace detail;

namespace {

template <typename Visit>
void forEachCell(const Eigen::Vector3i& from, const Eigen::Vector3i& to, Visit&& visit) {
  for (int x = from.x(); x <= to.x(); ++x) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int z = from.z(); z <= to.z(); ++z) visit(Eigen::Vector3i(x, y, z));
    }
  }
}

}  // namespace

double hitOf(const Triangle& triangle, const Segment& segment) {
  const Vec3 direction = segment.to - segment.from;
  const Vec3 ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0],
             offset = segment.from - triangle[0];
  const Vec3 across = direction.cross(ac), around = offset.cross(ab);
  const double determinant = ab.dot(across);
  if (determinant == 0.0) return 1.0;
  const double u = offset.dot(across) / determinant, v = direction.dot(around) / determinant;
  const double t = ac.dot(around) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 ? std::min(t, 1.0) : 1.0;
}

Reference::Reference(const TriangleMesh& blisk, double cell_size)
    : blisk_(blisk),
      cell_size_(cell_size),
      lowest_(blisk.bounds().min),
      cells_(((blisk.bounds().max - lowest_) / cell_size_).cast<int>() + Cell::Ones()),
      begin_(static_cast<std::size_t>(cells_.cast<long>().prod()) + 1, 0) {
  const auto forEachEntry = [&](auto&& enter) {
    for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
      const Aabb box = boundsOf(blisk.triangle(t));
      forEachCell(cellOf(box.min), cellOf(box.max), [&](const Cell& cell) { enter(indexOf(cell), t); });
    }
  };
  forEachEntry([&](std::size_t cell, std::size_t) { ++begin_[cell + 1]; });
  for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  triangles_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  forEachEntry(
      [&](std::size_t cell, std::size_t t) { triangles_[next[cell]++] = static_cast<std::uint32_t>(t); });
}

Reference::Cell Reference::cellOf(const Vec3& point) const {
  const Vec3 place = ((point - lowest_) / cell_size_).array().floor();
  return place.cwiseMax(0.0).cwiseMin((cells_ - Cell::Ones()).cast<double>()).cast<int>();
}

std::size_t Reference::indexOf(const Cell& cell) const {
  return static_cast<std::size_t>((static_cast<long>(cell.x()) * cells_.y() + cell.y()) * cells_.z() +
                                  cell.z());
}

void Reference::forEachPair(double reach, const TriangleMesh& belt, const Pose& belt_in_blisk,
                            const std::function<bool(const Triangle&, const Triangle&)>& visit) const {
  std::vector<Vec3> posed;
  for (const Vec3& vertex : belt.vertices()) posed.push_back(belt_in_blisk * vertex);
  bool done = false;
  for (const TriangleMesh::Indices& corner : belt.triangles()) {
    const Triangle of_belt = {posed[corner[0]], posed[corner[1]], posed[corner[2]]};
    const Aabb box = boundsOf(of_belt).grown(reach);
    if (!box.meets(blisk_.bounds())) continue;
    forEachCell(cellOf(box.min), cellOf(box.max), [&](const Cell& cell) {
      const std::size_t index = indexOf(cell);
      for (std::uint32_t k = begin_[index]; k < begin_[index + 1] && !done; ++k) {
        const Triangle of_blisk = blisk_.triangle(triangles_[k]);
        const Aabb other = boundsOf(of_blisk);
        if (!box.meets(other)) continue;
        // The boxes may share several cells. Only the cell of their common lowest corner counts the pair.
        if (cellOf(box.min.cwiseMax(other.min)) == cell) done = visit(of_blisk, of_belt);
      }
    });
    if (done) return;
  }
}

std::size_t Reference::touchingPairs(const TriangleMesh& belt, const Pose& belt_in_blisk) const {
  std::size_t pairs = 0;
  forEachPair(0.0, belt, belt_in_blisk, [&](const Triangle& of_blisk, const Triangle& of_belt) {
    pairs += intersects(of_blisk, of_belt);
    return false;
  });
  return pairs;
}

double Reference::firstHit(const Segment& segment) const {
  const Vec3 direction = segment.to - segment.from;
  const double pieces = std::ceil(direction.norm() / cell_size_);
  double first = 1.0;
  for (double piece = 0.0; piece < pieces; ++piece) {
    if (first <= piece / pieces) break;
    Aabb box;
    box.extend(segment.from + piece / pieces * direction);
    box.extend(segment.from + (piece + 1.0) / pieces * direction);
    if (!box.meets(blisk_.bounds())) continue;
    forEachCell(cellOf(box.min), cellOf(box.max), [&](const Cell& cell) {
      const std::size_t index = indexOf(cell);
      for (std::uint32_t k = begin_[index]; k < begin_[index + 1]; ++k) {
        first = std::min(first, hitOf(blisk_.triangle(triangles_[k]), segment));
      }
    });
  }
  return first;
}

double Reference::distanceTo(const Vec3& point, double farthest) const {
  const Vec3 reach = Vec3::Constant(farthest);
  double least = std::numeric_limits<double>::infinity();
  forEachCell(cellOf(point - reach), cellOf(point + reach), [&](const Cell& cell) {
    const std::size_t index = indexOf(cell);
    for (std::uint32_t k = begin_[index]; k < begin_[index + 1]; ++k) {
      least = std::min(least, testing::bruteForceDistance(blisk_.triangle(triangles_[k]), point));
    }
  });
  return least <= farthest ? least : std::numeric_limits<double>::infinity();
}

double Reference::firstTouch(const Segment& segment, double radius) const {
  constexpr double kTouching = 1e-4, kStep = 2.0;  // mm
  const double length = (segment.to - segment.from).norm();
  for (double gone = 0.0; gone < length;) {
    const double farthest = radius + kStep;
    const double apart =
        std::min(distanceTo(segment.from + gone / length * (segment.to - segment.from), farthest), farthest) -
        radius;
    if (apart <= kTouching) return gone / length;
    gone += apart;
  }
  return 1.0;
}

bool Reference::within(double reach, const TriangleMesh& belt, const Pose& belt_in_blisk) const {
  bool found = false;
  forEachPair(reach, belt, belt_in_blisk, [&](const Triangle& of_blisk, const Triangle& of_belt) {
    found = intersects(of_blisk, of_belt) || closestPoints(of_blisk, of_belt).distance <= reach;
    return found;
  });
  return found;
}

std::optional<double> Reference::distance(double farthest, const TriangleMesh& belt,
                                          const Pose& belt_in_blisk) const {
  constexpr double kFirstReach = 0.125;
  for (double reach = std::min(kFirstReach, farthest);; reach = std::min(2.0 * reach, farthest)) {
    double least = std::numeric_limits<double>::infinity();
    forEachPair(reach, belt, belt_in_blisk, [&](const Triangle& of_blisk, const Triangle& of_belt) {
      least = std::min(least, closestPoints(of_blisk, of_belt).distance);
      return false;
    });
    if (least <= reach) return least;
    if (reach == farthest) return std::nullopt;
  }
}

const Truth& truthOf(const Scene& scene, const std::vector<Pose>& poses) {
  static std::map<const std::vector<Pose>*, Truth> known;
  const auto [entry, is_new] = known.try_emplace(&poses);
  Truth& truth = entry->second;
  if (!is_new) return truth;
  const Reference reference(*scene.blisk);
  std::size_t hits = 0, near = 0;
  for (const Pose& pose : poses) {
    truth.touching_pairs.push_back(reference.touchingPairs(*scene.belt, pose));
    if (truth.touching_pairs.back() > 0) {
      ++hits;
    } else {
      near += reference.within(0.5, *scene.belt, pose);
    }
  }
  truth.hit_rate = static_cast<double>(hits) / static_cast<double>(poses.size());
  truth.near_rate = static_cast<double>(near) / static_cast<double>(poses.size());
  return truth;
}

const PrimitiveTruth& truthOf(const Scene& scene, Primitive primitive) {
  static std::map<std::pair<const Scene*, Primitive>, PrimitiveTruth> known;
  const auto [entry, is_new] = known.try_emplace({&scene, primitive});
  PrimitiveTruth& truth = entry->second;
  if (!is_new) return truth;
  constexpr double kCellSize = 0.1, kFar = 0.3;
  const Reference reference(*scene.blisk, kCellSize);
  const auto [core, margin] = roundedCore(primitive);
  const double unsure = primitive == Primitive::cylinder ? 1e-3 : 1e-4;
  for (const Pose& pose : scene.path) {
    const bool touches = reference.within(margin - unsure, *core, pose);
    if (!touches && reference.within(margin + unsure, *core, pose)) continue;
    truth.poses.push_back(pose);
    truth.touches.push_back(touches);
    truth.hits += touches;
    if (primitive == Primitive::sphere)
      truth.distances.push_back(reference.distanceTo(pose.translation, kFar) - margin);
  }
  return truth;
}

}  // namespace octoblisk::bench
