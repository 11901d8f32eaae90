#include "report/grinding_pictures.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "geometry/separating_axis.h"
#include "octoblisk/distance.h"
#include "render/contact_sheet.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr double kCloseUp = 26.0;  // half the side of the close-up's cube, mm
constexpr int kBoxDepth = 4;       // level of the tree's boxes in the close-up

Color colorOf(const std::string& part) {
  if (part.starts_with("belt")) return palette::kSand;
  return part == "arm" ? palette::kSlate : palette::kSky;
}

Color colorOf(Verdict verdict) {
  return verdict == Verdict::intended_contact ? palette::kGreen
         : verdict >= Verdict::unknown        ? palette::kVermilion
                                              : palette::kYellow;
}

/// The blisk, with the ground blade in its own colour.
void addBlisk(const GrindingRun& run, Picture& picture) {
  constexpr Color kGroundBlade{0.93f, 0.80f, 0.86f};
  std::vector<Color> colors(run.job.blisk->mesh().triangleCount(), palette::kSteel);
  const int ground = run.job.rules.ground_blade;
  for (std::size_t t = 0; ground != 0 && t < colors.size(); ++t) {
    if (run.job.blades.blade_of_triangle[t] == ground) colors[t] = kGroundBlade;
  }
  picture.scene.addMesh(run.job.blisk->mesh(), {}, colors);
  picture.annotation.legend.push_back({palette::kSteel, "blisk"});
  if (ground != 0) {
    picture.annotation.legend.push_back({kGroundBlade, "ground blade " + std::to_string(ground)});
  }
}

void addFixtures(const GrindingRun& run, Picture& picture) {
  constexpr Color kFixture{0.63f, 0.55f, 0.45f};
  for (const Fixture& fixture : run.job.fixtures) {
    picture.scene.addMesh(fixture.tree->mesh(), {}, kFixture);
    picture.annotation.legend.push_back({kFixture, fixture.name});
  }
}

void addTool(const GrindingRun& run, const PoseReport& pose, Picture& picture) {
  for (const ToolPart& part : run.job.parts) {
    picture.scene.addMesh(part.tree->mesh(), pose.tool_in_blisk, colorOf(part.name));
    const bool wheel = part.name == "drive wheel";  // one entry for both wheels
    if (!wheel) {
      picture.annotation.legend.push_back(
          {colorOf(part.name), part.name == "contact wheel" ? "wheels" : part.name});
    }
  }
}

void addContacts(const PoseReport& pose, float width, Picture& picture) {
  for (const Verdict verdict :
       {Verdict::near_miss, Verdict::intended_contact, Verdict::unknown, Verdict::interference}) {
    std::vector<Vec3> points;
    for (const Touch& touch : pose.touches) {
      if (touch.verdict == verdict && !touch.is_inside) points.push_back(touch.contact.point_on_a);
    }
    if (points.empty()) continue;
    picture.scene.addPoints(
        points, {.color = colorOf(verdict), .width = width, .hidden_opacity = 0.6f, .halo = true});
    picture.annotation.legend.push_back({colorOf(verdict), nameOf(verdict), LegendSymbol::point});
  }
}

void addPath(const GrindingRun& run, Picture& picture) {
  std::vector<Vec3> line;
  for (const PoseReport& pose : run.poses) line.push_back(pose.tool_in_blisk.translation);
  picture.scene.addPolyline(line, {.color = palette::kPurple, .width = 2.5f, .hidden_opacity = 0.25f});
  picture.annotation.legend.push_back({palette::kPurple, "path of the contact wheel", LegendSymbol::line});
}

/// The tree's boxes near a point.
std::vector<Obb> boxesNear(const ClusteredOctree& tree, const Vec3& center) {
  std::vector<Obb> boxes = tree.boxes(kBoxDepth);
  const Obb region{center, Mat3::Identity(), Vec3::Constant(0.45 * kCloseUp)};
  std::erase_if(boxes, [&](const Obb& box) { return !overlaps(region, box); });
  return boxes;
}

