#include "access/contact_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "models/blade_section.h"
#include "models/require.h"
#include "models/shared_tree.h"
#include "models/welded_surface.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/distance.h"

namespace octoblisk::demos {
namespace {

constexpr double kRadian = std::numbers::pi / 180.0;

/// The triangles of a blade, or of one of its sides, with normals that change smoothly over them.
class SmoothSide {
 public:
  enum class Side { both, forward, backward };

  SmoothSide(const TriangleMesh& blisk, const BladesFound& blades, int blade, Side side)
      : tree_(treeOf(trianglesOf(blisk, blades, blade, side))) {
    const TriangleMesh& mesh = tree_->mesh();
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const Triangle corners = mesh.triangle(t);
      for (const Vec3& corner : corners) {
        normals_.try_emplace(keyOf(corner), Vec3::Zero()).first->second += scaledNormal(corners);
      }
    }
  }

  const ClusteredOctree& tree() const { return *tree_; }

  /// At a point of a triangle: the weighted mean of the corners' normals.
  Vec3 normalAt(const ClosestPoint& at) const {
    const Triangle corners = tree_->mesh().triangle(at.triangle);
    const Vec3 face = scaledNormal(corners);
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle opposite = {at.point, corners[(k + 1) % 3], corners[(k + 2) % 3]};
      const double weight = std::max(0.0, scaledNormal(opposite).dot(face));
      normal += weight * normals_.at(keyOf(corners[k])).normalized();
    }
    return (normal.isZero() ? face : normal).normalized();
  }

 private:
  using Key = std::array<double, 3>;  // the position, because the mesh may repeat its vertices
  static Key keyOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

  static TriangleMesh trianglesOf(const TriangleMesh& blisk, const BladesFound& blades, int blade,
                                  Side side) {
    std::vector<TriangleMesh::Indices> triangles;
    for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
      if (blades.blade_of_triangle[t] != blade) continue;
      const Triangle corners = blisk.triangle(t);
      const Vec3 centre = centroidOf(corners);
      const double forward = scaledNormal(corners).dot(Vec3(-centre.y(), centre.x(), 0.0));
      if (side == Side::forward && forward <= 0.0) continue;
      if (side == Side::backward && forward >= 0.0) continue;
      triangles.push_back(blisk.triangles()[t]);
    }
    return TriangleMesh(blisk.vertices(), std::move(triangles));
  }

  std::shared_ptr<const ClusteredOctree> tree_;
  std::map<Key, Vec3> normals_;
};

void requireBlade(const TriangleMesh& blisk, const BladesFound& blades, int blade) {
  require(blades.blade_of_triangle.size() == blisk.triangleCount(), "the blades are not those of this mesh");
  require(blade >= 1 && blade <= blades.count, "there is no blade " + std::to_string(blade) +
                                                   ": the blades are numbered 1 to " +
                                                   std::to_string(blades.count));
}

void requireUsable(const SiteGridOptions& options) {
  require(options.rows > 0 && options.columns > 0, "the numbers of rows and columns must be above 0");
  for (const double span : {options.span_from, options.span_to}) {
    require(span >= 0.0 && span <= 1.0, "the fractions of the span must be from 0 to 1");
  }
  require(options.clear_of_edges >= 0.0 && options.clear_of_edges < 0.5,
          "the fraction left out at the edges must be at least 0 and below 0.5");
  require(std::isfinite(options.wheel_radius) && options.wheel_radius > 0.0,
          "the wheel radius must be above 0 mm");
  require(std::abs(options.depth) < options.wheel_radius, "the depth must be below the wheel radius");
}

double lengthOf(const std::vector<SectionPoint>& side) {
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < side.size(); ++k)
    length += (side[k + 1].position - side[k].position).norm();
  return length;
}

Vec3 pointAlong(const std::vector<SectionPoint>& side, double arc) {
  for (std::size_t k = 0; k + 1 < side.size(); ++k) {
    const Vec3 step = side[k + 1].position - side[k].position;
    const double length = step.norm();
    if (arc <= length && length > 0.0) return side[k].position + arc / length * step;
    arc -= length;
  }
  return side.back().position;
}

/// A point's arc length along a side of a section, and its distance from that side.
struct PlaceOnSide {
  double arc = 0.0, off = std::numeric_limits<double>::infinity();
};

PlaceOnSide placeOn(const std::vector<SectionPoint>& side, const Vec3& point) {
  PlaceOnSide best;
  double before = 0.0;
  for (std::size_t k = 0; k + 1 < side.size(); ++k) {
    const Vec3 step = side[k + 1].position - side[k].position;
    const double length = step.norm();
    if (length == 0.0) continue;
    const double along = std::clamp(step.dot(point - side[k].position) / length, 0.0, length);
    const double off = (side[k].position + along / length * step - point).norm();
    if (off < best.off) best = {before + along, off};
    before += length;
  }
  return best;
}

