#include "query/gap_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octoblisk::detail {
namespace {

/// The edges of an outline, sorted along the axis of its greatest extent.
class SortedEdges {
 public:
  explicit SortedEdges(std::span<const Vec3> outline) {
    boundsOf(outline).halfExtents().maxCoeff(&axis_);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 &from = outline[i], &to = outline[(i + 1) % outline.size()];
      edges_.push_back({from, to, 0.5 * (from[axis_] + to[axis_]), i});
      reach_ = std::max(reach_, 0.5 * std::abs(to[axis_] - from[axis_]));
    }
    std::ranges::sort(edges_, {}, &Edge::middle);
  }

  /// The distance from a point to the nearest edge but two.
  double distance(const Vec3& point, std::size_t without, std::size_t and_without) const {
    double nearest = std::numeric_limits<double>::infinity();
    const auto visit = [&](const Edge& edge) {
      if (std::abs(edge.middle - point[axis_]) - reach_ >= nearest) return false;
      if (edge.index != without && edge.index != and_without)
        nearest = std::min(nearest, octoblisk::distance({edge.from, edge.to, edge.to}, point));
      return true;
    };
    const auto middle = std::ranges::lower_bound(edges_, point[axis_], {}, &Edge::middle);
    for (auto edge = middle; edge != edges_.end() && visit(*edge);) ++edge;
    for (auto edge = middle; edge != edges_.begin() && visit(*--edge);) continue;
    return nearest;
  }

 private:
  struct Edge {
    Vec3 from, to;
    double middle;
    std::size_t index;
  };
  Eigen::Index axis_ = 0;
  double reach_ = 0.0;  // half the greatest extent of an edge
  std::vector<Edge> edges_;
};

bool isStraight(std::span<const Vec3> outline, std::size_t i) {
  const Vec3 &last = outline[(i + outline.size() - 1) % outline.size()],
             &next = outline[(i + 1) % outline.size()];
  return (outline[i] - last).dot(next - outline[i]) > 0.0;
}

}  // namespace

std::vector<Vec3> outlineOf(const Gap& gap) {
  std::vector<Vec3> outline;
  const auto lowest = std::ranges::min_element(gap.edges, {}, &GapEdge::triangle) - gap.edges.begin();
  for (std::size_t i = 0; i < gap.edges.size(); ++i) {
    const GapEdge& edge = gap.edges[(static_cast<std::size_t>(lowest) + i) % gap.edges.size()];
    if (i > 0 && edge.from != outline.back()) outline.push_back(edge.from);
    if (i == 0) outline.push_back(edge.from);
    outline.push_back(edge.to);
  }
  if (outline.back() == outline.front()) outline.pop_back();
  return outline;
}

Vec3 areaVector(std::span<const Vec3> outline) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < outline.size(); ++i)
    sum += (outline[i - 1] - outline[0]).cross(outline[i] - outline[0]);
  return sum;
}

MeshGap shapeOf(const Gap& gap) {
  MeshGap shape;
  shape.outline = outlineOf(gap);
  shape.edges = gap.edges.size();
  shape.triangle = std::ranges::min(gap.edges, {}, &GapEdge::triangle).triangle;
  const std::size_t corners = shape.outline.size();
  for (std::size_t i = 0; i < corners; ++i) {
    shape.length += (shape.outline[(i + 1) % corners] - shape.outline[i]).norm();
    shape.center += shape.outline[i] / static_cast<double>(corners);
  }
  const Vec3 vector = areaVector(shape.outline), normal = vector.normalized();
  shape.area = 0.5 * vector.norm();
  for (const Vec3& corner : shape.outline)
    shape.off_plane = std::max(shape.off_plane, std::abs(normal.dot(corner - shape.center)));
  const double size = 2.0 * boundsOf(shape.outline).halfExtents().norm();
  shape.is_planar = shape.area > 0.0 && shape.off_plane <= kPlanar * size;
  return shape;
}

std::vector<Vec3> straightCorners(std::span<const Vec3> outline) {
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (isStraight(outline, i)) corners.push_back(outline[i]);
  }
  return corners;
}

double widthOf(std::span<const Vec3> outline) {
  const SortedEdges edges(outline);
  double width = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3& next = outline[(i + 1) % outline.size()];
    width = std::max(width, edges.distance(0.5 * (outline[i] + next), i, i));
    const std::size_t before = (i + outline.size() - 1) % outline.size();
    if (isStraight(outline, i)) width = std::max(width, edges.distance(outline[i], i, before));
  }
  return width;
}

}  // namespace octoblisk::detail
