// Meshes with defects that are known by number and place.
#include "octoblisk/inspection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "core/solid.h"
#include "shapes/box.h"
#include "shared/block.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::block;
using ::testing::HasSubstr;
using testing::insideOut;
using testing::joined;
using testing::SharedMesh;

SharedMesh shared(TriangleMesh mesh) { return std::make_shared<const TriangleMesh>(std::move(mesh)); }

MeshInspection inspectionOf(const SharedMesh& mesh) { return inspect(Solid(mesh).surface); }

ClosedMesh closedOf(const SharedMesh& mesh) { return closeHoles(Solid(mesh).surface); }

SharedMesh box(const Vec3& low, const Vec3& high) { return shared(shapes::box(low, high)); }

SharedMesh without(const TriangleMesh& mesh, const std::function<bool(const Triangle&)>& is_gone) {
  std::vector<TriangleMesh::Indices> kept;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!is_gone(mesh.triangle(t))) kept.push_back(mesh.triangles()[t]);
  }
  EXPECT_LT(kept.size(), mesh.triangleCount());
  return shared({mesh.vertices(), kept});
}

bool liesOn(const Triangle& triangle, Eigen::Index axis, double at) {
  return std::ranges::all_of(triangle, [&](const Vec3& corner) { return corner[axis] == at; });
}

/// The walls of a prism over an outline in the plane z = 0 that turns left. It is open below and above.
SharedMesh walls(const std::vector<Eigen::Vector2d>& outline, double height) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const Eigen::Vector2d& corner : outline) vertices.emplace_back(corner.x(), corner.y(), 0.0);
  for (const Eigen::Vector2d& corner : outline) vertices.emplace_back(corner.x(), corner.y(), height);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    triangles.push_back({i, next, count + next});
    triangles.push_back({i, count + next, count + i});
  }
  return shared({vertices, triangles});
}

std::vector<Eigen::Vector2d> zigzag(int corners, double inner, double outer) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners, r = i % 2 == 0 ? outer : inner;
    outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return outline;
}

