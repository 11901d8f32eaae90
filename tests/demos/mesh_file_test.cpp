#include "io/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "demos/scratch_folder.h"
#include "models/belt_grinder.h"
#include "models/blisk.h"

namespace octoblisk::demos {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kAsciiFacets =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 0 0 1.5\nendloop\nendfacet\n";
const std::string kAsciiStl = "solid two\n" + kAsciiFacets + "endsolid two\n";
const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.5\nf 1 2 3\nf 1 3 4\n";
const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPly = kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n0 0 1.5\n3 0 1 2\n3 0 2 3\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// A binary STL with the given facets; its header declares `count` of them.
std::string binaryStl(const std::vector<std::array<float, 9>>& facets, std::uint32_t count,
                      const std::string& title = "binary") {
  std::string bytes = title + std::string(80 - title.size(), '\0');
  bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
  for (const auto& facet : facets) {
    bytes.append(12, '\0');  // its normal
    bytes.append(reinterpret_cast<const char*>(facet.data()), sizeof(facet));
    bytes.append(2, '\0');
  }
  return bytes;
}

const std::vector<std::array<float, 9>> kTwoFacets{{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                   {0, 0, 0, 0, 1, 0, 0, 0, 1.5f}};

class MeshFile : public ::testing::Test {
 protected:
  std::string refusal(const std::string& name, const std::string& content) {
    const auto file = folder_.write(name, content);
    const std::string message = messageOf<std::runtime_error>([&] { readMesh(file); });
    EXPECT_THAT(message, HasSubstr(file.string())) << "names the file";
    return message;
  }
  TriangleMesh read(const std::string& name, const std::string& content) {
    return readMesh(folder_.write(name, content));
  }

  ScratchFolder folder_;
};

void expectTwoTriangles(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.vertices(), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.5}}));
  EXPECT_EQ(mesh.triangles(), (std::vector<TriangleMesh::Indices>{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(MeshFile, readsEveryFormat) {
  expectTwoTriangles(read("a.stl", kAsciiStl));
  expectTwoTriangles(read("b.stl", binaryStl(kTwoFacets, 2)));
  expectTwoTriangles(read("c.STL", binaryStl(kTwoFacets, 2, "solid, says a binary file")));
  expectTwoTriangles(read("d.obj", kObj));
  expectTwoTriangles(read("e.ply", kPly));
}

TEST_F(MeshFile, roundTripsTriangleForTriangle) {
  for (const TriangleMesh& mesh : {makeDefaultBlisk(10'000).mesh, makeBelt()}) {
    for (const char* name : {"m.stl", "m.obj", "m.ply"}) {
      writeMesh(folder_.path() / name, mesh);
      const TriangleMesh back = readMesh(folder_.path() / name);
      EXPECT_EQ(back.vertices().size(), mesh.vertices().size()) << name;
      ASSERT_EQ(back.triangleCount(), mesh.triangleCount()) << name;
      for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
          const Eigen::Vector3f written = mesh.triangle(t)[corner].cast<float>();
          const Eigen::Vector3f read = back.triangle(t)[corner].cast<float>();
          ASSERT_EQ(read, written) << name << ", triangle " << t;
        }
      }
    }
  }
}

TEST_F(MeshFile, roundTripsFloatsOfAnySize) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-20.0, 11.0);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::uint32_t t = 0; t < 2000; ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      vertices.push_back(Vec3::NullaryExpr([&] { return std::pow(10.0, exponent(random)); }));
    }
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const TriangleMesh mesh(vertices, triangles);
  for (const char* name : {"m.stl", "m.obj", "m.ply"}) {
    writeMesh(folder_.path() / name, mesh);
    const TriangleMesh back = readMesh(folder_.path() / name);
    ASSERT_EQ(back.triangleCount(), mesh.triangleCount()) << name;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(back.vertices()[v][axis] / vertices[v][axis], 1.0, 2.5e-7) << name;
      }
    }
  }
}

TEST_F(MeshFile, keepsDegenerateTrianglesAndOrder) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {5, 5, 5}};
  const TriangleMesh mesh(vertices, {{0, 1, 2}, {0, 1, 3}, {1, 1, 3}, {4, 4, 4}});
  for (const char* name : {"m.stl", "m.obj", "m.ply"}) {
    writeMesh(folder_.path() / name, mesh);
    const TriangleMesh back = readMesh(folder_.path() / name);
    EXPECT_EQ(back.vertices(), mesh.vertices()) << name;
    EXPECT_EQ(back.triangles(), mesh.triangles()) << name;
  }
}

TEST_F(MeshFile, cutsPolygonsAndPassesOverLines) {
  EXPECT_EQ(read("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\n").triangleCount(), 2u);
  EXPECT_EQ(read("five.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n").triangleCount(),
            3u);
  EXPECT_EQ(read("groups.obj", "o a\n" + kObj + "o b\nf -1 -2 -3\n").triangleCount(), 3u);
  EXPECT_EQ(read("two.stl", kAsciiStl + kAsciiStl).triangleCount(), 4u);
}

