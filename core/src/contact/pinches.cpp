#include "contact/pinches.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace octoblisk::detail {
namespace {

/// Whether two triangles face each other along their contact, as at the wall of a hole, not where one body
/// crosses the other.
bool areFacing(const PairedContact& contact, const SurfacePair& surfaces) {
  constexpr double kFacing = 0.55;  // a cosine; of the faces at a box's corner, one has at least 0.577
  const Vec3 &of_a = surfaces.a.facing(contact.pair), &of_b = surfaces.b.facing(contact.pair);
  return of_a.dot(contact.normal) < -kFacing * of_a.norm() &&
         of_b.dot(contact.normal) > kFacing * of_b.norm();
}

}  // namespace

void Pinches::open(std::vector<PairedContact>& contacts, const SurfacePair& surfaces,
                   const std::vector<NumberPair>& meeting) {
  pinching_.clear();
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].distance <= 0.0 && !areFacing(contacts[c], surfaces)) pinching_.push_back(c);
  }
  if (pinching_.empty()) return;
  curve_.clear();
  of_segments_.clear();
  for (const NumberPair& pair : meeting) {
    if (const std::optional<CurveSegment> segment =
            meetingSegment(surfaces.a.triangle(pair), surfaces.b.triangle(pair))) {
      curve_.push_back(*segment);
      of_segments_.push_back(pair);
    }
  }
  if (!wayOut(curve_)) return;  // one body may pierce the other
  crossings_.reset(surfaces);
  crossings_.add(meeting);
  const auto groupOf = [&](std::uint32_t c) { return crossings_.groupOf(contacts[c].pair); };
  std::ranges::sort(pinching_, {}, [&](std::uint32_t c) { return std::pair(groupOf(c), c); });
  for (auto first = pinching_.begin(); first != pinching_.end();) {
    const std::uint32_t group = groupOf(*first);
    const auto last =
        std::find_if(first, pinching_.end(), [&](std::uint32_t c) { return groupOf(c) != group; });
    open(contacts, {first, last}, group);
    first = last;
  }
  std::erase_if(contacts, [](const PairedContact& contact) { return contact.is_removed; });
}

/// Opens one crossing: a group of pairs that meet. The members are its contacts that may pinch. Where bars
/// cross, the curve extends as far as they overlap. An end that pokes into a side has a planar curve: the
/// depth is that of the triangles. The curve of surfaces that lie along each other, as the walls of nested
/// cups do, extends much farther than they overlap: contacts across the way out stay.
void Pinches::open(std::vector<PairedContact>& contacts, Members members, std::uint32_t group) {
  crossing_.clear();
  for (std::size_t s = 0; s < curve_.size(); ++s) {
    if (crossings_.groupOf(of_segments_[s]) == group) crossing_.push_back(curve_[s]);
  }
  const std::optional<Vec3> out = wayOut(crossing_);
  if (!out) return;
  constexpr double kOpposed = 0.9, kAcross = 0.5, kOut = 0.2, kAgainst = 0.3;  // cosines
  constexpr double kCrossing = 0.25;  // the least depth as a fraction of the extent; bars that cross have 1
  const double extent = extentAlong(*out, crossing_);
  const bool lie_along = depthAlong(*out, crossing_) < kCrossing * extent;
  const bool is_planar = isPlanar(*out, crossing_);
  touching_.clear();
  for (const PairedContact& contact : contacts) {
    if (contact.distance <= 0.0 && crossings_.groupOf(contact.pair) == group)
      touching_.push_back(contact.normal);
  }
  const auto isAnyPushing = [&](const Vec3& direction, double least_cosine) {
    return std::ranges::any_of(touching_,
                               [&](const Vec3& normal) { return normal.dot(direction) > least_cosine; });
  };
  const bool has_way_out = isAnyPushing(*out, kOut);
  const bool keeps_way_out = isAnyPushing(*out, kAcross);
  std::uint32_t deepest = kNoIndex;
  for (const std::uint32_t c : members) {
    const Vec3& normal = contacts[c].normal;
    const double along = normal.dot(*out);
    const bool pulls = is_planar && along < -kAgainst;
    const bool pinches = !lie_along && along < kAcross && (!has_way_out || isAnyPushing(-normal, kOpposed));
    if (!pulls && !pinches) continue;
    contacts[c].is_removed = true;
    if (pulls && keeps_way_out) continue;
    if (deepest == kNoIndex || contacts[c].distance < contacts[deepest].distance) deepest = c;
  }
  if (deepest == kNoIndex) return;
  contacts[deepest].is_removed = false;
  Contact& contact = contacts[deepest];
  contact.normal = *out;
  contact.distance = keeps_way_out ? -extent : std::min(contact.distance, -extent);
  placeAround(middleOf(crossing_), contact);
}

}  // namespace octoblisk::detail
