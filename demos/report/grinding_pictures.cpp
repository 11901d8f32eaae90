// The pictures of a grinding run.
#include <algorithm>
#include <array>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>

#include "octoblisk/separating_axis.h"
#include "report/grinding_report.h"
#include "report/picture.h"

namespace octoblisk::demos {
namespace {

constexpr int kWidth = 1600, kHeight = 1200;  // pixels
constexpr double kCloseUp = 26.0;             // half the side of the cube that the close-up shows, mm
constexpr int kBoxDepth = 4;                  // of the tree's boxes in the close-up

Color colorOf(const std::string& part) {
  if (part == "belt") return palette::kSand;
  return part == "arm" ? palette::kGreen : palette::kSky;
}

Color colorOf(Verdict verdict) {
  return verdict == Verdict::intended_contact ? palette::kGreen
         : verdict == Verdict::interference   ? palette::kVermilion
                                              : palette::kYellow;
}

void addTool(const GrindingRun& run, const PoseReport& pose, Picture& picture) {
  for (const ToolPart& part : run.parts) {
    picture.scene.addMesh(part.tree->mesh(), pose.tool_in_blisk, colorOf(part.name));
    const bool wheel = part.name == "drive wheel";  // one entry for both wheels
    if (!wheel) {
      picture.annotation.legend.push_back(
          {colorOf(part.name), part.name == "contact wheel" ? "wheels" : part.name});
    }
  }
}

void addContacts(const PoseReport& pose, float width, Picture& picture) {
  for (const Verdict verdict : {Verdict::near_miss, Verdict::intended_contact, Verdict::interference}) {
    std::vector<Vec3> points;
    for (std::size_t c = 0; c < pose.contacts.size(); ++c) {
      if (pose.verdicts[c] == verdict) points.push_back(pose.contacts[c].contact.point_on_a);
    }
    if (points.empty()) continue;
    picture.scene.addPoints(
        points, {.color = colorOf(verdict), .width = width, .hidden_opacity = 0.6f, .halo = true});
    picture.annotation.legend.push_back({colorOf(verdict), nameOf(verdict), LegendSymbol::kPoint});
  }
}

void addPath(const GrindingRun& run, Picture& picture) {
  std::vector<Vec3> line;
  for (const PoseReport& pose : run.poses) line.push_back(pose.tool_in_blisk.translation);
  picture.scene.addPolyline(line, {.color = palette::kPurple, .width = 2.5f, .hidden_opacity = 0.25f});
  picture.annotation.legend.push_back({palette::kPurple, "path of the contact wheel", LegendSymbol::kLine});
}

/// The tree's boxes near a point.
std::vector<Obb> boxesNear(const ClusteredOctree& tree, const Vec3& center) {
  std::vector<Obb> boxes = tree.boxes(kBoxDepth);
  const Obb region{center, Mat3::Identity(), Vec3::Constant(0.45 * kCloseUp)};
  std::erase_if(boxes, [&](const Obb& box) { return !overlaps(region, box); });
  return boxes;
}

std::string title(const GrindingRun& run, std::size_t shown) {
  return "Pose " + std::to_string(shown) + " of " + std::to_string(run.poses.size()) + ": " +
         nameOf(run.poses[shown].verdict);
}

std::string counts(const GrindingRun& run) {
  std::ostringstream text;
  text << "Whole path: " << run.count(Verdict::clear) << " clear, " << run.count(Verdict::intended_contact)
       << " intended contact, " << run.count(Verdict::near_miss) << " near miss, "
       << run.count(Verdict::interference) << " interference";
  return text.str();
}

}  // namespace

std::string describeWorst(const GrindingRun& run, const PoseReport& pose) {
  const std::size_t c = worstContact(pose).value();
  const auto& [part, contact] = pose.contacts[c];
  std::ostringstream text;
  text << run.parts[part].name
       << (pose.blades[c] ? " on blade " + std::to_string(pose.blades[c]) : " on hub or shroud") << ", "
       << std::fixed << std::setprecision(2) << std::abs(contact.distance) << " mm "
       << (contact.distance > 0.0 ? "away" : "deep");
  return text.str();
}

std::size_t poseToShow(const GrindingRun& run) {
  std::size_t shown = run.poses.size() / 2;
  std::pair<Verdict, double> worst = {Verdict::clear, 0.0};
  for (std::size_t p = 0; p < run.poses.size(); ++p) {
    const PoseReport& pose = run.poses[p];
    const std::optional<std::size_t> c = worstContact(pose);
    if (!c || pose.verdict == Verdict::clear) continue;
    const std::pair rank = {pose.verdict, -pose.contacts[*c].contact.distance};
    if (rank <= worst) continue;
    worst = rank;
    shown = p;
  }
  return shown;
}

void writePictures(const GrindingRun& run, const std::filesystem::path& folder) {
  const std::size_t shown = poseToShow(run);
  const PoseReport& pose = run.poses[shown];
  const Vec3 wheel = pose.tool_in_blisk.translation;
  const Vec3 outward = Vec3(wheel.x(), wheel.y(), 0.0).normalized();

  Picture overview;
  overview.annotation = {.title = title(run, shown), .subtitle = counts(run), .length_unit = "mm"};
  overview.annotation.legend.push_back({palette::kSteel, "blisk"});
  overview.scene.addMesh(run.blisk->mesh(), {}, palette::kSteel);
  addTool(run, pose, overview);
  addPath(run, overview);
  addContacts(pose, 11.0f, overview);
  const Vec3 sideways = Vec3::UnitZ().cross(outward);
  overview.camera =
      frame(overview.scene.points(), -outward - 0.6 * sideways - 1.1 * Vec3::UnitZ(), Vec3::UnitZ());
  writePng(overview, (folder / "overview.png").string(), kWidth, kHeight);

  Picture closeup;
  closeup.annotation = {
      .title = title(run, shown), .subtitle = "No contact at this pose", .length_unit = "mm"};
  closeup.annotation.legend.push_back({palette::kSteel, "blisk"});
  closeup.scene.addMesh(run.blisk->mesh(), {}, palette::kSteel);
  addTool(run, pose, closeup);
  Vec3 center = wheel;
  if (const std::optional<std::size_t> worst = worstContact(pose)) {
    center = pose.contacts[*worst].contact.point_on_a;
    closeup.annotation.subtitle = describeWorst(run, pose);
  }
  const std::vector<Obb> boxes = boxesNear(*run.blisk, center);
  closeup.scene.addBoxes(boxes, {.color = palette::kBlue, .width = 1.6f});
  closeup.annotation.legend.push_back(
      {palette::kBlue, "boxes of the tree, level " + std::to_string(kBoxDepth), LegendSymbol::kLine});
  addContacts(pose, 13.0f, closeup);
  const Vec3 wheel_axis = pose.tool_in_blisk.rotation.col(2);
  const Vec3 along =
      wheel_axis.z() > 0.0 ? Vec3(-wheel_axis) : wheel_axis;  // from above, along the wheel's axis
  const Aabb cube{center - Vec3::Constant(kCloseUp), center + Vec3::Constant(kCloseUp)};
  closeup.camera = frame(cube, along - 0.35 * outward, outward);
  writePng(closeup, (folder / "closeup.png").string(), kWidth, kHeight);
}

}  // namespace octoblisk::demos
