// Reduces the many contacts of a pose to those that a report shows.
#pragma once

#include <span>
#include <vector>

#include "grinding/grinding_cell.h"

namespace octoblisk::demos {

/// Reduces the contacts of each part with each blade or fixture to a few of each contact patch
/// (contact/contact_patches.h), ordered by part, then by body. The deepest contact of a part with a body is
/// always kept, so a pose's verdict is the same as with all contacts. `body_of_triangle` is that of
/// Surroundings (fixture.h).
std::vector<PartContact> reduceContacts(std::span<const PartContact> contacts,
                                        std::span<const int> body_of_triangle);

}  // namespace octoblisk::demos
