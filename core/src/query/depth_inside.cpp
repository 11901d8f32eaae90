// Which triangles of B meet A's surface, and which are wholly inside A: where DepthQuery's search begins.
#include <algorithm>

#include "octoblisk/collide.h"
#include "octoblisk/depth.h"

namespace octoblisk {

using namespace detail;

void DepthQuery::meetingOrInside(const Surface& a, const Surface& b, const Pose& b_in_a,
                                 std::vector<std::uint32_t>& found) {
  prepare(a, b, b_in_a, 0.0);
  findCrossings();
  findInside();
  found = marked_;
}

void DepthQuery::findCrossings() {
  touchingPairs(a_->tree(), b_->tree(), b_in_a_, crossings_);
  std::ranges::sort(crossings_, {}, [](const TrianglePair& pair) { return std::pair(pair.b, pair.a); });
  for (const TrianglePair& pair : crossings_) {
    if (!boundsSolid(pair.a)) best_.is_known = false;
    if (mark_[pair.b] == Mark::crossing) continue;
    mark_[pair.b] = Mark::crossing;
    marked_.push_back(pair.b);
    for (const std::uint32_t corner : b_->corners(pair.b)) {
      addCorner(corner);
      part_crosses_[b_->part(corner)] = true;
    }
  }
}

/// Marks the triangles of B that are wholly inside A: those that hang together with an inside corner by
/// triangles that do not cross A's surface.
void DepthQuery::findInside() {
  for (std::size_t i = 0, crossing_corners = known_.size(); i < crossing_corners; ++i) {
    const std::uint32_t corner = known_[i];
    if (corners_[corner_of_b_[corner]].side != Side::unknown) continue;
    sideOf(corners_[corner_of_b_[corner]]);
    spread(corner);
  }
  for (std::size_t part = 0; part < b_->partCount(); ++part) {
    if (part_crosses_[part]) continue;
    const std::uint32_t corner = b_->cornerOfPart(part);
    const Vec3 point = b_in_a_ * b_->position(corner);
    const PointLocation location = located(point);
    if (location == PointLocation::unknown) best_.is_known = false;
    if (location != PointLocation::inside) continue;
    corners_[addCorner(corner)].side = Side::inside;
    spread(corner);
  }
}

/// Gives the corners that hang together with this one its side: inside all, outside only those of crossing
/// triangles, for the outside may be large and does not matter. Where A's surface has holes, B may leave A
/// through one: each corner is asked.
void DepthQuery::spread(std::uint32_t from) {
  const Side side = corners_[corner_of_b_[from]].side;
  if (side == Side::on_surface || side == Side::undecided) return;  // all triangles round it cross, or may
  open_.push_back(from);
  while (!open_.empty()) {
    const std::uint32_t corner = open_.back();
    open_.pop_back();
    for (const std::uint32_t triangle : b_->star(corner)) {
      if (mark_[triangle] == Mark::crossing) continue;
      if (side == Side::inside && mark_[triangle] == Mark::none) {
        mark_[triangle] = Mark::inside;
        marked_.push_back(triangle);
      }
      for (const std::uint32_t next : b_->corners(triangle)) {
        if (side == Side::outside && corner_of_b_[next] == kNone) continue;
        const std::uint32_t index = addCorner(next);
        Corner& neighbour = corners_[index];
        if (neighbour.side == Side::unknown) {
          if (boundary_ == nullptr) neighbour.side = side;
          if (sideOf(neighbour) == side) open_.push_back(next);
        }
        if (boundary_ && neighbour.side != side && neighbour.side != Side::on_surface) best_.is_known = false;
      }
    }
  }
}

}  // namespace octoblisk
