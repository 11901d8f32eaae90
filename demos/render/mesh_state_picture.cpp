#include "render/mesh_state_picture.h"

#include <vector>

namespace octoblisk::demos {
namespace {

Color colorOf(TriangleRole role) {
  switch (role) {
    case TriangleRole::outward:
      return palette::kSteel;
    case TriangleRole::inward:
      return palette::kSand;
    case TriangleRole::inner:
      return palette::kSlate;
    case TriangleRole::sheet:
      return palette::kSky;
  }
  return palette::kSteel;
}

}  // namespace

Picture meshStatePicture(const octoblisk::Surface& surface, const MeshInspection& found) {
  const TriangleMesh& mesh = surface.tree().mesh();
  std::vector<Color> colors;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) colors.push_back(colorOf(surface.role(t)));
  Picture picture;
  picture.scene.addMesh(mesh, {}, colors);
  bool has_holes = false, has_narrow = false;
  for (const MeshGap& gap : found.gaps) {
    if (gap.outline.empty()) continue;
    const bool is_hole = gap.kind == GapKind::hole || gap.kind == GapKind::turned;
    (is_hole ? has_holes : has_narrow) = true;
    std::vector<Vec3> line = gap.outline;
    line.push_back(line.front());
    picture.scene.addPolyline(line, {.color = is_hole ? palette::kVermilion : palette::kGreen,
                                     .width = is_hole ? 4.0f : 2.5f,
                                     .hidden_opacity = 0.25f});
  }
  std::vector<Vec3> meetings;
  for (const DefectPlace& place : found.intersecting) meetings.push_back(place.position);
  if (!meetings.empty())
    picture.scene.addPoints(meetings, {.color = palette::kInk, .width = 5.0f, .hidden_opacity = 0.15f});
  picture.annotation.title = found.isSolid() ? "The mesh bounds a solid" : "What the mesh bounds";
  picture.annotation.legend = {{palette::kSteel, "bounds a solid"}};
  const auto explain = [&](bool occurs, const Color& color, const char* text, LegendSymbol symbol) {
    if (occurs) picture.annotation.legend.push_back({color, text, symbol});
  };
  explain(!found.inward.empty(), palette::kSand, "faces inward", LegendSymbol::surface);
  explain(!found.inner.empty(), palette::kSlate, "inside the solid", LegendSymbol::surface);
  explain(!found.sheets.empty(), palette::kSky, "sheet", LegendSymbol::surface);
  explain(has_holes, palette::kVermilion, "hole", LegendSymbol::line);
  explain(has_narrow, palette::kGreen, "crack or T-junction", LegendSymbol::line);
  explain(!meetings.empty(), palette::kInk, "intersects others", LegendSymbol::point);
  picture.camera = frame(picture.scene.points(), Vec3(-0.75, -0.5, -0.45), Vec3::UnitZ());
  return picture;
}

}  // namespace octoblisk::demos