std::string title(const GrindingRun& run, std::size_t shown) {
  return "Pose " + std::to_string(shown) + " (of 0-" + std::to_string(run.poses.size() - 1) +
         "): " + nameOf(run.poses[shown].verdict);
}

std::string counts(const GrindingRun& run) {
  std::ostringstream text;
  text << "Whole path: " << run.count(Verdict::clear) << " clear, " << run.count(Verdict::intended_contact)
       << " intended contact, " << run.count(Verdict::near_miss) << " near miss, "
       << run.count(Verdict::interference) << " interference";
  if (run.count(Verdict::unknown) > 0) text << ", " << run.count(Verdict::unknown) << " unknown";
  return text.str();
}

/// The subject of the close-up: the worst touch, or the place where the tool comes nearest to the blisk.
struct Focus {
  Vec3 center;
  double half_side;  ///< of the close-up's cube, mm
  std::string text;
};

Focus focusOf(const GrindingRun& run, const PoseReport& pose) {
  if (const Touch* const worst = worstTouch(pose)) {
    return {worst->contact.point_on_a, kCloseUp, describeWorst(run, pose)};
  }
  Clearance nearest;
  std::string part;
  for (const ToolPart& each : run.job.parts) {
    const Clearance clearance = distance(*run.job.blisk, *each.tree, pose.tool_in_blisk);
    if (!part.empty() && clearance.distance >= nearest.distance) continue;
    nearest = clearance;
    part = each.name;
  }
  std::ostringstream text;
  text << "No contact at this pose: the " << part << " is " << std::fixed << std::setprecision(2)
       << nearest.distance << " mm away";
  constexpr double kRoomRound = 0.75;
  return {0.5 * (nearest.point_on_a + nearest.point_on_b), std::max(kCloseUp, kRoomRound * nearest.distance),
          text.str()};
}

/// The blisk's axis in its mesh's frame.
Vec3 axisOf(const GrindingRun& run) { return run.job.mesh_in_blisk.rotation.row(2).transpose(); }

/// The direction from the axis to the contact wheel, in the mesh's frame.
Vec3 outwardOf(const GrindingRun& run, const PoseReport& pose) {
  const Vec3 wheel = run.job.mesh_in_blisk * pose.tool_in_blisk.translation;
  const double radius = std::hypot(wheel.x(), wheel.y());
  const Vec3 outward = radius > 0.0 ? Vec3(wheel.x() / radius, wheel.y() / radius, 0.0) : Vec3::UnitX();
  return run.job.mesh_in_blisk.rotation.transpose() * outward;
}

}  // namespace

std::string describeWorst(const GrindingRun& run, const PoseReport& pose) {
  const BodyNames names = run.names();
  const Touch& worst = *worstTouch(pose);
  std::ostringstream text;
  text << run.job.parts[worst.part].name
       << (!worst.is_inside               ? " on "
           : names.isFixture(worst.blade) ? " wholly inside, or around, "
                                          : " wholly inside the blisk, or around it, near ")
       << names.nameOf(worst.blade) << ", " << std::fixed << std::setprecision(2) << std::abs(worst.depth)
       << " mm " << (worst.depth < 0.0 ? "away" : "deep");
  if (worst.deepest_blade != worst.blade) text << " on " << names.nameOf(worst.deepest_blade);
  return text.str();
}

std::size_t poseToShow(const GrindingRun& run) {
  std::size_t shown = run.poses.size() / 2;
  std::pair<Verdict, double> worst = {Verdict::clear, 0.0};
  for (std::size_t p = 0; p < run.poses.size(); ++p) {
    const PoseReport& pose = run.poses[p];
    const Touch* const touch = worstTouch(pose);
    if (!touch || pose.verdict == Verdict::clear) continue;
    const std::pair rank = {pose.verdict, touch->depth};
    if (rank <= worst) continue;
    worst = rank;
    shown = p;
  }
  return shown;
}