double area(const std::vector<Eigen::Vector2d>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// Nothing that keeps a mesh from being a solid.
void expectSolid(const MeshInspection& found, double volume) {
  EXPECT_TRUE(found.isSolid());
  EXPECT_TRUE(found.is_closed);
  EXPECT_EQ(whyNotSolid(found), "");
  EXPECT_EQ(found.sheets.size() + found.inward.size() + found.opposed_edges.size(), 0u);
  EXPECT_EQ(found.count(GapKind::hole), 0u);
  EXPECT_NEAR(found.mass.volume, volume, 1e-9 * volume);
}

std::size_t harmless(const MeshInspection& found) {
  return found.gaps.size() + found.t_junctions.size() + found.copies.size() + found.zero_area.size() +
         found.shared_edges.size() + found.intersecting.size() + found.folded.size() + found.inner.size();
}

TEST(Inspection, findsNothingInCleanMeshes) {
  for (const SharedMesh& mesh : {shared(block({1, 2, 3}, 4)), testing::torus(1.0, 0.3, 20, 12),
                                 testing::tube(0.5, 1.0, 0.7, 16), testing::cup(1.0, 1.2, 1.0, 0.1, 12)}) {
    const MeshInspection found = inspectionOf(mesh);
    expectSolid(found, massProperties(*mesh).volume);
    EXPECT_EQ(harmless(found), 0u);
    EXPECT_EQ(found.triangles, mesh->triangleCount());
    EXPECT_EQ(found.components, 1u);
    EXPECT_EQ(found.shells, 1u);
    EXPECT_EQ(found.hollows, 0u);
  }
}

TEST(Inspection, measuresHoles) {
  const TriangleMesh whole = block({2, 1, 1}, 4);
  const MeshInspection found =
      inspectionOf(without(whole, [](const Triangle& t) { return liesOn(t, 0, 2.0); }));
  ASSERT_EQ(found.count(GapKind::hole), 1u);
  ASSERT_EQ(found.gaps.size(), 1u);
  const MeshGap& hole = found.gaps.front();
  EXPECT_EQ(hole.edges, 16u);
  EXPECT_EQ(hole.outline.size(), 16u);
  EXPECT_EQ(found.openEdges(GapKind::hole), 16u);
  EXPECT_NEAR(hole.length, 8.0, 1e-12);
  EXPECT_NEAR(hole.area, 4.0, 1e-12);
  EXPECT_LT((hole.center - Vec3(2, 0, 0)).norm(), 1e-12);
  EXPECT_TRUE(hole.is_planar);
  EXPECT_EQ(hole.off_plane, 0.0);
  EXPECT_FALSE(found.is_closed);
  EXPECT_FALSE(found.mass.is_solid);
  EXPECT_FALSE(found.sheets.empty());
  EXPECT_EQ(harmless(found), 1u);
  EXPECT_THAT(whyNotSolid(found), HasSubstr("The mesh has a hole with 16 edges beside triangle "));
  EXPECT_THAT(whyNotSolid(found), HasSubstr(" at (2 0 0)."));
}

TEST(Inspection, aHolesOutlineBeginsBesideItsLowestTriangle) {
  const SharedMesh mesh = without(block({2, 1, 1}, 4), [](const Triangle& t) { return liesOn(t, 0, 2.0); });
  const MeshInspection found = inspectionOf(mesh);
  const MeshGap& hole = found.gaps.front();
  const Triangle beside = mesh->triangle(hole.triangle);
  const auto from = std::ranges::find(beside, hole.outline[0]);
  ASSERT_NE(from, beside.end());
  EXPECT_EQ(beside[(from - beside.begin() + 1) % 3], hole.outline[1]);
}

TEST(Inspection, countsTJunctions) {
  // A face of three squares a side on a box whose other faces have one: two corners on each of four edges.
  const SharedMesh coarse = without(block({1, 1, 1}, 1), [](const Triangle& t) { return liesOn(t, 2, 1.0); });
  const SharedMesh fine = without(block({1, 1, 1}, 3), [](const Triangle& t) { return !liesOn(t, 2, 1.0); });
  const SharedMesh mesh = joined(*coarse, *fine);
  const MeshInspection found = inspectionOf(mesh);
  expectSolid(found, 8.0);
  EXPECT_EQ(found.t_junctions.size(), 8u);
  EXPECT_EQ(found.count(GapKind::t_junction), 4u);
  EXPECT_EQ(found.openEdges(GapKind::t_junction), 16u);
  EXPECT_EQ(harmless(found), 12u);
  for (const DefectPlace& place : found.t_junctions) {
    EXPECT_EQ(place.position.z(), 1.0);
    EXPECT_NEAR(place.position.cwiseAbs().minCoeff(), 1.0 / 3.0, 1e-12);
    EXPECT_LT(place.triangle, coarse->triangleCount()) << "it has the long edge";
  }
}

TEST(Inspection, measuresCracks) {
  for (const double width : {1e-9, 1e-6, 1e-3}) {
    SCOPED_TRACE(width);
    const SharedMesh below =
        without(block({1, 1, 1}, 1), [](const Triangle& t) { return liesOn(t, 2, 1.0); });
    const SharedMesh lid = testing::scaledAndMoved(
        without(block({1, 1, 1}, 1), [](const Triangle& t) { return !liesOn(t, 2, 1.0); }), 1.0,
        Vec3(0, 0, width));
    const MeshInspection found = inspectionOf(joined(*below, *lid));
    EXPECT_TRUE(found.isSolid());
    EXPECT_EQ(found.count(GapKind::crack), 4u);
    EXPECT_EQ(found.gaps.size(), 4u);
    for (const MeshGap& gap : found.gaps) {
      EXPECT_EQ(gap.edges, 2u);
      EXPECT_NEAR(gap.width, width, 1e-6 * width + 1e-15);
    }
    EXPECT_NEAR(found.mass.volume, 8.0, 8.0 * width);
  }
}

TEST(Inspection, countsCopies) {
  const TriangleMesh cube = block({1, 1, 1}, 1);
  std::vector<TriangleMesh::Indices> twice = cube.triangles(), once_more = cube.triangles();
  twice.insert(twice.end(), cube.triangles().begin(), cube.triangles().end());
  once_more.push_back(cube.triangles()[5]);
  const MeshInspection doubled = inspectionOf(shared({cube.vertices(), twice}));
  expectSolid(doubled, 8.0);
  EXPECT_EQ(doubled.copies.size(), 12u);
  EXPECT_EQ(doubled.copies.front().triangle, 12u);
  EXPECT_EQ(doubled.shared_edges.size(), 0u) << "copies count once";
  EXPECT_EQ(harmless(doubled), 12u);
  const MeshInspection one = inspectionOf(shared({cube.vertices(), once_more}));
  expectSolid(one, 8.0);
  ASSERT_EQ(one.copies.size(), 1u);
  EXPECT_EQ(one.copies[0].triangle, 12u);
  EXPECT_EQ(one.copies[0].position, centroidOf(cube.triangle(5)));
}

TEST(Inspection, triangleThatIsThereThreeTimesIsFoldedOver) {
  const TriangleMesh cube = block({1, 1, 1}, 1);
  std::vector<TriangleMesh::Indices> triangles = cube.triangles();
  const auto [a, b, c] = triangles[5];
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, b});
  const MeshInspection found = inspectionOf(shared({cube.vertices(), triangles}));
  expectSolid(found, 8.0);
  EXPECT_EQ(found.copies.size(), 2u);
  ASSERT_EQ(found.folded.size(), 1u);
  EXPECT_EQ(found.folded[0].triangle, 13u);
}

