#include "render/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "demos/scratch_folder.h"
#include "render/corner_normals.h"

#ifdef __SANITIZE_ADDRESS__
// Fontconfig keeps its caches until the process ends.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }
#endif

namespace octoblisk::demos {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr Image::Pixel kWhite{255, 255, 255, 255};
constexpr std::array<TriangleMesh::Indices, 12> kCubeTriangles = {{{0, 2, 1},
                                                                   {1, 2, 3},
                                                                   {4, 5, 6},
                                                                   {5, 7, 6},
                                                                   {0, 1, 4},
                                                                   {1, 5, 4},
                                                                   {2, 6, 3},
                                                                   {3, 6, 7},
                                                                   {0, 4, 2},
                                                                   {2, 4, 6},
                                                                   {1, 3, 5},
                                                                   {3, 7, 5}}};

/// The cube [-1, 1]³.
TriangleMesh cube() {
  std::vector<Vec3> vertices;
  for (const double z : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double x : {-1.0, 1.0}) vertices.emplace_back(x, y, z);
    }
  }
  return {vertices, {kCubeTriangles.begin(), kCubeTriangles.end()}};
}

/// The square [-1, 1]² in the plane z = height.
TriangleMesh square(double height) {
  return {{{-1, -1, height}, {1, -1, height}, {1, 1, height}, {-1, 1, height}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Looks down on the xy plane: a window of 4 × 3 around the origin.
Camera fromAbove(Projection projection = Projection::orthographic) {
  Camera camera;
  camera.view_width = 4.0;
  camera.view_height = 3.0;
  camera.projection = projection;
  return camera;
}

Image renderSmall(const Picture& picture, unsigned threads = 1) {
  return render(picture, kWidth, kHeight, threads);
}

Image::Pixel center(const Image& image) { return image.at(image.width / 2, image.height / 2); }

int difference(const Image::Pixel& pixel, Color color) {
  const std::array<float, 3> channels = {color.r, color.g, color.b};
  int largest = 0;
  for (int channel = 0; channel < 3; ++channel) {
    largest =
        std::max(largest, std::abs(pixel[channel] - static_cast<int>(std::lround(255 * channels[channel]))));
  }
  return largest;
}

/// A scene with every kind of object.
Picture busyPicture() {
  Picture picture;
  picture.scene.addMesh(cube(), {}, palette::kSteel);
  picture.scene.addMesh(cube(), {Mat3::Identity(), {0.7, 0.9, 0.6}}, palette::kSky, 0.4f);
  picture.scene.addBoxes(std::array{Obb{{0, 0, 0}, Mat3::Identity(), {1.2, 1.1, 1.3}}},
                         {.color = palette::kBlue});
  picture.scene.addPoints(std::array{Vec3(0, 0, 1), Vec3(0.1, 0, 1)},
                          {.color = palette::kVermilion, .width = 60, .halo = true});
  picture.scene.addPolyline(std::array{Vec3(-1, -1, 1.5), Vec3(0, 1, 1.2), Vec3(1, -1, 0)},
                            {.color = palette::kPurple, .width = 20, .hidden_opacity = 0.4f});
  picture.scene.addArrow({2, 2, 2}, {1, 1, 1}, {.color = palette::kGreen, .width = 20});
  picture.camera = frame(picture.scene.points(), {-1, -2, -1.5}, Vec3::UnitZ(), Projection::perspective);
  picture.annotation = {
      .title = "Title", .subtitle = "Subtitle", .legend = {{palette::kSteel, "cube"}}, .length_unit = "mm"};
  return picture;
}

TEST(Picture, surfaceThatFacesTheCameraHasTheColourOfItsLegend) {
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Picture picture;
    picture.scene.addMesh(cube(), {}, palette::kVermilion);
    picture.camera = fromAbove(projection);
    const Image image = renderSmall(picture);
    ASSERT_EQ(image.width, kWidth);
    ASSERT_EQ(image.height, kHeight);
    EXPECT_LE(difference(center(image), palette::kVermilion), 2);
    EXPECT_EQ(image.at(0, 0), kWhite);
    EXPECT_EQ(image.at(kWidth - 1, kHeight - 1), kWhite);
  }
}

TEST(Picture, poseMovesTheMesh) {
  Picture picture;
  picture.scene.addMesh(square(0.0), {Mat3::Identity(), {3.0, 0.0, 0.0}}, palette::kBlue);
  picture.camera = fromAbove();
  EXPECT_EQ(center(renderSmall(picture)), kWhite);
  picture.camera.target = {3.0, 0.0, 0.0};
  EXPECT_LE(difference(center(renderSmall(picture)), palette::kBlue), 2);
}

TEST(Picture, trianglesHaveTheirOwnColours) {
  Picture picture;
  picture.scene.addMesh(square(0.0), {}, std::array{palette::kGreen, palette::kPurple});
  picture.camera = fromAbove();
  const Image image = renderSmall(picture);
  EXPECT_LE(difference(image.at(kWidth / 2 + 20, kHeight / 2 + 20), palette::kGreen), 2);   // x > y
  EXPECT_LE(difference(image.at(kWidth / 2 - 20, kHeight / 2 - 20), palette::kPurple), 2);  // x < y
}

TEST(Picture, transparentMeshLetsWhatIsBehindThrough) {
  const auto pixelBehind = [](float opacity) {
    Picture picture;
    picture.scene.addMesh(square(0.0), {}, Color{0.8f, 0.0f, 0.0f});
    picture.scene.addMesh(square(0.5), {}, Color{0.0f, 0.0f, 0.8f}, opacity);
    picture.camera = fromAbove();
    return center(renderSmall(picture));
  };
  const Image::Pixel opaque = pixelBehind(1.0f);
  const Image::Pixel half = pixelBehind(0.5f);
  const Image::Pixel thin = pixelBehind(0.1f);
  EXPECT_EQ(opaque[0], 0);
  EXPECT_GT(half[0], 100);
  EXPECT_GT(half[2], 100);
  EXPECT_GT(thin[0], half[0]);
  EXPECT_LT(thin[2], half[2]);
}

TEST(Picture, hiddenMarksShineThroughByTheirOpacity) {
  const auto imageWith = [](float hidden_opacity) {
    Picture picture;
    picture.scene.addMesh(square(0.5), {}, palette::kSteel);
    picture.scene.addPoints(std::array{Vec3(0, 0, -0.5)},
                            {.color = palette::kVermilion, .width = 300, .hidden_opacity = hidden_opacity});
    picture.camera = fromAbove();
    return renderSmall(picture);
  };
  EXPECT_LE(difference(center(imageWith(0.0f)), palette::kSteel), 2);
  EXPECT_LE(difference(center(imageWith(1.0f)), palette::kVermilion), 2);
  const Image::Pixel half = center(imageWith(0.5f));
  EXPECT_GT(difference(half, palette::kSteel), 20);
  EXPECT_GT(difference(half, palette::kVermilion), 20);
}

TEST(Picture, linesAreAsWideOnPaperAtAnyDepth) {
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    for (const double height : {-2.0, 0.0, 2.0}) {
      Picture picture;
      picture.scene.addPolyline(std::array{Vec3(0, -0.5, height), Vec3(0, 0.5, height)},
                                {.color = Color{}, .width = 80});  // 8 pixels on a page of a tenth
      picture.camera = fromAbove(projection);
      const Image image = renderSmall(picture);
      double ink = 0.0;
      for (int column = 0; column < kWidth; ++column) ink += 1.0 - image.at(column, kHeight / 2)[1] / 255.0;
      EXPECT_NEAR(ink, 8.0, 0.7) << "at height " << height;
    }
  }
}

TEST(Picture, sameBitsForAnyNumberOfThreads) {
  const Picture picture = busyPicture();
  const Image one = renderSmall(picture, 1);
  EXPECT_EQ(one.pixels, renderSmall(picture, 2).pixels);
  EXPECT_EQ(one.pixels, renderSmall(picture, 5).pixels);
}

TEST(Picture, reportsProgressWithoutChangingThePicture) {
  for (const unsigned threads : {1u, 3u}) {
    std::vector<std::size_t> reported;
    std::size_t of = 0;
    const Image image =
        render(busyPicture(), kWidth, kHeight, threads, [&](std::size_t done, std::size_t bands) {
          reported.push_back(done);
          of = bands;
        });
    EXPECT_TRUE(image.pixels == renderSmall(busyPicture()).pixels);
    EXPECT_TRUE(std::ranges::is_sorted(reported));
    if (threads > 1) continue;  // one of them is enough
    ASSERT_GT(of, 1u);
    ASSERT_EQ(reported.size(), of);
    EXPECT_EQ(reported.back(), of);
  }
}

TEST(Picture, emptySceneIsWhite) {
  for (const Image::Pixel& pixel : renderSmall(Picture{}).pixels) ASSERT_EQ(pixel, kWhite);
}

TEST(Picture, wordsKeepOffTheScene) {
  Picture picture;
  picture.scene.addMesh(square(0.0), {Mat3(100.0 * Mat3::Identity()), Vec3::Zero()}, palette::kSky);
  picture.camera = fromAbove();
  picture.annotation = {.title = "A title", .legend = {{palette::kSky, "square"}}, .length_unit = "mm"};
  const Layout layout(picture.annotation, kWidth, kHeight);
  ASSERT_GT(layout.sceneTop(), 4);
  ASSERT_LT(layout.sceneTop() + layout.sceneHeight(), kHeight - 4);
  const Image image = renderSmall(picture);
  for (int row = layout.sceneTop() + 1; row < layout.sceneTop() + layout.sceneHeight() - 1; ++row) {
    for (const int column : {1, kWidth / 4, kWidth - 2}) {
      ASSERT_LE(difference(image.at(column, row), palette::kSky), 2) << "row " << row;
    }
  }
}

TEST(Picture, writesPngOfTheRightSize) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "picture.png";
  writePng(busyPicture(), path.string(), kWidth, kHeight, 1);
  std::array<unsigned char, 24> head{};
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(head.data()), head.size());
  constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  EXPECT_TRUE(std::equal(kSignature.begin(), kSignature.end(), head.begin()));
  EXPECT_EQ(head[19], kWidth);  // the last byte of the big-endian width, then that of the height
  EXPECT_EQ(head[23], kHeight);
}

