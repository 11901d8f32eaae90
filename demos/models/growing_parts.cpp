#include "models/growing_parts.h"

namespace octoblisk::demos {

GrowingParts::GrowingParts(const WeldedSurface& surface)
    : surface_(&surface),
      connected_(surface.mesh.vertices().size()),
      sums_(connected_.size()),
      seen_(connected_.size()) {}

void GrowingParts::addBetween(double low, double high) {
  for (; next_ < surface_->outermost.size() && surface_->low[surface_->outermost[next_]] > low; ++next_) {
    const std::uint32_t triangle = surface_->outermost[next_];
    if (surface_->high[triangle] < high) add(triangle);
  }
}

std::vector<Part> GrowingParts::parts() {
  std::erase_if(roots_, [&](std::uint32_t vertex) { return !connected_.isRoot(vertex); });
  std::vector<Part> result;
  for (const std::uint32_t root : roots_) {
    const Sums& sums = sums_[root];
    if (sums.area > 0.0) result.push_back({root, sums.area, sums.moment / sums.area});
  }
  return result;
}

void GrowingParts::add(std::uint32_t triangle) {
  const TriangleMesh::Indices& corners = surface_->corners[triangle];
  for (const std::uint32_t corner : corners) {
    if (!seen_[corner]) roots_.push_back(corner);
    seen_[corner] = true;
    const std::uint32_t from = rootOf(corner);
    const std::uint32_t into = rootOf(corners[0]);
    if (from == into) continue;
    connected_.join(from, into);
    sums_[into].area += sums_[from].area;
    sums_[into].moment += sums_[from].moment;
  }
  const Triangle t = surface_->mesh.triangle(triangle);
  const double area = 0.5 * scaledNormal(t).norm();
  Sums& sums = sums_[rootOf(corners[0])];
  sums.area += area;
  sums.moment += area * (t[0] + t[1] + t[2]) / 3.0;
}

}  // namespace octoblisk::demos
