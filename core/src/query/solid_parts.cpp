#include "query/solid_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/no_index.h"
#include "base/parallel.h"
#include "geometry/triangle_pieces.h"
#include "query/candidate_pairs.h"
#include "query/copies.h"
#include "query/holes.h"
#include "query/sides.h"
#include "query/surface_edges.h"
#include "query/touching_distance.h"

namespace octoblisk::detail {
namespace {

/// Triangles side by side, with nothing that meets the surface between them: one role fits all.
using Region = std::vector<std::uint32_t>;

Gap gapOf(const OpenLoop& loop, std::span<const Vec3> positions) {
  Gap gap;
  for (const OpenEdge& edge : loop)
    gap.edges.push_back({positions[edge.from], positions[edge.to], edge.triangle});
  gap.cap = capOf(outlineOf(loop), positions);
  return gap;
}

std::vector<std::vector<Triangle>> capsOf(std::span<const Gap> gaps) {
  std::vector<std::vector<Triangle>> caps;
  for (const Gap& gap : gaps) caps.push_back(gap.cap);
  return caps;
}

class SolidSearch {
 public:
  SolidSearch(const Surface& surface, int threads)
      : surface_(surface),
        mesh_(surface.tree().mesh()),
        threads_(threads),
        tolerance_(touchingDistance(mesh_)) {}

  std::shared_ptr<SolidParts> find() {
    findEdges();
    roles_.assign(mesh_.triangleCount(), TriangleRole::inner);
    const Copies copies = is_manifold_ ? Copies() : findCopies(surface_);
    if (copies.are_left_out) {
      judgeByOriginals(copies);
      parts_->copies = copies.triangles;
      return parts_;
    }
    const std::vector<Vec3> positions = cornerPositions();
    std::vector<Gap> gaps;
    for (const OpenLoop& loop : openLoops(open_edges_, positions)) gaps.push_back(gapOf(loop, positions));
    parts_ = std::make_shared<SolidParts>(Winding(surface_.tree(), capsOf(gaps)));
    parts_->gaps = std::move(gaps);
    parts_->copies = copies.triangles;
    Holes holes = findHoles(surface_, parts_->winding, parts_->gaps, threads_);
    parts_->near_hole = std::move(holes.near_hole);
    has_holes_ = std::ranges::find(parts_->near_hole, 1) != parts_->near_hole.end();
    if (!holes.sees_hole.empty() && std::ranges::find(holes.sees_hole, 0) == holes.sees_hole.end()) {
      roles_.assign(roles_.size(), TriangleRole::sheet);
      return parts_;
    }
    findCuts();
    findRegions();
    judgeRegions();
    judgePieces();
    for (std::size_t t = 0; t < holes.sees_hole.size(); ++t) {
      if (holes.sees_hole[t] != 0 && roles_[t] != TriangleRole::inner) roles_[t] = TriangleRole::sheet;
    }
    buildBoundary();
    return parts_;
  }

  bool isOriented() const { return open_edges_.empty(); }
  bool hasNoDefect() const {
    return is_manifold_ && isOriented() && parts_->intersecting.empty() && !parts_->boundary &&
           std::ranges::find(roles_, TriangleRole::sheet) == roles_.end();
  }
  bool hasHoles() const { return has_holes_; }
  std::vector<TriangleRole> takeRoles() { return std::move(roles_); }

 private:
  std::vector<Vec3> cornerPositions() const;
  void findEdges();
  void judgeByOriginals(const Copies& copies);
  void findCuts();
  void findRegions();
  void judgeRegions();
  void judgePieces();
  void buildBoundary();

  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // corners, the lower one first
  Edge edgeOf(std::uint32_t triangle, std::size_t edge) const {
    return std::minmax({surface_.corners(triangle)[edge], surface_.corners(triangle)[(edge + 1) % 3]});
  }
  void noteSeams(std::uint32_t of, std::uint32_t beside);
  bool mayCut(std::uint32_t a, std::uint32_t b) const;
  bool isBoundaryAsItIs() const;

