#include "toolpath/grinding_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "models/radians.h"
#include "models/welded_surface.h"

namespace octoblisk::demos {
namespace {

Vec3 tangentialAt(const Vec3& point) { return Vec3(-point.y(), point.x(), 0.0).normalized(); }

/// True if the normals of a blade's triangles point out of the blade. The field θ e_theta has the divergence
/// 1/radius > 0, and none of it flows through the blade's open root, a surface of revolution.
bool facesOutwards(const std::vector<Triangle>& blade) {
  double outflow = 0.0;
  for (const Triangle& t : blade) {
    const Vec3 e_theta = tangentialAt(centroidOf(t));
    const Vec3 e_theta_first = tangentialAt(centroidOf(blade.front()));
    const double angle = std::atan2(e_theta_first.cross(e_theta).z(), e_theta_first.dot(e_theta));
    outflow += angle * scaledNormal(t).dot(e_theta);
  }
  return outflow >= 0.0;
}

struct SurfacePoint {
  Vec3 position;
  Vec3 normal;  ///< unit, outwards
};

/// The triangles of one side of a blade, projected to (z, radius).
class SideOfBlade {
 public:
  SideOfBlade(const TriangleMesh& blisk, const BladesFound& blades, int blade, bool forward) {
    std::vector<Triangle> of_blade;
    for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
      if (blades.blade_of_triangle[t] == blade) of_blade.push_back(blisk.triangle(t));
    }
    const double outwards = facesOutwards(of_blade) ? 1.0 : -1.0;
    const double towards_side = forward ? 1.0 : -1.0;

    std::map<std::array<double, 3>, Vec3> normals;  // by position: the mesh may repeat its vertices
    const auto key = [](const Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
    for (const Triangle& corners : of_blade) {
      const Vec3 normal = outwards * scaledNormal(corners);
      if (towards_side * normal.dot(tangentialAt(centroidOf(corners))) <= 0.0) continue;
      facets_.push_back({corners});
      for (const Vec3& corner : corners) {
        normals.try_emplace(key(corner), Vec3::Zero()).first->second += normal;
      }
    }
    for (Facet& facet : facets_) {
      for (int k = 0; k < 3; ++k) facet.normals[k] = normals[key(facet.corners[k])].normalized();
    }
  }

  /// The point at a radius and a fraction 0..1 of the distance in z from edge to edge at that radius.
  std::optional<SurfacePoint> at(double radius, double chord_part) const {
    double z_least = std::numeric_limits<double>::infinity();
    double z_greatest = -z_least;
    std::vector<const Facet*> crossed;
    for (const Facet& facet : facets_) {
      bool crosses = false;
      for (int k = 0; k < 3; ++k) {
        const Vec3& from = facet.corners[k];
        const Vec3& to = facet.corners[(k + 1) % 3];
        const double from_above = radiusOf(from) - radius;
        const double to_above = radiusOf(to) - radius;
        if ((from_above < 0.0) == (to_above < 0.0)) continue;
        const double z = std::lerp(from.z(), to.z(), from_above / (from_above - to_above));
        z_least = std::min(z_least, z);
        z_greatest = std::max(z_greatest, z);
        crosses = true;
      }
      if (crosses) crossed.push_back(&facet);
    }
    if (crossed.empty()) return std::nullopt;
    return pointOn(crossed, std::lerp(z_least, z_greatest, chord_part), radius);
  }

 private:
  struct Facet {
    Triangle corners;
    std::array<Vec3, 3> normals = {Vec3::Zero(), Vec3::Zero(),
                                   Vec3::Zero()};  ///< of the side, at the corners
  };

  static std::optional<SurfacePoint> pointOn(const std::vector<const Facet*>& facets, double z,
                                             double radius) {
    for (const Facet* facet : facets) {
      const auto& [corners, normals] = *facet;
      const auto area = [](double z1, double r1, double z2, double r2) { return z1 * r2 - z2 * r1; };
      std::array<double, 3> dz, dr, weight;
      for (int k = 0; k < 3; ++k) {
        dz[k] = corners[k].z() - z;
        dr[k] = radiusOf(corners[k]) - radius;
      }
      for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const int last = (k + 2) % 3;
        weight[k] = area(dz[next], dr[next], dz[last], dr[last]);
      }
      const double sum = weight[0] + weight[1] + weight[2];
      const auto [least, greatest] = std::minmax({weight[0], weight[1], weight[2]});
      if (sum == 0.0 || (sum > 0.0 ? least < 0.0 : greatest > 0.0)) continue;
      SurfacePoint point{Vec3::Zero(), Vec3::Zero()};
      for (int k = 0; k < 3; ++k) {
        point.position += weight[k] / sum * corners[k];
        point.normal += weight[k] / sum * normals[k];
      }
      point.normal.normalize();
      return point;
    }
    return std::nullopt;
  }

