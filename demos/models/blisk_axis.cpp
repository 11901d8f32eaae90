#include "models/blisk_axis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/principal_axes.h"
#include "models/require.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {
namespace {

constexpr double kGreatestError = 0.005;  // of the tip radius
// Two would not do: any ring consists of two equal halves about its diameter.
constexpr int kMinBlades = 3;

struct SurfaceMoments {
  double area = 0.0;
  Vec3 first = Vec3::Zero();   ///< ∫ x dA
  Mat3 second = Mat3::Zero();  ///< ∫ x xᵀ dA

  void add(const Triangle& t) {
    const double part = 0.5 * scaledNormal(t).norm();
    const Vec3 sum = t[0] + t[1] + t[2];
    Mat3 squares = sum * sum.transpose();
    for (const Vec3& corner : t) squares += corner * corner.transpose();
    area += part;
    first += part / 3.0 * sum;
    second += part / 12.0 * squares;
  }
};

/// The principal axes of the surface; the axis with the most nearly equal moments about the other two comes
/// first.
std::vector<BliskAxis> principalAxes(const TriangleMesh& mesh) {
  const Vec3 middle = mesh.bounds().center();
  SurfaceMoments moments;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle corners = mesh.triangle(t);
    moments.add({corners[0] - middle, corners[1] - middle, corners[2] - middle});
  }
  if (!(moments.area > 0.0)) return {};
  const Vec3 centroid = moments.first / moments.area;
  const Mat3 spread = moments.second / moments.area - centroid * centroid.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  const Vec3 values = solver.eigenvalues();
  std::array<int, 3> order = {0, 1, 2};
  const auto difference = [&](int k) { return std::abs(values[(k + 1) % 3] - values[(k + 2) % 3]); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return difference(a) < difference(b); });
  std::vector<BliskAxis> axes;
  for (const int k : order) axes.push_back({solver.eigenvectors().col(k), middle + centroid});
  return axes;
}

/// The direction or its opposite, whichever has a positive greatest coordinate.
Vec3 upright(const Vec3& direction) {
  Eigen::Index greatest = 0;
  direction.cwiseAbs().maxCoeff(&greatest);
  return direction[greatest] < 0.0 ? Vec3(-direction) : direction;
}

/// The axis of the polygon formed by the blades' centroids; none if they form no polygon.
std::optional<BliskAxis> axisOfBlades(const TriangleMesh& mesh, const BladesFound& blades) {
  if (blades.count < 3) return std::nullopt;
  std::vector<SurfaceMoments> of_blade(blades.count);
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (const int blade = blades.blade_of_triangle[t]; blade != 0) of_blade[blade - 1].add(mesh.triangle(t));
  }
  Vec3 center = Vec3::Zero();
  for (const SurfaceMoments& blade : of_blade) center += blade.first / blade.area / blades.count;
  Mat3 spread = Mat3::Zero();
  for (const SurfaceMoments& blade : of_blade) {
    const Vec3 arm = blade.first / blade.area - center;
    spread += arm * arm.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  return BliskAxis{upright(solver.eigenvectors().col(0)), center};
}

/// See BliskFound; uses at most about 2,000 vertices.
double repeatErrorOf(const ClusteredOctree& blisk, const BladesFound& blades) {
  constexpr std::size_t kSamples = 2'000;
  const TriangleMesh& mesh = blisk.mesh();
  std::vector<std::uint32_t> of_blades;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (blades.blade_of_triangle[t] == 0) continue;
    of_blades.insert(of_blades.end(), mesh.triangles()[t].begin(), mesh.triangles()[t].end());
  }
  const std::size_t step = std::max<std::size_t>(1, of_blades.size() / kSamples);
  const Eigen::AngleAxisd pitch(2.0 * std::numbers::pi / blades.count, Vec3::UnitZ());
  double greatest = 0.0;
  for (std::size_t k = 0; k < of_blades.size(); k += step) {
    const Vec3 turned_on = pitch * mesh.vertices()[of_blades[k]];
    greatest = std::max(greatest, closestPoint(blisk, turned_on).value().distance);
  }
  return greatest;
}

/// The blades about an axis; none if there are none, or if they do not repeat.
std::optional<BliskFound> repeatingAbout(const TriangleMesh& mesh, const BliskAxis& axis) {
  BliskFound found{axis, meshInBlisk(axis), {}, 0.0};
  const auto in_blisk = std::make_shared<const TriangleMesh>(moved(mesh, found.mesh_in_blisk));
  found.blades = findBlades(*in_blisk);
  if (found.blades.count == 0) return std::nullopt;
  found.repeat_error = repeatErrorOf(ClusteredOctree::build(in_blisk), found.blades);
  return found;
}

bool isProved(const std::optional<BliskFound>& found) {
  return found && found->repeat_error <= kGreatestError * found->blades.tip_radius;
}

}  // namespace

Pose meshInBlisk(const BliskAxis& axis) {
  require(axis.direction.allFinite() && axis.point.allFinite(), "the axis must consist of finite numbers");
  const double length = axis.direction.stableNorm();
  require(length > 0.0, "the axis' direction must not be zero");
  const Vec3 z = axis.direction / length;
  constexpr double kNear = 0.9;
  const Vec3 reference = std::abs(z.x()) > kNear ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 x = (reference - reference.dot(z) * z).normalized();
  Mat3 blisk_in_mesh;
  blisk_in_mesh << x, z.cross(x), z;
  const Vec3 origin = axis.point - axis.point.dot(z) * z;
  return Pose{blisk_in_mesh, origin}.inverse();
}

TriangleMesh moved(const TriangleMesh& mesh, const Pose& pose) {
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& vertex : vertices) vertex = pose * vertex;
  return {std::move(vertices), mesh.triangles()};
}

BliskFound findBlisk(const TriangleMesh& mesh) {
  const std::optional<BliskFound> about_z = repeatingAbout(mesh, {});
  if (isProved(about_z)) return *about_z;
  std::optional<BliskFound> best = about_z;
  for (BliskAxis axis : principalAxes(mesh)) {
    axis.direction = upright(axis.direction);
    std::optional<BliskFound> found = repeatingAbout(mesh, axis);
    const bool is_enough = found && found->blades.count >= kMinBlades;
    if (!is_enough) continue;
    if (const auto finer = axisOfBlades(mesh, found->blades)) {
      std::optional<BliskFound> again = repeatingAbout(mesh, *finer);
      if (again && again->repeat_error < found->repeat_error) found = std::move(again);
    }
    if (isProved(found)) return *found;
    if (!best || found->repeat_error < best->repeat_error) best = std::move(found);
  }
  if (!best) {
    throw std::invalid_argument(
        "no blades were found about the Z axis or about a principal axis of the surface");
  }
  std::ostringstream message;
  message << best->blades.count
          << " parts are arranged like blades about a principal axis, but after rotation by one pitch "
          << "they are up to " << best->repeat_error
          << " mm off: this is not a blisk, or its axis was not found";
  throw std::invalid_argument(message.str());
}

BliskFound findBlisk(const TriangleMesh& mesh, const BliskAxis& axis) {
  std::optional<BliskFound> found = repeatingAbout(mesh, axis);
  if (!found) throw std::invalid_argument("no blades were found about the given axis: check --axis");
  found->axis.direction.normalize();
  return *found;
}

}  // namespace octoblisk::demos
