// Makes the pictures of docs/how-it-works.md: tree_pictures FOLDER. `./dev pictures` runs it.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "geometry/separating_axis.h"
#include "models/belt_grinder.h"
#include "models/blade_finder.h"
#include "models/blisk.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "paper/surface_points.h"
#include "render/contact_sheet.h"
#include "toolpath/grinding_path.h"
#include "tree/tree.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr int kFrameWidth = 500, kFrameHeight = 450;  // pixels
constexpr std::array<Color, kLanes> kColors = {palette::kBlue,   palette::kVermilion, palette::kGreen,
                                               palette::kYellow, palette::kPurple,    palette::kSky,
                                               palette::kSlate,  palette::kOrange};

std::vector<Slot> slotsBelow(const Tree& tree, Slot slot) {
  std::vector<Slot> below;
  const Child child = tree.child(slot);
  for (std::uint32_t lane = 0; !child.isLeaf() && lane < kLanes; ++lane) {
    if (!tree.child({child.node(), lane}).isEmpty()) below.push_back({child.node(), lane});
  }
  return below;
}

/// The boxes a number of levels below a slot, and leaves above that level.
std::vector<Slot> slotsBelow(const Tree& tree, Slot slot, int levels) {
  const std::vector<Slot> below = slotsBelow(tree, slot);
  if (levels == 0 || below.empty()) return {slot};
  std::vector<Slot> all;
  for (const Slot each : below) {
    const std::vector<Slot> of_each = slotsBelow(tree, each, levels - 1);
    all.insert(all.end(), of_each.begin(), of_each.end());
  }
  return all;
}

std::vector<Obb> boxesOf(const Tree& tree, const std::vector<Slot>& slots) {
  std::vector<Obb> boxes;
  for (const Slot slot : slots) boxes.push_back(tree.box(slot));
  return boxes;
}

std::shared_ptr<const TriangleMesh> bladeOf(const Blisk& blisk) {
  return std::make_shared<const TriangleMesh>(partOf(blisk.mesh, blisk.blade_of_triangle, 1));
}

std::string percentText(double part) {
  return std::to_string(static_cast<int>(std::lround(100.0 * part))) + " %";
}

const Vec3 kSideways(-0.35, -1.0, 0.55);  // towards a side of the blade, from one edge

/// The blade's boxes at four depths, coloured by the root's child that contains them.
Image depthsPicture(const Tree& tree) {
  const Camera camera =
      frame(tree.mesh().vertices(), kSideways, Vec3::UnitX(), Projection::orthographic, 1.15);
  std::vector<SheetFrame> frames;
  for (int depth = 1; depth <= 4; ++depth) {
    SheetFrame frame;
    std::size_t count = 0, cluster = 0;
    double volume = 0.0;
    frame.picture.scene.addMesh(tree.mesh(), {}, palette::kSteel);
    for (const Slot child : slotsBelow(tree, Tree::kRoot)) {
      const std::vector<Obb> boxes = boxesOf(tree, slotsBelow(tree, child, depth - 1));
      for (const Obb& box : boxes) volume += box.volume();
      count += boxes.size();
      frame.picture.scene.addBoxes(
          boxes, {.color = kColors[cluster++], .width = depth < 3 ? 2.4f : 1.6f, .hidden_opacity = 0.15f});
    }
    frame.picture.camera = camera;
    frame.caption = "depth " + std::to_string(depth) + ": " + std::to_string(count) + " boxes, " +
                    percentText(volume / tree.stats().root_volume) + " of the root's volume";
    frames.push_back(std::move(frame));
  }
  return contactSheet(frames, "Boxes of a blade's tree", "One colour for each child of the root", 2,
                      kFrameWidth, kFrameHeight);
}

Vec3 thinAxis(const Obb& box) {
  Eigen::Index thin;
  box.half_extents.minCoeff(&thin);
  return box.axes.col(thin);
}

std::vector<std::uint32_t> trianglesBelow(const Tree& tree, Slot slot) {
  std::vector<std::uint32_t> all;
  for (const Slot leaf : slotsBelow(tree, slot, Tree::kMaxDepth)) {
    const std::span<const std::uint32_t> triangles = tree.triangles(tree.child(leaf));
    all.insert(all.end(), triangles.begin(), triangles.end());
  }
  return all;
}

/// The mean normal of the triangles below a slot, along the axis.
double meanNormal(const Tree& tree, Slot slot, const Vec3& axis) {
  double sum = 0.0;
  const std::vector<std::uint32_t> triangles = trianglesBelow(tree, slot);
  for (const std::uint32_t t : triangles) sum += unitNormal(tree.mesh().triangle(t)).dot(axis);
  return sum / static_cast<double>(triangles.size());
}

