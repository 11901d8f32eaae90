// Many contacts reduced to the few that hold two bodies apart.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// Up to four contacts that push alike: one of the deepest, and those that span the widest area with it.
struct ContactPatch {
  std::array<Contact, 4> contacts;
  int count = 0;

  std::span<const Contact> points() const { return {contacts.data(), static_cast<std::size_t>(count)}; }
};

/// Groups contacts into patches. A patch is the deepest contact and all whose normals are within 45° of its
/// normal: between rigid bodies these push alike, wherever they are.
class ContactPatches {
 public:
  static constexpr std::size_t kMaxPatches = 16;

  /// Returns the patches, at most kMaxPatches, the deepest ones, by ascending triangles. The contacts of a
  /// patch are more than `spacing` apart on A and on B. Contacts near those that the last call returned are
  /// preferred to others that are hardly deeper or wider apart, so that a resting body keeps its contacts.
  /// The order of the contacts does not matter. Valid until the next call; once warm, allocates nothing.
  std::span<const ContactPatch> reduce(std::span<const Contact> contacts, double spacing) &;

  /// Returns the patches of the last call.
  std::span<const ContactPatch> last() const { return patches_; }

 private:
  using Members = std::span<const std::uint32_t>;

  ContactPatch spread(std::span<const Contact> contacts, Members members, double spacing) const;

  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> members_;
  std::vector<ContactPatch> patches_;
  std::vector<Vec3> kept_;  // the points on A of the last call's contacts
};

}  // namespace octoblisk::detail
