#include "scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <regex>
#include <span>
#include <stdexcept>
#include <utility>

#include "gallery/nut_run.h"
#include "models/belt_grinder.h"
#include "models/blade_finder.h"
#include "models/blisk.h"
#include "shapes/bodies.h"
#include "shared/meshes.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::bench {
namespace {

using testing::uniform;

constexpr int kBlades = 24;
constexpr std::size_t kPathTriangles = 300'000;  // of the blisk used to make the path

std::shared_ptr<const TriangleMesh> roundedToFloat(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& vertex : vertices) vertex = vertex.cast<float>().cast<double>();
  return std::make_shared<const TriangleMesh>(std::move(vertices), mesh.triangles());
}

/// The height of the belt over the surface at each pose, mm. Random heights thirty poses apart, smoothly
/// joined. Below 0 the belt is pressed in.
std::vector<double> smoothLifts(std::size_t poses, std::mt19937_64& random) {
  constexpr std::size_t kApart = 30;
  const auto height = [&] {
    const double kind = uniform(random, 0.0, 1.0);
    if (kind < 0.52) return uniform(random, -0.2, 0.0);  // pressed in
    if (kind < 0.70) return uniform(random, 0.05, 0.5);  // a near miss
    return uniform(random, 0.5, 3.0);                    // clear
  };
  std::vector<double> heights(poses / kApart + 2);
  for (double& h : heights) h = height();
  std::vector<double> lifts;
  for (std::size_t k = 0; k < poses; ++k) {
    const double t = static_cast<double>(k % kApart) / kApart;
    lifts.push_back(std::lerp(heights[k / kApart], heights[k / kApart + 1], t * t * (3.0 - 2.0 * t)));
  }
  return lifts;
}

std::vector<Pose> makePath(const TriangleMesh& blisk, const demos::BladesFound& blades) {
  demos::GrindingPathOptions options;
  options.passes = 10;
  options.poses_per_pass = 95;
  options.span_to = 0.35;
  options.depth = 0.0;
  options.retract = 40.0;
  options.retract_poses = 40;
  std::vector<Pose> path;
  for (const bool forward : {true, false}) {
    options.forward_side = forward;
    const std::vector<Pose> side = demos::makeGrindingPath(blisk, blades, options);
    path.insert(path.end(), side.begin(), side.end());
  }
  std::mt19937_64 random(1);
  const std::vector<double> lifts = smoothLifts(path.size(), random);
  const double lean = options.lean_degrees * std::numbers::pi / 180.0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Mat3& axes = path[k].rotation;
    const Vec3 off_the_surface = std::sin(lean) * axes.col(0) + std::cos(lean) * axes.col(1);
    path[k].translation += lifts[k] * off_the_surface;
  }
  return path;
}

std::vector<Pose> stretchesOf(const std::vector<Pose>& path, std::size_t poses) {
  constexpr std::size_t kStretch = 20;
  if (poses == 0 || poses >= path.size()) return path;
  const std::size_t count = std::max<std::size_t>(1, poses / kStretch);
  std::vector<Pose> kept;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * (path.size() - kStretch) / count;
    for (const Pose& pose : std::span(path).subspan(begin, kStretch)) kept.push_back(pose);
  }
  return kept;
}

std::vector<Pose> shuffledOverBlades(const std::vector<Pose>& path) {
  std::mt19937_64 random(2);
  std::vector<Pose> poses;
  for (const Pose& pose : path) {
    const double angle = 2.0 * std::numbers::pi / kBlades * static_cast<double>(random() % kBlades);
    poses.push_back(Pose{Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero()} * pose);
  }
  for (std::size_t k = poses.size() - 1; k > 0; --k) std::swap(poses[k], poses[random() % (k + 1)]);
  return poses;
}

std::vector<Segment> randomSegments(const TriangleMesh& blisk, std::size_t count) {
  const Vec3 reach = 1.1 * blisk.bounds().max;
  std::mt19937_64 random(3);
  const auto point = [&] {
    Vec3 p = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) p[axis] = uniform(random, -reach[axis], reach[axis]);
    return Vec3(p.cast<float>().cast<double>());
  };
  std::vector<Segment> segments(count);
  for (Segment& segment : segments) segment = {point(), point()};
  return segments;
}

