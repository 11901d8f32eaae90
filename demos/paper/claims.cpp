#include "paper/claims.h"

#include <utility>

namespace octoblisk::demos {

Section claimsSection(const std::vector<Claim>& claims) {
  Table table{.name = "claims",
              .caption = "The paper's claims for its improved method, and its results here",
              .columns = {"claim", "paper", "here"},
              .rows = {}};
  for (const Claim& claim : claims) table.rows.push_back({claim.claim, claim.paper, claim.here});
  return {.title = "The claims",
          .paragraphs = {"A percentage is a change compared with the traditional method: below 0, the "
                         "improved method needs less. The section of each table explains how the numbers are "
                         "found and what they leave out."},
          .tables = {std::move(table)}};
}

}  // namespace octoblisk::demos
