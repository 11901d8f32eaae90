#include "octoblisk/inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <utility>

#include "geometry/thin_triangle.h"
#include "query/gap_shape.h"
#include "query/solid_parts.h"
#include "query/surface_edges.h"
#include "query/touching_distance.h"

namespace octoblisk {

using namespace detail;

namespace {

/// The rounding of two points to floats, relative to their coordinates: of a corner, and of the line that it
/// is meant to be on.
constexpr double kFloatRounding = 0x1p-23;

class Inspector {
 public:
  explicit Inspector(const Surface& surface)
      : surface_(surface),
        mesh_(surface.tree().mesh()),
        parts_(surface.solidParts()),
        rounding_(touchingDistance(mesh_)) {}

  MeshInspection inspect() {
    found_.triangles = mesh_.triangleCount();
    found_.components = surface_.componentCount();
    found_.is_closed = surface_.isClosed();
    found_.mass = massProperties(surface_);
    findTriangles();
    findEdges();
    for (const Gap& gap : parts_.gaps) addGap(gap);
    countShells();
    for (std::uint32_t t = 0; t < mesh_.triangleCount() && !found_.pushes_out; ++t) {
      const bool is_near_hole = !parts_.near_hole.empty() && parts_.near_hole[t] != 0;
      found_.pushes_out = surface_.role(t) == TriangleRole::outward && !is_near_hole;
    }
    std::ranges::stable_sort(found_.gaps, {}, [](const MeshGap& g) { return std::pair(g.kind, -g.length); });
    for (auto* places : {&found_.t_junctions, &found_.shared_edges, &found_.opposed_edges})
      std::ranges::stable_sort(*places, {}, &DefectPlace::triangle);
    return std::move(found_);
  }

 private:
  using Ends = std::array<std::uint32_t, 2>;  // the corners of an edge, ascending

  void findTriangles();
  void findEdges();
  void addGap(const Gap& gap);
  void countShells();

  bool isFolded(std::uint32_t t) const;
  bool isTurned(const Gap& gap) const;
  DefectPlace placeOf(std::uint32_t t) const { return {t, centroidOf(mesh_.triangle(t))}; }

