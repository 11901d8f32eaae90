#include "octoblisk/contacts.h"

#include <algorithm>

#include "octoblisk/leaf_triangles.h"
#include "octoblisk/traversal.h"
#include "octoblisk/triangle_convex.h"
#include "octoblisk/triangle_pair.h"

namespace octoblisk {
namespace {

void sortByTriangles(std::vector<Contact>& found) {
  std::ranges::sort(found, {}, [](const Contact& c) { return TrianglePair{c.triangle_a, c.triangle_b}; });
}

}  // namespace

void contacts(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found) {
  found.clear();
  traversePairs(a, b, b_in_a, threshold, [&](Child leaf_a, Child leaf_b) {
    const LeafTriangles in_a(a, leaf_a), in_b(b, leaf_b, &b_in_a);
    return forEachPairWithin(in_a, in_b, threshold, [&](std::size_t i, std::size_t j) {
      Contact contact = contactOf(in_a[i], in_b[j]);
      if (contact.distance <= threshold) {
        contact.triangle_a = in_a.id(i);
        contact.triangle_b = in_b.id(j);
        found.push_back(contact);
      }
      return false;
    });
  });
  sortByTriangles(found);
}

void contacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found) {
  found.clear();
  const Aabb bounds = b.bounds();
  const Pose a_in_b = b_in_a.inverse();
  traverseBox(a, b_in_a * Obb{bounds.center(), Mat3::Identity(), bounds.halfExtents()}, threshold,
              [&](Child leaf) {
                const LeafTriangles triangles(a, leaf, &a_in_b);
                for (std::size_t i = 0; i < triangles.size(); ++i) {
                  std::optional<Contact> contact = contactOf(triangles[i], b, threshold);
                  if (!contact) continue;
                  contact->point_on_a = b_in_a * contact->point_on_a;
                  contact->point_on_b = b_in_a * contact->point_on_b;
                  contact->normal = b_in_a.rotation * contact->normal;
                  contact->triangle_a = triangles.id(i);
                  found.push_back(*contact);
                }
                return false;
              });
  sortByTriangles(found);
}

}  // namespace octoblisk
