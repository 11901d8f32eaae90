#include "render/mesh_state_picture.h"

#include <vector>

namespace octoblisk::demos {
namespace {

constexpr float kLineWidth = 4.0f, kHidden = 0.25f;

struct TriangleStyle {
  const std::vector<DefectPlace>& places;
  Color color;
  const char* text;
};

struct GapStyle {
  GapKind kind;
  Color color;
  const char* text;
};

constexpr GapStyle kGapStyles[] = {{GapKind::hole, palette::kVermilion, "hole"},
                                   {GapKind::turned, palette::kOrange, "triangles face opposite ways"},
                                   {GapKind::t_junction, palette::kBlue, "T-junction"},
                                   {GapKind::crack, palette::kGreen, "crack"},
                                   {GapKind::inner, palette::kInk, "gap inside"}};

}  // namespace

Picture meshStatePicture(const octoblisk::Surface& surface, const MeshInspection& found,
                         const std::string& length_unit) {
  const TriangleMesh& mesh = surface.tree().mesh();
  Picture picture;
  std::vector<LegendEntry>& legend = picture.annotation.legend;
  std::vector<Color> colors(mesh.triangleCount(), palette::kSteel);
  if (found.isAnywhereSolid() && !found.facesInward()) legend.push_back({palette::kSteel, "bounds a solid"});
  // The later ones replace the earlier ones.
  const TriangleStyle styles[] = {{found.inner, palette::kSlate, "inside the solid"},
                                  {found.sheets, palette::kSky, "sheet"},
                                  {found.inward, palette::kSand, "faces inward"},
                                  {found.intersecting, palette::kPurple, "intersects or overlaps others"},
                                  {found.folded, palette::kYellow, "folded over"}};
  for (const TriangleStyle& style : styles) {
    if (!style.places.empty()) legend.push_back({style.color, style.text});
    for (const DefectPlace& place : style.places) colors[place.triangle] = style.color;
  }
  picture.scene.addMesh(mesh, {}, colors);
  for (const GapStyle& style : kGapStyles) {
    if (found.count(style.kind) > 0) legend.push_back({style.color, style.text, LegendSymbol::line});
    for (const MeshGap& gap : found.gaps) {
      if (gap.kind != style.kind) continue;
      std::vector<Vec3> line = gap.outline;
      line.push_back(line.front());
      picture.scene.addPolyline(line, {.color = style.color, .width = kLineWidth, .hidden_opacity = kHidden});
    }
  }
  picture.annotation.title = found.isSolid()           ? "The mesh bounds a solid"
                             : found.isAnywhereSolid() ? "Parts of the mesh bound a solid"
                                                       : "The mesh bounds no solid";
  picture.annotation.length_unit = length_unit;
  picture.camera = frame(picture.scene.points(), Vec3(-0.75, 0.5, -0.45), Vec3::UnitZ());
  return picture;
}

}  // namespace octoblisk::demos
