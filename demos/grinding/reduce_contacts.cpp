#include "grinding/reduce_contacts.h"

#include <map>
#include <utility>

#include "contact/contact_patches.h"

namespace octoblisk::demos {

using namespace detail;

std::vector<PartContact> reduceContacts(std::span<const PartContact> contacts,
                                        std::span<const int> body_of_triangle) {
  std::map<std::pair<std::size_t, int>, std::vector<Contact>> by_part_and_body;
  for (const auto& [part, contact] : contacts) {
    by_part_and_body[{part, body_of_triangle[contact.triangle_a]}].push_back(contact);
  }
  std::vector<PartContact> kept;
  for (const auto& [part_and_body, group] : by_part_and_body) {
    ContactPatches patches;
    for (const ContactPatch& patch : patches.reduce(group, 0.0)) {
      for (const Contact& contact : patch.points()) kept.push_back({part_and_body.first, contact});
    }
  }
  return kept;
}

}  // namespace octoblisk::demos
