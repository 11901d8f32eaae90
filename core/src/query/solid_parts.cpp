#include "query/solid_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/no_index.h"
#include "base/parallel.h"
#include "geometry/thin_triangle.h"
#include "geometry/triangle_pieces.h"
#include "octoblisk/containment.h"
#include "query/candidate_pairs.h"

namespace octoblisk::detail {
namespace {

/// The greatest share of all directions in which a triangle of a solid may see holes: with up to a quarter,
/// the winding number is nearer to 0 before the triangle and to 1 behind it than to 1/2. Also the greatest
/// share of its area that a component with holes may lack, because a triangle sees about that share on
/// average.
constexpr double kHoleShare = 1.0 / 4.0;

/// The same for SolidParts::near_hole. A hole seen in a smaller share is no entrance: an open box of any
/// proportions up to a depth of four times its width shows more.
constexpr double kEntranceShare = 1.0 / 64.0;

/// Triangles side by side, with nothing that meets the surface between them: one role fits all.
using Region = std::vector<std::uint32_t>;

/// The winding numbers before and behind a triangle.
struct Sides {
  int front = 0, back = 0;

  TriangleRole role() const {
    if (front != 0 && back != 0) return TriangleRole::inner;
    if (front == 0 && back == 0) return TriangleRole::sheet;
    return front == 0 ? TriangleRole::outward : TriangleRole::inward;
  }
};

class SolidSearch {
 public:
  SolidSearch(const Surface& surface, int threads)
      : surface_(surface),
        mesh_(surface.tree().mesh()),
        threads_(threads),
        tolerance_(touchingDistance(mesh_)) {}

  std::shared_ptr<SolidParts> find() {
    const std::vector<Vec3> positions = cornerPositions();
    findEdges();
    roles_.assign(mesh_.triangleCount(), TriangleRole::inner);
    const Copies copies = is_manifold_ ? Copies() : findCopies();
    if (!copies.triangles.empty()) {
      judgeByOriginals(copies);
      return parts_;
    }
    std::vector<Gap> gaps;
    std::vector<Triangle> caps;
    for (std::vector<OpenEdge> open = open_edges_; !open.empty();) {
      const std::vector<OpenLoop> loops = openLoops(open, positions);
      for (const OpenLoop& loop : loops) {
        Gap& gap = gaps.emplace_back();
        for (const OpenEdge& edge : loop)
          gap.edges.push_back({positions[edge.from], positions[edge.to], edge.triangle});
        gap.cap = capOf(outlineOf(loop), positions);
        caps.insert(caps.end(), gap.cap.begin(), gap.cap.end());
      }
      open = leftOver(loops);
    }
    parts_ = std::make_shared<SolidParts>(Winding(surface_.tree(), std::move(caps)));
    parts_->gaps = std::move(gaps);
    findHoles();
    if (std::ranges::find(sees_hole_, 0) == sees_hole_.end()) {
      roles_.assign(roles_.size(), TriangleRole::sheet);
      return parts_;
    }
    findCuts();
    findRegions();
    judgeRegions();
    judgePieces();
    for (std::size_t t = 0; t < roles_.size(); ++t) {
      if (sees_hole_[t] != 0 && roles_[t] != TriangleRole::inner) roles_[t] = TriangleRole::sheet;
    }
    expose();
    return parts_;
  }

  bool isOriented() const { return open_edges_.empty(); }
  bool hasNoDefect() const {
    return is_manifold_ && isOriented() && parts_->intersecting.empty() && !parts_->exposed &&
           std::ranges::find(roles_, TriangleRole::sheet) == roles_.end();
  }
  bool hasHoles() const { return has_holes_; }
  std::vector<TriangleRole> takeRoles() { return std::move(roles_); }

