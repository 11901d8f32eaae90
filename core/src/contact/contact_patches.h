// Many contacts reduced to the few that hold two bodies apart.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// Up to four contacts of one region of touch: the deepest, and those that span the widest area with it.
struct ContactPatch {
  std::array<Contact, 4> contacts;
  int count = 0;

  std::span<const Contact> points() const { return {contacts.data(), static_cast<std::size_t>(count)}; }
};

/// Groups contacts into patches. Contacts belong together where a chain of contacts that share a triangle
/// joins them (all of them, where B is convex) and their normals are within 45° of the patch's deepest.
class ContactPatches {
 public:
  static constexpr std::size_t kMaxPatches = 16;

  /// The patches of the contacts, at most kMaxPatches, the deepest kept; by ascending triangles. Does not
  /// depend on the order of the contacts. Valid until the next call; once warm, allocates nothing.
  std::span<const ContactPatch> reduce(std::span<const Contact> contacts) &;

 private:
  void join(std::span<const Contact> contacts);
  std::uint32_t rootOf(std::uint32_t contact);

  std::vector<std::uint32_t> parent_;  // of each contact in the forest of joined contacts
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> members_;
  std::vector<ContactPatch> patches_;
};

}  // namespace octoblisk::detail
