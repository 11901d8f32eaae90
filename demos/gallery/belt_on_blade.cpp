#include "gallery/belt_on_blade.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/belt_path.h"
#include "models/blade_anatomy.h"
#include "models/blisk.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::gallery {
namespace {

constexpr int kBlade = 1;

/// The tool whose lower strand touches the convex side along its chord. The drive wheel is on the side away
/// from the next blade across the channel.
Pose toolTouching(const TriangleMesh& blisk, const demos::BladesFound& blades,
                  const BeltOnBladeOptions& options) {
  const demos::BliskAnatomy anatomy = demos::findAnatomy(blisk, blades);
  const bool forward = anatomy.convex_side.value_or(demos::BladeSide::forward) == demos::BladeSide::forward;
  const demos::BladeContour contour = demos::BladeContours(blisk, anatomy.sides, kBlade).at(options.height);
  const std::vector<demos::ContourPoint>& side = forward ? contour.forward : contour.backward;

  const Vec3 leading = side.front().position, trailing = side.back().position;
  const Vec3 chord = (trailing - leading).normalized();
  Vec3 normal = Vec3::Zero();
  for (const demos::ContourPoint& point : side) normal += point.normal;
  normal = (normal - normal.dot(chord) * chord).normalized();
  const Vec3 top = std::ranges::max_element(side, {}, [&](const demos::ContourPoint& point) {
                     return normal.dot(point.position);
                   })->position;

  const double pitch = (forward ? 2.0 : -2.0) * std::numbers::pi / blades.count;
  const Vec3 next = Eigen::AngleAxisd(pitch, Vec3::UnitZ()) * top;
  const Vec3 to_drive = (next - top).dot(chord) > 0.0 ? Vec3(-chord) : chord;
  const Vec3 near_edge = to_drive.dot(chord) > 0.0 ? leading : trailing;

  // The strand's outward normal and direction in the tool's frame.
  const demos::BeltParameters& sizes = options.belt.sizes;
  const double slope = demos::BeltPath(sizes).slope();
  const Vec3 out(-std::sin(slope), -std::cos(slope), 0.0), along(std::cos(slope), -std::sin(slope), 0.0);
  Mat3 in_tool, in_blisk;
  in_tool << along, -out, Vec3::UnitZ();
  in_blisk << to_drive, normal, to_drive.cross(normal);
  const Mat3 rotation = in_blisk * in_tool.transpose();
  const double beyond_edge = 3.0 * sizes.contact_wheel_radius;
  const double from_wheel = (top - near_edge).dot(to_drive) + beyond_edge;
  const Vec3 touching = (sizes.contact_wheel_radius + sizes.thickness) * out + from_wheel * along;
  return {rotation, top - rotation * touching};
}

}  // namespace

BeltOnBlade::BeltOnBlade(const BeltOnBladeOptions& options)
    : options_(options),
      shape_(std::make_shared<const ClusteredOctree>(ClusteredOctree::build(
          std::make_shared<const TriangleMesh>(demos::makeDefaultBlisk(options.blisk_triangles).mesh),
          options.tree))),
      surface_(shape_.tree()),
      blades_(demos::findBlades(shape_.tree().mesh())),
      touching_(toolTouching(shape_.tree().mesh(), blades_, options)) {
  registerAlgorithm(&dispatcher_);
  world_.setGravity(btVector3(0, 0, -9810));
  blisk_body_.setFriction(btScalar(0.004));  // applied in every iteration of the soft body's solver
  world_.addRigidBody(&blisk_body_);
  belt_ = std::make_unique<SoftBelt>(world_, options.belt, toolAt(0.0));
}

BeltOnBlade::~BeltOnBlade() {
  belt_.reset();
  world_.removeRigidBody(&blisk_body_);
}

Pose BeltOnBlade::toolAt(double time) const {
  const double part =
      std::clamp((time - options_.press_begin) / (options_.press_end - options_.press_begin), 0.0, 1.0);
  const double eased = part * part * (3.0 - 2.0 * part);
  const double above = options_.clearance - eased * (options_.clearance + options_.press);
  const demos::BeltPath path(options_.belt.sizes);
  const Vec3 normal = touching_.rotation * Vec3(std::sin(path.slope()), std::cos(path.slope()), 0.0);
  return {touching_.rotation, touching_.translation + above * normal};
}

void BeltOnBlade::step() {
  time_ += kTimeStep;
  belt_->step(toolAt(time_), kTimeStep);
}

double BeltOnBlade::deepestNode() const {
  double deepest = 0.0;
  for (int station = 0; station < belt_->stations(); ++station) {
    for (int k = 0; k < belt_->nodesAcross(); ++k) {
      const Vec3 node = belt_->node(station, k);
      if (locate(surface_, node) != PointLocation::inside) continue;
      deepest = std::max(deepest, closestPoint(shape_.tree(), node)->distance);
    }
  }
  return deepest;
}

std::vector<Vec3> BeltOnBlade::touching(double gap) const {
  const double reach = 0.5 * options_.belt.sizes.thickness + gap;
  std::vector<Vec3> nodes;
  for (int station = 0; station < belt_->stations(); ++station) {
    for (int k = 0; k < belt_->nodesAcross(); ++k) {
      const Vec3 node = belt_->node(station, k);
      if (closestPoint(shape_.tree(), node, reach)) nodes.push_back(node);
    }
  }
  return nodes;
}

std::vector<Number> BeltOnBlade::numbers() const {
  const SoftBelt::Strain strain = belt_->strain();
  return {{"strain_percent", 100.0 * strain.mean},
          {"least_strain_percent", 100.0 * strain.least},
          {"belt_speed_mm_s", belt_->meanSpeed()},
          {"nodes_on_blisk", static_cast<double>(touching().size())},
          {"deepest_node_mm", deepestNode()}};
}

demos::Picture BeltOnBlade::picture() const {
  namespace palette = demos::palette;
  demos::Picture picture;
  demos::Scene& scene = picture.scene;
  constexpr demos::Color kGroundBlade{0.93f, 0.80f, 0.86f};
  std::vector<demos::Color> colors(blades_.blade_of_triangle.size(), palette::kSteel);
  for (std::size_t t = 0; t < colors.size(); ++t) {
    if (blades_.blade_of_triangle[t] == kBlade) colors[t] = kGroundBlade;
  }
  scene.addMesh(shape_.tree().mesh(), {}, colors);
  scene.addMesh(belt_->mesh(), {}, palette::kSand);
  for (const TriangleMesh& wheel : belt_->wheelMeshes()) scene.addMesh(wheel, {}, palette::kSky);
  const std::vector<Vec3> touched = touching();
  if (!touched.empty())
    scene.addPoints(touched, {.color = palette::kGreen, .width = 8.0f, .hidden_opacity = 0.6f});
  picture.annotation.legend = {{palette::kSteel, "blisk"},
                               {kGroundBlade, "ground blade"},
                               {palette::kSand, "belt"},
                               {palette::kSky, "wheels"},
                               {palette::kGreen, "nodes that touch the blade", demos::LegendSymbol::point}};
  // From outside, along the wheels' axis.
  std::vector<Vec3> corners;
  for (const TriangleMesh& wheel : belt_->wheelMeshes())
    corners.insert(corners.end(), wheel.vertices().begin(), wheel.vertices().end());
  const Vec3 axis = touching_.rotation.col(2);
  const Vec3 inward = axis.dot(touching_.translation) > 0.0 ? Vec3(-axis) : axis;
  picture.camera = demos::frame(corners, inward, touching_.rotation.col(1));
  return picture;
}

}  // namespace octoblisk::gallery
