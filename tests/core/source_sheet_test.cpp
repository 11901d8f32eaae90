// The sheet that is made of another library's triangles near a body.
#include "contact/source_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::uniform;

/// Hands out all its triangles, whatever is asked for, in the order of the list.
class ListedTriangles final : public TriangleSource {
 public:
  Aabb bounds() const override {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
  }
  void forEachTriangleIn(const Aabb&, FunctionRef<void(const SourceTriangle&)> visit) const override {
    for (const SourceTriangle& triangle : triangles) visit(triangle);
  }

  std::vector<SourceTriangle> triangles;
};

ListedTriangles listed(const TriangleMesh& mesh) {
  ListedTriangles source;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
    source.triangles.push_back({mesh.triangle(t), static_cast<int>(t % 3), static_cast<int>(t)});
  return source;
}

Aabb boxAround(const Vec3& center, const Vec3& half_extents) {
  return {center - half_extents, center + half_extents};
}

/// The triangles of a sheet with their numbers. Those of the mesh must be the same.
std::vector<SourceTriangle> trianglesOf(const SourceSheet& sheet) {
  std::vector<SourceTriangle> all;
  if (sheet.isEmpty()) return all;
  const TriangleMesh& mesh = sheet.features().tree().mesh();
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    all.push_back(sheet.triangle(t));
    EXPECT_EQ(mesh.triangle(t), all.back().corners);
  }
  return all;
}

bool areSame(const std::vector<SourceTriangle>& a, const std::vector<SourceTriangle>& b) {
  return std::ranges::equal(a, b, [](const SourceTriangle& s, const SourceTriangle& t) {
    return s.corners == t.corners && s.part == t.part && s.index == t.index;
  });
}

/// All triangles that meet the box are read once, and none that is far from it.
TEST(SourceSheet, hasTheTrianglesInTheBox_vs_bruteForce) {
  std::mt19937_64 random(70);
  const testing::SharedMesh meshes[] = {testing::soup(random, 300, 5, 0.4), testing::torus(3, 1, 24, 12),
                                        testing::waveSheet(4, 0.3, 12)};
  SourceSheet sheet;
  int none = 0, some = 0, others = 0;
  for (int i = 0; i < 600; ++i) {
    const testing::SharedMesh& mesh = meshes[i % 3];
    const ListedTriangles source = listed(*mesh);
    const Vec3 half_extents(uniform(random, 0.0, 0.6), uniform(random, 0.0, 0.6), uniform(random, 0.0, 0.6));
    const Aabb box = boxAround(testing::randomPoint(random, 4.0), half_extents);
    sheet.read(source, box);
    const std::vector<SourceTriangle> read = trianglesOf(sheet);
    std::vector<int> times(mesh->triangleCount(), 0);
    for (const SourceTriangle& triangle : read) ++times[static_cast<std::size_t>(triangle.index)];
    // Whole cells that are less than twice as large as half the box.
    const Aabb nearby = box.grown(2.0 * half_extents.maxCoeff());
    std::size_t in_box = 0;
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
      const Aabb bounds = boundsOf(mesh->triangle(t));
      const bool must = box.meets(bounds), may = nearby.meets(bounds);
      in_box += must;
      ASSERT_LE(times[t], 1) << i;
      if (must) {
        ASSERT_EQ(times[t], 1) << i << ' ' << t;
      } else if (!may) {
        ASSERT_EQ(times[t], 0) << i << ' ' << t;
      }
    }
    ASSERT_EQ(sheet.isEmpty(), read.empty());
    none += in_box == 0;
    some += in_box > 0;
    others += read.size() > in_box;
  }
  EXPECT_GT(none, 100);
  EXPECT_GT(some, 100);
  EXPECT_GT(others, 100);
}

TEST(SourceSheet, isASheetEverywhere) {
  const testing::SharedMesh mesh = testing::boxMesh({1, 1, 1});
  SourceSheet sheet;
  sheet.read(listed(*mesh), mesh->bounds());
  ASSERT_FALSE(sheet.isEmpty());
  EXPECT_TRUE(sheet.features().hasSheets());
  for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) EXPECT_TRUE(sheet.features().isSheet(t));
  EXPECT_EQ(sheet.features().cornerCount(), 8u);  // triangles share corners at the same place
}