 private:
  std::vector<Vec3> cornerPositions() const;
  void findEdges();
  /// Triangles with the same corners as others.
  struct Copies {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> original;  // per triangle: the lowest with the same corners
    std::vector<int> count;               // per original: those that face its way minus the others
  };
  Copies findCopies() const;
  void judgeByOriginals(const Copies& copies);
  void findCuts();
  void findRegions();
  void judgeRegions();
  void judgePieces();
  void findHoles();
  void expose();

  /// Whether the triangle is higher than rounding.
  bool hasArea(std::uint32_t t) const {
    const Triangle triangle = mesh_.triangle(t);
    return scaledNormal(triangle).squaredNorm() > tolerance_ * tolerance_ * squaredLongestEdge(triangle);
  }
  std::uint32_t componentOf(std::size_t triangle) const {
    return surface_.component(surface_.corners(static_cast<std::uint32_t>(triangle))[0]);
  }
  std::uint32_t componentOf(const Gap& gap) const { return componentOf(gap.edges.front().triangle); }
  bool areSameWay(std::uint32_t a, std::uint32_t b) const;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // corners, the lower one first
  Edge edgeOf(std::uint32_t triangle, std::size_t edge) const {
    return std::minmax({surface_.corners(triangle)[edge], surface_.corners(triangle)[(edge + 1) % 3]});
  }
  void noteSeams(std::uint32_t of, std::uint32_t beside);
  std::uint32_t acrossEdge(std::uint32_t triangle, std::size_t edge) const;
  bool mayCut(std::uint32_t a, std::uint32_t b) const;
  Sides sidesOf(const Vec3& middle, const Vec3& normal) const;
  bool isExposedAsItIs() const;

