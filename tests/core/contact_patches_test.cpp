#include "contact/contact_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

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
  const auto patches = reducer.reduce(square(Vec3::Zero(), 0, 7), 0.0);
  ASSERT_EQ(patches.size(), 1u);
  ASSERT_EQ(patches[0].count, 4);
  EXPECT_EQ(patches[0].contacts[0].distance, -0.5);
  for (int i = 1; i < 4; ++i) {  // three of the four corners of the square
    const Vec3& p = patches[0].contacts[static_cast<std::size_t>(i)].point_on_a;
    EXPECT_EQ(p.cwiseAbs(), Vec3(2, 2, 0));
  }
}

TEST(ContactPatches, contactsThatPushAlikeAreOnePatchHoweverFarApart) {
  std::vector<Contact> contacts = square(Vec3::Zero(), 0, 1);
  std::vector<Contact> other = square(Vec3(100, 0, 0), 50, 2);
  for (Contact& contact : other) contact.distance += 0.05;
  contacts.insert(contacts.end(), other.begin(), other.end());
  ContactPatches reducer;
  const auto patches = reducer.reduce(contacts, 0.0);
  ASSERT_EQ(patches.size(), 1u);
  const auto isOfOther = [](const Contact& contact) { return contact.triangle_b == 2; };
  EXPECT_EQ(std::ranges::count_if(patches[0].points(), isOfOther), 2);
}

/// A rod that lies on one of its facets. The edges of the next facets are wider apart, but above the floor.
TEST(ContactPatches, aNarrowFaceCarriesABodyBesideWiderContacts) {
  std::vector<Contact> contacts;
  for (const double y : {-1.0, 1.0}) {
    for (const double x : {-0.3, -0.1, 0.1, 0.3}) {
      const double clearance = std::abs(x) > 0.2 ? 0.04 : 0.0;
      contacts.push_back(
          contactAt(Vec3(x, y, 0), Vec3::UnitZ(), clearance, static_cast<std::uint32_t>(contacts.size()), 0));
    }
  }
  ContactPatches reducer;
  const auto patches = reducer.reduce(contacts, 0.1);
  int carrying = 0, wide = 0;
  for (const ContactPatch& patch : patches) {
    for (const Contact& contact : patch.points()) ++(contact.distance == 0.0 ? carrying : wide);
  }
  EXPECT_EQ(carrying, 4);
  EXPECT_GE(wide, 2);
  for (Contact& contact : contacts) contact.distance = 0.0;
  EXPECT_EQ(reducer.reduce(contacts, 0.1).size(), 1u);
}

/// Whoever has room for one patch only keeps the deepest.
TEST(ContactPatches, theDeepestPatchIsFirst) {
  ContactPatches reducer;
  const auto patches = reducer.reduce(std::vector{contactAt(Vec3::Zero(), Vec3::UnitX(), -0.1, 0, 0),
                                                  contactAt(Vec3::Zero(), Vec3::UnitY(), -0.5, 1, 1),
                                                  contactAt(Vec3::Zero(), Vec3::UnitZ(), -0.3, 2, 2)},
                                      1.0);
  const auto distanceOf = [](const ContactPatch& patch) { return patch.contacts[0].distance; };
  EXPECT_TRUE(std::ranges::equal(patches, std::vector{-0.5, -0.3, -0.1}, {}, distanceOf));
}

/// A contact with one side of a groove along y, whose normal is turned by some degrees from z.
Contact sideOfGroove(double degrees, const Vec3& place, double distance, std::uint32_t a) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return contactAt(place, {std::sin(angle), 0, std::cos(angle)}, distance, a, 9);
}

std::size_t countAll(std::span<const ContactPatch> patches) {
  std::size_t count = 0;
  for (const ContactPatch& patch : patches) count += patch.points().size();
  return count;
}

TEST(ContactPatches, theSidesOfAGrooveAreTwoPatches) {
  const auto countsOf = [](double half, double apart, double less_deep) {
    ContactPatches reducer;
    const auto patches = reducer.reduce(std::vector{sideOfGroove(half, {0, 0, 0}, -0.5, 0),
                                                    sideOfGroove(-half, {apart, 0, 0}, -0.5 + less_deep, 1)},
                                        1.0);
    return std::pair(patches.size(), countAll(patches));
  };
  using Counts = std::pair<std::size_t, std::size_t>;  // of patches, of contacts
  EXPECT_EQ(countsOf(3, 0.5, 0.05), Counts(2, 2));
  EXPECT_EQ(countsOf(2, 0.5, 0.05), Counts(1, 1)) << "hardly a groove";
  EXPECT_EQ(countsOf(3, 1.5, 0.05), Counts(1, 2)) << "apart, so that one patch keeps both";
  EXPECT_EQ(countsOf(3, 0.5, 0.15), Counts(1, 1)) << "only one side touches";
}

/// A bar touches both sides at both of its ends.
TEST(ContactPatches, bothSidesOfAGrooveAreKeptEverywhere) {
  ContactPatches reducer;
  const auto patches = reducer.reduce(
      std::vector{sideOfGroove(10, {0, 0, 0}, -0.5, 0), sideOfGroove(-10, {0.5, 0, 0}, -0.5, 1),
                  sideOfGroove(10, {0, 9, 0}, -0.5, 2), sideOfGroove(-10, {0.5, 9, 0}, -0.5, 3)},
      1.0);
  EXPECT_EQ(patches.size(), 2u);
  EXPECT_EQ(countAll(patches), 4u);
}

