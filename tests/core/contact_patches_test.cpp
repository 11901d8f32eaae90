#include "contact/contact_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "octoblisk/contacts.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

Contact contactAt(const Vec3& point, const Vec3& normal, double distance, std::uint32_t a, std::uint32_t b) {
  return {point, point, normal, distance, a, b};
}

/// A square of contacts that share the triangle `b`, the middle one deepest.
std::vector<Contact> square(const Vec3& center, std::uint32_t first, std::uint32_t b) {
  std::vector<Contact> contacts;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      const double depth = x == 0 && y == 0 ? 0.5 : 0.1;
      contacts.push_back(contactAt(center + Vec3(x, y, 0), Vec3::UnitZ(), -depth, first++, b));
    }
  }
  return contacts;
}

TEST(ContactPatches, keepsTheDeepestAndTheCorners) {
  ContactPatches reducer;
  const auto patches = reducer.reduce(square(Vec3::Zero(), 0, 7));
  ASSERT_EQ(patches.size(), 1u);
  ASSERT_EQ(patches[0].count, 4);
  EXPECT_EQ(patches[0].contacts[0].distance, -0.5);
  for (int i = 1; i < 4; ++i) {  // three of the four corners of the square
    const Vec3& p = patches[0].contacts[static_cast<std::size_t>(i)].point_on_a;
    EXPECT_EQ(p.cwiseAbs(), Vec3(2, 2, 0));
  }
}

TEST(ContactPatches, regionsThatShareNoTriangleAreApart) {
  std::vector<Contact> contacts = square(Vec3::Zero(), 0, 1);
  const std::vector<Contact> other = square(Vec3(100, 0, 0), 50, 2);
  contacts.insert(contacts.end(), other.begin(), other.end());
  ContactPatches reducer;
  EXPECT_EQ(reducer.reduce(contacts).size(), 2u);
  contacts.push_back(contactAt({50, 0, 0}, Vec3::UnitZ(), -0.1, 0, 2));  // a chain from one to the other
  EXPECT_EQ(reducer.reduce(contacts).size(), 1u);
}

TEST(ContactPatches, normalsFarApartAreTwoPatches) {
  std::vector<Contact> contacts = {contactAt({0, 0, 0}, Vec3::UnitZ(), -0.2, 0, 0),
                                   contactAt({1, 0, 0}, -Vec3::UnitZ(), -0.1, 1, 0)};
  ContactPatches reducer;
  EXPECT_EQ(reducer.reduce(contacts).size(), 2u);
}

TEST(ContactPatches, doesNotDependOnTheOrder) {
  const ClusteredOctree a = ClusteredOctree::build(testing::fan(9, 12)),
                        b = ClusteredOctree::build(testing::torus(0.5, 0.2, 24, 12));
  std::mt19937_64 random(41);
  std::vector<Contact> found;
  int with_patches = 0;
  for (int i = 0; i < 100; ++i) {
    contacts(a, b, testing::randomPose(random, 1.0), 0.02, found);
    ContactPatches one, two;
    const auto expected = one.reduce(found);
    std::ranges::shuffle(found, random);
    const auto shuffled = two.reduce(found);
    ASSERT_EQ(expected.size(), shuffled.size());
    for (std::size_t p = 0; p < expected.size(); ++p) {
      ASSERT_EQ(expected[p].count, shuffled[p].count);
      for (std::size_t c = 0; c < expected[p].points().size(); ++c) {
        ASSERT_EQ(expected[p].contacts[c].triangle_a, shuffled[p].contacts[c].triangle_a);
        ASSERT_EQ(expected[p].contacts[c].triangle_b, shuffled[p].contacts[c].triangle_b);
      }
    }
    with_patches += expected.size() > 1;
    if (found.empty()) continue;
    double deepest = 1.0, kept = 1.0;
    for (const Contact& c : found) deepest = std::min(deepest, c.distance);
    for (const ContactPatch& patch : expected) kept = std::min(kept, patch.contacts[0].distance);
    ASSERT_EQ(kept, deepest);
  }
  EXPECT_GT(with_patches, 20);
}

TEST(ContactPatches, keepsTheDeepestWhereThereAreTooMany) {
  std::vector<Contact> contacts;
  for (std::uint32_t i = 0; i < 40; ++i)
    contacts.push_back(contactAt({double(i), 0, 0}, Vec3::UnitZ(), -0.01 * i, i, i));
  ContactPatches reducer;
  const auto patches = reducer.reduce(contacts);
  ASSERT_EQ(patches.size(), ContactPatches::kMaxPatches);
  for (const ContactPatch& patch : patches) EXPECT_GE(patch.contacts[0].triangle_a, 24u);
}

}  // namespace
}  // namespace octoblisk