  const Surface& surface_;
  const TriangleMesh& mesh_;
  int threads_;
  double tolerance_;  // a length
  std::shared_ptr<SolidParts> parts_;
  bool is_manifold_ = true;  // each edge belongs to two triangles in opposite directions, or to one
  std::vector<OpenEdge> open_edges_;
  bool has_holes_ = false;
  std::vector<char> sees_hole_;  // per triangle: whether it is a sheet because of a hole
  std::vector<TriangleRole> roles_;
  std::vector<Region> regions_;
  std::vector<Sides> sides_of_region_;
  std::vector<TrianglePair> cuts_;                  // triangle b cuts a; by ascending a
  std::vector<Edge> seams_;                         // edges along which another triangle meets the surface
  std::vector<std::vector<TrianglePiece>> pieces_;  // of each intersecting triangle
  std::vector<std::vector<Sides>> sides_of_pieces_;
};

std::vector<Vec3> SolidSearch::cornerPositions() const {
  std::vector<Vec3> positions(surface_.cornerCount());
  for (std::uint32_t corner = 0; corner < positions.size(); ++corner)
    positions[corner] = surface_.position(corner);
  return positions;
}

void SolidSearch::findEdges() {
  struct Use {
    std::uint32_t other;  // the edge's greater corner
    int direction;        // +1 towards `other`
    std::uint32_t triangle;
  };
  std::vector<Use> uses;
  for (std::uint32_t corner = 0; corner < surface_.cornerCount(); ++corner) {
    uses.clear();
    for (const std::uint32_t t : surface_.star(corner)) {
      const auto& [a, b, c] = surface_.corners(t);
      if (a == b || b == c || c == a) continue;  // runs there and back: it neither closes nor opens an edge
      const std::uint32_t next = a == corner ? b : b == corner ? c : a;
      const std::uint32_t last = a == corner ? c : b == corner ? a : b;
      if (next > corner) uses.push_back({next, 1, t});
      if (last > corner) uses.push_back({last, -1, t});
    }
    std::ranges::sort(uses, {}, [](const Use& use) { return std::pair(use.other, use.triangle); });
    for (auto begin = uses.begin(); begin != uses.end();) {
      const auto end =
          std::find_if(begin, uses.end(), [&](const Use& use) { return use.other != begin->other; });
      int balance = 0;
      for (auto use = begin; use != end; ++use) balance += use->direction;
      is_manifold_ &= end - begin == 1 || (end - begin == 2 && balance == 0);
      for (auto use = end; use != begin && balance != 0;) {
        if ((--use)->direction * balance < 0) continue;
        balance -= use->direction;
        const bool is_forward = use->direction > 0;
        open_edges_.push_back(
            {is_forward ? corner : use->other, is_forward ? use->other : corner, use->triangle});
      }
      begin = end;
    }
  }
}

SolidSearch::Copies SolidSearch::findCopies() const {
  std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> order;
  for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
    std::array<std::uint32_t, 3> corners = surface_.corners(t);
    std::ranges::sort(corners);
    order.emplace_back(corners, t);
  }
  std::ranges::sort(order);
  Copies copies;
  copies.original.resize(order.size());
  copies.count.assign(order.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t triangle = order[i].second;
    const bool is_copy = i > 0 && order[i].first == order[i - 1].first && hasArea(triangle);
    copies.original[triangle] = is_copy ? copies.original[order[i - 1].second] : triangle;
    copies.count[copies.original[triangle]] += areSameWay(triangle, copies.original[triangle]) ? 1 : -1;
    if (is_copy) copies.triangles.push_back(triangle);
  }
  return copies;
}

/// Gives each triangle the role that it has if all its copies count once.
void SolidSearch::judgeByOriginals(const Copies& copies) {
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<std::uint32_t> source;
  std::vector<signed char> counts(mesh_.triangleCount(), 0);
  for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
    if (copies.original[t] != t || copies.count[t] == 0) continue;
    counts[t] = copies.count[t] > 0 ? 1 : -1;
    triangles.push_back(mesh_.triangles()[t]);
    if (counts[t] < 0) std::swap(triangles.back()[1], triangles.back()[2]);
    source.push_back(t);
  }
  if (triangles.empty()) {
    parts_ = std::make_shared<SolidParts>(Winding(surface_.tree(), {}, std::move(counts)));
    parts_->copies = copies.triangles;
    roles_.assign(roles_.size(), TriangleRole::sheet);
    has_holes_ = true;
    return;
  }
  auto reduced = std::make_shared<const TriangleMesh>(mesh_.vertices(), std::move(triangles));
  const ClusteredOctree tree = ClusteredOctree::build(std::move(reduced), {.threads = threads_});
  const Surface single(tree, threads_);
  const SolidParts& found = single.solidParts();
  std::vector<Triangle> caps;
  for (const Gap& gap : found.gaps) caps.insert(caps.end(), gap.cap.begin(), gap.cap.end());
  parts_ = std::make_shared<SolidParts>(Winding(surface_.tree(), std::move(caps), std::move(counts)));
  parts_->copies = copies.triangles;
  const auto reversed = [](TriangleRole role) {
    return role == TriangleRole::outward  ? TriangleRole::inward
           : role == TriangleRole::inward ? TriangleRole::outward
                                          : role;
  };
  for (std::uint32_t t = 0; t < source.size(); ++t)
    roles_[source[t]] = copies.count[source[t]] > 0 ? single.role(t) : reversed(single.role(t));
  for (std::uint32_t t = 0; t < roles_.size(); ++t) {
    const std::uint32_t original = copies.original[t];
    if (original != t) {
      roles_[t] = areSameWay(t, original) ? roles_[original] : reversed(roles_[original]);
    } else if (copies.count[t] == 0) {
      const bool is_inside = locate(single, centroidOf(mesh_.triangle(t))) == PointLocation::inside;
      roles_[t] = is_inside ? TriangleRole::inner : TriangleRole::sheet;
    }
  }
  has_holes_ = !single.isClosed();
  if (!found.near_hole.empty()) {
    parts_->near_hole.assign(roles_.size(), 1);
    for (std::uint32_t t = 0; t < source.size(); ++t) parts_->near_hole[source[t]] = found.near_hole[t];
    for (const std::uint32_t t : copies.triangles)
      parts_->near_hole[t] = parts_->near_hole[copies.original[t]];
  }
  parts_->gaps = found.gaps;
  for (Gap& gap : parts_->gaps) {
    for (GapEdge& edge : gap.edges) edge.triangle = source[edge.triangle];
  }
  for (const std::uint32_t t : found.intersecting) parts_->intersecting.push_back(source[t]);
  const ClusteredOctree& boundary = found.exposed ? found.exposed->tree : tree;
  parts_->exposed = std::make_unique<ExposedSurface>(boundary);
  for (std::uint32_t t = 0; t < boundary.mesh().triangleCount(); ++t) {
    parts_->exposed->source.push_back(source[single.sourceOf(t)]);
    parts_->exposed->share.push_back(found.exposed                            ? found.exposed->share[t]
                                     : single.role(t) == TriangleRole::inward ? -1.0
                                                                              : 1.0);
  }
}