/// The surface of the convex hull of points. No four of them may lie in one plane.
std::shared_ptr<const TriangleMesh> hullMesh(std::vector<Vec3> points) {
  const auto count = static_cast<std::uint32_t>(points.size());
  std::vector<TriangleMesh::Indices> faces;
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = a + 1; b < count; ++b) {
      for (std::uint32_t c = b + 1; c < count; ++c) {
        const Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]);
        const auto above = std::ranges::count_if(
            points, [&](const Vec3& point) { return normal.dot(point - points[a]) > 1e-12; });
        if (above == 0) faces.push_back({a, b, c});
        if (above == count - 3) faces.push_back({a, c, b});
      }
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(points), std::move(faces));
}

/// Random poses with origins outside the torus, near its surface.
std::vector<Pose> posesRoundTorus(double major_radius, double minor_radius, std::size_t count) {
  std::mt19937_64 random(4);
  std::vector<Pose> poses(count);
  for (Pose& pose : poses) {
    const double u = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const double v = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const double away = minor_radius + uniform(random, 0.05, 0.19);
    const double radius = major_radius + away * std::cos(v);
    const Vec3 origin(radius * std::cos(u), radius * std::sin(u), away * std::sin(v));
    pose = {testing::randomRotation(random), origin.cast<float>().cast<double>()};
  }
  return poses;
}

/// The sizes that a scene's name gives.
struct Sizes {
  std::size_t blisk = 300'000;
  std::size_t belt = 0;  // 0: the default belt
  std::size_t bodies = 200;
  std::size_t torus = 0;  // triangles of a torus; 0: a blisk
};

Sizes sizesOf(const std::string& name) {
  static const std::regex blisk("([0-9]{1,5})k"), belt("belt-([0-9]{1,4})k"), bodies("([0-9]{1,5})-bodies"),
      torus("([0-9]{1,6})-triangles");
  const auto number = [](const std::smatch& match) { return std::stoul(match[1]); };
  std::smatch match;
  if (std::regex_match(name, match, blisk)) return {.blisk = 1000 * number(match)};
  if (std::regex_match(name, match, belt)) return {.belt = 1000 * number(match)};
  if (std::regex_match(name, match, bodies)) return {.blisk = 50'000, .bodies = number(match)};
  if (std::regex_match(name, match, torus)) return {.torus = number(match)};
  throw std::invalid_argument("unknown scene '" + name + "'");
}

/// Stations and points in the proportion of the default belt, with enough stations to go around the wheels. A
/// belt has twice as many triangles as points.
demos::BeltParameters beltOf(std::size_t triangles) {
  constexpr int kFewestStations = 250;
  demos::BeltParameters parameters;
  if (triangles == 0) return parameters;
  const double points = 0.5 * static_cast<double>(triangles);
  const double scale = std::sqrt(points / (parameters.stations * parameters.points_per_station));
  parameters.stations = std::max(kFewestStations, static_cast<int>(std::lround(parameters.stations * scale)));
  parameters.points_per_station = static_cast<int>(std::lround(points / parameters.stations));
  return parameters;
}

Scene torusScene(const std::string& name, std::size_t triangles, const SceneSize& size) {
  constexpr double kMajorRadius = 1.0, kMinorRadius = 0.35;
  constexpr std::size_t kPoses = 2000;
  // Segments around the tube: about as long as those along it, in a number that gives the exact triangle
  // count.
  auto round = static_cast<std::size_t>(std::ceil(std::sqrt(0.2 * static_cast<double>(triangles))));
  while (round > 3 && triangles % (2 * round) != 0) --round;
  if (round < 3 || triangles % (2 * round) != 0) {
    throw std::invalid_argument("no torus has " + std::to_string(triangles) + " triangles");
  }
  Scene scene;
  scene.name = name;
  scene.blisk = roundedToFloat(*testing::torus(
      kMajorRadius, kMinorRadius, static_cast<int>(triangles / (2 * round)), static_cast<int>(round)));
  scene.path = posesRoundTorus(kMajorRadius, kMinorRadius, size.poses > 0 ? size.poses : kPoses);
  return scene;
}

Scene nutScene(const std::string& name, const SceneSize& size) {
  constexpr int kSteps = 144;
  constexpr double kMillimetres = 1e3, kPressedIn = 2e-3;  // in a metre; mm
  const gallery::NutRun run(kNutThread, kNutPitches);
  Scene scene;
  scene.name = name;
  scene.blisk = roundedToFloat(*shapes::scaled(*run.boltMesh(), kMillimetres));
  scene.belt = roundedToFloat(*shapes::scaled(*run.nutMesh(), kMillimetres));
  for (int step = 1; step <= kSteps; ++step) {
    Pose nut_in_bolt = run.poseAt(step * gallery::NutRun::kTimeStep);
    nut_in_bolt.translation *= kMillimetres;
    nut_in_bolt.translation.z() -= 0.5 * kMillimetres * axialPlay(kNutThread) + kPressedIn;
    scene.path.push_back(nut_in_bolt);
  }
  scene.path = stretchesOf(scene.path, size.poses);
  return scene;
}

Scene makeScene(const std::string& name, const SceneSize& size) {
  if (name == "nut-on-bolt") return nutScene(name, size);
  constexpr std::size_t kSegments = 100'000, kQuickSegments = 10'000;
  const Sizes sizes = sizesOf(name);
  if (sizes.torus > 0) return torusScene(name, sizes.torus, size);
  const demos::BeltParameters belt = beltOf(sizes.belt);
  Scene scene;
  scene.name = name;
  scene.blisk = roundedToFloat(demos::makeDefaultBlisk(sizes.blisk).mesh);
  scene.belt = roundedToFloat(demos::makeBelt(belt));
  scene.stations = belt.stations;
  scene.points_per_station = belt.points_per_station;
  static const std::vector<Pose> whole_path = [] {
    const TriangleMesh blisk = demos::makeDefaultBlisk(kPathTriangles).mesh;
    return makePath(blisk, demos::findBlades(blisk));
  }();
  scene.path = stretchesOf(whole_path, size.poses);
  scene.shuffled = shuffledOverBlades(scene.path);
  scene.segments = randomSegments(*scene.blisk, size.quick ? kQuickSegments : kSegments);
  scene.bodies = sizes.bodies;
  return scene;
}

}  // namespace