TEST_F(MeshFile, refusesWhatIsNoMeshFile) {
  const auto missing = [&] { readMesh(folder_.path() / "none.stl"); };
  EXPECT_THAT(messageOf<std::runtime_error>(missing),
              AllOf(HasSubstr("none.stl"), HasSubstr("no such file")));
  EXPECT_THAT(refusal("m.step", kObj), HasSubstr("'.step'"));
  for (const char* name : {"m.stl", "m.obj", "m.ply"}) EXPECT_THAT(refusal(name, ""), HasSubstr("empty"));
  EXPECT_THAT(refusal("m.ply", "play\n"), HasSubstr("m.ply:1: "));
  EXPECT_THAT(refusal("m.stl", "nothing"), HasSubstr("not an STL file"));
  EXPECT_THAT(messageOf<std::runtime_error>([&] { readMesh(folder_.path() / "."); }),
              ::testing::Not(HasSubstr("no such file")));
}

TEST_F(MeshFile, namesTheFormatThatAMisnamedFileHas) {
  EXPECT_THAT(refusal("m.stl", "# made by hand\n" + kObj), HasSubstr("name it .obj"));
  EXPECT_THAT(refusal("m.stl", kPly), HasSubstr("name it .ply"));
  EXPECT_THAT(refusal("m.obj", kAsciiStl), HasSubstr("name it .stl"));
}

TEST_F(MeshFile, refusesTruncatedStl) {
  const std::string whole = binaryStl(kTwoFacets, 2);
  EXPECT_THAT(refusal("m.stl", whole.substr(0, whole.size() - 20)),
              AllOf(HasSubstr("truncated"), HasSubstr("2 triangles, 184 bytes"), HasSubstr("164")));
  EXPECT_THAT(refusal("m.stl", whole.substr(0, 70)), HasSubstr("truncated"));
  EXPECT_THAT(refusal("m.stl", binaryStl(kTwoFacets, 3, "solid")), HasSubstr("truncated"));
  EXPECT_THAT(refusal("m.stl", binaryStl(kTwoFacets, 1)), HasSubstr("size is wrong"));
  EXPECT_THAT(refusal("m.stl", "solid two\n" + kAsciiFacets), HasSubstr("endsolid"));
  EXPECT_THAT(refusal("m.stl", kAsciiStl.substr(0, kAsciiStl.size() - 30)), HasSubstr("endfacet"));
  EXPECT_THAT(refusal("m.stl", replaced(kAsciiStl, "vertex 1 0 0\n", "")),
              AllOf(HasSubstr("m.stl:7: "), HasSubstr("2 vertices")));
  EXPECT_THAT(refusal("m.stl", replaced(kAsciiStl, "vertex 1 0 0", "vertex 1 0")), HasSubstr("m.stl:5: "));
}

TEST_F(MeshFile, refusesTruncatedObj) {
  EXPECT_THAT(refusal("m.obj", kObj.substr(0, kObj.size() - 3)),
              AllOf(HasSubstr("m.obj:6: "), HasSubstr("corners")));
  EXPECT_THAT(refusal("m.obj", kObj + "v 1 2"), HasSubstr("m.obj:7: "));
  EXPECT_THAT(refusal("m.obj", "v 0 0 0\nv 1 0\n"), HasSubstr("m.obj:2: "));
  EXPECT_THAT(refusal("m.obj", replaced(kObj, "v 0 1 0", "v 0 one 0")),
              AllOf(HasSubstr("m.obj:3: "), HasSubstr("one")));
}

TEST_F(MeshFile, takesAnObjWhoseLastLineIsCompleteWithoutItsEnd) {
  expectTwoTriangles(read("m.obj", kObj.substr(0, kObj.size() - 1)));
  expectTwoTriangles(read("m.obj", "f 1 2 3\nf 1 3 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.5"));
}

