// The paper's claims, each beside the result of the same experiment here.
#pragma once

#include <string>
#include <vector>

#include "render/document.h"

namespace octoblisk::demos {

/// Usually a change compared with the traditional method: "-12.8 %".
struct Claim {
  std::string claim;
  std::string paper, here;
};

/// The report's first section.
Section claimsSection(const std::vector<Claim>& claims);

}  // namespace octoblisk::demos