TEST(Inspection, findsFacesThatAreFoldedOver) {
  TriangleMesh cube = block({1, 1, 1}, 4);
  std::vector<Vec3> vertices = cube.vertices();
  for (Vec3& v : vertices) {
    if (v == Vec3(0, 0, 1)) v = Vec3(0.7, 0.1, 1);  // past its neighbour at x = 0.5
  }
  const SharedMesh mesh = shared({vertices, cube.triangles()});
  std::set<std::uint32_t> downward, folded;
  for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
    if (liesOn(mesh->triangle(t), 2, 1.0) && scaledNormal(mesh->triangle(t)).z() < 0.0) downward.insert(t);
  }
  const MeshInspection found = inspectionOf(mesh);
  for (const DefectPlace& place : found.folded) folded.insert(place.triangle);
  expectSolid(found, 8.0);
  EXPECT_GT(downward.size(), 0u);
  EXPECT_EQ(folded, downward);
  EXPECT_GT(found.intersecting.size(), folded.size());
}

TEST(Inspection, countsTrianglesWithoutArea) {
  const TriangleMesh cube = block({1, 1, 1}, 2);
  std::vector<TriangleMesh::Indices> triangles = cube.triangles();
  const auto [a, b, c] = triangles.front();
  triangles.push_back({a, a, b});
  triangles.push_back({c, c, c});
  const MeshInspection found = inspectionOf(shared({cube.vertices(), triangles}));
  expectSolid(found, 8.0);
  EXPECT_EQ(found.zero_area.size(), 2u);
  EXPECT_EQ(harmless(found), 2u);
}

TEST(Inspection, countsEdgesOfMoreThanTwoTriangles) {
  const MeshInspection found = inspectionOf(joined(*box({0, 0, 0}, {1, 1, 1}), *box({1, 1, 0}, {2, 2, 1})));
  expectSolid(found, 2.0);
  ASSERT_EQ(found.shared_edges.size(), 1u);
  EXPECT_EQ(found.shared_edges[0].position, Vec3(1, 1, 0.5));
  EXPECT_EQ(harmless(found), 1u);
}

TEST(Inspection, findsTrianglesThatFaceAgainstTheirNeighbours) {
  TriangleMesh cube = block({1, 1, 1}, 3);
  std::vector<TriangleMesh::Indices> triangles = cube.triangles();
  std::swap(triangles[7][1], triangles[7][2]);
  const SharedMesh mesh = shared({cube.vertices(), triangles});
  const MeshInspection found = inspectionOf(mesh);
  EXPECT_FALSE(found.isSolid());
  EXPECT_EQ(found.opposed_edges.size(), 3u);
  EXPECT_EQ(found.count(GapKind::hole), 0u) << "no triangle is missing";
  EXPECT_GT(found.count(GapKind::turned), 0u);
  EXPECT_THAT(whyNotSolid(found), HasSubstr("The mesh has triangles that face opposite ways at 3 edges"));
  const ClosedMesh closed = closedOf(mesh);
  EXPECT_EQ(closed.added.size() + closed.refused.size(), 0u);
  EXPECT_EQ(closed.mesh.triangleCount(), mesh->triangleCount());
}

TEST(Inspection, overlappingPartsAreShells) {
  const MeshInspection found =
      inspectionOf(joined(*box({0, 0, 0}, {2, 2, 2}), *box({1, 0.5, 0.5}, {3, 1.5, 1.5})));
  expectSolid(found, 9.0);
  EXPECT_EQ(found.shells, 2u);
  EXPECT_EQ(found.inner.size(), 2u) << "the end of the small box";
  EXPECT_EQ(found.intersecting.size(), 10u)
      << "the other faces of the small box, and a face of the large one";
}

