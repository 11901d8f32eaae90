#include "query/holes.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/parallel.h"
#include "geometry/thin_triangle.h"
#include "geometry/triangle_pieces.h"
#include "octoblisk/distance.h"
#include "octoblisk/triangles_in_box.h"
#include "query/sides.h"
#include "query/touching_distance.h"

namespace octoblisk::detail {
namespace {

/// The greatest share of all directions in which a triangle of a solid may see holes: with up to a quarter,
/// the winding number is nearer to 0 before the triangle and to 1 behind it than to 1/2. Also the greatest
/// share of its area that a component with holes may lack, because a triangle sees about that share on
/// average.
constexpr double kHoleShare = 1.0 / 4.0;

/// The same for SolidParts::near_hole. From inside an open box that is up to four times as deep as it is
/// wide, the opening takes up more than this.
constexpr double kEntranceShare = 1.0 / 64.0;

class HoleSearch {
 public:
  HoleSearch(const Surface& surface, const Winding& winding, std::span<Gap> gaps, int threads)
      : surface_(surface),
        mesh_(surface.tree().mesh()),
        winding_(winding),
        gaps_(gaps),
        threads_(threads),
        tolerance_(touchingDistance(mesh_)) {}

  Holes find();

 private:
  bool isHidden(const Vec3& point, const Vec3& normal) const;
  bool isInside(const GapEdge& edge) const;
  bool isClosedByOthers(const GapEdge& edge) const;
  std::vector<Triangle> visibleCap(const Gap& gap) const;
  std::uint32_t componentOf(std::size_t triangle) const {
    return surface_.component(surface_.corners(static_cast<std::uint32_t>(triangle))[0]);
  }
  std::uint32_t componentOf(const Gap& gap) const { return componentOf(gap.edges.front().triangle); }