Picture overviewOf(const GrindingRun& run) { return overviewOf(run, poseToShow(run)); }

Picture overviewOf(const GrindingRun& run, std::size_t shown) {
  const PoseReport& pose = run.poses[shown];
  Picture overview;
  overview.annotation = {.title = title(run, shown), .subtitle = counts(run), .length_unit = "mm"};
  addBlisk(run, overview);
  addFixtures(run, overview);
  addTool(run, pose, overview);
  addPath(run, overview);
  addContacts(pose, 11.0f, overview);
  const Vec3 axis = axisOf(run), outward = outwardOf(run, pose), sideways = axis.cross(outward);
  overview.camera = frame(overview.scene.points(), -outward - 0.6 * sideways - 1.1 * axis, axis);
  return overview;
}

Picture closeupOf(const GrindingRun& run) {
  const std::size_t shown = poseToShow(run);
  const PoseReport& pose = run.poses[shown];
  const auto [center, half_side, text] = focusOf(run, pose);
  Picture closeup;
  closeup.annotation = {.title = title(run, shown), .subtitle = text, .length_unit = "mm"};
  addBlisk(run, closeup);
  addFixtures(run, closeup);
  addTool(run, pose, closeup);
  if (const std::vector<Obb> boxes = boxesNear(*run.job.blisk, center); !boxes.empty()) {
    closeup.scene.addBoxes(boxes, {.color = palette::kBlue, .width = 1.6f, .hidden_opacity = 0.3f});
    closeup.annotation.legend.push_back(
        {palette::kBlue, "boxes of the tree, level " + std::to_string(kBoxDepth) + " (faint where hidden)",
         LegendSymbol::line});
  }
  addContacts(pose, 13.0f, closeup);
  const Vec3 wheel_axis = pose.tool_in_blisk.rotation.col(2);
  const Vec3 along = wheel_axis.dot(axisOf(run)) > 0.0 ? Vec3(-wheel_axis)
                                                       : wheel_axis;  // from above, along the wheel's axis
  const Aabb cube{center - Vec3::Constant(half_side), center + Vec3::Constant(half_side)};
  const Vec3 outward = outwardOf(run, pose);
  closeup.camera = frame(cube, along - 0.35 * outward, outward);
  return closeup;
}

namespace {

constexpr int kSheetFrameWidth = 480, kSheetFrameHeight = 400;  // pixels

std::string frameName(std::size_t frame) {
  std::ostringstream name;
  name << std::setw(4) << std::setfill('0') << frame << ".png";
  return name.str();
}

}  // namespace

std::vector<std::size_t> posesOfFrames(std::size_t poses, std::size_t count) {
  std::vector<std::size_t> chosen;
  count = std::min(count, poses);
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? 0 : (i * (poses - 1) + (count - 1) / 2) / (count - 1));
  }
  return chosen;
}

void writeFrames(const GrindingRun& run, std::size_t count, const std::filesystem::path& folder,
                 WholeFiles& files, const DrawPicture& draw) {
  const std::filesystem::path frames = folder / "frames";
  std::error_code error;
  std::filesystem::create_directories(frames, error);
  if (error) throw std::runtime_error(frames.string() + ": cannot create the folder: " + error.message());
  const Camera camera = overviewOf(run).camera;
  std::vector<SheetFrame> sheet;
  for (const std::size_t pose : posesOfFrames(run.poses.size(), count)) {
    Picture picture = overviewOf(run, pose);
    picture.camera = camera;
    draw(picture, files.add(frames / frameName(sheet.size())).string());
    sheet.push_back({"Pose " + std::to_string(pose) + ": " + nameOf(run.poses[pose].verdict), picture});
  }
  if (sheet.empty()) return;
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(sheet.size()))));
  writePng(contactSheet(sheet, "Poses along the path", sheet.front().picture.annotation.subtitle, columns,
                        kSheetFrameWidth, kSheetFrameHeight),
           files.add(folder / "contact_sheet.png").string());
}

}  // namespace octoblisk::demos