TEST(SourceSheet, leavesOutCopiesAndWhatIsNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(),
                   kNan = std::numeric_limits<double>::quiet_NaN();
  const Triangle floor = {Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)};
  const SourceTriangle whole{floor, 2, 1};
  ListedTriangles source;
  const auto add = [&](const SourceTriangle& triangle) { source.triangles.push_back(triangle); };
  add(whole);
  for (const double bad : {kNan, kInfinity, -kInfinity, 2.0 * TriangleMesh::kMaxCoordinate}) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        SourceTriangle broken = whole;
        broken.corners[corner][axis] = bad;
        add(broken);
      }
    }
  }
  add(whole);                                          // a copy
  add({floor, 2, 3});                                  // another number
  add({floor, 1, 1});                                  // another part
  add({{floor[1], floor[2], floor[0]}, 2, 1});         // turned: not the same corners
  add({{floor[0], floor[1], Vec3(0, 9, 0.5)}, 2, 1});  // the same number again
  add(whole);
  SourceSheet sheet;
  sheet.read(source, boxAround(Vec3::Zero(), Vec3::Ones()));
  EXPECT_EQ(trianglesOf(sheet).size(), 5u);
  const auto wholes = trianglesOf(sheet);
  EXPECT_EQ(std::ranges::count_if(wholes, [&](const SourceTriangle& t) { return areSame({t}, {whole}); }), 1);

  std::erase_if(source.triangles, [](const SourceTriangle& triangle) {
    return std::ranges::all_of(triangle.corners, [](const Vec3& corner) { return corner.allFinite(); });
  });
  EXPECT_EQ(source.triangles.size(), 27u);
  sheet.read(source, boxAround(Vec3::Zero(), Vec3::Ones()));
  EXPECT_TRUE(sheet.isEmpty());
}

TEST(SourceSheet, isKeptWhileTheTrianglesAreTheSame) {
  std::mt19937_64 random(71);
  ListedTriangles source = listed(*testing::waveSheet(4, 0.3, 12));
  SourceSheet sheet;
  int kept = 0, made = 0;
  std::vector<SourceTriangle> before;
  Vec3 place = Vec3::Zero();
  for (int i = 0; i < 400; ++i) {
    const Vec3 step = testing::randomPoint(random, 0.05);
    place += Vec3(step.x(), step.y(), 0.2 * step.z());
    const MeshFeatures* const last = sheet.isEmpty() ? nullptr : &sheet.features();
    std::ranges::shuffle(source.triangles, random);  // the order does not matter
    sheet.read(source, boxAround(place, {0.5, 0.4, 0.3}));
    const std::vector<SourceTriangle> now = trianglesOf(sheet);
    ASSERT_FALSE(now.empty()) << i;
    if (areSame(before, now)) {
      ASSERT_EQ(last, &sheet.features()) << i;
      ++kept;
    } else {
      ++made;
    }
    before = now;
  }
  EXPECT_GT(kept, 250);  // a body that moves slowly seldom sees other triangles
  EXPECT_GT(made, 5);
}

/// A change of a bit of a coordinate, of a number or of the triangles' count, in place.
TEST(SourceSheet, noticesEachChange) {
  ListedTriangles source = listed(*testing::waveSheet(1, 0.3, 4));
  const Aabb box = boxAround(Vec3::Zero(), Vec3::Ones());
  SourceSheet sheet;
  const auto expectAsFresh = [&](const char* change) {
    sheet.read(source, box);
    SourceSheet fresh;
    fresh.read(source, box);
    EXPECT_TRUE(areSame(trianglesOf(sheet), trianglesOf(fresh))) << change;
    EXPECT_EQ(sheet.isEmpty(), source.triangles.empty()) << change;
  };
  expectAsFresh("none");
  const std::vector<SourceTriangle> original = trianglesOf(sheet);
  ASSERT_EQ(original.size(), 32u);
  const auto expectOther = [&](const char* change) {
    const std::vector<SourceTriangle> before = trianglesOf(sheet);
    expectAsFresh(change);
    EXPECT_FALSE(areSame(before, trianglesOf(sheet))) << change;
  };
  double& z = source.triangles[7].corners[1].z();
  z = std::nextafter(z, 1.0);
  expectOther("a bit of a coordinate");
  source.triangles[5].part = 9;
  expectOther("a part");
  source.triangles[5].index = 99;
  expectOther("an index");
  source.triangles.push_back({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)}, 0, 50});
  expectOther("one more");
  source.triangles.erase(source.triangles.begin());
  expectOther("one less");
  source.triangles.clear();
  expectOther("all gone");
  EXPECT_TRUE(sheet.isEmpty());
  source = listed(*testing::waveSheet(1, 0.3, 4));
  expectOther("all back");
  EXPECT_TRUE(areSame(trianglesOf(sheet), original));
}

