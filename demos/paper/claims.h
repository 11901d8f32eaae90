// The paper's claims, each beside what the same experiment gave here.
#pragma once

#include <string>
#include <vector>

#include "render/document.h"

namespace octoblisk::demos {

/// A change against the traditional method, as a rule: "-12.8 %".
struct Claim {
  std::string claim;
  std::string paper, here;
};

/// The report's first section.
Section claimsSection(const std::vector<Claim>& claims);

}  // namespace octoblisk::demos
