#include "models/defect_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demos/block.h"
#include "models/shared_tree.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

using ::testing::MatchesRegex;
using ::testing::StartsWith;

MeshInspection defects(const TriangleMesh& mesh) { return defectsOf(*treeOf(mesh)); }

TEST(DefectWords, nameTheEdgesOfHoles) {
  const TriangleMesh whole = block({1, 1, 1}, 4);
  EXPECT_EQ(openText(defects(whole)), "");
  EXPECT_EQ(inwardText(defects(whole)), "");
  std::vector<TriangleMesh::Indices> triangles = whole.triangles();
  triangles.erase(triangles.begin() + 5);
  EXPECT_THAT(openText(defects({whole.vertices(), triangles})),
              MatchesRegex("3 of its edges are open, the first from \\(.* .* .*\\) to \\(.* .* .*\\)"));
}

TEST(DefectWords, keepSilentAboutWhatChangesNothing) {
  const TriangleMesh whole = block({1, 1, 1}, 4);
  std::vector<TriangleMesh::Indices> doubled = whole.triangles();
  doubled.insert(doubled.end(), whole.triangles().begin(), whole.triangles().end());
  const TriangleMesh overlapping = joined(whole, moved(whole, {0.5, 0.3, 0.2}));
  for (const TriangleMesh& mesh : {TriangleMesh(whole.vertices(), doubled), overlapping}) {
    const MeshInspection found = defects(mesh);
    EXPECT_TRUE(found.is_closed);
    EXPECT_EQ(openText(found), "");
    EXPECT_EQ(inwardText(found), "");
  }
}

TEST(DefectWords, nameTrianglesThatFaceTheWrongWay) {
  const TriangleMesh whole = block({1, 1, 1}, 2);
  std::vector<TriangleMesh::Indices> triangles = whole.triangles();
  std::swap(triangles[9][0], triangles[9][1]);
  EXPECT_THAT(openText(defects({whole.vertices(), triangles})),
              StartsWith("triangles face opposite ways at 3 of its edges, the first at triangle "));
  triangles = whole.triangles();
  for (TriangleMesh::Indices& corners : triangles) std::swap(corners[0], corners[1]);
  const TriangleMesh turned(whole.vertices(), triangles);
  EXPECT_EQ(inwardText(defects(turned)), "it faces inward");
  EXPECT_EQ(inwardText(defects(joined(whole, moved(turned, {5, 0, 0})))),
            "48 of its triangles face inward, the first number 48");
}

TEST(DefectWords, callASheetWhatHasNoHole) {
  const TriangleMesh whole = block({1, 1, 1}, 1);
  const TriangleMesh two_sided({Vec3(3, 0, 0), Vec3(4, 0, 0), Vec3(3, 1, 0)}, {{0, 1, 2}, {0, 2, 1}});
  EXPECT_EQ(openText(defects(joined(whole, two_sided))),
            "2 of its triangles bound no solid, the first number 12");
}

}  // namespace
}  // namespace octoblisk::demos
