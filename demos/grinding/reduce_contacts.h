// The many contacts of a pose reduced to those that a report shows.
#pragma once

#include <span>
#include <vector>

#include "grinding/grinding_cell.h"

namespace octoblisk::demos {

/// The contacts of each part with each blade, reduced by ContactPatches (octoblisk/contact_patches.h): up to
/// four of each patch of touch, by part, then by blade. The deepest contact of a part with a blade is always
/// kept, so a pose's verdict is the same as by all contacts. `blade_of_triangle`: of the blisk's mesh.
std::vector<PartContact> reduceContacts(std::span<const PartContact> contacts,
                                        std::span<const int> blade_of_triangle);

}  // namespace octoblisk::demos