  const Surface& surface_;
  const TriangleMesh& mesh_;
  int threads_;
  double tolerance_;  // a length
  std::shared_ptr<SolidParts> parts_;
  bool is_manifold_ = true;  // each edge belongs to two triangles in opposite directions, or to one
  std::vector<OpenEdge> open_edges_;
  std::vector<std::array<std::uint32_t, 3>>
      across_;  // per triangle and edge: the only other one, if opposite
  bool has_holes_ = false;
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
  across_.assign(mesh_.triangleCount(), {kNoTriangle, kNoTriangle, kNoTriangle});
  const auto acrossEdge = [&](std::uint32_t triangle, std::uint32_t from) -> std::uint32_t& {
    const auto& corners = surface_.corners(triangle);
    return across_[triangle][static_cast<std::size_t>(std::ranges::find(corners, from) - corners.begin())];
  };
  const auto isLeftOut = [](std::uint32_t) { return false; };
  forEachEdge(surface_, isLeftOut, [&](std::uint32_t corner, std::span<const EdgeUse> uses) {
    const std::uint32_t other = uses[0].other;
    std::ptrdiff_t balance = 0;
    for (const EdgeUse& use : uses) balance += use.is_forward ? 1 : -1;
    is_manifold_ &= uses.size() == 1 || (uses.size() == 2 && balance == 0);
    if (uses.size() == 2 && balance == 0) {
      acrossEdge(uses[0].triangle, uses[0].is_forward ? corner : other) = uses[1].triangle;
      acrossEdge(uses[1].triangle, uses[1].is_forward ? corner : other) = uses[0].triangle;
    }
    for (auto use = uses.rbegin(); balance != 0; ++use) {
      if (use->is_forward != (balance > 0)) continue;
      balance += use->is_forward ? -1 : 1;
      open_edges_.push_back(
          {use->is_forward ? corner : other, use->is_forward ? other : corner, use->triangle});
    }
  });
}

/// Gives each triangle the role that it has if its copies are left out.
void SolidSearch::judgeByOriginals(const Copies& copies) {
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<std::uint32_t> source;
  std::vector<signed char> counts(mesh_.triangleCount(), 0);
  for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
    if (copies.original[t] != t) continue;
    counts[t] = copies.count[t];
    triangles.push_back(mesh_.triangles()[t]);
    if (counts[t] < 0) std::swap(triangles.back()[1], triangles.back()[2]);
    source.push_back(t);
  }
  auto reduced = std::make_shared<const TriangleMesh>(mesh_.vertices(), std::move(triangles));
  const ClusteredOctree tree = ClusteredOctree::build(std::move(reduced), {.threads = threads_});
  const Surface single(tree, threads_);
  const SolidParts& found = single.solidParts();
  parts_ = std::make_shared<SolidParts>(Winding(surface_.tree(), capsOf(found.gaps), std::move(counts)));
  const auto reversed = [](TriangleRole role) {
    return role == TriangleRole::outward  ? TriangleRole::inward
           : role == TriangleRole::inward ? TriangleRole::outward
                                          : role;
  };
  for (std::uint32_t t = 0; t < source.size(); ++t)
    roles_[source[t]] = copies.count[source[t]] > 0 ? single.role(t) : reversed(single.role(t));
  if (!found.near_hole.empty()) parts_->near_hole.resize(roles_.size());
  for (std::uint32_t t = 0; t < found.near_hole.size(); ++t)
    parts_->near_hole[source[t]] = found.near_hole[t];
  for (std::uint32_t t = 0; t < roles_.size(); ++t) {
    const std::uint32_t original = copies.original[t];
    if (original == t) continue;
    roles_[t] = areSameWay(surface_, t, original) ? roles_[original] : reversed(roles_[original]);
    if (!found.near_hole.empty()) parts_->near_hole[t] = parts_->near_hole[original];
  }
  has_holes_ = !single.isClosed();
  parts_->gaps = found.gaps;
  for (Gap& gap : parts_->gaps) {
    for (GapEdge& edge : gap.edges) edge.triangle = source[edge.triangle];
  }
  for (const std::uint32_t t : found.intersecting) parts_->intersecting.push_back(source[t]);
  const ClusteredOctree& of_boundary = found.boundary ? found.boundary->tree : tree;
  parts_->boundary = std::make_unique<BoundarySurface>(of_boundary);
  for (std::uint32_t t = 0; t < of_boundary.mesh().triangleCount(); ++t) {
    parts_->boundary->source.push_back(source[single.sourceOf(t)]);
    parts_->boundary->share.push_back(found.boundary                           ? found.boundary->share[t]
                                      : single.role(t) == TriangleRole::inward ? -1.0
                                                                               : 1.0);
  }
}

/// Whether two triangles near each other may cut one another, or have a seam. Most share corners, where
/// surfaces touch.
bool SolidSearch::mayCut(std::uint32_t a, std::uint32_t b) const {
  const auto &of_a = surface_.corners(a), &of_b = surface_.corners(b);
  std::size_t i = 0, j = 0, shared = 0;  // corners i of A and j of B are the same
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t l = 0; l < 3; ++l) {
      if (of_a[k] != of_b[l]) continue;
      i = k, j = l;
      ++shared;
    }
  }
  const Triangle first = mesh_.triangle(a), second = mesh_.triangle(b);
  if (shared == 1 && meetOnlyAt(first[i], {first[(i + 1) % 3], first[(i + 2) % 3]},
                                {second[(j + 1) % 3], second[(j + 2) % 3]}, tolerance_))
    return false;
  // Across an edge, triangles overlap only if one is folded onto the other, in one plane.
  if (shared == 2) {
    const bool is_next = of_a[(i + 1) % 3] == of_b[(j + 2) % 3],
               is_last = of_a[(i + 2) % 3] == of_b[(j + 1) % 3];
    const Vec3 up = scaledNormal(first), other_up = scaledNormal(second);
    if ((is_next || is_last) && up.dot(other_up) > 0.0) return false;
    const auto isOffPlane = [&](const Triangle& of, const Triangle& plane, const Vec3& normal) {
      const double near = tolerance_ * normal.norm();
      return std::ranges::any_of(of,
                                 [&](const Vec3& p) { return std::abs(normal.dot(p - plane[0])) > near; });
    };
    if (isOffPlane(second, first, up) || isOffPlane(first, second, other_up)) return false;
  }
  return hasArea(first, tolerance_) && hasArea(second, tolerance_);
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

