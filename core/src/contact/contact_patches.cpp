#include "contact/contact_patches.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace octoblisk::detail {
namespace {

constexpr double kSameDirection = 0.70710678118654752;  // the cosine of 45°
constexpr double kSameNormal = 0.99619469809174553;     // the cosine of 5°
constexpr double kPreference = 1.5;    // factor for the scores of contacts kept from the last call
constexpr double kHardlyDeeper = 0.1;  // a difference of depths that does not count, over the spacing

/// Deepest first; contacts of equal depth by triangles and positions.
auto byDepth(const Contact& c) {
  const Vec3& p = c.point_on_a;
  return std::tuple(c.distance, c.triangle_a, c.triangle_b, p.x(), p.y(), p.z());
}

std::uint32_t deepestOf(std::span<const Contact> contacts, std::span<const std::uint32_t> members) {
  return *std::ranges::min_element(members, {}, [&](std::uint32_t m) { return byDepth(contacts[m]); });
}

bool isWithin(double distance, const Vec3& a, const Vec3& b) {
  return (a - b).squaredNorm() <= distance * distance;
}

/// Whether Bullet would take one contact for the other.
bool areNear(const Contact& a, const Contact& b, double spacing) {
  return isWithin(spacing, a.point_on_a, b.point_on_a) || isWithin(spacing, a.point_on_b, b.point_on_b);
}

bool isAsDeep(const Contact& contact, const Contact& other, double spacing) {
  return contact.distance <= other.distance + kHardlyDeeper * spacing;
}

}  // namespace

/// Selects from the members: the deepest, the farthest from it, then those that make the widest triangle and
/// the widest quadrangle. Empty if there are no members.
ContactPatch ContactPatches::spread(std::span<const Contact> contacts, Members members,
                                    double spacing) const {
  ContactPatch patch;
  if (members.empty()) return patch;
  const auto at = [&](std::size_t i) -> const Vec3& { return patch.contacts[i].point_on_a; };
  const auto wasKept = [&](const Contact& contact) {
    return std::ranges::any_of(
        kept_, [&](const Vec3& point) { return isWithin(spacing, point, contact.point_on_a); });
  };
  // Adds the member with the highest score above `least` that is not near those already added.
  const auto addBest = [&](double least, auto&& score) {
    const Contact* best = nullptr;
    for (const std::uint32_t m : members) {
      const Contact& contact = contacts[m];
      double value = score(contact);
      if (!(value >= least / kPreference)) continue;
      if (wasKept(contact)) value *= kPreference;
      if (!(value > least || (best && value == least && byDepth(contact) < byDepth(*best)))) continue;
      const auto isNear = [&](const Contact& added) { return areNear(added, contact, spacing); };
      if (std::ranges::any_of(patch.points(), isNear)) continue;
      least = value;
      best = &contact;
    }
    if (best) patch.add(*best);
    return best != nullptr;
  };

  patch.add(contacts[deepestOf(contacts, members)]);
  if (!addBest(0.0, [&](const Contact& c) { return (c.point_on_a - at(0)).squaredNorm(); })) return patch;
  const Vec3 base = at(1) - at(0);
  const double flat = 1e-6 * base.squaredNorm();
  if (!addBest(flat, [&](const Contact& c) { return base.cross(c.point_on_a - at(0)).norm(); })) return patch;
  const Vec3 normal = base.cross(at(2) - at(0)).normalized();
  // The area gained beyond one of the three edges.
  addBest(flat, [&](const Contact& c) {
    double gain = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &from = at(i), &to = at((i + 1) % 3);
      gain = std::max(gain, -normal.dot((to - from).cross(c.point_on_a - from)));
    }
    return gain;
  });
  return patch;
}

/// If contacts of a patch are less deep than its deepest, selects others that carry the body: members about
/// as deep as the deepest, and not near the patch's own. May be empty. Leaves only these members.
ContactPatch ContactPatches::carrying(const ContactPatch& patch, std::span<const Contact> contacts,
                                      double spacing) {
  const auto carries = [&](const Contact& contact) { return isAsDeep(contact, patch.contacts[0], spacing); };
  if (std::ranges::all_of(patch.points(), carries)) return {};
  std::erase_if(members_, [&](std::uint32_t m) {
    const auto isNear = [&](const Contact& added) { return areNear(added, contacts[m], spacing); };
    return !carries(contacts[m]) || std::ranges::any_of(patch.points(), isNear);
  });
  return spread(contacts, members_, spacing);
}

/// For each contact of a patch, selects the one of the members near it that is about as deep and pushes in
/// the most different direction: the other side of a groove. Empty if there are none.
ContactPatch ContactPatches::otherSides(const ContactPatch& patch, std::span<const Contact> contacts,
                                        Members members, double spacing) {
  ContactPatch others;
  for (const Contact& side : patch.points()) {
    const Contact* best = nullptr;
    double least = kSameNormal;
    for (const std::uint32_t m : members) {
      const Contact& contact = contacts[m];
      const double cosine = contact.normal.dot(side.normal);
      if (!(cosine < least || (best && cosine == least && byDepth(contact) < byDepth(*best)))) continue;
      if (contact.triangles() == side.triangles()) continue;
      if (!isAsDeep(contact, side, spacing) || !areNear(contact, side, spacing)) continue;
      const auto isNear = [&](const Contact& added) { return areNear(added, contact, spacing); };
      if (std::ranges::any_of(others.points(), isNear)) continue;
      least = cosine;
      best = &contact;
    }
    if (best) others.add(*best);
  }
  return others;
}

std::span<const ContactPatch> ContactPatches::reduce(std::span<const Contact> contacts, double spacing) & {
  kept_.clear();
  for (const ContactPatch& patch : patches_) {
    for (const Contact& contact : patch.points()) kept_.push_back(contact.point_on_a);
  }
  patches_.clear();
  others_.clear();
  if (contacts.size() == 1) {
    patches_.emplace_back().add(contacts[0]);
    return patches_;
  }
  left_.resize(contacts.size());
  std::iota(left_.begin(), left_.end(), 0u);
  while (!left_.empty() && patches_.size() < kMaxPatches) {
    const std::uint32_t deepest = deepestOf(contacts, left_);
    members_.clear();
    members_.reserve(left_.size());
    std::erase_if(left_, [&](std::uint32_t i) {
      const bool belongs = i == deepest || contacts[i].normal.dot(contacts[deepest].normal) >= kSameDirection;
      if (belongs) members_.push_back(i);
      return belongs;
    });
    patches_.push_back(spread(contacts, members_, spacing));
    const ContactPatch& patch = patches_.back();
    const auto addOthers = [&](const ContactPatch& others) {
      if (others.count > 0) others_.push_back(others);
    };
    addOthers(otherSides(patch, contacts, members_, spacing));
    addOthers(carrying(patch, contacts, spacing));  // last, because it removes members
  }
  others_.resize(std::min(others_.size(), kMaxPatches - patches_.size()));
  patches_.insert(patches_.end(), others_.begin(), others_.end());
  return patches_;
}

}  // namespace octoblisk::detail
