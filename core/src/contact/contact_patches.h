// Reduces many contacts to the few that hold two bodies apart.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// Up to four contacts that push in similar directions: the deepest, and those that span the widest area with
/// it.
struct ContactPatch {
  std::array<Contact, 4> contacts;
  std::size_t count = 0;

  void add(const Contact& contact) { contacts[count++] = contact; }
  std::span<const Contact> points() const { return {contacts.data(), count}; }
};

/// Groups contacts into patches. A patch consists of the deepest contact and all contacts whose normals are
/// within 45° of its normal: between rigid bodies these have similar effects, wherever they are. Two more
/// patches may go with it:
/// - A body in a groove touches both sides: contacts near the patch's own that are about as deep, but push in
///   directions that differ by more than 5°.
/// - A wide body rests on a narrow face: if contacts that are less deep, but wider apart, fill the patch,
///   another patch holds the contacts that are about as deep as the deepest.
class ContactPatches {
 public:
  static constexpr std::size_t kMaxPatches = 16;

  /// Returns at most kMaxPatches patches, the deepest first, then those that go with others. The contacts of
  /// a patch are more than `spacing` apart on A and on B. Contacts near those of the last call are preferred
  /// to others that are only slightly wider apart, so that a resting body keeps its contacts. The order of
  /// the contacts does not matter. The result is valid until the next call. Allocates nothing once warm.
  std::span<const ContactPatch> reduce(std::span<const Contact> contacts, double spacing) &;

  /// Returns the patches of the last call.
  std::span<const ContactPatch> last() const { return patches_; }

 private:
  using Members = std::span<const std::uint32_t>;

  ContactPatch spread(std::span<const Contact> contacts, Members members, double spacing) const;
  ContactPatch carrying(const ContactPatch& patch, std::span<const Contact> contacts, double spacing);
  static ContactPatch otherSides(const ContactPatch& patch, std::span<const Contact> contacts,
                                 Members members, double spacing);

  std::vector<std::uint32_t> left_;  // the contacts of no patch yet
  std::vector<std::uint32_t> members_;
  std::vector<ContactPatch> patches_;
  std::vector<ContactPatch> others_;  // the patches that go with patches_
  std::vector<Vec3> kept_;            // the points on A of the contacts of the last call
};

}  // namespace octoblisk::detail