void SolidSearch::findRegions() {
  std::vector<char> seen(mesh_.triangleCount(), 0);
  for (const std::uint32_t cut : parts_->intersecting) seen[cut] = 1;
  for (std::uint32_t first = 0; first < seen.size(); ++first) {
    if (seen[first] != 0) continue;
    Region region = {first};
    seen[first] = 1;
    for (std::size_t next = 0; next < region.size(); ++next) {
      for (std::size_t edge = 0; edge < 3; ++edge) {
        const std::uint32_t other = across_[region[next]][edge];
        if (other == kNoTriangle || seen[other] != 0) continue;
        if (std::ranges::binary_search(seams_, edgeOf(region[next], edge))) continue;
        seen[other] = 1;
        region.push_back(other);
      }
    }
    regions_.push_back(std::move(region));
  }
}

void SolidSearch::judgeRegions() {
  sides_of_region_.resize(regions_.size());
  parallelFor(regions_.size(), threads_, [&](std::size_t r, std::size_t) {
    const std::uint32_t largest = *std::ranges::max_element(
        regions_[r], {}, [&](std::uint32_t t) { return scaledNormal(mesh_.triangle(t)).squaredNorm(); });
    const Triangle triangle = mesh_.triangle(largest);
    if (!hasArea(triangle, tolerance_)) return;
    sides_of_region_[r] = sidesOf(parts_->winding, centroidOf(triangle), unitNormal(triangle), tolerance_);
    for (const std::uint32_t t : regions_[r]) roles_[t] = sides_of_region_[r].role();
  });
}

void SolidSearch::judgePieces() {
  const std::vector<std::uint32_t>& triangles = parts_->intersecting;
  pieces_.resize(triangles.size());
  sides_of_pieces_.resize(triangles.size());
  std::vector<char> is_tangled(triangles.size(), 0);
  parallelFor(triangles.size(), threads_, [&](std::size_t i, std::size_t) {
    const Triangle triangle = mesh_.triangle(triangles[i]);
    std::vector<Triangle> others;
    for (const TrianglePair& cut : std::ranges::equal_range(cuts_, triangles[i], {}, &TrianglePair::a))
      others.push_back(mesh_.triangle(cut.b));
    auto pieces = piecesBetween(triangle, std::move(others), tolerance_);
    if (!pieces) {  // bodies can touch all of it
      pieces_[i] = {TrianglePiece(triangle.begin(), triangle.end())};
      sides_of_pieces_[i] = {Sides()};
      roles_[triangles[i]] = TriangleRole::sheet;
      is_tangled[i] = 1;
      return;
    }
    pieces_[i] = std::move(*pieces);
    std::array<double, 4> area{};  // per role
    for (const TrianglePiece& piece : pieces_[i]) {
      const Sides sides = sidesOf(parts_->winding, middleOf(piece), unitNormal(triangle), tolerance_);
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
  has_holes_ |= std::ranges::find(is_tangled, 1) != is_tangled.end();
}

bool SolidSearch::isBoundaryAsItIs() const {
  for (std::uint32_t t = 0; t < roles_.size(); ++t) {
    if (roles_[t] == TriangleRole::inner && hasArea(mesh_.triangle(t), tolerance_)) return false;
  }
  return parts_->intersecting.empty();
}

void SolidSearch::buildBoundary() {
  if (isBoundaryAsItIs()) return;
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
  parts_->boundary =
      std::make_unique<BoundarySurface>(ClusteredOctree::build(std::move(boundary), {.threads = threads_}));
  parts_->boundary->source = std::move(source);
  parts_->boundary->share = std::move(share);
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
  if (parts->boundary) {
    parts->boundary->surface.reset(new Surface(parts->boundary->tree, Surface::OnlyConnected()));
  }
  return parts;
}

}  // namespace octoblisk::detail