/// Whether two triangles with the same corners face the same way.
bool SolidSearch::areSameWay(std::uint32_t a, std::uint32_t b) const {
  const auto &of_a = surface_.corners(a), &of_b = surface_.corners(b);
  const auto first = static_cast<std::size_t>(std::ranges::find(of_b, of_a[0]) - of_b.begin());
  return of_b[(first + 1) % 3] == of_a[1];
}

/// Whether two triangles near each other may cut one another. Most share a corner, where surfaces touch.
bool SolidSearch::mayCut(std::uint32_t a, std::uint32_t b) const {
  const auto &of_a = surface_.corners(a), &of_b = surface_.corners(b);
  const Triangle first = mesh_.triangle(a), second = mesh_.triangle(b);
  const Vec3 normal = scaledNormal(first), other_normal = scaledNormal(second);
  std::array<bool, 3> is_shared_by_a{}, is_shared_by_b{};
  int shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (of_a[i] != of_b[j]) continue;
      is_shared_by_a[i] = is_shared_by_b[j] = true;
      ++shared;
    }
  }
  if (shared == 0) return hasArea(a) && hasArea(b);
  // Across an edge, triangles overlap only if one is folded onto the other.
  if (shared >= 2 && normal.dot(other_normal) > 0.0) {
    const auto i =
        static_cast<std::size_t>(std::ranges::find(is_shared_by_a, false) - is_shared_by_a.begin());
    const auto j =
        static_cast<std::size_t>(std::ranges::find(is_shared_by_b, false) - is_shared_by_b.begin());
    if (i < 3 && j < 3 && of_a[(i + 1) % 3] == of_b[(j + 2) % 3]) return false;
  }
  // Else the corners that are not shared lie on both sides of the other's plane, or in it.
  const auto isOnOneSide = [&](const Triangle& of, const std::array<bool, 3>& is_shared,
                               const Triangle& plane, const Vec3& up) {
    const double near = tolerance_ * up.norm();
    bool above = true, below = true;
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_shared[i]) continue;
      const double height = up.dot(of[i] - plane[0]);
      above &= height > near;
      below &= height < -near;
    }
    return above || below;
  };
  return !isOnOneSide(second, is_shared_by_b, first, normal) &&
         !isOnOneSide(first, is_shared_by_a, second, other_normal) && hasArea(a) && hasArea(b);
}

void SolidSearch::findCuts() {
  forEachCandidatePairWithin(treeOf(surface_.tree()), [&](const CandidatePair& pair) {
    const auto [a, b] = pair.triangles;
    if (!mayCut(a, b)) return;
    const Triangle first = mesh_.triangle(a), second = mesh_.triangle(b);
    if (cuts(second, first, tolerance_)) cuts_.push_back({a, b});
    if (cuts(first, second, tolerance_)) cuts_.push_back({b, a});
    noteSeams(a, b);
    noteSeams(b, a);
  });
  std::ranges::sort(seams_);
  std::ranges::sort(cuts_);
  for (const TrianglePair& cut : cuts_) {
    if (parts_->intersecting.empty() || parts_->intersecting.back() != cut.a)
      parts_->intersecting.push_back(cut.a);
  }
}

