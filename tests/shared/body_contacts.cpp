#include "shared/body_contacts.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "shared/brute_force.h"
#include "shared/solids.h"

namespace octoblisk::testing {

std::string faultOfContacts(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a,
                            double threshold, double not_felt, double noise,
                            const std::vector<Contact>& found) {
  const auto message = [](const auto&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    return stream.str();
  };
  constexpr double kNearer = 0.99;  // the height over a face of a corner that is beside it by a tenth of that
  const std::vector<Contact> all = bruteForceContacts(a, b, b_in_a, threshold / kNearer + noise);
  if (all.empty()) return found.empty() ? "" : message(found.size(), " contacts where nothing is near");
  const double nearest = deepest(all);
  if (found.empty()) {
    if (nearest > threshold - noise) return "";
    return message("no contact where the distance is ", nearest);
  }
  const double least = deepest(found);
  const bool do_meet = nearest <= 0.0;
  if (do_meet && least > noise) return message("no contact touches: ", least);
  if (!do_meet && !(least > kNearer * nearest - noise && least <= nearest + not_felt + noise))
    return message("the nearest contact is at ", least, " instead of ", nearest);
  for (const Contact& contact : found) {
    const double beside = 0.1 * contact.distance + noise,
                 of_a = bruteForceDistance(a.triangle(contact.triangle_a), contact.point_on_a),
                 of_b = bruteForceDistance(b_in_a * b.triangle(contact.triangle_b), contact.point_on_b);
    const bool does_overlap = contact.distance < 0.0 || (do_meet && contact.distance == 0.0);
    if (!does_overlap && (of_a > beside || of_b > beside))
      return message("points are ", of_a, " and ", of_b, " from their triangles, at a distance of ",
                     contact.distance);
    const double along = (contact.point_on_a - contact.point_on_b).dot(contact.normal);
    if (std::abs(along - contact.distance) > noise || std::abs(contact.normal.norm() - 1.0) > noise)
      return message("points and normal give ", along, " instead of ", contact.distance);
  }
  return "";
}

}  // namespace octoblisk::testing