TEST(SourceSheet, isEmptyWhereNothingIsNear) {
  const testing::SharedMesh floor = testing::waveSheet(4, 0.0, 12);
  const ListedTriangles source = listed(*floor);
  SourceSheet sheet;
  EXPECT_TRUE(sheet.isEmpty());
  const Vec3 half_extents(0.3, 0.2, 0.25);
  for (const double height : {10.0, 0.0, -10.0, 1.0, 0.2}) {
    sheet.read(source, boxAround({0.1, 0.2, height}, half_extents));
    EXPECT_EQ(sheet.isEmpty(), std::abs(height) >= 1.0) << height;
  }
  sheet.read(ListedTriangles(), boxAround(Vec3::Zero(), half_extents));
  EXPECT_TRUE(sheet.isEmpty());
}

/// A box may be as flat as a plane, and as small as a point.
TEST(SourceSheet, ofBoxesWithoutVolumeHasWhatTheyMeet) {
  const testing::SharedMesh floor = testing::waveSheet(4, 0.0, 12);
  const ListedTriangles source = listed(*floor);
  const Vec3 place(0.1, 0.2, 0.0);
  for (const Vec3& half_extents : {Vec3(1, 1, 0), Vec3(0, 0, 0.3), Vec3(1e-9, 0, 0), Vec3(0, 0, 0)}) {
    const Aabb box = boxAround(place, half_extents);
    SourceSheet sheet;
    sheet.read(source, box);
    std::size_t in_box = 0;
    for (std::uint32_t t = 0; t < floor->triangleCount(); ++t)
      in_box += box.meets(boundsOf(floor->triangle(t)));
    EXPECT_GE(in_box, 1u);
    EXPECT_GE(trianglesOf(sheet).size(), in_box) << half_extents.transpose();
  }
}

/// What was read before makes no difference, and neither does the order in which the source hands out.
TEST(SourceSheet, dependsOnTheBoxAndTheSourceAlone) {
  std::mt19937_64 random(72);
  ListedTriangles source = listed(*testing::soup(random, 400, 3, 0.4));
  SourceSheet used;
  std::size_t most = 0;
  for (int i = 0; i < 200; ++i) {
    const Aabb box = boxAround(testing::randomPoint(random, 3.0), Vec3::Constant(uniform(random, 0.1, 1.5)));
    std::ranges::shuffle(source.triangles, random);
    used.read(source, box);
    SourceSheet fresh;
    std::ranges::shuffle(source.triangles, random);
    fresh.read(source, box);
    ASSERT_EQ(used.isEmpty(), fresh.isEmpty()) << i;
    if (used.isEmpty()) continue;
    ASSERT_TRUE(areSame(trianglesOf(used), trianglesOf(fresh))) << i;
    const MeshFeatures &a = used.features(), &b = fresh.features();
    ASSERT_EQ(a.cornerCount(), b.cornerCount()) << i;
    for (std::uint32_t corner = 0; corner < a.cornerCount(); ++corner) {
      ASSERT_EQ(a.position(corner), b.position(corner)) << i;
      ASSERT_EQ(a.triangleAt(corner), b.triangleAt(corner)) << i;
    }
    most = std::max(most, trianglesOf(used).size());
  }
  EXPECT_GT(most, 100u);
}

}  // namespace
}  // namespace octoblisk
