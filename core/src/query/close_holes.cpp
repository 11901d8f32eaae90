#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "geometry/polygon_triangles.h"
#include "octoblisk/inspection.h"
#include "query/gap_shape.h"
#include "query/solid_parts.h"

namespace octoblisk {

using namespace detail;

namespace {

/// A planar hole with the numbers of its corners in the mesh, in the direction of the triangles that fill it.
struct Hole {
  MeshGap shape;
  Ring corners;
  Vec3 normal = Vec3::Zero();
  std::optional<std::size_t> around;  // the hole that this one is an island in
};

/// Leaves out the coordinate along which a plane is seen best, so that left turns stay left turns.
class Projection {
 public:
  explicit Projection(const Vec3& normal) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    u_ = (axis + 1) % 3;
    v_ = (axis + 2) % 3;
    if (normal[axis] < 0.0) std::swap(u_, v_);
  }
  Vec2 operator()(const Vec3& point) const { return {point[u_], point[v_]}; }

 private:
  Eigen::Index u_ = 0, v_ = 1;
};

class HoleCloser {
 public:
  explicit HoleCloser(const Surface& surface)
      : surface_(surface), mesh_(surface.tree().mesh()), triangles_(mesh_.triangles()) {}

  ClosedMesh close() {
    findHoles();
    findIslands();
    for (std::size_t i = 0; i < holes_.size(); ++i) {
      if (!holes_[i].around) fill(i);
    }
    std::ranges::stable_sort(refused_, {}, &MeshGap::triangle);
    return {{mesh_.vertices(), std::move(triangles_)}, std::move(added_), std::move(refused_)};
  }

 private:
  void findHoles();
  void findIslands();
  void fill(std::size_t hole);
  bool isIn(const Hole& inner, const Hole& outer) const;

  const Surface& surface_;
  const TriangleMesh& mesh_;
  std::vector<TriangleMesh::Indices> triangles_;
  std::map<std::array<double, 3>, std::uint32_t> vertex_at_;  // those of triangles beside gaps
  std::vector<Hole> holes_;                                   // the greatest first
  std::vector<HoleCap> added_;
  std::vector<MeshGap> refused_;
};

std::array<double, 3> keyOf(const Vec3& p) { return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; }

void HoleCloser::findHoles() {
  for (const Gap& gap : surface_.solidParts().gaps) {
    for (const GapEdge& edge : gap.edges) {
      for (const std::uint32_t vertex : mesh_.triangles()[edge.triangle])
        vertex_at_.try_emplace(keyOf(mesh_.vertices()[vertex]), vertex);
    }
  }
  for (MeshGap& gap : inspect(surface_).gaps) {
    if (gap.kind != GapKind::hole) continue;
    if (!gap.is_planar) {
      refused_.push_back(std::move(gap));
      continue;
    }
    Hole& hole = holes_.emplace_back();
    for (auto corner = gap.outline.rbegin(); corner != gap.outline.rend(); ++corner)
      hole.corners.push_back(vertex_at_.at(keyOf(*corner)));
    hole.normal = -areaVector(gap.outline).normalized();
    hole.shape = std::move(gap);
  }
  std::ranges::stable_sort(holes_, {}, [](const Hole& hole) { return -hole.shape.area; });
}

/// Whether one hole is in the plane of another and within its outline.
bool HoleCloser::isIn(const Hole& inner, const Hole& outer) const {
  const double size = 2.0 * boundsOf(outer.shape.outline).halfExtents().norm();
  const auto isOff = [&](const Vec3& corner) {
    return std::abs(outer.normal.dot(corner - outer.shape.center)) > kPlanar * size;
  };
  if (std::ranges::any_of(inner.shape.outline, isOff)) return false;
  const Projection project(outer.normal);
  std::vector<Vec2> ring;
  for (const Vec3& corner : outer.shape.outline) ring.push_back(project(corner));
  return encloses(ring, project(inner.shape.outline.front()));
}

/// A missing ring leaves two holes: an outer one, and in it one that faces the other way.
void HoleCloser::findIslands() {
  for (std::size_t i = 0; i < holes_.size(); ++i) {
    for (std::size_t outer = i; outer-- > 0;) {  // the smallest first
      if (!isIn(holes_[i], holes_[outer])) continue;
      const bool is_opposite = holes_[i].normal.dot(holes_[outer].normal) < 0.0;
      if (is_opposite && !holes_[outer].around) holes_[i].around = outer;
      break;
    }
  }
}

void HoleCloser::fill(std::size_t hole) {
  std::vector<const Hole*> outlines = {&holes_[hole]};
  for (const Hole& other : holes_) {
    if (other.around == hole) outlines.push_back(&other);
  }
  const Projection project(holes_[hole].normal);
  std::vector<std::uint32_t> vertex;
  std::vector<Vec2> points;
  std::vector<Ring> rings;
  for (const Hole* const outline : outlines) {
    Ring& ring = rings.emplace_back();
    for (const std::uint32_t corner : outline->corners) {
      ring.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(project(mesh_.vertices()[corner]));
      vertex.push_back(corner);
    }
  }
  Ring outer = std::move(rings.front());
  rings.erase(rings.begin());
  const auto filled = polygonTriangles(points, std::move(outer), std::move(rings));
  if (filled.empty()) {
    for (const Hole* const outline : outlines) refused_.push_back(outline->shape);
    return;
  }
  HoleCap cap{.outlines = outlines.size(),
              .triangles = filled.size(),
              .triangle = holes_[hole].shape.triangle,
              .center = holes_[hole].shape.center};
  for (const Hole* const outline : outlines) {
    cap.edges += outline->shape.edges;
    cap.area += (outline == outlines.front() ? 1.0 : -1.0) * outline->shape.area;
  }
  for (const auto& [a, b, c] : filled) triangles_.push_back({vertex[a], vertex[b], vertex[c]});
  added_.push_back(cap);
}

}  // namespace

ClosedMesh closeHoles(const Surface& surface) { return HoleCloser(surface).close(); }

}  // namespace octoblisk
