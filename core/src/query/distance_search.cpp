#include "query/distance_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "geometry/triangle_pair.h"

namespace octoblisk::detail {

namespace {

constexpr double kLead = 0.98;  // a pair is measured at once if its distance is below this part of the bound

}  // namespace

bool DistanceSearch::offer(const TrianglePair& pair, bool may_meet) {
  ++measured_;
  const Triangle triangle_a = a_.triangle(pair.a), triangle_b = b_in_a_ * b_.triangle(pair.b);
  const bool meet = may_meet && intersects(triangle_a, triangle_b);
  const Contact contact =
      meet ? meetingContact(triangle_a, triangle_b) : closestPoints(triangle_a, triangle_b);
  const double distance = meet ? 0.0 : contact.distance;
  if (distance < best_.distance) {
    best_ = {distance, meet ? contact.point_on_b : contact.point_on_a, contact.point_on_b, pair.a, pair.b};
    bound_ = std::min(bound_, distance);
    direction_ = (best_.point_on_b - best_.point_on_a).stableNormalized().cast<float>();
  }
  return distance == 0.0;
}

bool DistanceSearch::consider(std::span<const TrianglePair> pairs, const DistanceBounds8& bounds) {
  const auto most = std::span(bounds.most).first(pairs.size());
  assert(std::ranges::none_of(most, [](float distance) { return std::isnan(distance); }));
  const auto nearest = static_cast<std::size_t>(std::ranges::min_element(most) - most.begin());
  const bool leads = double(most[nearest]) < kLead * bound_;
  if (leads && offer(pairs[nearest], false)) return true;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if ((leads && k == nearest) || double(bounds.least[k]) > bound()) continue;
    bound_ = std::min(bound_, double(most[k]));
    keep(pairs[k], double(bounds.least[k]));
  }
  return best_.distance == 0.0;
}

void DistanceSearch::keep(const TrianglePair& pair, double least) {
  if (count_ == candidates_.size()) {
    const auto nearer = [&](const Candidate& candidate) { return candidate.least <= bound_; };
    const auto end = std::partition(candidates_.begin(), candidates_.end(), nearer);
    count_ = static_cast<std::size_t>(end - candidates_.begin());
  }
  if (count_ == candidates_.size()) settleAll();
  candidates_[count_++] = {least, pair};
}

void DistanceSearch::settleAll() {
  const auto end = candidates_.begin() + static_cast<std::ptrdiff_t>(count_);
  std::sort(candidates_.begin(), end, [](const Candidate& one, const Candidate& other) {
    return one.least != other.least ? one.least < other.least : one.pair < other.pair;
  });
  for (auto candidate = candidates_.begin(); candidate != end && candidate->least <= best_.distance;
       ++candidate) {
    offer(candidate->pair, false);
  }
  count_ = 0;
}

Clearance DistanceSearch::settled() {
  settleAll();
  return best_;
}

bool ConvexDistanceSearch::offer(std::uint32_t triangle) {
  const std::optional<Contact> contact = b_.contactWith(a_.triangle(triangle), best_.distance);
  if (!contact || std::max(contact->distance, 0.0) >= best_.distance) return false;
  const bool meet = contact->distance <= 0.0;
  best_.distance = meet ? 0.0 : contact->distance;
  best_.point_on_b = contact->point_on_b;
  best_.point_on_a = meet ? best_.point_on_b : contact->point_on_a;
  best_.triangle_a = triangle;
  return meet;
}

}  // namespace octoblisk::detail
