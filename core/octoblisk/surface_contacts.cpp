#include "octoblisk/surface_contacts.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "octoblisk/triangle_feature.h"

namespace octoblisk {
namespace {

std::uint64_t hashOf(std::uint32_t triangle, const Vec3& position) {
  std::uint64_t hash = triangle;
  for (const double x : position) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15u;  // -0 is 0
    hash ^= hash >> 32;
  }
  return hash;
}

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t contact) {
  while (parent[contact] != contact) contact = parent[contact] = parent[parent[contact]];
  return contact;
}

}  // namespace

void SurfaceContacts::keepIn(std::vector<Contact>& contacts) {
  if (contacts.size() < 2) return;
  removed_.assign(contacts.size(), kKept);
  join(contacts);
  markPast(contacts);
  markInner(contacts, true);
  markInner(contacts, false);
  keepDeepest(contacts);
  std::size_t kept = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (removed_[c] == kKept) contacts[kept++] = contacts[c];
  }
  contacts.resize(kept);
}

/// Groups those that hang together by triangles. The root of a group is its deepest.
void SurfaceContacts::join(const std::vector<Contact>& contacts) {
  order_.resize(contacts.size());
  parent_.resize(contacts.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (const auto triangle : {&Contact::triangle_a, &Contact::triangle_b}) {
    std::ranges::sort(order_, {}, [&](std::uint32_t c) { return contacts[c].*triangle; });
    for (std::size_t i = 1; i < order_.size(); ++i) {
      if (contacts[order_[i]].*triangle != contacts[order_[i - 1]].*triangle) continue;
      std::uint32_t a = rootOf(parent_, order_[i - 1]), b = rootOf(parent_, order_[i]);
      if (contacts[b].distance < contacts[a].distance) std::swap(a, b);
      parent_[b] = a;
    }
  }
}

/// Gives its deepest contact back to a group of which all were removed, and the deepest of all.
void SurfaceContacts::keepDeepest(const std::vector<Contact>& contacts) {
  const auto deepest = std::ranges::min_element(contacts, {}, &Contact::distance) - contacts.begin();
  removed_[static_cast<std::size_t>(deepest)] = kKept;
  order_.assign(parent_.size(), 0);  // of a root: whether something of its group stays
  for (std::uint32_t c = 0; c < parent_.size(); ++c) {
    if (removed_[c] == kKept) order_[rootOf(parent_, c)] = 1;
  }
  for (std::uint32_t c = 0; c < parent_.size(); ++c) {
    if (parent_[c] == c && order_[c] == 0) removed_[c] = kKept;
  }
}

/// Those that are apart, on the back of one of the two triangles, and hang together with some that meet.
void SurfaceContacts::markPast(const std::vector<Contact>& contacts) {
  const auto isApart = [](const Contact& contact) { return contact.distance > 0.0; };
  constexpr double kBehind = 1e-3;
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (!isApart(contact) || isApart(contacts[rootOf(parent_, c)])) continue;
    const Vec3 facing_a = scaledNormal(pairs_[c].a), facing_b = scaledNormal(pairs_[c].b);
    if (contact.normal.dot(facing_a) > kBehind * facing_a.norm() ||
        contact.normal.dot(facing_b) < -kBehind * facing_b.norm()) {
      removed_[c] = kPast;
    }
  }
}

/// Those askew at a feature of one body's triangle beyond which another, in contact with the same triangle of
/// the other body, leans towards it.
void SurfaceContacts::markInner(const std::vector<Contact>& contacts, bool of_a) {
  const auto ownOf = [&](std::uint32_t c) -> const Triangle& { return of_a ? pairs_[c].a : pairs_[c].b; };
  const auto oppositeOf = [&](std::uint32_t c) {
    return of_a ? contacts[c].triangle_b : contacts[c].triangle_a;
  };
  const auto has = [](const Triangle& triangle, const Vec3& corner) {
    return std::ranges::find(triangle, corner) != triangle.end();
  };
  corners_.clear();
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    for (const Vec3& corner : ownOf(c)) corners_.push_back({hashOf(oppositeOf(c), corner), c});
  }
  std::ranges::sort(corners_);

  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    const Triangle& own = ownOf(c);
    const unsigned feature = featureOf(own, of_a ? contact.point_on_a : contact.point_on_b);
    if (removed_[c] != kKept || feature == 0b111u || feature == 0 || isSquare(own, contact.normal)) continue;
    const auto [first, second] = endsOf(feature);
    const Vec3 towards = of_a ? Vec3(-contact.normal) : contact.normal;
    const double size = (own[1] - own[0]).norm() + (own[2] - own[0]).norm();
    const std::uint64_t hash = hashOf(oppositeOf(c), own[first]);
    for (auto corner = std::ranges::lower_bound(corners_, hash, {}, &Corner::hash);
         corner != corners_.end() && corner->hash == hash; ++corner) {
      const std::uint32_t o = corner->contact;
      const Contact& other = contacts[o];
      // What is wholly past the face is deeper than what meets it.
      const bool is_nearer = contact.distance > 0.0 ? other.distance < contact.distance - 1e-9 * size
                                                    : other.distance <= 0.0 || removed_[o] == kPast;
      if (o == c || !is_nearer || oppositeOf(o) != oppositeOf(c)) continue;
      const Triangle& shares = ownOf(o);
      if (!has(shares, own[first]) || !has(shares, own[second])) continue;
      if (!leansOver(shares, own[first], own[second], towards)) continue;
      removed_[c] = kInner;
      break;
    }
  }
}

}  // namespace octoblisk
