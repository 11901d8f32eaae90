#include "paper/figures.h"

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "build/paper/principal_box.h"
#include "io/number_text.h"
#include "paper/segmentation.h"
#include "render/picture.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr int kWidth = 1000, kHeight = 800;  // pixels

constexpr std::array<Color, 8> kClusterColors = {palette::kBlue,   palette::kVermilion, palette::kGreen,
                                                 palette::kYellow, palette::kPurple,    palette::kSky,
                                                 palette::kInk,    palette::kOrange};

/// The room around the blade, the same in all pictures of cells, so that they can be compared.
constexpr double kRoomForCells = 1.5;

/// Looks at the blade's broad side, slightly from above and from one edge, with its tip up.
Camera bladeCamera(const PaperModel& model, const Points& cloud, double margin) {
  const Obb box = principalBox(cloud);
  const Vec3 outward(box.center.x(), box.center.y(), 0.0);
  const Vec3 up =
      model.isBlisk() && outward.norm() > 0.0 ? Vec3(outward.normalized()) : Vec3(box.axes.col(0));
  const Vec3 broadside = box.axes.col(2);
  return frame(cloud, -broadside + 0.45 * up.cross(broadside) - 0.3 * up, up, Projection::orthographic,
               margin);
}

Picture bladePicture(const PaperModel& model) {
  Picture picture;
  picture.scene.addMesh(*model.blade, {}, palette::kSteel);
  picture.annotation.legend = {{palette::kSteel, "blade"}};
  picture.annotation.length_unit = "mm";
  return picture;
}

void addCells(const std::vector<Obb>& cells, Color color, const std::string& name, Picture& picture) {
  picture.scene.addBoxes(cells, {.color = color, .width = 1.4f, .hidden_opacity = 0.12f});
  picture.annotation.legend.push_back({color, name, LegendSymbol::line});
}

std::string cellsText(const Segmentation& segmentation, std::size_t cells) {
  return std::to_string(segmentation.totalNodes()) + " nodes, " + std::to_string(cells) +
         " cells with points, together " + fixedText(1e-3 * segmentation.leafVolume(), 1) + " · 10³ mm³";
}

struct NamedPicture {
  std::string file;
  std::string caption;
  Picture picture;
};

NamedPicture segmentationPicture(const PaperModel& model, const Points& cloud,
                                 const std::vector<Points>& clusters, std::size_t fnop, CellFrame cells_frame,
                                 std::string file, const std::string& title) {
  const Segmentation all(clusters, fnop, cells_frame);
  Picture picture = bladePicture(model);
  std::size_t count = 0;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const std::vector<Obb> cells = Segmentation(std::span(&clusters[c], 1), fnop, cells_frame).leafCells();
    count += cells.size();
    const std::string name =
        clusters.size() == 1 ? "cells with points" : "cells of cluster " + std::to_string(c + 1);
    addCells(cells, kClusterColors[c % kClusterColors.size()], name, picture);
  }
  picture.annotation.title = title;
  picture.annotation.subtitle = cellsText(all, count);
  picture.camera = bladeCamera(model, cloud, kRoomForCells);
  std::string caption = title + ": " + picture.annotation.subtitle;
  return {std::move(file), std::move(caption), std::move(picture)};
}

/// Figure 2: the belt's points in their box along the principal axes.
NamedPicture beltBoxPicture(const TriangleMesh& belt) {
  const Obb box = principalBox(belt.vertices());
  Picture picture;
  picture.scene.addPoints(belt.vertices(), {.color = palette::kOrange, .width = 2.2f});
  picture.scene.addBoxes(std::span(&box, 1),
                         {.color = palette::kBlue, .width = 3.0f, .hidden_opacity = 0.4f});
  picture.camera = frame(picture.scene.points(), {0.25, -0.55, -0.8}, Vec3::UnitY());
  const Vec3 size = 2.0 * box.half_extents;
  const std::string points = std::to_string(belt.vertices().size()) + " points";
  picture.annotation = {.title = "Box of the belt along its principal axes",
                        .subtitle = points + "; " + fixedText(size.x(), 1) + " × " + fixedText(size.y(), 1) +
                                    " × " + fixedText(size.z(), 1) + " mm",
                        .legend = {{palette::kOrange, points + " of the belt", LegendSymbol::point},
                                   {palette::kBlue, "its box", LegendSymbol::line}},
                        .length_unit = "mm"};
  return {"fig2.png", "Figure 2: the belt's " + points + " in their box along the principal axes",
          std::move(picture)};
}

/// Figure 4: the blade's traditional cells at FNOP 2, 10 and 50, cubes along the axes.
std::vector<NamedPicture> cellPictures(const PaperModel& model, const Points& cloud) {
  std::vector<NamedPicture> pictures;
  const std::array<std::pair<std::size_t, char>, 3> cases = {{{2, 'a'}, {10, 'b'}, {50, 'c'}}};
  for (const auto& [fnop, letter] : cases) {
    pictures.push_back(segmentationPicture(
        model, cloud, {cloud}, fnop, CellFrame::cube, std::string("fig4") + letter + ".png",
        std::string("Figure 4 (") + letter + "): FNOP " + std::to_string(fnop)));
  }
  return pictures;
}

