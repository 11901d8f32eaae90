// A track of a replay as JSON: numbers in base64, in the order of this machine's bytes.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "report/replay.h"

namespace octoblisk::demos {

using PageJson = nlohmann::ordered_json;

/// Where the track has more than `most_contacts`, the deepest of each pose alone; adds to those left out.
PageJson trackJson(const ReplayTrack& track, std::size_t most_contacts, std::size_t& contacts_left_out);

}  // namespace octoblisk::demos