TEST(Inspection, tellsShellsFromHollows) {
  const SharedMesh large = box({0, 0, 0}, {4, 4, 4}), small = box({1, 1, 1}, {2, 2, 2}),
                   apart = box({6, 0, 0}, {7, 1, 1});
  const MeshInspection hollow = inspectionOf(joined(*large, *insideOut(*small)));
  expectSolid(hollow, 63.0);
  EXPECT_EQ(hollow.shells, 1u);
  EXPECT_EQ(hollow.hollows, 1u);
  const MeshInspection nested = inspectionOf(joined(*large, *small));
  expectSolid(nested, 64.0);
  EXPECT_EQ(nested.shells, 1u);
  EXPECT_EQ(nested.hollows, 0u);
  EXPECT_EQ(nested.inner.size(), 12u);
  const MeshInspection beside = inspectionOf(joined(*large, *apart));
  expectSolid(beside, 65.0);
  EXPECT_EQ(beside.shells, 2u);
}

TEST(Inspection, findsPartsThatFaceInward) {
  const SharedMesh one = box({0, 0, 0}, {1, 1, 1}), other = box({3, 0, 0}, {4, 1, 1});
  const MeshInspection whole = inspectionOf(insideOut(*one));
  EXPECT_TRUE(whole.is_closed);
  EXPECT_TRUE(whole.facesInward());
  EXPECT_EQ(whole.inward.size(), 12u);
  EXPECT_EQ(whole.shells, 1u);
  EXPECT_EQ(whyNotSolid(whole), "The mesh faces inward: its triangles must be reversed.");
  const MeshInspection part = inspectionOf(joined(*one, *insideOut(*other)));
  EXPECT_FALSE(part.facesInward());
  EXPECT_FALSE(part.isSolid());
  EXPECT_EQ(part.inward.size(), 12u);
  EXPECT_EQ(part.inward.front().triangle, 12u);
  EXPECT_THAT(whyNotSolid(part), HasSubstr("has 12 triangles that face inward, the first triangle 12 at ("));
}

TEST(Inspection, findsSheets) {
  const MeshInspection sheet = inspectionOf(testing::waveSheet(1.0, 0.1, 6));
  EXPECT_FALSE(sheet.isAnywhereSolid());
  EXPECT_EQ(sheet.sheets.size(), sheet.triangles);
  EXPECT_EQ(sheet.shells, 0u);
  EXPECT_EQ(sheet.openEdges(GapKind::hole), 24u);
  // A triangle with a front and a back beside a cube.
  TriangleMesh cube = block({1, 1, 1}, 1);
  std::vector<Vec3> vertices = cube.vertices();
  std::vector<TriangleMesh::Indices> triangles = cube.triangles();
  vertices.insert(vertices.end(), {Vec3(3, 0, 0), Vec3(4, 0, 0), Vec3(3, 1, 0)});
  triangles.push_back({8, 9, 10});
  triangles.push_back({8, 10, 9});
  const MeshInspection found = inspectionOf(shared({vertices, triangles}));
  EXPECT_EQ(found.sheets.size(), 2u);
  EXPECT_TRUE(found.is_closed);
  EXPECT_FALSE(found.isSolid());
  EXPECT_THAT(whyNotSolid(found),
              HasSubstr("The mesh has 2 triangles without a solid on either side, the first "
                        "triangle 12 at ("));
}

TEST(CloseHoles, closesAnOpenBore) {
  const TriangleMesh tube = *testing::tube(0.5, 1.0, 0.7, 24);
  // Without the wall of its bore, the tube has a hole at each end.
  const SharedMesh open = without(tube, [](const Triangle& t) {
    return std::ranges::all_of(t, [](const Vec3& v) { return std::hypot(v.x(), v.y()) < 0.75; });
  });
  const MeshInspection before = inspectionOf(open);
  EXPECT_EQ(before.count(GapKind::hole), 2u);
  const ClosedMesh closed = closedOf(open);
  EXPECT_EQ(closed.refused.size(), 0u);
  ASSERT_EQ(closed.added.size(), 2u);
  for (const HoleCap& cap : closed.added) {
    EXPECT_EQ(cap.outlines, 1u);
    EXPECT_EQ(cap.edges, 24u);
    EXPECT_EQ(cap.triangles, 22u);
    EXPECT_NEAR(std::abs(cap.center.z()), 0.7, 1e-12);
  }
  EXPECT_EQ(closed.mesh.triangleCount(), open->triangleCount() + 44);
  const MeshInspection found = inspectionOf(shared(closed.mesh));
  const SharedMesh rod = walls(zigzag(24, 0.5, 0.5), 1.4);
  const double bore = area(zigzag(24, 0.5, 0.5)) * 1.4;
  EXPECT_EQ(harmless(found), 0u);
  expectSolid(found, massProperties(tube).volume + bore);
}

