#include "contact/contact_patches.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace octoblisk::detail {
namespace {

constexpr double kSameDirection = 0.70710678118654752;  // the cosine of 45°
constexpr double kSameNormal = 0.99619469809174553;     // the cosine of 5°

auto byTriangles(const Contact& c) {
  const Vec3& p = c.point_on_a;
  return std::tuple(c.triangle_a, c.triangle_b, p.x(), p.y(), p.z());
}

/// Deepest first; contacts of equal depth by triangles and positions.
auto byDepth(const Contact& c) { return std::tuple_cat(std::tuple(c.distance), byTriangles(c)); }

constexpr double kPreference = 1.5;    // factor for lengths and areas of contacts kept from the last call
constexpr double kHardlyDeeper = 0.1;  // as a fraction of the spacing

bool isWithin(double distance, const Vec3& a, const Vec3& b) {
  return (a - b).squaredNorm() <= distance * distance;
}

bool isAsDeep(const Contact& contact, const Contact& deepest, double spacing) {
  return contact.distance <= deepest.distance + kHardlyDeeper * spacing;
}

}  // namespace

/// Selects from the members, which are sorted by depth: the deepest, the farthest from it, then those that
/// make the widest triangle and the widest quadrangle.
ContactPatch ContactPatches::spread(std::span<const Contact> contacts, Members members,
                                    double spacing) const {
  ContactPatch patch;
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
      if (!(value > least / kPreference)) continue;
      if (wasKept(contact)) value *= kPreference;
      if (!(value > least)) continue;
      const auto isNear = [&](const Contact& added) {
        return isWithin(spacing, added.point_on_a, contact.point_on_a) ||
               isWithin(spacing, added.point_on_b, contact.point_on_b);
      };
      if (std::ranges::any_of(patch.points(), isNear)) continue;
      least = value;
      best = &contact;
    }
    if (best) patch.contacts[static_cast<std::size_t>(patch.count++)] = *best;
    return best != nullptr;
  };

  const Contact& deepest = contacts[members.front()];
  addBest(0.0, [&](const Contact& c) { return isAsDeep(c, deepest, spacing) ? 1.0 : 0.0; });
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

std::span<const ContactPatch> ContactPatches::reduce(std::span<const Contact> contacts, double spacing) & {
  kept_.clear();
  for (const ContactPatch& patch : patches_) {
    for (const Contact& contact : patch.points()) kept_.push_back(contact.point_on_a);
  }
  patches_.clear();
  order_.resize(contacts.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::sort(order_, {}, [&](std::uint32_t i) { return byDepth(contacts[i]); });

  while (!order_.empty() && patches_.size() < kMaxPatches) {
    const std::uint32_t first = order_.front();
    const Contact& deepest = contacts[first];
    const auto belongs = [&](const Contact& contact) {
      const double cosine = contact.normal.dot(deepest.normal);
      const bool is_other_side = cosine < kSameNormal && isAsDeep(contact, deepest, spacing) &&
                                 isWithin(spacing, contact.point_on_a, deepest.point_on_a);
      return cosine >= kSameDirection && !is_other_side;
    };
    members_.clear();
    members_.reserve(order_.size());
    std::erase_if(order_, [&](std::uint32_t i) {
      if (i != first && !belongs(contacts[i])) return false;
      members_.push_back(i);
      return true;
    });
    patches_.push_back(spread(contacts, members_, spacing));
  }
  std::ranges::sort(patches_, {}, [](const ContactPatch& patch) { return byTriangles(patch.contacts[0]); });
  return patches_;
}

}  // namespace octoblisk::detail