  const Surface& surface_;
  const TriangleMesh& mesh_;
  const Winding& winding_;
  std::span<Gap> gaps_;
  int threads_;
  double tolerance_;  // a length
};

/// Whether the surface through a point with this normal is inside the solid there.
bool HoleSearch::isHidden(const Vec3& point, const Vec3& normal) const {
  const Sides sides = sidesOf(winding_, point, normal, tolerance_);
  // Where the mesh turns inside out, the winding number passes 0 in the gap.
  return sides.role() == TriangleRole::inner && (sides.front > 0) == (sides.back > 0);
}

/// Whether the middle of an open edge is inside the solid.
bool HoleSearch::isInside(const GapEdge& edge) const {
  const Vec3 middle = 0.5 * (edge.from + edge.to), along = edge.to - edge.from;
  // Turned by some angle, because the triangle at the edge may be axis-aligned.
  const Vec3 aside = Eigen::AngleAxisd(1.0, along.normalized()) * along.unitOrthogonal();
  return isHidden(middle, aside) && isHidden(middle, along.cross(aside).normalized());
}

/// Whether another component is so near to the middle of an open edge that what is between them is a crack:
/// the triangle at the edge sees it in about kEntranceShare of all directions or less.
bool HoleSearch::isClosedByOthers(const GapEdge& edge) const {
  const double height = scaledNormal(mesh_.triangle(edge.triangle)).norm() / (edge.to - edge.from).norm();
  const double near = kEntranceShare * height;
  const Vec3 middle = 0.5 * (edge.from + edge.to);
  return forEachTriangleIn(surface_.tree(), {.center = middle}, near, [&](std::uint32_t t) {
    return componentOf(t) != componentOf(edge.triangle) && distance(mesh_.triangle(t), middle) <= near;
  });
}

/// The part of a gap's cap that is not inside the solid. All of it if no edge of the gap is inside, even if
/// something passes through it. Nothing if others close the gap all around: then the rest of the cap is in a
/// pocket between both.
std::vector<Triangle> HoleSearch::visibleCap(const Gap& gap) const {
  if (std::ranges::all_of(gap.edges, [&](const GapEdge& e) { return isClosedByOthers(e) || isInside(e); }))
    return {};
  if (std::ranges::none_of(gap.edges, [&](const GapEdge& e) { return isInside(e); })) return gap.cap;
  std::vector<Triangle> visible;
  for (const Triangle& triangle : gap.cap) {
    if (!hasArea(triangle, tolerance_)) continue;
    Aabb bounds;
    for (const Vec3& corner : triangle) bounds.extend(corner);
    const Obb box{.center = bounds.center(), .half_extents = bounds.halfExtents()};
    std::vector<Triangle> others;
    forEachTriangleIn(surface_.tree(), box, tolerance_, [&](std::uint32_t t) {
      const Triangle other = mesh_.triangle(t);
      if (hasArea(other, tolerance_) && cuts(other, triangle, tolerance_)) others.push_back(other);
      return false;
    });
    const auto pieces = piecesBetween(triangle, std::move(others), tolerance_);
    if (!pieces) visible.push_back(triangle);
    for (const TrianglePiece& piece : pieces.value_or(std::vector<TrianglePiece>())) {
      if (isHidden(middleOf(piece), unitNormal(triangle))) continue;
      for (std::size_t corner = 2; corner < piece.size(); ++corner)
        visible.push_back({piece[0], piece[corner - 1], piece[corner]});
    }
  }
  return visible;
}

Holes HoleSearch::find() {
  std::vector<std::vector<Triangle>> visible(gaps_.size());                      // parts of caps
  std::map<std::uint32_t, std::vector<std::vector<Triangle>>> caps;              // the same by component
  std::vector<double> missing(surface_.componentCount(), 0.0), areas = missing;  // twice the areas
  for (std::size_t i = 0; i < visible.size(); ++i) {
    Gap& gap = gaps_[i];
    if (std::ranges::none_of(gap.cap, [&](const Triangle& t) { return hasArea(t, tolerance_); })) continue;
    visible[i] = visibleCap(gap);
    if (visible[i].empty()) {
      gap.is_inner = std::ranges::any_of(gap.edges, [&](const GapEdge& edge) { return isInside(edge); });
      continue;
    }
    caps[componentOf(gap)].push_back(visible[i]);
    // The cap of a narrow gap may fold back on itself, so its triangles' areas say nothing.
    Vec3 area_vector = Vec3::Zero();
    for (const Triangle& triangle : visible[i]) area_vector += scaledNormal(triangle);
    missing[componentOf(gap)] += area_vector.norm();
  }
  Holes found;
  if (caps.empty()) return found;
  found.sees_hole.assign(mesh_.triangleCount(), 0);
  for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t)
    areas[componentOf(t)] += scaledNormal(mesh_.triangle(t)).norm();
  found.near_hole.assign(mesh_.triangleCount(), 0);
  std::map<std::uint32_t, WindingShare> holes;
  for (auto& [component, parts] : caps) holes.try_emplace(component, std::move(parts));
  parallelForChunks(found.sees_hole.size(), 1024, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto of_component = holes.find(componentOf(t));
      if (of_component == holes.end() || isThin(mesh_.triangle(t))) continue;
      const auto& [component, share] = *of_component;
      const auto lacks = [&](double limit) {
        return missing[component] > limit * areas[component] ||
               share.exceeds(limit, centroidOf(mesh_.triangle(t)));
      };
      found.near_hole[t] = lacks(kEntranceShare);
      found.sees_hole[t] = found.near_hole[t] != 0 && lacks(kHoleShare);
    }
  });
  for (std::size_t i = 0; i < visible.size(); ++i) {
    if (visible[i].empty()) continue;
    Gap& gap = gaps_[i];
    const WindingShare cap(std::vector<std::vector<Triangle>>{visible[i]});
    const auto isSeenFrom = [&](const Vec3& point) { return cap.exceeds(kEntranceShare, point); };
    for (const GapEdge& edge : gap.edges) {
      const Triangle triangle = mesh_.triangle(edge.triangle);
      if (isThin(triangle)) continue;
      const Vec3 normal = unitNormal(triangle), along = edge.to - edge.from;
      // Over the middle of the edge, a quarter of the triangle's height away from it.
      const double off = 0.25 * scaledNormal(triangle).norm() / along.norm();
      const Vec3 middle = 0.5 * (edge.from + edge.to);
      const bool sees_it = isSeenFrom(middle + off * normal) || isSeenFrom(middle - off * normal) ||
                           (found.near_hole[edge.triangle] != 0 && isSeenFrom(centroidOf(triangle)));
      if (!sees_it) continue;
      gap.is_hole = true;
      found.sees_hole[edge.triangle] = found.near_hole[edge.triangle] = 1;
    }
  }
  return found;
}

}  // namespace

Holes findHoles(const Surface& surface, const Winding& winding, std::span<Gap> gaps, int threads) {
  return HoleSearch(surface, winding, gaps, threads).find();
}

}  // namespace octoblisk::detail