/// Figure 5: traditional beside improved with k = 2, along the axes and in principal frames, at FNOP 10.
std::vector<NamedPicture> comparisonPictures(const PaperModel& model, const Points& cloud,
                                             std::uint64_t seed) {
  constexpr std::size_t kFnop = 10;
  const std::vector<Points> clusters = clustersOf(cloud, {.k = 2, .seed = seed});
  return {segmentationPicture(model, cloud, {cloud}, kFnop, CellFrame::cube, "fig5a.png",
                              "Figure 5 (a): traditional"),
          segmentationPicture(model, cloud, clusters, kFnop, CellFrame::cube, "fig5b.png",
                              "Figure 5 (b): improved, k = 2"),
          segmentationPicture(model, cloud, clusters, kFnop, CellFrame::principal_box, "fig5c.png",
                              "Not in the paper: k = 2, principal frames")};
}

/// Figure 8: the blade's clusters for k = 2..8.
std::vector<NamedPicture> clusterPictures(const PaperModel& model, const Points& cloud, std::uint64_t seed) {
  std::vector<NamedPicture> pictures;
  for (std::size_t k = 2; k <= 8; ++k) {
    Picture picture = bladePicture(model);
    const std::vector<Points> clusters = clustersOf(cloud, {.k = k, .seed = seed});
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      const Color color = kClusterColors[c % kClusterColors.size()];
      picture.scene.addPoints(clusters[c], {.color = color, .width = 9.0f});
      picture.annotation.legend.push_back(
          {color, std::to_string(clusters[c].size()) + " points", LegendSymbol::point});
    }
    const char letter = static_cast<char>('a' + (k - 2));
    const std::string title = std::string("Figure 8 (") + letter + "): k = " + std::to_string(k);
    picture.annotation.title = title;
    picture.camera = bladeCamera(model, cloud, 1.06);
    pictures.push_back({std::string("fig8") + letter + ".png", title, std::move(picture)});
  }
  return pictures;
}

}  // namespace

FlowChart algorithmChart() {
  enum : std::size_t {
    kBelt,
    kBlisk,
    kParts,
    kBeltBox,
    kClusters,
    kOctrees,
    kCells,
    kOverlap,
    kClear,
    kCall,
    kTriangles,
    kTouch,
    kFalseAlarm,
    kContact
  };
  FlowChart chart;
  chart.boxes = {{0.0, 0, "Points of the abrasive belt"},
                 {1.0, 0, "Points of the blisk"},
                 {1.0, 1, "Parts: each blade, the hub"},
                 {0.0, 2, "One box along the belt's principal axes (eq. 1–3)"},
                 {1.0, 2, "k-means: k clusters of each part (eq. 4, 5)"},
                 {1.0, 3, "An octree over each cluster: a cell with more points than FNOP is divided"},
                 {0.5, 4,
                  "At each pose: test the belt's box against the cells, from the roots down, with separating "
                  "axes (eq. 11)"},
                 {0.5, 5, "Does a leaf cell with points overlap it?", FlowShape::question},
                 {0.0, 6, "No collision"},
                 {1.0, 6, "Collision: the paper stops here"},
                 {1.0, 7, "Not in the paper: the exact test of the triangles"},
                 {1.0, 8, "Do two triangles touch?", FlowShape::question},
                 {0.5, 9, "False positive"},
                 {1.5, 9, "Contact"}};
  chart.arrows = {{kBelt, kBeltBox},        {kBlisk, kParts},         {kParts, kClusters},
                  {kClusters, kOctrees},    {kBeltBox, kCells},       {kOctrees, kCells},
                  {kCells, kOverlap},       {kOverlap, kClear, "no"}, {kOverlap, kCall, "yes"},
                  {kCall, kTriangles},      {kTriangles, kTouch},     {kTouch, kFalseAlarm, "no"},
                  {kTouch, kContact, "yes"}};
  return chart;
}

nlohmann::json drawFigures(const PaperModel& model, const TriangleMesh& belt, const Points& cloud,
                           std::uint64_t seed, const std::filesystem::path& folder,
                           const Progress& progress) {
  std::map<std::string, std::vector<NamedPicture>> pictures;
  pictures["belt_box"].push_back(beltBoxPicture(belt));
  pictures["cells"] = cellPictures(model, cloud);
  pictures["comparison"] = comparisonPictures(model, cloud, seed);
  pictures["clusters"] = clusterPictures(model, cloud, seed);
  std::size_t count = 0, done = 0;
  for (const auto& [name, named] : pictures) count += named.size();
  nlohmann::json figures;
  for (const auto& [name, of_name] : pictures) {
    for (const NamedPicture& named : of_name) {
      writePng(named.picture, (folder / named.file).string(), kWidth, kHeight);
      figures[name].push_back({{"file", named.file}, {"caption", named.caption}});
      progress(static_cast<double>(++done) / static_cast<double>(count));
    }
  }
  writeSvg(algorithmChart(), folder / "fig7.svg");
  return figures;
}

}  // namespace octoblisk::demos
