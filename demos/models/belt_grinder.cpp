#include "models/belt_grinder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "models/belt_path.h"
#include "models/length_limit.h"
#include "models/orientation.h"
#include "models/require.h"
#include "shapes/box.h"
#include "shapes/grid_mesh.h"

namespace octoblisk::demos {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kWheelSegments = 120;
constexpr int kWheelRows = 8;
constexpr int kMaxPoints = 100'000;               // along the belt, or around its cross-section
constexpr std::int64_t kMaxVertices = 5'000'000;  // 10 million triangles

void requireUsable(const BeltParameters& p) {
  const std::pair<double, const char*> sizes[] = {{p.width, "belt width"},
                                                  {p.thickness, "belt thickness"},
                                                  {p.contact_wheel_radius, "contact wheel radius"},
                                                  {p.drive_wheel_radius, "drive wheel radius"},
                                                  {p.wheel_distance, "wheel distance"},
                                                  {p.wheel_gap, "wheel gap"},
                                                  {p.arm_start, "arm start"},
                                                  {p.arm_width, "arm width"},
                                                  {p.arm_height, "arm height"}};
  for (const auto& [size, name] : sizes) {
    require(size > 0.0 && size <= kMaxLength,
            std::string("the ") + name + " must be above 0 and at most 100,000 mm");
  }
  require(p.wheel_distance > p.contact_wheel_radius + p.drive_wheel_radius + 2.0 * p.thickness,
          "the wheel distance must keep the two wheels apart");
  require(p.wheel_gap < 0.5 * std::min(p.contact_wheel_radius, p.drive_wheel_radius),
          "the wheel gap must be below half the wheels' radii");
  require(p.points_per_station >= 4 && p.points_per_station <= kMaxPoints,
          "the number of points per station must be from 4 to " + std::to_string(kMaxPoints));
  require(p.stations >= 16 && p.stations <= kMaxPoints,
          "the number of stations must be from 16 to " + std::to_string(kMaxPoints));
  require(std::int64_t{p.stations} * p.points_per_station <= kMaxVertices,
          "stations times points per station must be at most " + std::to_string(kMaxVertices));
  const double half_turn = 0.5 * BeltPath(p).greatestTurn();
  const double cut = std::max(p.contact_wheel_radius, p.drive_wheel_radius) * (1.0 - std::cos(half_turn));
  require(cut < 0.5 * p.wheel_gap, "the belt needs more stations, or else its facets cut the wheels");
}

/// A closed cylinder with an axis along z.
TriangleMesh cylinder(const Vec3& centre, double radius, double width) {
  std::vector<Vec3> vertices;
  for (int row = 0; row <= kWheelRows; ++row) {
    const double z = width * (static_cast<double>(row) / kWheelRows - 0.5);
    for (int segment = 0; segment < kWheelSegments; ++segment) {
      const double angle = 2.0 * kPi * segment / kWheelSegments;
      vertices.push_back(centre + Vec3(radius * std::cos(angle), radius * std::sin(angle), z));
    }
  }
  const auto lower_centre = static_cast<std::uint32_t>(vertices.size());
  vertices.push_back(centre + Vec3(0.0, 0.0, -0.5 * width));
  vertices.push_back(centre + Vec3(0.0, 0.0, 0.5 * width));

  const auto at = [](int row, int segment) {
    return static_cast<std::uint32_t>(row * kWheelSegments + segment % kWheelSegments);
  };
  std::vector<TriangleMesh::Indices> triangles;
  for (int segment = 0; segment < kWheelSegments; ++segment) {
    for (int row = 0; row < kWheelRows; ++row) {
      triangles.push_back({at(row, segment), at(row, segment + 1), at(row + 1, segment + 1)});
      triangles.push_back({at(row, segment), at(row + 1, segment + 1), at(row + 1, segment)});
    }
    triangles.push_back({lower_centre, at(0, segment + 1), at(0, segment)});
    triangles.push_back({lower_centre + 1, at(kWheelRows, segment), at(kWheelRows, segment + 1)});
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

/// A closed band between two heights above the belt's inner surface.
TriangleMesh band(const BeltParameters& p, double low, double high) {
  const BeltPath path(p);
  const int outer_points = p.points_per_station / 2;
  const int inner_points = p.points_per_station - outer_points;

  const auto point_at = [&](int station, int k) -> Vec3 {
    const auto [point, normal] = path.at(static_cast<double>(station) / p.stations);
    const bool is_outer = k < outer_points;
    const double z = is_outer ? p.width * (static_cast<double>(k) / (outer_points - 1) - 0.5)
                              : p.width * (0.5 - static_cast<double>(k - outer_points) / (inner_points - 1));
    return point + (is_outer ? high : low) * normal + Vec3(0.0, 0.0, z);
  };
  return turned(*shapes::gridMesh(p.stations, p.points_per_station, true, true, point_at));
}

void requireTwoLayers(const BeltParameters& p) {
  require(p.abrasive > 0.0 && p.abrasive < p.thickness,
          "the abrasive must be thicker than 0 and thinner than the belt");
}

}  // namespace

TriangleMesh makeBelt(const BeltParameters& p) {
  requireUsable(p);
  return band(p, 0.0, p.thickness);
}

TriangleMesh makeBeltContactSide(const BeltParameters& p) {
  requireUsable(p);
  requireTwoLayers(p);
  return band(p, p.thickness - p.abrasive, p.thickness);
}

TriangleMesh makeBeltBack(const BeltParameters& p) {
  requireUsable(p);
  requireTwoLayers(p);
  return band(p, 0.0, p.thickness - p.abrasive);
}

TriangleMesh makeContactWheel(const BeltParameters& p) {
  requireUsable(p);
  return cylinder(Vec3::Zero(), p.contact_wheel_radius - p.wheel_gap, p.width);
}

TriangleMesh makeDriveWheel(const BeltParameters& p) {
  requireUsable(p);
  return cylinder({p.wheel_distance, 0.0, 0.0}, p.drive_wheel_radius - p.wheel_gap, p.width);
}

TriangleMesh makeArm(const BeltParameters& p) {
  requireUsable(p);
  constexpr double kClearance = 1.0;
  const double arm_end = p.wheel_distance - p.drive_wheel_radius - kClearance;
  require(p.arm_start >= p.contact_wheel_radius, "the arm must start outside the contact wheel");
  require(p.arm_start < arm_end, "the arm must start before the drive wheel");
  const BeltPath path(p);
  const double half_gap = std::min(path.halfGap(p.arm_start), path.halfGap(arm_end));
  require(0.5 * p.arm_height < half_gap, "the arm must be lower than the gap between the belt's strands");
  const Vec3 half_size(0.0, 0.5 * p.arm_height, 0.5 * p.arm_width);
  return shapes::box(Vec3(p.arm_start, 0.0, 0.0) - half_size, Vec3(arm_end, 0.0, 0.0) + half_size);
}

}  // namespace octoblisk::demos