/// The first node that has both sides of the blade and whose children each have only one.
Slot dividedByNormals(const Tree& tree) {
  for (int depth = 0; depth < tree.stats().depth; ++depth) {
    for (const Slot slot : slotsBelow(tree, Tree::kRoot, depth)) {
      const std::vector<Slot> children = slotsBelow(tree, slot);
      const Vec3 axis = thinAxis(tree.box(slot));
      const auto is_one_sided = [&](Slot child) { return std::abs(meanNormal(tree, child, axis)) > 0.9; };
      const bool has_both = std::abs(meanNormal(tree, slot, axis)) < 0.3;
      if (has_both && children.size() == kLanes && std::ranges::all_of(children, is_one_sided)) return slot;
    }
  }
  throw std::logic_error("no node is divided by normals");
}

/// A node's triangles in the colours of its children: in place, drawn apart, and by place and normal.
Image divisionPicture(const Tree& tree) {
  const TriangleMesh& mesh = tree.mesh();
  const Slot node = dividedByNormals(tree);
  const std::vector<Slot> children = slotsBelow(tree, node);
  const Obb box = tree.box(node);
  const Vec3 thin = thinAxis(box);
  const double height = 0.6 * box.half_extents.maxCoeff();
  std::vector<SheetFrame> frames(3);
  std::vector<Color> colors(mesh.triangleCount(), palette::kSteel);
  Scene &on_blade = frames[0].picture.scene, &apart = frames[1].picture.scene,
        &dots = frames[2].picture.scene;
  for (std::size_t c = 0; c < children.size(); ++c) {
    const std::vector<std::uint32_t> triangles = trianglesBelow(tree, children[c]);
    std::vector<Vec3> places;
    for (const std::uint32_t t : triangles) {
      colors[t] = kColors[c];
      const Triangle corners = mesh.triangle(t);
      const Vec3 centroid = centroidOf(corners);
      const Vec3 place = box.axes.transpose() * (centroid - box.center);
      places.push_back({place.x(), place.y(), height * unitNormal(corners).dot(thin)});
    }
    Obb moved = tree.box(children[c]);
    const Vec3 outward = moved.center - box.center;
    const Pose away{Mat3::Identity(), 0.4 * outward + 18.0 * thin.dot(outward) * thin};
    moved.center = away * moved.center;
    apart.addMesh(partOf(mesh, triangles), away, kColors[c]);
    apart.addBoxes(std::span(&moved, 1), {.color = kColors[c], .width = 2.0f, .hidden_opacity = 0.3f});
    dots.addPoints(places, {.color = kColors[c], .width = 7.0f});
  }
  on_blade.addMesh(mesh, {}, colors);
  on_blade.addBoxes(std::span(&box, 1), {.color = palette::kInk, .width = 2.4f, .hidden_opacity = 0.3f});
  frames[0].caption = "a node with both sides of a blade";
  frames[0].picture.camera = frame(mesh.vertices(), kSideways, Vec3::UnitX());
  frames[1].caption = "its 8 children, drawn apart: 4 per side";
  frames[1].picture.camera = frame(apart.points(), kSideways, Vec3::UnitX());
  frames[2].caption = "one dot per triangle; the normal is up";
  frames[2].picture.camera = frame(dots.points(), {-0.4, 1.0, -0.5}, Vec3::UnitZ());
  return contactSheet(
      frames, "A node's triangles are divided by position and normal",
      "One colour for each child. Where the blade is thin, its two sides are close together, but "
      "their normals point in opposite directions",
      3, kFrameWidth, kFrameHeight);
}

/// One box of each tree.
struct Pair {
  Slot a, b;
};

/// The pairs of boxes that overlap after a number of steps down; each step opens the larger box of a pair.
std::vector<Pair> step(const Tree& a, const Tree& b, const Pose& b_in_a, const std::vector<Pair>& pairs,
                       std::size_t& tests) {
  std::vector<Pair> next;
  for (const Pair& pair : pairs) {
    const std::vector<Slot> below_a = slotsBelow(a, pair.a), below_b = slotsBelow(b, pair.b);
    if (below_a.empty() && below_b.empty()) next.push_back(pair);
    const bool opens_a = below_b.empty() || (!below_a.empty() && a.box(pair.a).half_extents.maxCoeff() >=
                                                                     b.box(pair.b).half_extents.maxCoeff());
    for (const Slot slot : opens_a ? below_a : below_b) {
      const Pair child = opens_a ? Pair{slot, pair.b} : Pair{pair.a, slot};
      ++tests;
      if (overlaps(a.box(child.a), b_in_a * b.box(child.b))) next.push_back(child);
    }
  }
  return next;
}

