// Hertz's closed forms, and the sliced contact of a wheel compared with them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cmm_shapes.h"
#include "hertz.h"
#include "paper/cmm/wheel_contact.h"

namespace octoblisk::demos {
namespace {

using std::numbers::pi;

TEST(CmmHertz, lineContactCarriesItsForceAndBendsToItsRadius) {
  const double modulus = 2.3, radius = 9.5, load = 1.1;
  const LineContact contact = lineContact(load, radius, modulus);
  EXPECT_NEAR(0.5 * pi * contact.peak_pressure * contact.half_width, load, 1e-12);
  // Under p0 √(1 - x²/b²) a half-plane's surface bends to the curvature 2 p0 / (E* b), which is the wheel's.
  EXPECT_NEAR(2.0 * contact.peak_pressure / (modulus * contact.half_width), 1.0 / radius, 1e-12);
}

TEST(CmmHertz, nothingTouchesWithoutForce) {
  EXPECT_EQ(lineContact(0.0, 10.0, 2.0).half_width, 0.0);
  EXPECT_EQ(ellipticContact(0.0, 10.0, 20.0, 2.0).peak_pressure, 0.0);
}

TEST(CmmHertz, equalRadiiAreASphere) {
  const double force = 5.0, radius = 12.0, modulus = 3.0;
  const EllipticContact contact = ellipticContact(force, radius, radius, modulus);
  const double a = std::cbrt(0.75 * force * radius / modulus);
  EXPECT_NEAR(contact.semi_major, a, 1e-7 * a);
  EXPECT_NEAR(contact.semi_minor, a, 1e-7 * a);
  EXPECT_NEAR(contact.approach, a * a / radius, 1e-7 * a);
  EXPECT_NEAR(contact.peak_pressure, 2.0 * a * modulus / (pi * radius), 1e-7);
}

// The gap of the undeformed surfaces, from the pressure's deflections: Johnson's equations, with the standard
// library's elliptic integrals.
TEST(CmmHertz, ellipsesMeetBothRadii) {
  for (const double greater : {9.6, 12.0, 40.0, 300.0, 1e5}) {
    const double lesser = 9.5, force = 7.0, modulus = 2.3;
    const EllipticContact c = ellipticContact(force, greater, lesser, modulus);
    ASSERT_LT(c.semi_minor, c.semi_major);
    const double e_squared = 1.0 - c.semi_minor * c.semi_minor / (c.semi_major * c.semi_major);
    const double e = std::sqrt(e_squared);
    const double first = std::comp_ellint_1(e), second = std::comp_ellint_2(e);
    const double scale = c.peak_pressure / modulus * c.semi_minor / (e_squared * c.semi_major * c.semi_major);
    EXPECT_NEAR(scale * (first - second) * 2.0 * greater, 1.0, 1e-6) << greater;
    EXPECT_NEAR(scale * (second / (1.0 - e_squared) - first) * 2.0 * lesser, 1.0, 1e-6) << greater;
    EXPECT_NEAR(2.0 / 3.0 * pi * c.semi_major * c.semi_minor * c.peak_pressure, force, 1e-9);
    EXPECT_NEAR(c.approach, c.peak_pressure / modulus * c.semi_minor * first, 1e-9);
  }
}

TEST(CmmHertz, slenderEllipsesAreLineContactsInTheirMiddle) {
  const double radius = 9.5, modulus = 2.3;
  const EllipticContact ellipse = ellipticContact(20.0, 1e7, radius, modulus);
  const double load_in_the_middle = 0.5 * pi * ellipse.peak_pressure * ellipse.semi_minor;
  const LineContact line = lineContact(load_in_the_middle, radius, modulus);
  EXPECT_NEAR(line.half_width / ellipse.semi_minor, 1.0, 1e-3);
  EXPECT_NEAR(line.peak_pressure / ellipse.peak_pressure, 1.0, 1e-3);
}

TEST(CmmHertz, moduli) {
  // Stiff steel on rubber that keeps its volume: E* = E / (1 - 1/4).
  EXPECT_NEAR(contactModulus({3.0, 0.5}, {1e15, 0.3}), 4.0, 1e-9);
  EXPECT_NEAR(contactModulus({6.0, 0.0}, {3.0, 0.0}), 2.0, 1e-12);
  EXPECT_NEAR(rubberModulus(50.0), 0.0981 * 437.168 / (0.137505 * 127.0), 1e-12);
  EXPECT_LT(rubberModulus(40.0), rubberModulus(60.0));
}

class CmmWheelContact : public ::testing::Test {
 protected:
  std::vector<ContactSlice> contactOn(const SectionGrid& grid, double x, double indentation) const {
    std::vector<ContactSlice> slices;
    findContact(grid, 0, stationAt(grid, x), wheel, indentation, slices);
    return slices;
  }

