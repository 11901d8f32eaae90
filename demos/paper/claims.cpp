#include "paper/claims.h"

#include <utility>

namespace octoblisk::demos {

Section claimsSection(const std::vector<Claim>& claims) {
  Table table{.name = "claims",
              .caption = "What the paper claims of its improved method, and what it did here",
              .columns = {"claim", "paper", "here"},
              .rows = {}};
  for (const Claim& claim : claims) table.rows.push_back({claim.claim, claim.paper, claim.here});
  return {
      .title = "The claims",
      .paragraphs = {"A share is a change against the traditional method: below 0, the improved one needs "
                     "less. How each is found, and what it hides, is said in the section of its table."},
      .tables = {std::move(table)}};
}

}  // namespace octoblisk::demos