bool isDone(const Tree& a, const Tree& b, const std::vector<Pair>& pairs) {
  return std::ranges::all_of(
      pairs, [&](const Pair& pair) { return a.child(pair.a).isLeaf() && b.child(pair.b).isLeaf(); });
}

std::string countText(std::size_t count, const std::string& what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

/// The descent of two trees after some steps: the boxes that overlap a box of the other body.
Image walkPicture(const ClusteredOctree& blisk_octree, const ClusteredOctree& belt_octree,
                  const Pose& belt_in_blisk) {
  const Tree &blisk = treeOf(blisk_octree), &belt = treeOf(belt_octree);
  std::vector<TrianglePair> touching;
  touchingPairs(blisk_octree, belt_octree, belt_in_blisk, touching);
  if (touching.empty()) throw std::logic_error("the belt touches nothing");
  const Vec3 touch = blisk.mesh().triangle(touching.front().a)[0];
  const Vec3 outward = Vec3(touch.x(), touch.y(), 0.0).normalized();
  const Vec3 looking = -0.5 * outward - 0.9 * Vec3::UnitZ().cross(outward) - 0.8 * Vec3::UnitZ();

  std::vector<SheetFrame> frames;
  std::vector<Pair> pairs = {{Tree::kRoot, Tree::kRoot}};
  std::size_t tests = 0;
  const std::array<double, 6> half_sides = {320.0, 320.0, 90.0, 45.0, 22.0, 12.0};  // of the view, mm
  for (std::size_t f = 0, steps = 0; f < half_sides.size(); ++f) {
    SheetFrame frame;
    Scene& scene = frame.picture.scene;
    scene.addMesh(blisk.mesh(), {}, palette::kSteel);
    scene.addMesh(belt.mesh(), belt_in_blisk, palette::kSand);
    std::vector<Obb> of_blisk, of_belt;
    for (const Pair& pair : pairs) {
      of_blisk.push_back(blisk.box(pair.a));
      of_belt.push_back(belt_in_blisk * belt.box(pair.b));
    }
    scene.addBoxes(of_blisk, {.color = palette::kBlue, .width = 2.4f, .hidden_opacity = 0.35f});
    scene.addBoxes(of_belt, {.color = palette::kVermilion, .width = 2.4f, .hidden_opacity = 0.35f});
    const Vec3 reach = Vec3::Constant(half_sides[f] / std::sqrt(3.0));
    frame.picture.camera = demos::frame(Aabb{touch - reach, touch + reach}, looking, outward);
    frame.caption = std::to_string(steps) + " steps: " + countText(pairs.size(), "pair") + " left, " +
                    std::to_string(tests) + " compared";
    frames.push_back(std::move(frame));
    // Two steps per frame; all remaining steps before the last frame.
    const bool is_last = f + 2 >= half_sides.size();
    for (int k = 0; (is_last || k < 2) && !isDone(blisk, belt, pairs); ++k, ++steps) {
      pairs = step(blisk, belt, belt_in_blisk, pairs, tests);
    }
  }
  const std::vector<LegendEntry> legend = {{palette::kSteel, "blisk"},
                                           {palette::kSand, "belt"},
                                           {palette::kBlue, "boxes of the blisk", LegendSymbol::line},
                                           {palette::kVermilion, "boxes of the belt", LegendSymbol::line}};
  frames.front().picture.annotation.legend = legend;
  return contactSheet(
      frames, "Traversal of two trees at one pose",
      "Only boxes that overlap a box of the other body; each step opens the larger box of a pair", 3,
      kFrameWidth, kFrameHeight);
}

void makePictures(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const Blisk model = makeDefaultBlisk(200'000);
  const ClusteredOctree blade = ClusteredOctree::build(bladeOf(model));
  writePng(depthsPicture(treeOf(blade)), folder / "tree-depths.png");
  const ClusteredOctree fine = ClusteredOctree::build(bladeOf(makeDefaultBlisk(1'500'000)));
  writePng(divisionPicture(treeOf(fine)), folder / "tree-division.png");
  const ClusteredOctree blisk = ClusteredOctree::build(std::make_shared<const TriangleMesh>(model.mesh));
  const ClusteredOctree belt = ClusteredOctree::build(std::make_shared<const TriangleMesh>(makeBelt()));
  const std::vector<Pose> path = makeGrindingPath(model.mesh, findBlades(model.mesh));
  writePng(walkPicture(blisk, belt, path[60]), folder / "tree-walk.png");
}

}  // namespace
}  // namespace octoblisk::demos

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: tree_pictures FOLDER\n";
    return 2;
  }
  try {
    octoblisk::demos::makePictures(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "tree_pictures: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