std::optional<BladeSection> sectionAt(const BladeCutter& cutter, double radius) {
  try {
    return cutter.at(radius);
  } catch (const std::invalid_argument&) {  // no closed curve: the mesh is open there, or this is the root
    return std::nullopt;
  }
}

/// The pose that touches a point with the arm along the surface.
Pose layingPose(const Vec3& point, const Vec3& normal, double distance) {
  const Vec3 outward(point.x(), point.y(), 0.0);
  const Vec3 arm = (outward - outward.dot(normal) * normal).normalized();
  Pose pose;
  pose.rotation << arm, normal, arm.cross(normal);
  pose.translation = point + distance * normal;
  return pose;
}

double partOfGrid(int index, int count) { return count > 1 ? static_cast<double>(index) / (count - 1) : 0.5; }

}  // namespace

Pose tiltedPose(const ContactSite& site, double tilt_degrees, double lead_degrees) {
  const Mat3 lead = Eigen::AngleAxisd(-lead_degrees * kRadian, site.normal).toRotationMatrix();
  const Mat3 tilt = Eigen::AngleAxisd(tilt_degrees * kRadian, Vec3::UnitZ()).toRotationMatrix();
  return {lead * site.base.rotation * tilt, site.point + lead * (site.base.translation - site.point)};
}

std::vector<ContactSite> sitesOnBlade(const TriangleMesh& blisk, const BladesFound& blades,
                                      const SiteGridOptions& options) {
  requireBlade(blisk, blades, options.blade);
  requireUsable(options);
  using Side = SmoothSide::Side;
  const SmoothSide side(blisk, blades, options.blade, options.forward_side ? Side::forward : Side::backward);
  const BladeCutter cutter(blisk, blades, options.blade);
  const double height = blades.tip_radius - blades.root_radius;
  std::vector<ContactSite> sites;
  for (int row = 0; row < options.rows; ++row) {
    const double span = std::lerp(options.span_from, options.span_to, partOfGrid(row, options.rows));
    const auto section = sectionAt(cutter, blades.root_radius + span * height);
    if (!section) continue;
    const std::vector<SectionPoint>& line = options.forward_side ? section->forward : section->backward;
    const double length = lengthOf(line);
    for (int column = 0; column < options.columns; ++column) {
      const double part = std::lerp(options.clear_of_edges, 1.0 - options.clear_of_edges,
                                    partOfGrid(column, options.columns));
      const auto closest = closestPoint(side.tree(), pointAlong(line, part * length));
      ContactSite site;
      site.point = closest->point;
      site.normal = side.normalAt(*closest);
      site.base = layingPose(site.point, site.normal, options.wheel_radius - options.depth);
      site.height = span * height;
      site.arc = part * length;
      site.half_width =
          0.5 * length * (1.0 - 2.0 * options.clear_of_edges) / std::max(1, options.columns - 1);
      site.half_height =
          0.5 * height * std::abs(options.span_to - options.span_from) / std::max(1, options.rows - 1);
      sites.push_back(site);
    }
  }
  require(!sites.empty(), "blade " + std::to_string(options.blade) +
                              " has no closed section on the grid: change the fractions of the span");
  return sites;
}

std::vector<ContactSite> sitesOfPath(const TriangleMesh& blisk, const BladesFound& blades, int blade,
                                     const ClusteredOctree& belt, std::span<const Pose> path, double reach) {
  requireBlade(blisk, blades, blade);
  const SmoothSide whole(blisk, blades, blade, SmoothSide::Side::both);
  const BladeCutter cutter(blisk, blades, blade);
  std::vector<ContactSite> sites;
  for (std::size_t p = 0; p < path.size(); ++p) {
    if (!distance(whole.tree(), belt, path[p], {.upper_bound = reach}).found()) continue;
    const auto closest = closestPoint(whole.tree(), path[p].translation);
    ContactSite site;
    site.pose = p;
    site.point = closest->point;
    const Vec3 off = path[p].translation - site.point;  // the wheel's centre is on the normal of the point
    site.normal = off.isZero() ? whole.normalAt(*closest) : off.normalized();
    site.base = path[p];
    site.height = radiusOf(site.point) - blades.root_radius;
    if (const auto section = sectionAt(cutter, radiusOf(site.point))) {
      const PlaceOnSide forward = placeOn(section->forward, site.point);
      const PlaceOnSide backward = placeOn(section->backward, site.point);
      site.arc = forward.off <= backward.off ? forward.arc : backward.arc;
    }
    sites.push_back(site);
  }
  return sites;
}

}  // namespace octoblisk::demos
