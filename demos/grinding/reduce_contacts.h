// Reduces the many contacts of a pose to those that a report shows.
#pragma once

#include <span>
#include <vector>

#include "grinding/grinding_cell.h"

namespace octoblisk::demos {

/// Reduces the contacts of each part with each blade with ContactPatches (octoblisk/contact_patches.h) to at
/// most four per contact patch, ordered by part, then by blade. The deepest contact of a part with a blade is
/// always kept, so a pose's verdict is the same as with all contacts. `blade_of_triangle` is for the blisk's
/// mesh.
std::vector<PartContact> reduceContacts(std::span<const PartContact> contacts,
                                        std::span<const int> blade_of_triangle);

}  // namespace octoblisk::demos
