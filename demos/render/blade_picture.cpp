#include "render/blade_picture.h"

#include <vector>

namespace octoblisk::demos {
namespace {

constexpr Color kFirstBlade{0.93f, 0.80f, 0.86f};

std::vector<Color> partColors(const BliskAnatomy& anatomy, BladeSide convex_side) {
  std::vector<Color> colors;
  for (const BladePart part : anatomy.sides.part_of_triangle) {
    const bool is_convex = (part == BladePart::forward) == (convex_side == BladeSide::forward);
    colors.push_back(part == BladePart::not_of_blade ? palette::kSteel
                     : part == BladePart::tip        ? palette::kSlate
                     : is_convex                     ? palette::kSand
                                                     : palette::kSky);
  }
  return colors;
}

}  // namespace

Picture bladePicture(const TriangleMesh& blisk, const BliskFound& found, const BliskAnatomy& anatomy,
                     BladeSide convex_side) {
  Picture picture;
  picture.scene.addMesh(blisk, {}, partColors(anatomy, convex_side));
  for (const BladeAnatomy& blade : anatomy.blades) {
    picture.scene.addPolyline(blade.leading,
                              {.color = palette::kGreen, .width = 4.0f, .hidden_opacity = 0.15f});
    picture.scene.addPolyline(blade.trailing,
                              {.color = palette::kVermilion, .width = 4.0f, .hidden_opacity = 0.15f});
  }
  const std::vector<Vec3> first_tip = {anatomy.blades.front().leading.back()};
  picture.scene.addPoints(first_tip, {.color = kFirstBlade, .width = 18.0f, .halo = true});
  const Aabb bounds = blisk.bounds();
  const double beyond = 0.15 * (bounds.max.z() - bounds.min.z()) + 0.05 * found.blades.tip_radius;
  picture.scene.addArrow(Vec3(0.0, 0.0, bounds.min.z() - beyond), Vec3(0.0, 0.0, bounds.max.z() + beyond),
                         {.color = palette::kInk, .width = 3.0f, .hidden_opacity = 0.3f});

  picture.annotation.title = std::to_string(found.blades.count) + " blades";
  picture.annotation.subtitle = "Blades are numbered by angle, starting at the ball on the tip of blade 1";
  picture.annotation.length_unit = "mm";
  picture.annotation.legend = {{palette::kSand, "convex side"},
                               {palette::kSky, "concave side"},
                               {palette::kSteel, found.blades.shrouded ? "hub, shroud" : "hub"},
                               {palette::kGreen, "leading edge", LegendSymbol::line},
                               {palette::kVermilion, "trailing edge", LegendSymbol::line},
                               {palette::kInk, "axis", LegendSymbol::line},
                               {kFirstBlade, "blade 1", LegendSymbol::point}};
  if (!found.blades.shrouded) {
    picture.annotation.legend.insert(picture.annotation.legend.begin() + 2, {palette::kSlate, "tip"});
  }
  picture.camera = frame(picture.scene.points(), Vec3(-0.75, -0.15, 1.0), Vec3::UnitX());
  return picture;
}

}  // namespace octoblisk::demos