/// Notes the edges of a triangle that lie on another one. An edge that both share is no seam by itself.
void SolidSearch::noteSeams(std::uint32_t of, std::uint32_t beside) {
  const Triangle triangle = mesh_.triangle(of), other = mesh_.triangle(beside);
  const auto& corners = surface_.corners(beside);
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const auto [from, to] = edgeOf(of, edge);
    if (std::ranges::count(corners, from) > 0 && std::ranges::count(corners, to) > 0) continue;
    if (liesAlong(other, triangle[edge], triangle[(edge + 1) % 3], tolerance_)) seams_.emplace_back(from, to);
  }
}

/// The only other triangle at an edge, if it continues the surface there and nothing else meets it.
std::uint32_t SolidSearch::acrossEdge(std::uint32_t triangle, std::size_t edge) const {
  const auto& corners = surface_.corners(triangle);
  const std::uint32_t from = corners[edge], to = corners[(edge + 1) % 3];
  if (std::ranges::binary_search(seams_, edgeOf(triangle, edge))) return kNoTriangle;
  std::uint32_t found = kNoTriangle;
  for (const std::uint32_t other : surface_.star(from)) {
    if (other == triangle || other == found) continue;
    const auto& of_other = surface_.corners(other);
    const auto at = static_cast<std::size_t>(std::ranges::find(of_other, to) - of_other.begin());
    if (at == 3) continue;
    if (found != kNoTriangle || of_other[(at + 1) % 3] != from) return kNoTriangle;
    found = other;
  }
  return found;
}

void SolidSearch::findRegions() {
  std::vector<char> seen(mesh_.triangleCount(), 0);
  for (const std::uint32_t cut : parts_->intersecting) seen[cut] = 1;
  for (std::uint32_t first = 0; first < seen.size(); ++first) {
    if (seen[first] != 0) continue;
    Region region = {first};
    seen[first] = 1;
    for (std::size_t next = 0; next < region.size(); ++next) {
      for (std::size_t edge = 0; edge < 3; ++edge) {
        const std::uint32_t other = acrossEdge(region[next], edge);
        if (other == kNoTriangle || seen[other] != 0) continue;
        seen[other] = 1;
        region.push_back(other);
      }
    }
    regions_.push_back(std::move(region));
  }
}

Sides SolidSearch::sidesOf(const Vec3& middle, const Vec3& normal) const {
  // A step farther if another part of the surface is exactly there.
  const auto beside = [&](double sign) {
    for (double step = tolerance_; step < 16.0 * tolerance_; step *= 2.0) {
      if (const auto number = parts_->winding.closedAt(middle + sign * step * normal)) return *number;
    }
    return 0;
  };
  return {beside(1.0), beside(-1.0)};
}

void SolidSearch::judgeRegions() {
  sides_of_region_.resize(regions_.size());
  parallelFor(regions_.size(), threads_, [&](std::size_t r, std::size_t) {
    const std::uint32_t largest = *std::ranges::max_element(
        regions_[r], {}, [&](std::uint32_t t) { return scaledNormal(mesh_.triangle(t)).squaredNorm(); });
    if (!hasArea(largest)) return;
    const Triangle triangle = mesh_.triangle(largest);
    sides_of_region_[r] = sidesOf(centroidOf(triangle), unitNormal(triangle));
    for (const std::uint32_t t : regions_[r]) roles_[t] = sides_of_region_[r].role();
  });
}

