#include "contact/inside_corners.h"

namespace octoblisk::detail {

void InsideCorners::find(const MeshFeatures& own, const Pose& own_in_a, const SolidMesh& other,
                         const Pose& other_in_a, std::span<const std::uint32_t> seeds) {
  for (const std::uint32_t corner : located_) side_[corner] = Side::unknown;
  located_.clear();
  corners_.clear();
  if (side_.size() < own.cornerCount()) side_.resize(own.cornerCount(), Side::unknown);
  const auto locate = [&](std::uint32_t corner, Side side) {
    side_[corner] = side;
    located_.push_back(corner);
    if (side == Side::inside) corners_.push_back(corner);
  };
  for (const std::uint32_t seed : seeds) {
    if (side_[seed] != Side::unknown) continue;
    const bool is_inside = other.contains(own_in_a * own.position(seed), other_in_a);
    locate(seed, is_inside ? Side::inside : Side::outside);
  }
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    for (const std::uint32_t neighbour : own.neighboursOf(corners_[c])) {
      if (side_[neighbour] == Side::unknown) locate(neighbour, Side::inside);
    }
  }
}

}  // namespace octoblisk::detail