TEST(CloseHoles, closesAMissingRing) {
  const TriangleMesh tube = *testing::tube(0.5, 1.0, 0.7, 16);
  const double top = tube.bounds().max.z();
  const SharedMesh open = without(tube, [&](const Triangle& t) { return liesOn(t, 2, top); });
  EXPECT_EQ(inspectionOf(open).count(GapKind::hole), 2u);
  const ClosedMesh closed = closedOf(open);
  ASSERT_EQ(closed.added.size(), 1u);
  EXPECT_EQ(closed.added[0].outlines, 2u);
  EXPECT_EQ(closed.added[0].edges, 32u);
  EXPECT_EQ(closed.added[0].triangles, 32u);
  const MeshInspection found = inspectionOf(shared(closed.mesh));
  EXPECT_EQ(harmless(found), 0u) << "nothing spans the bore";
  expectSolid(found, massProperties(tube).volume);
}

TEST(CloseHoles, closesOutlinesThatAreNotConvex) {
  const std::vector<Eigen::Vector2d> hook = {{0, 0}, {4, 0}, {4, 4}, {1, 4}, {1, 3}, {3, 3}, {3, 1}, {0, 1}};
  const Pose tilted{Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix(), Vec3(5, -3, 2)};
  for (const auto& outline : {hook, zigzag(30, 0.4, 2.0), zigzag(101, 0.9, 1.0)}) {
    for (const Pose& pose : {Pose(), tilted}) {
      const SharedMesh open = testing::moved(*walls(outline, 1.5), pose);
      const ClosedMesh closed = closedOf(open);
      ASSERT_EQ(closed.added.size(), 2u);
      EXPECT_EQ(closed.added[0].triangles, outline.size() - 2);
      EXPECT_NEAR(closed.added[0].area, area(outline), 1e-9 * area(outline));
      const MeshInspection found = inspectionOf(shared(closed.mesh));
      EXPECT_EQ(harmless(found), 0u);
      expectSolid(found, 1.5 * area(outline));
    }
  }
}

TEST(CloseHoles, refusesWhatIsNotPlanar) {
  const TriangleMesh cube = block({1, 1, 1}, 4);
  const SharedMesh open = without(cube, [](const Triangle& t) {
    return std::ranges::any_of(t, [](const Vec3& v) { return v == Vec3(1, 1, 1); }) || liesOn(t, 2, -1.0);
  });
  const ClosedMesh closed = closedOf(open);
  ASSERT_EQ(closed.added.size(), 1u) << "the bottom";
  ASSERT_EQ(closed.refused.size(), 1u) << "the corner";
  EXPECT_EQ(closed.added[0].edges, 16u);
  EXPECT_GT(closed.refused[0].off_plane, 0.05);
  EXPECT_FALSE(closed.refused[0].is_planar);
  const MeshInspection found = inspectionOf(shared(closed.mesh));
  EXPECT_EQ(found.count(GapKind::hole), 1u);
}

TEST(CloseHoles, takesHolesThatAreNearlyPlanar) {
  for (const double off : {2e-5, 2e-3}) {
    std::vector<Vec3> vertices = walls(zigzag(12, 1.0, 1.0), 1.0)->vertices();
    const std::vector<TriangleMesh::Indices> triangles = walls(zigzag(12, 1.0, 1.0), 1.0)->triangles();
    for (std::size_t i = 12; i < 24; i += 2) vertices[i].z() += 2.0 * off;
    const ClosedMesh closed = closedOf(shared({vertices, triangles}));
    EXPECT_EQ(closed.added.size(), off < 1e-4 ? 2u : 1u);
    EXPECT_EQ(closed.refused.size(), off < 1e-4 ? 0u : 1u);
  }
}

TEST(CloseHoles, knowsThePlacesOfDoubledMeshes) {
  const SharedMesh open = walls(zigzag(20, 0.6, 1.0), 2.0);
  std::vector<TriangleMesh::Indices> twice = open->triangles();
  twice.insert(twice.begin(), open->triangles().begin(), open->triangles().end());
  const SharedMesh doubled = shared({open->vertices(), twice});
  const MeshInspection before = inspectionOf(doubled);
  ASSERT_EQ(before.count(GapKind::hole), 2u);
  for (const MeshGap& gap : before.gaps) {
    for (const Vec3& corner : gap.outline) EXPECT_TRUE(corner.z() == 0.0 || corner.z() == 2.0);
    EXPECT_NEAR(gap.area, area(zigzag(20, 0.6, 1.0)), 1e-12);
  }
  const ClosedMesh closed = closedOf(doubled);
  EXPECT_EQ(closed.added.size(), 2u);
  expectSolid(inspectionOf(shared(closed.mesh)), 2.0 * area(zigzag(20, 0.6, 1.0)));
}

}  // namespace
}  // namespace octoblisk