void SolidSearch::judgePieces() {
  const std::vector<std::uint32_t>& triangles = parts_->intersecting;
  pieces_.resize(triangles.size());
  sides_of_pieces_.resize(triangles.size());
  parallelFor(triangles.size(), threads_, [&](std::size_t i, std::size_t) {
    const Triangle triangle = mesh_.triangle(triangles[i]);
    pieces_[i] = {TrianglePiece(triangle.begin(), triangle.end())};
    for (const TrianglePair& cut : std::ranges::equal_range(cuts_, triangles[i], {}, &TrianglePair::a)) {
      cutAlong(mesh_.triangle(cut.b), pieces_[i], tolerance_);
    }
    std::array<double, 4> area{};  // per role
    for (const TrianglePiece& piece : pieces_[i]) {
      Vec3 middle = Vec3::Zero();
      for (const Vec3& corner : piece) middle += corner / static_cast<double>(piece.size());
      const Sides sides = sidesOf(middle, unitNormal(triangle));
      sides_of_pieces_[i].push_back(sides);
      for (std::size_t corner = 2; corner < piece.size(); ++corner) {
        area[static_cast<std::size_t>(sides.role())] +=
            scaledNormal({piece[0], piece[corner - 1], piece[corner]}).norm();
      }
    }
    const auto areaOf = [&](TriangleRole role) { return area[static_cast<std::size_t>(role)]; };
    TriangleRole& role = roles_[triangles[i]];
    role = areaOf(TriangleRole::inward) > areaOf(TriangleRole::outward) ? TriangleRole::inward
           : areaOf(TriangleRole::outward) > 0.0                        ? TriangleRole::outward
           : areaOf(TriangleRole::inner) > 0.0                          ? TriangleRole::inner
                                                                        : TriangleRole::sheet;
  });
}

/// Finds the triangles that see holes of their component. A gap inside the solid is no hole.
void SolidSearch::findHoles() {
  std::map<std::uint32_t, std::vector<Triangle>> caps;                           // by component
  std::vector<double> missing(surface_.componentCount(), 0.0), areas = missing;  // twice the areas
  for (Gap& gap : parts_->gaps) {
    if (gap.cap.empty()) continue;
    const Triangle& largest = *std::ranges::max_element(
        gap.cap, {}, [](const Triangle& t) { return scaledNormal(t).squaredNorm(); });
    if (scaledNormal(largest).isZero(0.0)) continue;
    const Sides sides = sidesOf(centroidOf(largest), unitNormal(largest));
    // Where the mesh turns inside out, the winding number passes 0 in the gap.
    gap.is_inner = sides.role() == TriangleRole::inner && (sides.front > 0) == (sides.back > 0);
    if (gap.is_inner) continue;
    auto& of_component = caps[componentOf(gap)];
    of_component.insert(of_component.end(), gap.cap.begin(), gap.cap.end());
    // The cap of a narrow gap may fold back on itself, so its triangles' areas say nothing.
    Vec3 area_vector = Vec3::Zero();
    for (const Triangle& triangle : gap.cap) area_vector += scaledNormal(triangle);
    missing[componentOf(gap)] += area_vector.norm();
  }
  sees_hole_.assign(roles_.size(), 0);
  if (caps.empty()) return;
  for (std::uint32_t t = 0; t < roles_.size(); ++t)
    areas[componentOf(t)] += scaledNormal(mesh_.triangle(t)).norm();
  parts_->near_hole.assign(roles_.size(), 0);
  std::map<std::uint32_t, WindingShare> holes;
  for (auto& [component, triangles] : caps) holes.try_emplace(component, std::move(triangles));
  parallelForChunks(sees_hole_.size(), 1024, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto of_component = holes.find(componentOf(t));
      if (of_component == holes.end() || isThin(mesh_.triangle(t))) continue;
      const auto& [component, share] = *of_component;
      const auto lacks = [&](double limit) {
        return missing[component] > limit * areas[component] ||
               share.exceeds(limit, centroidOf(mesh_.triangle(t)));
      };
      parts_->near_hole[t] = lacks(kEntranceShare);
      sees_hole_[t] = parts_->near_hole[t] != 0 && lacks(kHoleShare);
    }
  });
  for (Gap& gap : parts_->gaps) {
    if (gap.is_inner || !holes.contains(componentOf(gap))) continue;
    const WindingShare cap(gap.cap);
    const auto isSeenFrom = [&](const Vec3& point) { return cap.exceeds(kEntranceShare, point); };
    for (const GapEdge& edge : gap.edges) {
      const Triangle triangle = mesh_.triangle(edge.triangle);
      if (isThin(triangle)) continue;
      const Vec3 normal = unitNormal(triangle), along = edge.to - edge.from;
      // Over the middle of the edge, a quarter of the triangle's height away from it.
      const double off = 0.25 * scaledNormal(triangle).norm() / along.norm();
      const Vec3 middle = 0.5 * (edge.from + edge.to);
      const bool sees_it = isSeenFrom(middle + off * normal) || isSeenFrom(middle - off * normal) ||
                           (parts_->near_hole[edge.triangle] != 0 && isSeenFrom(centroidOf(triangle)));
      if (!sees_it) continue;
      gap.is_hole = true;
      sees_hole_[edge.triangle] = parts_->near_hole[edge.triangle] = 1;
    }
  }
  has_holes_ = std::ranges::find(parts_->near_hole, 1) != parts_->near_hole.end();
}

