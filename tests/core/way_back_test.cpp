#include "contact/way_back.h"

#include <gtest/gtest.h>

namespace octoblisk::detail {
namespace {

/// Contacts of a body B with the surface z = 0 of A. A moves along the normals, so B moves against them.
class WayBackTest : public ::testing::Test {
 protected:
  static constexpr double kUp = -1.0, kDown = 1.0;  // where a contact pushes B

  static Contact push(double way, double depth, double x = 0.0) {
    const Vec3 normal(0, 0, way), on_surface(x, 0, 0);
    return {on_surface, on_surface + depth * normal, normal, -depth};
  }

  /// B moves from a height to another.
  void pushBack(double before, double after) {
    const auto at = [](double height) { return Pose{Mat3::Identity(), Vec3(0, 0, height)}; };
    const auto feet = [this](const Vec3&) { return std::span<const Vec3>(feet_); };
    const auto crossing = [](const Vec3& from, const Vec3& to) -> std::optional<RayHit> {
      if (from.z() * to.z() > 0.0) return std::nullopt;
      const double t = from.z() / (from.z() - to.z());
      return RayHit{t, 0, from + t * (to - from), Vec3::UnitZ(), from.z() < 0.0};
    };
    way_back_.noticeTouch(at(before));
    way_back_.pushBack(
        contacts_, at(after), {Vec3::Zero(), feet, kRadius}, [this](const Contact&) { return triangle_; },
        crossing);
  }

  /// The ways in which the contacts push, as a mean.
  double way() const {
    double sum = 0.0;
    for (const Contact& contact : contacts_) sum += contact.normal.z();
    return sum / static_cast<double>(contacts_.size());
  }