TEST(Picture, unwritablePathIsNamed) {
  const std::string path = "/no/such/folder/picture.png";
  try {
    writePng(Picture{}, path, 16, 12, 1);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
  }
}

TEST(Picture, badInputIsRefused) {
  Picture picture;
  EXPECT_THROW(render(picture, 0, 10), std::invalid_argument);
  EXPECT_THROW(render(picture, 10, 1 << 20), std::invalid_argument);
  EXPECT_THROW(picture.scene.addMesh(cube(), {}, Color{}, 0.0f), std::invalid_argument);
  EXPECT_THROW(picture.scene.addMesh(cube(), {}, std::array{Color{}, Color{}}), std::invalid_argument);
  EXPECT_EQ(picture.scene.solids().size(), 0u);
  picture.camera.direction = Vec3::Zero();
  EXPECT_THROW(render(picture, 10, 10), std::invalid_argument);
  picture.camera = {};
  picture.camera.view_width = 0.0;
  EXPECT_THROW(render(picture, 10, 10), std::invalid_argument);
}

TEST(Camera, frameSeesEveryPointAndFitsTight) {
  const std::vector<Vec3> points = {{0, 0, 0}, {10, 2, 1}, {3, 8, -4}, {-2, 5, 12}, {6, 6, 6}};
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Picture picture;
    picture.camera = frame(points, {-1, 2, -0.5}, Vec3::UnitZ(), projection);
    picture.scene.addPoints(points, {.color = Color{}, .width = 20});
    const Image image = renderSmall(picture);
    int left = kWidth, right = 0, top = kHeight, bottom = 0;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        if (image.at(column, row) == kWhite) continue;
        left = std::min(left, column);
        right = std::max(right, column);
        top = std::min(top, row);
        bottom = std::max(bottom, row);
      }
    }
    EXPECT_GT(left, 0);
    EXPECT_LT(right, kWidth - 1);
    EXPECT_GT(top, 0);
    EXPECT_LT(bottom, kHeight - 1);
    EXPECT_TRUE(right - left > 0.8 * kWidth || bottom - top > 0.8 * kHeight);
  }
}