bool SolidSearch::isExposedAsItIs() const {
  for (std::uint32_t t = 0; t < roles_.size(); ++t) {
    if (roles_[t] == TriangleRole::inner && hasArea(t)) return false;
  }
  return parts_->intersecting.empty();
}

void SolidSearch::expose() {
  if (isExposedAsItIs()) return;
  std::vector<Vec3> vertices = mesh_.vertices();
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<std::uint32_t> source;
  std::vector<double> share;
  const auto add = [&](const TriangleMesh::Indices& indices, std::uint32_t t, const Sides& sides) {
    triangles.push_back(indices);
    source.push_back(t);
    const bool is_sheet = roles_[t] == TriangleRole::sheet || sides.front == sides.back;
    share.push_back(is_sheet ? 0.0 : 1.0 / (sides.back - sides.front));
    if (sides.role() == TriangleRole::inward) share.back() = -share.back();
  };
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    for (const std::uint32_t t : regions_[r]) {
      if (roles_[t] != TriangleRole::inner) add(mesh_.triangles()[t], t, sides_of_region_[r]);
    }
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    for (std::size_t p = 0; p < pieces_[i].size(); ++p) {
      if (sides_of_pieces_[i][p].role() == TriangleRole::inner) continue;
      const auto first = static_cast<std::uint32_t>(vertices.size());
      const TrianglePiece& piece = pieces_[i][p];
      vertices.insert(vertices.end(), piece.begin(), piece.end());
      for (std::uint32_t corner = 2; corner < piece.size(); ++corner) {
        add({first, first + corner - 1, first + corner}, parts_->intersecting[i], sides_of_pieces_[i][p]);
      }
    }
  }
  if (triangles.empty()) return;
  auto boundary = std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
  parts_->exposed =
      std::make_unique<ExposedSurface>(ClusteredOctree::build(std::move(boundary), {.threads = threads_}));
  parts_->exposed->source = std::move(source);
  parts_->exposed->share = std::move(share);
}

}  // namespace

std::shared_ptr<const SolidParts> SolidParts::of(Surface& surface, int threads) {
  SolidSearch search(surface, threads);
  std::shared_ptr<SolidParts> parts = search.find();
  surface.oriented_ = search.isOriented();
  surface.whole_ = search.hasNoDefect();
  surface.roles_ = search.takeRoles();
  const auto bounds = [](TriangleRole role) {
    return role == TriangleRole::outward || role == TriangleRole::inward;
  };
  surface.closed_ = std::ranges::any_of(surface.roles_, bounds) && !search.hasHoles();
  if (std::ranges::all_of(surface.roles_, [](TriangleRole role) { return role == TriangleRole::outward; }))
    surface.roles_.clear();
  if (parts->exposed) {
    parts->exposed->surface.reset(new Surface(parts->exposed->tree, Surface::OnlyConnected()));
  }
  return parts;
}

}  // namespace octoblisk::detail