  std::vector<Facet> facets_;
};

/// The pose in which the belt touches a point.
Pose touching(const SurfacePoint& point, const GrindingPathOptions& options) {
  const Vec3 in_surface = armInSurface(options.arm, point.position, point.normal);
  return beltAt(point.position, point.normal, in_surface, radians(options.lean_degrees),
                options.wheel_radius - options.depth);
}

Pose retracted(const Pose& belt_in_blisk, double length) {
  return {belt_in_blisk.rotation, belt_in_blisk.translation + length * belt_in_blisk.rotation.col(0)};
}

void requireUsable(const TriangleMesh& blisk, const BladesFound& blades, const GrindingPathOptions& options) {
  const auto require = [](bool holds, const std::string& message) {
    if (!holds) throw std::invalid_argument(message);
  };
  require(blades.count > 0, "no blades were found on the mesh: give a path with --path");
  require(options.blade >= 1 && options.blade <= blades.count,
          "there is no blade " + std::to_string(options.blade) + ": the blades are numbered 1 to " +
              std::to_string(blades.count));
  require(blades.blade_of_triangle.size() == blisk.triangleCount(), "the blades are not those of this mesh");
  require(options.passes > 0, "the number of passes must be above 0");
  require(options.poses_per_pass > 0, "the number of poses per pass must be above 0");
  require(options.retract_poses > 0, "the number of retraction poses must be above 0");
  require(std::abs(options.lean_degrees) < 90.0, "the lean must be within 90 degrees");
  require(options.clear_of_edges >= 0.0 && options.clear_of_edges < 0.5,
          "the fraction of the chord left out at the edges must be at least 0 and below 0.5");
  for (const double span : {options.span_from, options.span_to}) {
    require(span >= 0.0 && span <= 1.0, "the fractions of the span must be from 0 to 1");
  }
  for (const double part : {options.chord_from, options.chord_to}) {
    require(part >= 0.0 && part <= 1.0, "the fractions of the chord must be from 0 to 1");
  }
  require(std::isfinite(options.wheel_radius) && options.wheel_radius > 0.0,
          "the wheel radius must be above 0 mm");
  require(std::abs(options.depth) < options.wheel_radius, "the depth must be below the wheel radius");
  require(std::isfinite(options.retract) && options.retract >= 0.0, "the retraction must be at least 0 mm");
}

/// A place on the side: a radius, and a fraction 0..1 of the chord.
struct Place {
  double radius, chord_part;
};

double fraction(int index, int count) { return count > 1 ? static_cast<double>(index) / (count - 1) : 0.0; }

/// Back and forth along the chord, pass by pass.
std::vector<Place> placesOfPass(int pass, const BladesFound& blades, const GrindingPathOptions& options) {
  const double span = std::lerp(options.span_from, options.span_to, fraction(pass, options.passes));
  const double radius = std::lerp(blades.root_radius, blades.tip_radius, span);
  std::vector<Place> places;
  for (int k = 0; k < options.poses_per_pass; ++k) {
    const double along = std::lerp(options.chord_from, options.chord_to, fraction(k, options.poses_per_pass));
    const double part = std::lerp(options.clear_of_edges, 1.0 - options.clear_of_edges, along);
    places.push_back({radius, part});
  }
  if (pass % 2 == 1) std::ranges::reverse(places);
  return places;
}

}  // namespace

std::vector<Pose> makeGrindingPath(const TriangleMesh& blisk, const BladesFound& blades,
                                   const GrindingPathOptions& options) {
  requireUsable(blisk, blades, options);
  const SideOfBlade side(blisk, blades, options.blade, options.forward_side);
  std::vector<Pose> work;
  const auto visit = [&](const Place& place) {
    if (const auto point = side.at(place.radius, place.chord_part)) work.push_back(touching(*point, options));
  };
  for (int pass = 0; pass < options.passes; ++pass) {
    const std::vector<Place> places = placesOfPass(pass, blades, options);
    const std::size_t before = work.size();
    for (const Place& place : places) visit(place);
    if (pass + 1 == options.passes || work.size() < before + 2) continue;

    const double step = (work.back().translation - work[work.size() - 2].translation).norm();
    const Place next = placesOfPass(pass + 1, blades, options).front();
    const auto end = side.at(next.radius, next.chord_part);
    if (!end || step == 0.0) continue;
    const double length = (touching(*end, options).translation - work.back().translation).norm();
    const int steps = static_cast<int>(std::min(1000.0, std::ceil(length / step)));
    for (int k = 1; k < steps; ++k) {
      const double radius = std::lerp(places.back().radius, next.radius, static_cast<double>(k) / steps);
      visit({radius, next.chord_part});
    }
  }
  if (work.empty()) {
    throw std::invalid_argument("blade " + std::to_string(options.blade) + " has no point on its " +
                                (options.forward_side ? "forward" : "backward") + " side along the path");
  }

  std::vector<Pose> path;
  const auto lift = [&](int k) { return options.retract * k / options.retract_poses; };
  for (int k = options.retract_poses; k > 0; --k) path.push_back(retracted(work.front(), lift(k)));
  path.insert(path.end(), work.begin(), work.end());
  for (int k = 1; k <= options.retract_poses; ++k) path.push_back(retracted(work.back(), lift(k)));
  return path;
}

}  // namespace octoblisk::demos