TEST(CornerNormals, sharpAtCreasesSmoothElsewhere) {
  const TriangleMesh mesh = cube();
  const auto sharp = cornerNormals(mesh.vertices(), mesh.triangles(), 0.5);
  const auto smooth = cornerNormals(mesh.vertices(), mesh.triangles(), 2.0);
  for (std::size_t index = 0; index < mesh.triangleCount(); ++index) {
    const Vec3f flat = unitNormal(mesh.triangle(index)).cast<float>();
    for (int corner = 0; corner < 3; ++corner) {
      EXPECT_LT((sharp[index][corner] - flat).norm(), 1e-6f);
      EXPECT_GT((smooth[index][corner] - flat).norm(), 0.1f);
    }
  }
}

TEST(CornerNormals, verticesAtOnePlaceAreOne) {
  // Two triangles that bend along an edge shared by position, not by index.
  const std::vector<Vec3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, -1, -0.2}};
  const std::vector<TriangleMesh::Indices> triangles = {{0, 1, 2}, {3, 4, 5}};
  const auto normals = cornerNormals(vertices, triangles, 0.5);
  EXPECT_LT((normals[0][0] - normals[1][1]).norm(), 1e-6f);
  EXPECT_GT((normals[0][0] - normals[0][2]).norm(), 0.05f);
}

TEST(Annotation, roundLengthIsTheLargestRoundNumberNotAbove) {
  EXPECT_DOUBLE_EQ(roundLength(1.0), 1.0);
  EXPECT_DOUBLE_EQ(roundLength(1.99), 1.0);
  EXPECT_DOUBLE_EQ(roundLength(47.0), 20.0);
  EXPECT_DOUBLE_EQ(roundLength(730.0), 500.0);
  EXPECT_DOUBLE_EQ(roundLength(0.03), 0.02);
}

}  // namespace
}  // namespace octoblisk::demos
