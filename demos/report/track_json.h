// Converts a track of a replay to JSON, with numbers in base64 in this machine's byte order.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "report/replay.h"

namespace octoblisk::demos {

using PageJson = nlohmann::ordered_json;

/// If the track has more than `most_contacts`, keeps only the deepest of each pose, and counts those left
/// out.
PageJson trackJson(const ReplayTrack& track, std::size_t most_contacts, std::size_t& contacts_left_out);

}  // namespace octoblisk::demos
