#include "shapes/threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

#include "shapes/rims.h"

namespace octoblisk::shapes {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Places of the profile in pitches from the middle of the crest: the ends of the crest and of the root.
constexpr std::array<double, 4> kCorners = {-1.0 / 16.0, 1.0 / 16.0, 6.0 / 16.0, 10.0 / 16.0};

/// The bolt's radius at a place of the profile in pitches.
double radiusAt(const Thread& thread, double place) {
  const double depth = 0.625 * 0.5 * std::numbers::sqrt3 * thread.pitch;
  const double from_crest = std::abs(place - std::round(place));
  const double down = std::clamp((from_crest - kCorners[1]) / (kCorners[2] - kCorners[1]), 0.0, 1.0);
  return 0.5 * thread.diameter - depth * down;
}

Vec3 onCylinder(const Thread& thread, int segment, double radius, double z) {
  const double angle = kTurn * (segment % thread.segments) / thread.segments;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Adds the thread's surface between z = 0 and `height`, and returns its lower and upper rim.
std::pair<Rim, Rim> addThread(Welded& mesh, const Thread& thread, double wider, double height,
                              bool faces_in) {
  // Row k of each column is where the column crosses the k-th line of the profile, which winds around the
  // axis. The last column is the first one, by one pitch of rows higher.
  const int per_pitch = 4 * thread.parts;
  const int rows = per_pitch * (static_cast<int>(std::ceil(height / thread.pitch)) + 3);
  const auto placeOf = [&](int row) {
    const int part = row % thread.parts, corner = row / thread.parts;
    const auto at = [](int k) { return std::floor(k / 4.0) + kCorners[static_cast<std::size_t>(k % 4)]; };
    return at(corner) + (at(corner + 1) - at(corner)) * part / thread.parts - 2.0;
  };
  const auto vertex = [&](int segment, int row) {
    if (segment == thread.segments) segment = 0, row += per_pitch;
    const double turn = static_cast<double>(segment) / thread.segments;
    const double z = std::clamp(thread.pitch * (placeOf(row) + turn), 0.0, height);
    return mesh.vertex(onCylinder(thread, segment, wider + radiusAt(thread, z / thread.pitch - turn), z));
  };
  Rim low, high;
  for (int segment = 0; segment < thread.segments; ++segment) {
    for (int row = 0; row < rows; ++row) {
      const std::uint32_t a = vertex(segment, row), b = vertex(segment + 1, row),
                          c = vertex(segment + 1, row + 1), d = vertex(segment, row + 1);
      faces_in ? mesh.quad(a, d, c, b) : mesh.quad(a, b, c, d);  // the diagonals of both are the same
    }
    low.push_back(vertex(segment, 0));
    high.push_back(vertex(segment, rows));
  }
  return {low, high};
}

}  // namespace

Thread coarseThread(int size, int segments) {
  static const std::map<int, double> kPitches = {{4, 0.7e-3},  {5, 0.8e-3},   {6, 1e-3},  {8, 1.25e-3},
                                                 {10, 1.5e-3}, {12, 1.75e-3}, {16, 2e-3}, {20, 2.5e-3}};
  const auto pitch = kPitches.find(size);
  if (pitch == kPitches.end()) throw std::invalid_argument("M" + std::to_string(size) + " is not listed");
  return {
      .diameter = 1e-3 * size, .pitch = pitch->second, .play = pitch->second / 50.0, .segments = segments};
}

double axialPlay(const Thread& thread) { return 2.0 * thread.play / std::numbers::sqrt3; }

SharedMesh bolt(const Thread& thread, double length) {
  Welded mesh;
  const double head_height = 0.6 * thread.diameter, head_radius = 0.8 * thread.diameter;
  const auto [low, high] = addThread(mesh, thread, 0.0, length, false);
  Rim head_top, head_bottom;
  for (int segment = 0; segment < thread.segments; ++segment) {
    head_top.push_back(mesh.vertex(onCylinder(thread, segment, head_radius, 0.0)));
    head_bottom.push_back(mesh.vertex(onCylinder(thread, segment, head_radius, -head_height)));
  }
  addDisk(mesh, high, length);
  addRing(mesh, low, head_top);
  addWall(mesh, head_bottom, head_top);
  addDisk(mesh, reversed(head_bottom), -head_height);
  return mesh.mesh();
}

SharedMesh nut(const Thread& thread, double height) {
  Welded mesh;
  const auto [low, high] = addThread(mesh, thread, thread.play, height, true);
  Rim outer_low, outer_high;
  for (int segment = 0; segment < thread.segments; ++segment) {
    const double sixth = kTurn / 6.0, angle = kTurn * segment / thread.segments;
    const double from_flat = angle - sixth * std::round(angle / sixth);
    const double radius = 0.75 * thread.diameter / std::cos(from_flat);
    outer_low.push_back(mesh.vertex(onCylinder(thread, segment, radius, 0.0)));
    outer_high.push_back(mesh.vertex(onCylinder(thread, segment, radius, height)));
  }
  addRing(mesh, high, outer_high);
  addRing(mesh, reversed(low), reversed(outer_low));
  addWall(mesh, outer_low, outer_high);
  return mesh.mesh();
}

}  // namespace octoblisk::shapes
