#include "grinding/depth_proof.h"

#include <algorithm>
#include <array>
#include <utility>

#include "models/triangle_tree.h"
#include "octoblisk/collide.h"
#include "octoblisk/containment.h"
#include "octoblisk/distance.h"
#include "query/solid_parts.h"

namespace octoblisk::demos {
namespace {

constexpr std::array kShells = {16.0, 60.0};  // mm: a contact wheel, the belt about it; the rest
constexpr double kKeptOff = 1e-5;             // mm: at least
constexpr int kMaxDistances = 200;            // of a shell

/// Whether a shell of the part, lifted, keeps farther off the blisk than a distance from one fraction to
/// another. Each distance that is measured proves the fractions on both sides of its own.
bool keepsOff(const ClusteredOctree& blisk, const ClusteredOctree& shell, const Motion& motion, double begin,
              double end, const Vec3& lift, double kept_off) {
  const double length = motion.lengthBound(shell);
  // The path length that the next distance must prove, on either side.
  double reach = 0.5 * (end - begin) * length;
  TrianglePair hint;
  for (int asked = 0; asked < kMaxDistances; ++asked) {
    const double left = std::max(0.0, 0.5 * (end - begin) * length);
    reach = std::min(reach, left);
    const double middle = length > 0.0 ? begin + reach / length : begin;
    Pose pose = motion.at(middle);
    pose.translation += lift;
    const Clearance found = distance(blisk, shell, pose, {.upper_bound = reach + kept_off, .hint = hint});
    if (found.found()) {
      hint = found.triangles();
      constexpr double kNearer = 0.7;  // of the step that would suffice if the distance were the same there
      reach = kNearer * (found.distance - kept_off);
      if (reach <= kKeptOff) return false;
      continue;
    }
    if (reach >= left) return true;
    begin = middle + reach / length;
    constexpr double kLonger = 1.3;
    reach *= kLonger;
  }
  return false;
}

}  // namespace

DepthProof::DepthProof(const octoblisk::Surface& blisk, const octoblisk::Surface& part)
    : blisk_(blisk), part_(part) {
  const TriangleMesh& mesh = part.tree().mesh();
  std::array<std::vector<TriangleMesh::Indices>, kShells.size() + 1> triangles;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    double radius = 0.0;
    for (const Vec3& corner : mesh.triangle(t)) radius = std::max(radius, corner.norm());
    const auto shell = std::ranges::lower_bound(kShells, radius) - kShells.begin();
    triangles[static_cast<std::size_t>(shell)].push_back(mesh.triangles()[t]);
  }
  for (auto& of_shell : triangles) {
    if (!of_shell.empty()) shells_.push_back(treeOfTriangles(mesh, std::move(of_shell)));
  }
}

bool DepthProof::holds(const Motion& motion, double begin, double end, const Vec3& up, double limit) const {
  const Vec3 lift = limit * up;
  const ClusteredOctree* const caps = blisk_.solidParts().winding.capTree();
  for (const Shell& shell : shells_) {
    if (!keepsOff(blisk_.tree(), *shell, motion, begin, end, lift, kKeptOff)) return false;
    if (caps && !keepsOff(*caps, *shell, motion, begin, end, Vec3::Zero(), limit + kKeptOff)) return false;
  }
  Pose lifted = motion.at(begin);  // the surfaces do not meet, so what holds here holds on the whole motion
  lifted.translation += lift;
  return !areNestedIfCapped(blisk_, part_, lifted);
}

namespace {

template <typename IsInA>
bool areNestedBy(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a,
                 const IsInA& is_in_a) {
  for (std::size_t k = 0; k < b.componentCount(); ++k) {
    if (is_in_a(b_in_a * b.position(b.cornerOfComponent(k)))) return true;
  }
  for (std::size_t k = 0; b.isClosed() && k < a.componentCount(); ++k) {
    if (locate(b, a.position(a.cornerOfComponent(k)), b_in_a) == PointLocation::inside) return true;
  }
  return false;
}

}  // namespace

bool areNested(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a) {
  return areNestedBy(a, b, b_in_a,
                     [&](const Vec3& point) { return locate(a, point) == PointLocation::inside; });
}

bool areNestedIfCapped(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a) {
  // A point on the mesh counts as inside, so that nothing is proved there.
  return areNestedBy(a, b, b_in_a, [&](const Vec3& point) {
    return a.solidParts().winding.closedAt(point).value_or(1) != 0;
  });
}

bool partsWhenLifted(const octoblisk::Surface& solid, const octoblisk::Surface& part,
                     const Pose& part_in_solid, const Vec3& up, double depth) {
  const ClusteredOctree* const caps = solid.solidParts().winding.capTree();
  if (caps && distance(*caps, part.tree(), part_in_solid, {.upper_bound = depth}).found()) return false;
  constexpr double kSlope = 0.3;
  const Vec3 across = up.unitOrthogonal(), along = up.cross(across);
  for (const Vec3& direction : {up, Vec3(up + kSlope * across), Vec3(up - kSlope * across),
                                Vec3(up + kSlope * along), Vec3(up - kSlope * along)}) {
    const Pose lifted{part_in_solid.rotation, part_in_solid.translation + depth * direction.normalized()};
    if (!collide(solid.tree(), part.tree(), lifted) && !areNestedIfCapped(solid, part, lifted)) return true;
  }
  return false;
}

}  // namespace octoblisk::demos
