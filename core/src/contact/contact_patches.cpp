#include "contact/contact_patches.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace octoblisk::detail {
namespace {

constexpr double kSameDirection = 0.70710678118654752;  // the cosine of 45°

auto byTriangles(const Contact& c) { return TrianglePair{c.triangle_a, c.triangle_b}; }

/// Deepest first; contacts of equal depth by their triangles.
auto byDepth(const Contact& c) { return std::tuple(c.distance, c.triangle_a, c.triangle_b); }

/// The member that scores highest, if it is above the least worthwhile score.
template <typename Score>
const Contact* best(std::span<const Contact> all, std::span<const std::uint32_t> members, double worthwhile,
                    Score&& score) {
  const Contact* found = nullptr;
  for (const std::uint32_t m : members) {
    const double value = score(all[m]);
    if (!(value > worthwhile)) continue;
    worthwhile = value;
    found = &all[m];
  }
  return found;
}

/// The members sorted by depth → the deepest, the farthest from it, the widest triangle, the widest
/// quadrangle.
ContactPatch spread(std::span<const Contact> all, std::span<const std::uint32_t> members) {
  ContactPatch patch;
  const auto add = [&](const Contact& contact) {
    patch.contacts[static_cast<std::size_t>(patch.count++)] = contact;
  };
  const auto at = [&](std::size_t i) -> const Vec3& { return patch.contacts[i].point_on_a; };
  add(all[members.front()]);
  const Contact* far =
      best(all, members, 0.0, [&](const Contact& c) { return (c.point_on_a - at(0)).squaredNorm(); });
  if (!far) return patch;
  add(*far);
  const Vec3 base = at(1) - at(0);
  const double flat = 1e-6 * base.squaredNorm();
  const Contact* wide =
      best(all, members, flat, [&](const Contact& c) { return base.cross(c.point_on_a - at(0)).norm(); });
  if (!wide) return patch;
  add(*wide);
  const Vec3 normal = base.cross(at(2) - at(0)).normalized();
  // Area gained beyond one of the three edges.
  const Contact* fourth = best(all, members, flat, [&](const Contact& c) {
    double gain = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &from = at(i), &to = at((i + 1) % 3);
      gain = std::max(gain, -normal.dot((to - from).cross(c.point_on_a - from)));
    }
    return gain;
  });
  if (fourth) add(*fourth);
  return patch;
}

}  // namespace

std::uint32_t ContactPatches::rootOf(std::uint32_t contact) {
  while (parent_[contact] != contact) contact = parent_[contact] = parent_[parent_[contact]];
  return contact;
}

void ContactPatches::join(std::span<const Contact> contacts) {
  parent_.resize(contacts.size());
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (const auto triangle : {&Contact::triangle_a, &Contact::triangle_b}) {
    std::ranges::sort(order_, {}, [&](std::uint32_t i) { return contacts[i].*triangle; });
    for (std::size_t i = 1; i < order_.size(); ++i) {
      if (contacts[order_[i]].*triangle != contacts[order_[i - 1]].*triangle) continue;
      const std::uint32_t a = rootOf(order_[i - 1]), b = rootOf(order_[i]);
      parent_[std::max(a, b)] = std::min(a, b);
    }
  }
}

std::span<const ContactPatch> ContactPatches::reduce(std::span<const Contact> contacts) & {
  patches_.clear();
  order_.resize(contacts.size());
  std::iota(order_.begin(), order_.end(), 0u);
  join(contacts);
  std::ranges::sort(order_, {}, [&](std::uint32_t i) { return byDepth(contacts[i]); });

  while (!order_.empty() && patches_.size() < kMaxPatches) {
    const std::uint32_t deepest = order_.front(), root = rootOf(deepest);
    members_.clear();
    std::erase_if(order_, [&](std::uint32_t i) {
      const bool belongs =
          rootOf(i) == root && contacts[i].normal.dot(contacts[deepest].normal) >= kSameDirection;
      if (belongs) members_.push_back(i);
      return belongs;
    });
    patches_.push_back(spread(contacts, members_));
  }
  std::ranges::sort(patches_, {}, [](const ContactPatch& patch) { return byTriangles(patch.contacts[0]); });
  return patches_;
}

}  // namespace octoblisk::detail