  ContactWheel wheel;
};

TEST_F(CmmWheelContact, onAFlatIsHertzsLineContact) {
  const SectionGrid grid = plate(60.0, 173, 1.0, 2);
  const auto slices = contactOn(grid, 0.0, indentationOnFlat(wheel, 20.0));
  const LineContact line = lineContact(20.0 / wheel.width, wheel.radius, wheel.contactModulus());
  EXPECT_NEAR(forceOf(slices, grid, 0), 20.0, 1e-9);
  for (const ContactSlice& slice : slices) {
    EXPECT_NEAR(slice.half_width, line.half_width, 1e-9);
    EXPECT_NEAR(slice.peak_pressure, line.peak_pressure, 1e-9);
  }
}

TEST_F(CmmWheelContact, halfOverAnEdgeCarriesHalf) {
  const SectionGrid grid = plate(60.0, 201, 1.0, 2);
  const double indentation = indentationOnFlat(wheel, 20.0);
  EXPECT_NEAR(forceOf(contactOn(grid, -30.0, indentation), grid, 0), 10.0, 1e-9);
  EXPECT_NEAR(forceOf(contactOn(grid, 30.0, indentation), grid, 0), 10.0, 1e-9);
  EXPECT_NEAR(forceOf(contactOn(grid, 24.0, indentation), grid, 0), 16.0, 1e-9);
}

TEST_F(CmmWheelContact, onAConvexSurfaceIsTheClosedForm) {
  const double curvature_radius = 60.0;
  const SectionGrid grid = openGrid(40.0, 2001, 1.0, 2, [&](double x) {
    return std::sqrt(curvature_radius * curvature_radius - x * x) - curvature_radius;
  });
  const double d = 0.2;  // small enough that the contact ends within the wheel
  const double half_length = std::sqrt(2.0 * d * curvature_radius);
  ASSERT_LT(half_length, 0.5 * wheel.width);
  const auto slices = contactOn(grid, 0.0, d);
  // ∫ (π/4) E* (d - x²/2R') dx
  const double expected = pi / 3.0 * wheel.contactModulus() * d * half_length;
  EXPECT_NEAR(forceOf(slices, grid, 0), expected, 0.01 * expected);
  // Slices are independent, so they do not give Hertz's ellipse; this measures the difference.
  const EllipticContact ellipse =
      ellipticContact(expected, curvature_radius, wheel.radius, wheel.contactModulus());
  double peak = 0.0;
  for (const ContactSlice& slice : slices) peak = std::max(peak, slice.peak_pressure);
  EXPECT_NEAR(peak / ellipse.peak_pressure, 1.0, 0.15);
}

TEST_F(CmmWheelContact, onAConcaveSurfaceRestsOnItsRims) {
  const SectionGrid grid = openGrid(60.0, 601, 1.0, 2, [](double x) { return x * x / 400.0; });
  const auto slices = contactOn(grid, 0.0, 0.1);  // the rims touch 0.25 mm higher than the middle
  ASSERT_FALSE(slices.empty());
  for (const ContactSlice& slice : slices) {
    EXPECT_GT(std::abs(grid.at(0, slice.station).flat.x()), 7.5);
  }
}

TEST_F(CmmWheelContact, nothingWithoutIndentation) {
  EXPECT_TRUE(contactOn(plate(60.0, 61, 1.0, 2), 0.0, 0.0).empty());
}

}  // namespace
}  // namespace octoblisk::demos