  const Surface& surface_;
  const TriangleMesh& mesh_;
  const SolidParts& parts_;
  double rounding_;  // a length
  MeshInspection found_;
  std::vector<bool> lies_on_others_;  // per triangle: those that are copies or intersect others, perhaps
  std::vector<Ends> opposed_;         // ascending
};

void Inspector::findTriangles() {
  lies_on_others_.assign(mesh_.triangleCount(), !parts_.copies.empty());
  for (const std::uint32_t t : parts_.intersecting) lies_on_others_[t] = true;
  for (const std::uint32_t t : parts_.intersecting) found_.intersecting.push_back(placeOf(t));
  for (const std::uint32_t t : parts_.copies) found_.copies.push_back(placeOf(t));
  for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
    const Triangle triangle = mesh_.triangle(t);
    if (!hasArea(triangle, rounding_)) {
      found_.zero_area.push_back(placeOf(t));
      continue;
    }
    const TriangleRole role = surface_.role(t);
    const bool bounds_solid = role == TriangleRole::outward || role == TriangleRole::inward;
    if (role == TriangleRole::inner) found_.inner.push_back(placeOf(t));
    if (role == TriangleRole::sheet) found_.sheets.push_back(placeOf(t));
    if (bounds_solid && isFolded(t)) {
      found_.folded.push_back(placeOf(t));
    } else if (role == TriangleRole::inward) {
      found_.inward.push_back(placeOf(t));
    }
  }
}

/// Whether a triangle that bounds a solid faces against the surface there: the winding number behind a
/// surface is by one greater than that before it. Only triangles that lie on others can do so.
bool Inspector::isFolded(std::uint32_t t) const {
  if (!lies_on_others_[t]) return false;
  const Triangle triangle = mesh_.triangle(t);
  const bool is_outward = surface_.role(t) == TriangleRole::outward;
  const double step = is_outward ? -rounding_ : rounding_;
  const auto in_solid = parts_.winding.closedAt(centroidOf(triangle) + step * unitNormal(triangle));
  return in_solid && (*in_solid > 0) != is_outward;
}

void Inspector::findEdges() {
  std::vector<bool> is_copy(mesh_.triangleCount(), false);
  for (const std::uint32_t t : parts_.copies) is_copy[t] = true;
  const auto isCopy = [&](std::uint32_t t) { return is_copy[t]; };
  forEachEdge(surface_, isCopy, [&](std::uint32_t corner, std::span<const EdgeUse> uses) {
    const std::uint32_t other = uses[0].other;
    const DefectPlace place{uses[0].triangle, 0.5 * (surface_.position(corner) + surface_.position(other))};
    if (uses.size() > 2) found_.shared_edges.push_back(place);
    if (uses.size() == 2 && uses[0].is_forward == uses[1].is_forward) {
      found_.opposed_edges.push_back(place);
      opposed_.push_back({corner, other});
    }
  });
}

/// Whether all edges of a gap are between triangles that face opposite ways.
bool Inspector::isTurned(const Gap& gap) const {
  return std::ranges::all_of(gap.edges, [&](const GapEdge& edge) {
    Ends ends{};
    for (const std::uint32_t corner : surface_.corners(edge.triangle)) {
      if (surface_.position(corner) == edge.from) ends[0] = corner;
      if (surface_.position(corner) == edge.to) ends[1] = corner;
    }
    std::ranges::sort(ends);
    return std::ranges::binary_search(opposed_, ends);
  });
}

void Inspector::addGap(const Gap& gap) {
  // Where caps left edges open between corners that are close to each other, no triangle has an edge.
  const Triangle beside = mesh_.triangle(gap.edges.front().triangle);
  const bool is_of_triangles = std::ranges::find(beside, gap.edges.front().from) != beside.end() &&
                               std::ranges::find(beside, gap.edges.front().to) != beside.end();
  if (!is_of_triangles && !gap.is_hole) return;

  MeshGap found = shapeOf(gap);
  const bool is_connected = found.outline.size() == gap.edges.size();
  if (gap.is_hole) {
    found.kind = isTurned(gap) ? GapKind::turned : GapKind::hole;
  } else {
    found.width = widthOf(found.outline);
    const bool has_width = found.width > kFloatRounding * mesh_.bounds().farthestFromOrigin();
    const bool is_t_junction = is_connected && !has_width;
    found.kind = is_t_junction ? GapKind::t_junction : gap.is_inner ? GapKind::inner : GapKind::crack;
  }
  if (found.kind == GapKind::t_junction) {
    const auto longest = std::ranges::max_element(
        gap.edges, {}, [](const GapEdge& edge) { return (edge.to - edge.from).squaredNorm(); });
    for (const Vec3& corner : straightCorners(found.outline))
      found_.t_junctions.push_back({longest->triangle, corner});
  }
  found_.gaps.push_back(std::move(found));
}

/// A shell's normals, if they face out of the solid, face away from what it encloses. A hollow's face towards
/// it.
void Inspector::countShells() {
  struct Component {
    double outward_area = 0.0, volume = 0.0;
    bool bounds_solid = false;
  };
  std::vector<Component> components(surface_.componentCount());
  const auto add = [&](std::uint32_t component, const Triangle& triangle) {
    const Vec3& from = surface_.position(surface_.cornerOfComponent(component));
    components[component].volume += (triangle[0] - from).dot((triangle[1] - from).cross(triangle[2] - from));
  };
  const auto componentOf = [&](std::uint32_t t) { return surface_.component(surface_.corners(t)[0]); };
  for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
    const Triangle triangle = mesh_.triangle(t);
    const std::uint32_t component = componentOf(t);
    add(component, triangle);
    const TriangleRole role = surface_.role(t);
    if (role != TriangleRole::outward && role != TriangleRole::inward) continue;
    components[component].bounds_solid = true;
    components[component].outward_area +=
        (role == TriangleRole::outward ? 1.0 : -1.0) * scaledNormal(triangle).norm();
  }
  for (const Gap& gap : parts_.gaps) {
    for (const Triangle& triangle : gap.cap) add(componentOf(gap.edges.front().triangle), triangle);
  }
  for (const Component& component : components) {
    if (!component.bounds_solid) continue;
    const bool is_shell = (component.volume > 0.0) == (component.outward_area > 0.0);
    ++(is_shell ? found_.shells : found_.hollows);
  }
}