  WayBack way_back_;
  static constexpr double kFar = 9.0;
  const Triangle surface_{Vec3(-kFar, -kFar, 0), Vec3(kFar, -kFar, 0), Vec3(0, kFar, 0)};
  std::optional<Triangle> triangle_ = surface_;
  std::vector<Contact> contacts_;
  static constexpr double kRadius = 0.1;
  std::vector<Vec3> feet_;
};

TEST_F(WayBackTest, aBodyThatIsThroughIsPushedBack) {
  for (const double from : {0.3, -0.3}) {
    contacts_ = {push(from > 0.0 ? kDown : kUp, 0.1)};
    way_back_.noticeApart({});
    pushBack(from, -0.1 * from);
    ASSERT_EQ(contacts_.size(), 1u);
    EXPECT_EQ(way(), from > 0.0 ? kUp : kDown);
    EXPECT_NEAR(contacts_[0].distance, -0.33, 1e-12);
    EXPECT_TRUE(contacts_[0].point_on_a.isZero());
    EXPECT_NEAR(contacts_[0].point_on_b.z(), from > 0.0 ? -0.33 : 0.33, 1e-12);
  }
}

TEST_F(WayBackTest, aContactThatPushesBackStaysAndReplacesTheOthers) {
  contacts_ = {push(kDown, 0.1, 0), push(kUp, 0.05, 1), push(kDown, 0.2, 2)};
  way_back_.noticeApart({});
  pushBack(0.3, -0.01);
  ASSERT_EQ(contacts_.size(), 1u);
  EXPECT_EQ(contacts_[0].distance, -0.05);
}

TEST_F(WayBackTest, feetThatArePastTheSurfaceAreAsDeepAsTheyAre) {
  feet_ = {Vec3(1, 0, 0.05), Vec3(-1, 0, -0.25), Vec3(2, 0, 0.45)};
  contacts_ = {push(kDown, 0.1)};
  way_back_.noticeApart({});
  pushBack(0.3, -0.2);
  ASSERT_EQ(contacts_.size(), 2u);  // one of the feet is above the surface
  EXPECT_EQ(way(), kUp);
  EXPECT_NEAR(contacts_[0].distance, -0.15 - kRadius, 1e-12);
  EXPECT_NEAR(contacts_[1].distance, -0.45 - kRadius, 1e-12);
  EXPECT_LT((contacts_[1].point_on_a - Vec3(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((contacts_[1].point_on_b - Vec3(-1, 0, -0.45 - kRadius)).norm(), 1e-12);
  EXPECT_TRUE(way_back_.isThrough());
}

/// Two triangles push a rod sideways, each its own way, out of the edge that they share.
TEST_F(WayBackTest, feetAreFoundAlsoWhereContactsPushAlongTheSurface) {
  feet_ = {Vec3(0, 1, -0.2), Vec3(0, -1, 0.2)};
  contacts_ = {{Vec3::Zero(), Vec3(-0.1, 0, 0), Vec3::UnitX(), -0.1},
               {Vec3::Zero(), Vec3(0.1, 0, 0), -Vec3::UnitX(), -0.1}};
  way_back_.noticeApart({});
  pushBack(0.3, 0.1);
  ASSERT_EQ(contacts_.size(), 3u);
  EXPECT_NEAR(contacts_[2].distance, -0.1 - kRadius, 1e-12);
  EXPECT_EQ(contacts_[2].normal, kUp * Vec3::UnitZ());
  EXPECT_TRUE(way_back_.isThrough());
}

TEST_F(WayBackTest, aBodyThatIsThroughStaysSoUntilItIsBack) {
  way_back_.noticeApart({});
  for (const double height : {-0.05, -0.1, -0.05}) {
    contacts_ = {push(kDown, 0.1)};
    pushBack(height + 0.2, height);  // wherever it came from in this step
    EXPECT_EQ(way(), kUp) << height;
  }
  contacts_ = {push(kUp, 0.1)};
  pushBack(-0.05, 0.05);
  EXPECT_EQ(way(), kUp);
  contacts_ = {push(kDown, 0.1)};  // it was back, and comes from below
  pushBack(-0.1, 0.02);
  EXPECT_EQ(way(), kDown);
}

TEST_F(WayBackTest, aBodyThatWasAloneOrForgottenStartsAnew) {
  contacts_ = {push(kDown, 0.1)};
  way_back_.noticeApart({});
  pushBack(0.3, -0.1);
  EXPECT_EQ(way(), kUp);
  EXPECT_FALSE(way_back_.isNew());
  way_back_.forget();
  EXPECT_TRUE(way_back_.isNew());
  contacts_ = {push(kDown, 0.1)};
  pushBack(-0.3, 0.1);
  EXPECT_EQ(way(), kDown);
}

TEST_F(WayBackTest, contactsAlongTheSurfaceStay) {
  const Contact at_edge{Vec3::Zero(), Vec3(0, 0, -0.1), Vec3::UnitX(), -0.1};
  contacts_ = {at_edge};
  way_back_.noticeApart({});
  pushBack(0.3, -0.1);
  EXPECT_EQ(contacts_[0].normal, Vec3::UnitX());
}

/// The features of other bodies know their sides.
TEST_F(WayBackTest, theReferenceIsWhereTheBodiesWereApart) {
  const Pose apart{Mat3::Identity(), Vec3::UnitX()}, later{Mat3::Identity(), Vec3::UnitY()};
  EXPECT_FALSE(way_back_.reference());
  way_back_.noticeTouch(apart);
  way_back_.noticeTouch(later);
  EXPECT_EQ(way_back_.reference()->translation, apart.translation);
  way_back_.noticeApart(later);
  EXPECT_FALSE(way_back_.reference());
  EXPECT_EQ(way_back_.lastApart()->translation, later.translation);
  way_back_.forget();
  way_back_.noticeOverlap();
  way_back_.noticeTouch(apart);
  EXPECT_FALSE(way_back_.reference());
}

TEST_F(WayBackTest, contactsOfSolidsStay) {
  triangle_.reset();
  contacts_ = {push(kDown, 0.1), push(kUp, 0.1)};
  way_back_.noticeApart({});
  pushBack(0.3, -0.1);
  EXPECT_EQ(contacts_.size(), 2u);
}

}  // namespace
}  // namespace octoblisk::detail