TEST_F(MeshFile, refusesEveryTruncationOfPly) {
  for (std::size_t length = 1; length + 2 < kPly.size(); ++length) refusal("m.ply", kPly.substr(0, length));
  const TriangleMesh arm = makeArm();
  writeMesh(folder_.path() / "arm.ply", arm);
  std::ifstream stream(folder_.path() / "arm.ply", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  for (std::size_t length = 1; length < bytes.size(); ++length) {
    EXPECT_THAT(refusal("m.ply", bytes.substr(0, length)), ::testing::Not(HasSubstr("no such")));
  }
  EXPECT_THAT(refusal("m.ply", replaced(kPly, "element face 2", "element face 2000000000")),
              HasSubstr("truncated"));
  // Without properties, so nothing in the body can be missing.
  EXPECT_THAT(refusal("m.ply", replaced(kPly, "element face 2", "element none 1e15\nelement face 2")),
              HasSubstr("truncated"));
}

TEST_F(MeshFile, refusesCountsThatAreNone) {
  for (const char* count : {"-4", "3.5", "nan"}) {
    EXPECT_THAT(refusal("m.ply", replaced(kPly, "element vertex 4", std::string("element vertex ") + count)),
                HasSubstr("m.ply:3: the number of elements must be a whole number from 0"));
    EXPECT_THAT(refusal("m.ply", replaced(kPly, "3 0 2 3", std::string(count) + " 0 2 3")),
                HasSubstr("m.ply:15: the length of a list must be a whole number from 0"));
  }
}

TEST_F(MeshFile, refusesIndicesOfNoVertex) {
  EXPECT_THAT(refusal("m.ply", replaced(kPly, "3 0 2 3", "3 0 2 4")),
              AllOf(HasSubstr("m.ply:15: "), HasSubstr("uses vertex 4, but there are only 4")));
  EXPECT_THAT(refusal("m.ply", replaced(kPly, "3 0 2 3", "3 0 2 -1")), HasSubstr("uses vertex -1"));
  EXPECT_THAT(refusal("m.ply", replaced(kPly, "3 0 2 3", "3 0 1e76 3")), HasSubstr("uses vertex 1e+76"));
  const std::pair<const char*, const char*> of_obj[] = {
      {"f 1 2 9", "uses vertex 9, but there are only 4"},
      {"f 1/1 2/2 5/3", "uses vertex 5, but there are only 4"},
      {"f 0 1 2", "uses vertex 0, but there are only 4"},
      {"f -5 1 2", "uses vertex -5, but there are only 4"},
      {"f 1 2 x", "'x' is not an index of a vertex"},
      {"f 1 2 /3", "'' is not an index of a vertex"},
      {"f 1 2 99999999999999999999", "is not an index of"}};
  for (const auto& [face, message] : of_obj) {
    EXPECT_THAT(refusal("m.obj", kObj + face + "\n" + "f 2 3 4\n"),
                AllOf(HasSubstr("m.obj:7: "), HasSubstr(message)));
  }
}

TEST_F(MeshFile, refusesFilesWithoutTriangles) {
  refusal("m.stl", "solid none\nendsolid none\n");
  refusal("m.stl", binaryStl({}, 0));
  EXPECT_THAT(refusal("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\n"), HasSubstr("no triangles"));
  EXPECT_THAT(refusal("m.ply", replaced(kPly, "face 2", "face 0").substr(0, kPly.size() - 16)),
              HasSubstr("no triangles"));
}

TEST_F(MeshFile, refusesFacesWithoutCorners) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0\n0\n";
  EXPECT_THAT(refusal("a.ply", ply), HasSubstr("triangle"));
}

TEST_F(MeshFile, refusesCoordinatesThatAreNoNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal("m.stl", binaryStl({kTwoFacets[0], {0, 0, nan, 1, 1, 1, 2, 2, 2}}, 2)),
              HasSubstr("triangle 1 (counted from 0) "));
  EXPECT_THAT(refusal("m.stl", binaryStl({{0, 0, 0, 1, infinity, 1, 2, 2, 2}}, 1)),
              HasSubstr("triangle 0 (counted from 0) "));
  EXPECT_THAT(refusal("m.stl", replaced(kAsciiStl, "1.5", "nan")), HasSubstr("triangle 1 (counted from 0) "));
  EXPECT_THAT(refusal("m.obj", replaced(kObj, "1.5", "inf")), HasSubstr("triangle 1 (counted from 0) "));
  EXPECT_THAT(refusal("m.ply", replaced(kPly, "1.5", "nan")), HasSubstr("triangle 1 (counted from 0) "));
  EXPECT_THAT(refusal("m.obj", replaced(kObj, "1.5", "1e50")),
              HasSubstr("infinite, or beyond the range of 32-bit floats"));
  EXPECT_THAT(refusal("m.obj", replaced(kObj, "1.5", "1e20")), HasSubstr("1e+20, beyond 1e+12"));
}

TEST_F(MeshFile, refusesWhatCannotBeWritten) {
  const TriangleMesh arm = makeArm();
  const auto refused = [&](const std::string& name, const TriangleMesh& mesh) {
    return messageOf<std::runtime_error>([&] { writeMesh(folder_.path() / name, mesh); });
  };
  EXPECT_THAT(refused("m.xyz", arm), HasSubstr("'.xyz'"));
  EXPECT_THAT(refused("no/such/folder/m.stl", arm),
              AllOf(HasSubstr("m.stl"), HasSubstr("cannot be written")));
}

}  // namespace
}  // namespace octoblisk::demos