std::string textOf(const Vec3& position) {
  constexpr double kNothing = 1e-9;  // relative to the other coordinates
  std::ostringstream text;
  const char* before = "(";
  for (const double value : position) {
    text << before << (std::abs(value) > kNothing * position.norm() ? value : 0.0);
    before = " ";
  }
  text << ')';
  return text.str();
}

std::string textOf(const DefectPlace& place) {
  return "triangle " + std::to_string(place.triangle) + " at " + textOf(place.position);
}

}  // namespace

std::size_t MeshInspection::count(GapKind kind) const {
  return static_cast<std::size_t>(std::ranges::count(gaps, kind, &MeshGap::kind));
}

std::size_t MeshInspection::openEdges(GapKind kind) const {
  std::size_t edges = 0;
  for (const MeshGap& gap : gaps) edges += gap.kind == kind ? gap.edges : 0;
  return edges;
}

bool MeshInspection::facesInward() const {
  constexpr std::size_t kFew = 64;
  const std::size_t others = zero_area.size() + inner.size() + sheets.size() + folded.size();
  return (triangles - others - inward.size()) * kFew < inward.size();
}

MeshInspection inspect(const Surface& surface) { return Inspector(surface).inspect(); }

std::string whyNotSolid(const MeshInspection& found) {
  if (found.isSolid()) return {};
  const std::string kSubject = "The mesh";
  std::string text = kSubject;
  const auto next = [&] { text += text == kSubject ? " " : ", and "; };
  if (const std::size_t holes = found.count(GapKind::hole); holes > 0) {
    const MeshGap& longest = *std::ranges::find(found.gaps, GapKind::hole, &MeshGap::kind);
    next();
    text += (holes == 1 ? "has a hole with " : "has " + std::to_string(holes) + " holes, the longest with ") +
            std::to_string(longest.edges) + " edges beside " +
            textOf(DefectPlace{longest.triangle, longest.center});
  }
  if (const std::size_t opposed = found.opposed_edges.size(); opposed > 0) {
    next();
    text += "has triangles that face opposite ways at " + std::to_string(opposed) +
            (opposed == 1 ? " edge, of " : " edges, the first of ") + textOf(found.opposed_edges.front());
  }
  if (const std::size_t inward = found.inward.size(); inward > 0) {
    next();
    text += found.facesInward() ? "faces inward: its triangles must be reversed"
                                : "has " + std::to_string(inward) +
                                      (inward == 1 ? " triangle that faces inward, "
                                                   : " triangles that face inward, the first ") +
                                      textOf(found.inward.front());
  }
  if (text == kSubject && !found.sheets.empty()) {
    next();
    const std::size_t sheets = found.sheets.size();
    text += !found.isAnywhereSolid()
                ? std::string("encloses no volume")
                : "has " + std::to_string(sheets) +
                      (sheets == 1 ? " triangle without a solid on either side, "
                                   : " triangles without a solid on either side, the first ") +
                      textOf(found.sheets.front());
  }
  if (text == kSubject)
    text +=
        found.is_closed ? " encloses no volume" : " has gaps that together lack more than 1/64 of its area";
  return text + '.';
}

}  // namespace octoblisk