/// Bullet also takes contacts for one if only their points on B are near.
TEST(ContactPatches, aCornerBetweenTwoWallsKeepsBoth) {
  Contact left = sideOfGroove(10, {0, 0, 0}, 0.0, 0), right = sideOfGroove(-10, {3, 0, 0}, 0.0, 1);
  left.point_on_b = right.point_on_b = Vec3(1.5, 0, 8);
  ContactPatches reducer;
  EXPECT_EQ(countAll(reducer.reduce(std::vector{left, right}, 1.0)), 2u);
}

TEST(ContactPatches, manySidesAtOnePlaceLeaveRoomForOtherPlaces) {
  std::vector<Contact> contacts;
  for (std::uint32_t k = 0; k < 25; ++k) {
    const Vec3 normal(0.12 * (k % 5 - 2.0), 0.12 * (k / 5 - 2.0), 1.0);
    contacts.push_back(contactAt(0.1 * normal, normal.normalized(), -0.5, k, 7));
  }
  contacts.push_back(contactAt({50, 0, 0}, Vec3::UnitX(), -0.1, 99, 8));
  ContactPatches reducer;
  const auto patches = reducer.reduce(contacts, 1.0);
  EXPECT_EQ(patches.size(), 3u);
  EXPECT_EQ(patches[1].contacts[0].triangle_a, 99u);
}

TEST(ContactPatches, contactsOfAPatchAreApart) {
  ContactPatches reducer;
  const auto patches = reducer.reduce(square(Vec3::Zero(), 0, 7), 3.0);
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_EQ(patches[0].count, 1);  // all are within 2.83 of the deepest one in the middle
  EXPECT_EQ(reducer.reduce(square(Vec3::Zero(), 0, 7), 2.5)[0].count, 4);
}

TEST(ContactPatches, keepsContactsThatAreHardlyLessWideApart) {
  std::vector<Contact> contacts = square(Vec3::Zero(), 0, 7);
  ContactPatches reducer;
  reducer.reduce(contacts, 0.5);
  const std::vector<Contact> before(reducer.last()[0].points().begin(), reducer.last()[0].points().end());
  // A corner that was not kept moves slightly outwards, and a contact becomes about as deep as the deepest.
  const auto keeps = [&](double out, double depth) {
    std::vector<Contact> moved = contacts;
    for (Contact& contact : moved) {
      const auto isIt = [&](const Contact& kept) { return kept.triangle_a == contact.triangle_a; };
      if (contact.point_on_a.cwiseAbs() == Vec3(2, 2, 0) && std::ranges::none_of(before, isIt)) {
        contact.point_on_a *= out;
      }
      if (contact.point_on_a == Vec3(0, 1, 0)) contact.distance = -depth;
    }
    ContactPatches again = reducer;
    const auto patch = again.reduce(moved, 0.5)[0];
    return std::ranges::equal(patch.points(), before, {}, &Contact::triangle_a, &Contact::triangle_a);
  };
  EXPECT_TRUE(keeps(1.1, 0.48));
  EXPECT_FALSE(keeps(2.0, 0.48));
  EXPECT_FALSE(keeps(1.1, 0.52)) << "a body that rolls needs its deepest contact at once";
}

TEST(ContactPatches, normalsFarApartAreTwoPatches) {
  std::vector<Contact> contacts = {contactAt({0, 0, 0}, Vec3::UnitZ(), -0.2, 0, 0),
                                   contactAt({1, 0, 0}, -Vec3::UnitZ(), -0.1, 1, 0)};
  ContactPatches reducer;
  EXPECT_EQ(reducer.reduce(contacts, 0.0).size(), 2u);
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
    const auto expected = one.reduce(found, 0.0);
    std::ranges::shuffle(found, random);
    const auto shuffled = two.reduce(found, 0.0);
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

TEST(ContactPatches, everyNormalIsWithin45DegreesOfAPatchsDeepest) {
  std::mt19937_64 random(43);
  for (int i = 0; i < 50; ++i) {
    std::vector<Contact> contacts;
    for (std::uint32_t c = 0; c < 100; ++c) {
      const Vec3 normal = testing::randomRotation(random).col(0);
      contacts.push_back(contactAt(Vec3::Zero(), normal, -testing::uniform(random, 0, 1), c, c));
    }
    ContactPatches reducer;
    const auto patches = reducer.reduce(contacts, 0.0);
    ASSERT_GT(patches.size(), 5u);
    ASSERT_LT(patches.size(), ContactPatches::kMaxPatches);
    for (const Contact& contact : contacts) {
      const auto pushesAlike = [&](const ContactPatch& patch) {
        return patch.contacts[0].normal.dot(contact.normal) >= std::sqrt(0.5) - 1e-12;
      };
      ASSERT_TRUE(std::ranges::any_of(patches, pushesAlike));
    }
  }
}

/// A normal that is zero or not a number is in the direction of nothing, not even of itself.
TEST(ContactPatches, everyContactIsInAPatch) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Contact> contacts = {contactAt(Vec3::Zero(), Vec3::Zero(), -0.5, 0, 0),
                                         contactAt(Vec3::UnitX(), Vec3(0, 0, nan), -0.4, 1, 0),
                                         contactAt(Vec3::UnitY(), Vec3::UnitZ(), -0.3, 2, 0)};
  ContactPatches reducer;
  EXPECT_EQ(reducer.reduce(contacts, 0.0).size(), 3u);
}

}  // namespace
}  // namespace octoblisk