RoundedCore roundedCore(Primitive primitive) {
  constexpr int kSides = 64;  // of the cylinder's prism, which is at most 0.00011 inside the cylinder
  constexpr int kCorners = 20;
  constexpr double kBoxMargin = 0.01, kHullMargin = 0.04;  // Bullet's for these sizes
  using Triangles = std::vector<TriangleMesh::Indices>;
  const auto meshOf = [](std::vector<Vec3> vertices, Triangles triangles) {
    return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
  };
  switch (primitive) {
    case Primitive::sphere:
      return {meshOf({Vec3::Zero()}, {{0, 0, 0}}), 0.12};
    case Primitive::box:
      return {testing::boxMesh(Vec3::Constant(0.1 - kBoxMargin)), kBoxMargin};
    case Primitive::capsule:
      return {meshOf({{0, 0, -0.075}, {0, 0, 0.075}}, {{0, 1, 1}}), 0.08};
    case Primitive::cylinder:
      return {shapes::cylinder(0.1 - kBoxMargin, 0.1 - kBoxMargin, kSides), kBoxMargin};
    case Primitive::hull: {
      std::mt19937_64 random(5);
      std::vector<Vec3> corners(kCorners);
      for (Vec3& corner : corners)
        corner = (0.08 * testing::randomRotation(random).col(0)).cast<float>().cast<double>();
      return {hullMesh(std::move(corners)), kHullMargin};
    }
  }
  throw std::invalid_argument("unknown primitive");
}

const Scene& sceneNamed(const std::string& name, const SceneSize& size) {
  static std::map<std::pair<std::string, SceneSize>, Scene> scenes;
  const auto key = std::pair(name, size);
  const auto known = scenes.find(key);
  return known != scenes.end() ? known->second : scenes.emplace(key, makeScene(name, size)).first->second;
}

std::shared_ptr<const TriangleMesh> bent(const TriangleMesh& blisk) {
  constexpr double kHeight = 0.5, kWave = 0.05;  // mm, 1/mm
  std::vector<Vec3> vertices = blisk.vertices();
  for (Vec3& v : vertices) {
    v.z() += kHeight * std::sin(kWave * v.x()) * std::cos(kWave * v.y());
    v = v.cast<float>().cast<double>();
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), blisk.triangles());
}

}  // namespace octoblisk::bench
