#include "contact/corner_contacts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "octoblisk/closest_point.h"
#include "octoblisk/raycast.h"

namespace octoblisk::detail {

std::span<const Contact> CornerContacts::find(const Meshes& meshes, double reach, double not_felt) & {
  const TriangleMesh& faces = meshes.other.tree().mesh();
  reach_ = reach;
  not_felt_ = not_felt;
  contacts_.clear();
  pushes_.clear();
  ways_back_.clear();
  if (least_height_.size() < meshes.own.cornerCount()) least_height_.resize(meshes.own.cornerCount(), kFar);
  for (const CornerAndFace& pair : meshes.pairs) {
    const Triangle face = faces.triangle(pair.face);
    const Vec3 normal = unitNormal(face);
    if (normal.isZero(0.0)) continue;
    if (meshes.other.isSheet(pair.face)) {
      addOverSheet(meshes, pair, face, normal);
      continue;
    }
    if (!meshes.isPushedAlong(pair.corner, normal)) continue;
    const Vec3 point = meshes.position(pair.corner);
    const double height = normal.dot(point - face[0]);
    if (!isOver(face, point - height * normal, height)) continue;
    double& least = least_height_[pair.corner];
    if (std::abs(height) < std::abs(least)) least = height;
    if (height >= -not_felt && height <= reach) pushes_.push_back({pair, normal, height});
  }
  addPastSheets(meshes);
  findInside(meshes);
  const auto isDeep = [&](std::uint32_t corner) {
    return inside_.contains(corner) && !(std::abs(least_height_[corner]) <= not_felt);
  };
  for (const auto& [pair, normal, height] : pushes_) {
    if (!isDeep(pair.corner)) add(meshes, pair, normal, height);
  }
  for (const std::uint32_t corner : inside_.corners()) {
    if (isDeep(corner)) addWayOut(meshes, corner);
  }
  addWaysBack(meshes);
  for (const CornerAndFace& pair : meshes.pairs) least_height_[pair.corner] = kFar;
  return contacts_;
}

void CornerContacts::add(const Meshes& meshes, const CornerAndFace& pair, const Vec3& normal, double height) {
  const Vec3 point = meshes.position(pair.corner);
  contacts_.push_back({point, point - height * normal, normal, height, pair.triangle, pair.face});
}

/// Whether a corner is over a face. Near an acute corner of the face, NearFeatures finds some that are beside
/// both edges and much farther from the face.
bool CornerContacts::isOver(const Triangle& face, const Vec3& foot, double height) const {
  constexpr double kRounding = 1e-4;  // of lengths that have no effect
  return octoblisk::distance(face, foot) <= kAlike * std::abs(height) + kRounding * not_felt_;
}

/// Adds the contact of a corner with a face of a sheet: on the side where it belongs, or on the side where it
/// is, or, if it is as good as on the face, on the side from which it can be pushed.
void CornerContacts::addOverSheet(const Meshes& meshes, const CornerAndFace& pair, const Triangle& face,
                                  const Vec3& normal) {
  const Vec3 point = meshes.position(pair.corner);
  const double height = normal.dot(point - face[0]), here = std::copysign(1.0, height);
  if (!(std::abs(height) <= reach_) || !isOver(face, point - height * normal, height)) return;
  const double side = meshes.meeting.empty() ? here : sideOf(meshes, pair.corner, face[0], normal);
  const bool is_known = meshes.when_apart && !meshes.meeting.empty();
  for (const double sense : {side, here, -here}) {
    if (is_known && sense != side) continue;
    const bool is_past = sense * height < -not_felt_, may_be_past = sense == side && !meshes.meeting.empty();
    if ((is_past && !may_be_past) || !meshes.isPushedAlong(pair.corner, sense * normal)) continue;
    return add(meshes, pair, sense * normal, sense * height);
  }
}

/// 1 if a corner belongs above a plane of a sheet, -1 if below. If it is known where the meshes were apart,
/// and the corner's way from there crosses sheets an odd number of times, it belongs before the last
/// crossing. If that place is not known or is on the plane, the middle of the corner's mesh shows the side,
/// unless the other mesh is smaller. Otherwise, the corner belongs where it is.
double CornerContacts::sideOf(const Meshes& meshes, std::uint32_t corner, const Vec3& on_plane,
                              const Vec3& normal) {
  const MeshFeatures &own = meshes.own, &other = meshes.other;
  const auto sideOfPoint = [&](const Vec3& point) {
    return std::copysign(1.0, normal.dot(point - on_plane));
  };
  const Vec3 to = meshes.position(corner);
  const double here = sideOfPoint(to);
  const Pose& before = meshes.when_apart ? *meshes.when_apart : meshes.own_in_other;
  const Vec3 from = before * own.position(corner);
  if (!meshes.when_apart || std::abs(normal.dot(from - on_plane)) <= not_felt_) {
    const auto sizeOf = [](const MeshFeatures& mesh) {
      return mesh.tree().mesh().bounds().halfExtents().norm();
    };
    return sizeOf(own) > sizeOf(other) ? here : sideOfPoint(before * own.tree().mesh().bounds().center());
  }
  allHits(other.tree(), {from, to - from, 1.0}, hits_);
  std::erase_if(hits_, [&](const RayHit& hit) { return !other.isSheet(hit.triangle); });
  const auto areOne = [](const RayHit& a, const RayHit& b) {  // a way through an edge hits both sides of it
    constexpr double kRounding = 1e-9;
    return b.t - a.t <= kRounding && a.back_face == b.back_face;
  };
  hits_.erase(std::unique(hits_.begin(), hits_.end(), areOne), hits_.end());
  if (hits_.size() % 2 == 0) return here;
  const RayHit& last = hits_.back();
  return std::copysign(1.0, (last.back_face ? -1.0 : 1.0) * last.normal.dot(normal));
}

/// Adds the contacts of corners past a sheet: of each triangle that meets the sheet, and from there downhill
/// the first one that can be pushed back.
void CornerContacts::addPastSheets(const Meshes& meshes) {
  const MeshFeatures &own = meshes.own, &other = meshes.other;
  if (!other.hasSheets()) return;
  past_.clear();
  for (const TrianglePair& pair : meshes.meeting) {
    if (!other.isSheet(pair.*meshes.other_triangle)) continue;
    const Triangle face = other.tree().mesh().triangle(pair.*meshes.other_triangle);
    const Vec3 normal = unitNormal(face);
    for (const std::uint32_t corner : own.cornersOf(pair.*meshes.own_triangle)) {
      const Vec3 out = sideOf(meshes, corner, face[0], normal) * normal;
      if (!(out.dot(meshes.position(corner) - face[0]) < 0.0)) continue;
      const Vec3 out_of_own = meshes.own_in_other.rotation.transpose() * out;
      for (std::uint32_t past = corner; past != kNoIndex; past = own.neighbourAgainst(past, out_of_own)) {
        const bool is_pushed = own.isPushedAlong(past, out_of_own);
        if (is_pushed || past == corner)
          past_.push_back({past, out, out.dot(face[0] - meshes.position(past))});
        if (is_pushed) break;
      }
    }
  }
  const auto key = [](const Past& past) {
    return std::tuple(past.corner, past.out.x(), past.out.y(), past.out.z(), past.depth);
  };
  std::ranges::sort(past_, {}, key);
  const auto areOne = [&](const Past& a, const Past& b) { return key(a) == key(b); };
  past_.erase(std::unique(past_.begin(), past_.end(), areOne), past_.end());
  for (const auto& [corner, out, depth] : past_) {
    const auto hit = closestHit(other.tree(), {meshes.position(corner), out, depth + reach_});
    if (hit && other.isSheet(hit->triangle))
      add(meshes, {corner, own.triangleAt(corner), hit->triangle}, out, -hit->t);
  }
}

/// Finds the corners inside the other solid. No corner is inside if no triangles meet.
void CornerContacts::findInside(const Meshes& meshes) {
  seeds_.clear();
  if (!meshes.meeting.empty()) {
    for (const TrianglePair& pair : meshes.meeting) {
      for (const std::uint32_t corner : meshes.own.cornersOf(pair.*meshes.own_triangle))
        seeds_.push_back(corner);
    }
    for (const CornerAndFace& pair : meshes.pairs) {
      if (least_height_[pair.corner] < -not_felt_) seeds_.push_back(pair.corner);
    }
  }
  inside_.find(meshes.own, meshes.own_in_a, meshes.other.solid(), meshes.other_in_a, seeds_);
}

/// The direction in which a corner of a sheet must leave a solid, so that the solid comes back to its side of
/// the sheet: where the solid's point at the corner was when the meshes were apart. If that is not known,
/// where the solid's middle is. None if the corner is not one of a sheet.
std::optional<Vec3> CornerContacts::wayOfSheet(const Meshes& meshes, std::uint32_t corner) const {
  const MeshFeatures& own = meshes.own;
  const std::uint32_t at = own.triangleAt(corner);
  const Vec3 normal = unitNormal(own.tree().mesh().triangle(at));
  if (!own.isSheet(at) || normal.isZero(0.0)) return std::nullopt;
  const auto heightOf = [&](const Vec3& point, const Pose& own_in_other) {
    return (own_in_other.rotation * normal).dot(point - own_in_other * own.position(corner));
  };
  double height = 0.0;
  if (meshes.when_apart) height = heightOf(meshes.position(corner), *meshes.when_apart);
  if (!(std::abs(height) > not_felt_)) {
    height = heightOf(meshes.other.tree().mesh().bounds().center(),
                      meshes.when_apart.value_or(meshes.own_in_other));
  }
  return meshes.own_in_other.rotation * (-std::copysign(1.0, height) * normal);
}

/// Adds the contact of a corner inside the other mesh with the nearest point of its surface, if that can push
/// the corner. If not, the corner may be past the middle of a thin part, or under a face near its rim. A
/// corner of a sheet is not pushed to the solid's side.
void CornerContacts::addWayOut(const Meshes& meshes, std::uint32_t corner) {
  const Vec3 point = meshes.position(corner);
  const ClosestPoint out = *closestPoint(meshes.other.tree(), point);
  const Vec3 normal = out.distance > not_felt_
                          ? Vec3((out.point - point) / out.distance)
                          : unitNormal(meshes.other.tree().mesh().triangle(out.triangle));
  const std::optional<Vec3> way = wayOfSheet(meshes, corner);
  if (!normal.isZero(0.0) && meshes.isPushedAlong(corner, normal) && !(way && way->dot(normal) < -kAlike)) {
    add(meshes, {corner, meshes.own.triangleAt(corner), out.triangle}, normal, -out.distance);
  } else if (way) {
    const auto hit = closestHit(meshes.other.tree(), {point, *way, kFar});
    if (hit && hit->back_face && meshes.isPushedAlong(corner, hit->normal)) {
      add(meshes, {corner, meshes.own.triangleAt(corner), hit->triangle}, hit->normal,
          -hit->t * way->dot(hit->normal));
    }
  } else {
    ways_back_.push_back({corner, normal});
  }
}

/// Adds the contacts of corners that the nearest point cannot push. Each comes out along the normal of a face
/// that a triangle at the corner meets and that does not face the way to the nearest point: others push that
/// way. If there are several such normals, it is the shortest way.
void CornerContacts::addWaysBack(const Meshes& meshes) {
  if (ways_back_.empty()) return;
  const MeshFeatures &own = meshes.own, &other = meshes.other;
  std::ranges::sort(ways_back_, {}, &WayBack::corner);
  for (const TrianglePair& pair : meshes.meeting) {
    const Vec3 out = unitNormal(other.tree().mesh().triangle(pair.*meshes.other_triangle));
    for (const std::uint32_t corner : own.cornersOf(pair.*meshes.own_triangle)) {
      const auto way = std::ranges::lower_bound(ways_back_, corner, {}, &WayBack::corner);
      if (way == ways_back_.end() || way->corner != corner || out.dot(way->to_nearest) > kAlike ||
          !meshes.isPushedAlong(corner, out))
        continue;
      const auto hit = closestHit(other.tree(), {meshes.position(corner), out, way->length});
      if (!hit || !hit->back_face || !meshes.isPushedAlong(corner, hit->normal)) continue;
      if (std::tuple(hit->t, hit->triangle) >= std::tuple(way->length, way->face)) continue;
      way->face = hit->triangle;
      way->length = hit->t;
      way->normal = hit->normal;
      way->height = -hit->t * out.dot(hit->normal);
    }
  }
  for (const WayBack& way : ways_back_) {
    if (way.face == kNoTriangle) continue;
    add(meshes, {way.corner, own.triangleAt(way.corner), way.face}, way.normal, way.height);
  }
}

}  // namespace octoblisk::detail
