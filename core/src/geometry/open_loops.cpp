#include "geometry/open_loops.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/no_index.h"

namespace octoblisk::detail {
namespace {

/// For each corner, one that stands for all those close to it: closer than 1/64 of the shortest of the open
/// edges at both.
std::vector<std::uint32_t> mergedCorners(std::span<const OpenEdge> edges, std::span<const Vec3> positions) {
  constexpr double kClose = 1.0 / 64.0;
  std::vector<double> reach(positions.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> corners;
  Aabb bounds;
  for (const OpenEdge& edge : edges) {
    const double length = kClose * (positions[edge.to] - positions[edge.from]).norm();
    for (const std::uint32_t corner : {edge.from, edge.to}) reach[corner] = std::min(reach[corner], length);
    corners.push_back(edge.from);  // each corner is where an edge begins
    bounds.extend(positions[edge.from]);
  }
  DisjointSets merged(positions.size());
  Eigen::Index axis = 0;
  if (!edges.empty()) bounds.halfExtents().maxCoeff(&axis);
  const auto height = [&](std::uint32_t corner) { return positions[corner][axis]; };
  std::ranges::sort(corners, {}, [&](std::uint32_t corner) { return std::pair(height(corner), corner); });
  for (auto corner = corners.begin(); corner != corners.end(); ++corner) {
    for (auto other = corner + 1; other != corners.end(); ++other) {
      if (height(*other) - height(*corner) > reach[*corner]) break;
      const double close = std::min(reach[*corner], reach[*other]);
      if ((positions[*other] - positions[*corner]).norm() < close) merged.join(*other, *corner);
    }
  }
  std::vector<std::uint32_t> place(positions.size());
  for (std::uint32_t corner = 0; corner < place.size(); ++corner) place[corner] = merged.rootOf(corner);
  return place;
}

/// For each edge, the one that follows it in its loop. Edges that turn back most sharply are joined first, so
/// that the others do not take what these need.
std::vector<std::uint32_t> nextEdges(std::span<const OpenEdge> edges, std::span<const Vec3> positions,
                                     std::span<const std::uint32_t> place) {
  std::vector<Vec3> direction;
  for (const OpenEdge& edge : edges)
    direction.push_back((positions[edge.to] - positions[edge.from]).normalized());
  const auto begin_at = [&](std::uint32_t edge) { return place[edges[edge].from]; };
  std::vector<std::uint32_t> order(edges.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, begin_at);
  struct Turn {
    double sharpness;
    std::uint32_t edge, next;
    bool operator<(const Turn& other) const {
      return std::pair(sharpness, other.edge) < std::pair(other.sharpness, edge);
    }
  };
  std::vector<std::uint32_t> next(edges.size(), kNoIndex);
  std::vector<bool> is_taken(edges.size(), false);
  const auto sharpestFree = [&](std::uint32_t edge) {
    Turn turn = {-std::numeric_limits<double>::infinity(), edge, kNoIndex};
    for (const std::uint32_t other : std::ranges::equal_range(order, place[edges[edge].to], {}, begin_at)) {
      const double sharpness = -direction[edge].dot(direction[other]);
      if (!is_taken[other] && sharpness > turn.sharpness) turn = {sharpness, edge, other};
    }
    return turn;
  };
  std::priority_queue<Turn> turns;
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) turns.push(sharpestFree(edge));
  // An edge searches at most this often: thousands of edges at one place would otherwise take cubic time.
  constexpr int kRounds = 8;
  std::vector<signed char> rounds(edges.size(), 0);
  while (!turns.empty()) {
    Turn turn = turns.top();
    turns.pop();
    if (is_taken[turn.next]) {
      turn = sharpestFree(turn.edge);
      if (++rounds[turn.edge] < kRounds) {
        turns.push(turn);
        continue;
      }
    }
    next[turn.edge] = turn.next;
    is_taken[turn.next] = true;
  }
  return next;
}

/// Divides open edges into loops. Corners with the same place count as one.
std::vector<OpenLoop> loopsOf(std::span<const OpenEdge> edges, std::span<const Vec3> positions,
                              std::span<const std::uint32_t> place) {
  const std::vector<std::uint32_t> next = nextEdges(edges, positions, place);
  std::vector<bool> is_used(edges.size(), false);
  std::vector<std::uint32_t> step_at(positions.size(), kNoIndex);  // per place: where it begins on the path
  std::vector<OpenLoop> loops;
  OpenLoop path;
  for (std::uint32_t first = 0; first < edges.size(); ++first) {
    for (std::uint32_t edge = first; !is_used[edge]; edge = next[edge]) {
      is_used[edge] = true;
      step_at[place[edges[edge].from]] = static_cast<std::uint32_t>(path.size());
      path.push_back(edges[edge]);
      const std::uint32_t begin = step_at[place[edges[edge].to]];
      if (begin == kNoIndex) continue;
      loops.emplace_back(path.begin() + begin, path.end());
      for (const OpenEdge& of_loop : loops.back()) step_at[place[of_loop.from]] = kNoIndex;
      path.resize(begin);
    }
  }
  return loops;
}

/// The edges that stay open if caps fill the outlines of all loops: those between corners that are close to
/// each other. Most cancel.
std::vector<OpenEdge> leftOver(std::span<const OpenLoop> loops) {
  std::vector<OpenEdge> left;
  for (const OpenLoop& loop : loops) {
    const OpenEdge* last = &loop.back();
    for (const OpenEdge& edge : loop) {
      // The cap adds an edge between corners that are close, so the opposite edge is open.
      if (last->to != edge.from) left.push_back({edge.from, last->to, edge.triangle});
      last = &edge;
    }
  }
  const auto ends = [](const OpenEdge& edge) { return std::pair(edge.from, edge.to); };
  std::ranges::stable_sort(left, {}, ends);
  std::vector<OpenEdge> open;
  std::vector<bool> is_matched(left.size(), false);
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (is_matched[i]) continue;
    const auto opposite = std::ranges::equal_range(left, std::pair(left[i].to, left[i].from), {}, ends);
    for (auto other = opposite.begin(); other != opposite.end() && !is_matched[i]; ++other) {
      const auto index = static_cast<std::size_t>(other - left.begin());
      if (is_matched[index]) continue;
      is_matched[index] = is_matched[i] = true;
    }
    if (!is_matched[i]) open.push_back(left[i]);
  }
  return open;
}

/// Adds the triangles between the corners from `first` to `last` of an outline. Halves it again and again, so
/// that most triangles are small.
void fill(std::span<const std::uint32_t> outline, std::span<const Vec3> positions, std::size_t first,
          std::size_t last, std::vector<Triangle>& triangles) {
  if (last - first < 2) return;
  const std::size_t middle = first + (last - first) / 2;
  triangles.push_back({positions[outline[first]], positions[outline[last]], positions[outline[middle]]});
  fill(outline, positions, first, middle, triangles);
  fill(outline, positions, middle, last, triangles);
}

}  // namespace

std::vector<OpenLoop> openLoops(std::span<const OpenEdge> edges, std::span<const Vec3> positions) {
  std::vector<OpenLoop> loops = loopsOf(edges, positions, mergedCorners(edges, positions));
  std::vector<std::uint32_t> each_itself(positions.size());
  std::iota(each_itself.begin(), each_itself.end(), 0u);
  for (OpenLoop& loop : loopsOf(leftOver(loops), positions, each_itself)) loops.push_back(std::move(loop));
  return loops;
}

std::vector<std::uint32_t> outlineOf(const OpenLoop& loop) {
  std::vector<std::uint32_t> outline;
  std::uint32_t last = loop.back().to;
  for (const OpenEdge& edge : loop) {
    if (edge.from != last) outline.push_back(last);
    outline.push_back(edge.from);
    last = edge.to;
  }
  return outline;
}

std::vector<Triangle> capOf(std::span<const std::uint32_t> outline, std::span<const Vec3> positions) {
  std::vector<Triangle> cap;
  if (outline.size() >= 3) fill(outline, positions, 0, outline.size() - 1, cap);
  return cap;
}

}  // namespace octoblisk::detail
