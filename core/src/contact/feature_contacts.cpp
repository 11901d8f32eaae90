#include "contact/feature_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "geometry/triangle_pair.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"

namespace octoblisk::detail {
namespace {

/// Two edges are parallel if the sine of their angle is at most this: corners and faces say more.
constexpr double kParallel = 0.02;

struct PosedEdge {
  Vec3 from, along;
  PosedEdge() = default;
  PosedEdge(const SharpEdge& edge, const MeshFeatures& mesh, const Pose& pose) {
    const Triangle triangle = mesh.tree().mesh().triangle(mesh.triangleOf(edge));
    from = pose * triangle[edge.corner];
    along = pose * triangle[(edge.corner + 1) % 3] - from;
  }
};

/// The turned normals of the two faces beside an edge, on the side from which the edge is convex.
std::array<Vec3, 2> normalsOf(const SharpEdge& edge, const MeshFeatures& mesh, const Mat3& turn) {
  const TriangleMesh& triangles = mesh.tree().mesh();
  const Triangle triangle = triangles.triangle(mesh.triangleOf(edge));
  const Vec3 first = unitNormal(triangle);
  if (edge.across == kNoTriangle) return {turn * first, -(turn * first)};
  const Vec3 second = unitNormal(triangles.triangle(edge.across));
  if (mesh.hasSheets() &&
      first.cross(second).dot(triangle[(edge.corner + 1) % 3] - triangle[edge.corner]) < 0.0)
    return {-(turn * second), -(turn * first)};
  return {turn * first, turn * second};
}

/// Whether a unit vector perpendicular to an edge is between the normals of its faces.
bool isBetween(const std::array<Vec3, 2>& normals, const Vec3& along, const Vec3& direction) {
  const double least = -kAlike * along.norm();
  return direction.dot(along.cross(normals[0])) >= least && direction.dot(normals[1].cross(along)) >= least &&
         direction.dot(normals[0] + normals[1]) >= 0.0;
}

/// Whether the way against a direction leads from an edge into the solid. At an acute edge, some directions
/// between the normals of the faces lead past it.
bool leadsOut(const std::array<Vec3, 2>& normals, const Vec3& direction) {
  return std::min(direction.dot(normals[0]), direction.dot(normals[1])) >= -kAlike;
}

}  // namespace

/// Adds a contact whose A is the corner's mesh.
void FeatureContacts::addCorner(const CornerAndFace& pair, const Vec3& point, const Vec3& normal,
                                double height) {
  contacts_.push_back({point, point - height * normal, normal, height, pair.triangle, pair.face});
}

/// Adds the contacts of corners with the faces of the other mesh, in its frame.
void FeatureContacts::addCorners(const PosedSolid& own, const PosedSolid& other,
                                 std::span<const CornerAndFace> pairs,
                                 std::uint32_t TrianglePair::*own_triangle) {
  const MeshFeatures& features = own.features;
  const TriangleMesh& faces = other.features.tree().mesh();
  const Pose own_in_other = other.in_a.inverse() * own.in_a;
  const Mat3 turn = own_in_other.rotation.transpose();
  if (least_height_.size() < features.cornerCount()) least_height_.resize(features.cornerCount(), kFar);
  pushes_.clear();
  own_in_other_ = own_in_other;
  before_in_other_ =
      knows_before_ ? std::optional(other.before_in_a.inverse() * own.before_in_a) : std::nullopt;
  for (const CornerAndFace& pair : pairs) {
    const Triangle face = faces.triangle(pair.face);
    const Vec3 normal = unitNormal(face), point = own_in_other * features.position(pair.corner);
    if (normal.isZero(0.0)) continue;
    const double height = normal.dot(point - face[0]);
    const auto isPushedAlong = [&](const Vec3& direction) {
      return features.isPushedAlong(pair.corner, turn * direction);
    };
    if (other.features.isSheet(pair.face)) {
      const double here = std::copysign(1.0, height),
                   side = near_.meeting.empty() ? here : sideOf(features, pair.corner, face[0], normal);
      for (const double sense : {side, here, -here}) {
        const double over = sense * height;
        if (over < -not_felt_ && (near_.meeting.empty() || sense != side)) continue;
        if (!isPushedAlong(sense * normal)) continue;
        addCorner(pair, point, sense * normal, over);
        break;
      }
      continue;
    }
    if (!isPushedAlong(normal)) continue;
    double& least = least_height_[pair.corner];
    if (std::abs(height) < std::abs(least)) least = height;
    if (height >= -not_felt_ && height <= reach_) pushes_.push_back({pair, point, normal, height});
  }
  findInside(own, other, pairs, own_triangle);
  const auto isDeep = [&](std::uint32_t corner) {
    return inside_.contains(corner) && !(std::abs(least_height_[corner]) <= not_felt_);
  };
  for (const auto& [pair, point, normal, height] : pushes_) {
    if (!isDeep(pair.corner)) addCorner(pair, point, normal, height);
  }
  ways_back_.clear();
  for (const std::uint32_t corner : inside_.corners()) {
    if (isDeep(corner)) addWayOut(features, other.features, own_in_other, corner);
  }
  addWaysBack(features, other.features, own_in_other, own_triangle);
  addPastSheets(features, other.features, own_in_other, own_triangle);
  for (const CornerAndFace& pair : pairs) least_height_[pair.corner] = kFar;
}

/// Finds the corners inside the other solid. No corner is inside if no triangles meet.
void FeatureContacts::findInside(const PosedSolid& own, const PosedSolid& other,
                                 std::span<const CornerAndFace> pairs,
                                 std::uint32_t TrianglePair::*own_triangle) {
  seeds_.clear();
  if (!near_.meeting.empty()) {
    for (const TrianglePair& pair : near_.meeting) {
      for (const std::uint32_t corner : own.features.cornersOf(pair.*own_triangle)) seeds_.push_back(corner);
    }
    for (const CornerAndFace& pair : pairs) {
      if (least_height_[pair.corner] < -not_felt_) seeds_.push_back(pair.corner);
    }
  }
  inside_.find(own.features, own.in_a, other.mesh, other.in_a, seeds_);
}

/// Adds the contact of a corner inside the other mesh with the nearest point of its surface, if that can push
/// the corner. If not, the corner may be past the middle of a thin part, or under a face near its rim.
void FeatureContacts::addWayOut(const MeshFeatures& own, const MeshFeatures& other, const Pose& own_in_other,
                                std::uint32_t corner) {
  const Vec3 point = own_in_other * own.position(corner);
  const ClosestPoint out = *closestPoint(other.tree(), point);
  const Vec3 normal = out.distance > not_felt_ ? Vec3((out.point - point) / out.distance)
                                               : unitNormal(other.tree().mesh().triangle(out.triangle));
  if (!normal.isZero(0.0) && own.isPushedAlong(corner, own_in_other.rotation.transpose() * normal)) {
    addCorner({corner, own.triangleAt(corner), out.triangle}, point, normal, -out.distance);
  } else {
    ways_back_.push_back({corner, normal});
  }
}

/// 1 if a corner belongs above a plane of a sheet in the other mesh, -1 if below: where it was when the
/// meshes were last apart. If that is not known, where the middle of its mesh is.
double FeatureContacts::sideOf(const MeshFeatures& own, std::uint32_t corner, const Vec3& on_plane,
                               const Vec3& normal) const {
  const auto height = [&](const Pose& pose, const Vec3& point) {
    return normal.dot(pose * point - on_plane);
  };
  const double before = before_in_other_ ? height(*before_in_other_, own.position(corner)) : 0.0;
  if (std::abs(before) > not_felt_) return std::copysign(1.0, before);
  const Vec3 middle = own.tree().mesh().bounds().center();
  return std::copysign(1.0, height(before_in_other_.value_or(own_in_other_), middle));
}

/// Takes a way back of a corner straight along a unit vector if it is shorter than the one known: to the
/// first face of the other mesh that can push the corner there.
void FeatureContacts::shortenWayBack(const MeshFeatures& own, const MeshFeatures& other,
                                     const Pose& own_in_other, const Vec3& out, CornerWayBack& way) {
  const Mat3 turn = own_in_other.rotation.transpose();
  const auto hit = closestHit(other.tree(), {own_in_other * own.position(way.corner), out, way.length});
  if (!hit) return;
  const bool is_of_sheet = other.isSheet(hit->triangle);
  const Vec3 normal = is_of_sheet ? out : hit->normal;
  if (!is_of_sheet && !(hit->back_face && own.isPushedAlong(way.corner, turn * normal))) return;
  if (std::tuple(hit->t, hit->triangle) >= std::tuple(way.length, way.face)) return;
  way.face = hit->triangle;
  way.length = hit->t;
  way.normal = normal;
  way.height = -hit->t * out.dot(normal);
}

/// Adds the contacts of corners that the nearest point cannot push. Each comes out along the normal of a face
/// that a triangle at the corner meets and that does not face the way to the nearest point: others push that
/// way. If there are several such normals, it is the shortest way.
void FeatureContacts::addWaysBack(const MeshFeatures& own, const MeshFeatures& other,
                                  const Pose& own_in_other, std::uint32_t TrianglePair::*own_triangle) {
  if (ways_back_.empty()) return;
  const auto other_triangle = own_triangle == &TrianglePair::a ? &TrianglePair::b : &TrianglePair::a;
  std::ranges::sort(ways_back_, {}, &CornerWayBack::corner);
  for (const TrianglePair& pair : near_.meeting) {
    const Vec3 out = unitNormal(other.tree().mesh().triangle(pair.*other_triangle));
    for (const std::uint32_t corner : own.cornersOf(pair.*own_triangle)) {
      const auto way = std::ranges::lower_bound(ways_back_, corner, {}, &CornerWayBack::corner);
      if (way == ways_back_.end() || way->corner != corner || out.dot(way->to_nearest) > kAlike ||
          !own.isPushedAlong(corner, own_in_other.rotation.transpose() * out))
        continue;
      shortenWayBack(own, other, own_in_other, out, *way);
    }
  }
  for (const CornerWayBack& way : ways_back_) addWayBack(own, own_in_other, way);
}

void FeatureContacts::addWayBack(const MeshFeatures& own, const Pose& own_in_other,
                                 const CornerWayBack& way) {
  if (way.face == kNoTriangle) return;
  const CornerAndFace pair{way.corner, own.triangleAt(way.corner), way.face};
  addCorner(pair, own_in_other * own.position(way.corner), way.normal, way.height);
}

/// Adds the contacts of corners that are past a sheet by more than the reach: those of triangles that meet
/// the sheet, and from each of them downhill the first one that can be pushed back.
void FeatureContacts::addPastSheets(const MeshFeatures& own, const MeshFeatures& other,
                                    const Pose& own_in_other, std::uint32_t TrianglePair::*own_triangle) {
  if (!other.hasSheets()) return;
  const auto other_triangle = own_triangle == &TrianglePair::a ? &TrianglePair::b : &TrianglePair::a;
  const Mat3 turn = own_in_other.rotation.transpose();
  past_.clear();
  for (const TrianglePair& pair : near_.meeting) {
    if (!other.isSheet(pair.*other_triangle)) continue;
    const Triangle face = other.tree().mesh().triangle(pair.*other_triangle);
    const Vec3 normal = unitNormal(face);
    for (const std::uint32_t corner : own.cornersOf(pair.*own_triangle)) {
      const Vec3 out = sideOf(own, corner, face[0], normal) * normal, out_of_own = turn * out;
      if (!(out.dot(own_in_other * own.position(corner) - face[0]) < 0.0)) continue;
      for (std::uint32_t past = corner; past != kNoIndex; past = own.neighbourAgainst(past, out_of_own)) {
        const bool is_pushed = own.isPushedAlong(past, out_of_own);
        if (is_pushed || past == corner) past_.push_back({past, out});
        if (is_pushed) break;
      }
    }
  }
  std::ranges::sort(past_, {}, [](const PastCorner& past) {
    return std::tuple(past.corner, past.out.x(), past.out.y(), past.out.z());
  });
  const auto areAlike = [](const PastCorner& a, const PastCorner& b) {
    return a.corner == b.corner && a.out.cross(b.out).norm() <= kAlike && a.out.dot(b.out) > 0.0;
  };
  past_.erase(std::unique(past_.begin(), past_.end(), areAlike), past_.end());
  for (const auto& [corner, out] : past_) {
    CornerWayBack way{corner, Vec3::Zero()};
    shortenWayBack(own, other, own_in_other, out, way);
    addWayBack(own, own_in_other, way);
  }
}

void FeatureContacts::addEdges(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                               const Pose& b_before) {
  const SharpEdge* last = nullptr;
  PosedEdge of_a;
  for (const EdgeAndEdge& pair : near_.edges) {
    if (pair.of_a != last) of_a = PosedEdge(*pair.of_a, a, Pose());
    last = pair.of_a;
    const PosedEdge of_b(*pair.of_b, b, b_in_a);
    const Vec3 between = of_a.from - of_b.from;
    const double aa = of_a.along.squaredNorm(), bb = of_b.along.squaredNorm(),
                 ab = of_a.along.dot(of_b.along), da = of_a.along.dot(between), db = of_b.along.dot(between);
    const double squared_sine = aa * bb - ab * ab;
    if (!(squared_sine > kParallel * kParallel * aa * bb)) continue;
    const double s = (ab * db - bb * da) / squared_sine, t = (aa * db - ab * da) / squared_sine;
    if (!(s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)) continue;
    Vec3 normal = of_a.along.cross(of_b.along).normalized();
    double distance = normal.dot(between);
    if (!(std::abs(distance) <= reach_)) continue;
    const auto normals_of_a = normalsOf(*pair.of_a, a, Mat3::Identity()),
               normals_of_b = normalsOf(*pair.of_b, b, b_in_a.rotation);
    const auto arePushed = [&] {
      return isBetween(normals_of_b, of_b.along, normal) && isBetween(normals_of_a, of_a.along, -normal);
    };
    if (distance < 0.0) normal = -normal, distance = -distance;
    if (knows_before_ && !near_.meeting.empty() &&
        (a.isSheet(a.triangleOf(*pair.of_a)) || b.isSheet(b.triangleOf(*pair.of_b)))) {
      const double before = normal.dot(of_a.from - b_before * (b_in_a.inverse() * of_b.from));
      if (before < -not_felt_) {
        normal = -normal, distance = -distance;
        if (!arePushed()) normal = -normal, distance = -distance;
      }
    }
    if (!arePushed()) {
      normal = -normal, distance = -distance;
      const auto leadsOutOf = [](const MeshFeatures& mesh, const SharpEdge& edge, const auto& normals,
                                 const Vec3& direction) {
        return mesh.isSheet(mesh.triangleOf(edge)) || leadsOut(normals, direction);
      };
      const bool may_overlap = !near_.meeting.empty() && leadsOutOf(b, *pair.of_b, normals_of_b, normal) &&
                               leadsOutOf(a, *pair.of_a, normals_of_a, -normal);
      if (!arePushed() || (distance < 0.0 && !may_overlap)) continue;
    }
    const Vec3 point = of_a.from + s * of_a.along, point_on_b = point - distance * normal;
    contacts_.push_back(
        {point, point_on_b, normal, distance, a.triangleOf(*pair.of_a), b.triangleOf(*pair.of_b)});
  }
}

/// Puts first the pairs that meet in which a triangle has no corner with a contact that touches. Returns
/// their number.
std::size_t FeatureContacts::countUnfelt(const MeshFeatures& a, const MeshFeatures& b) {
  if (near_.meeting.empty()) return 0;
  const auto set = [](const MeshFeatures& mesh, std::uint32_t triangle, std::vector<char>& is_felt, char to) {
    for (const std::uint32_t corner : mesh.cornersOf(triangle)) is_felt[corner] = to;
  };
  const auto isFelt = [](const MeshFeatures& mesh, std::uint32_t triangle, const std::vector<char>& is_felt) {
    return std::ranges::any_of(mesh.cornersOf(triangle),
                               [&](std::uint32_t corner) { return is_felt[corner] != 0; });
  };
  if (is_felt_a_.size() < a.cornerCount()) is_felt_a_.resize(a.cornerCount(), 0);
  if (is_felt_b_.size() < b.cornerCount()) is_felt_b_.resize(b.cornerCount(), 0);
  const auto setAll = [&](char to) {
    for (const Contact& contact : contacts_) {
      if (!(contact.distance <= not_felt_)) continue;
      set(a, contact.triangle_a, is_felt_a_, to);
      set(b, contact.triangle_b, is_felt_b_, to);
    }
  };
  setAll(1);
  const auto felt = std::ranges::partition(near_.meeting, [&](const TrianglePair& pair) {
    return !isFelt(a, pair.a, is_felt_a_) || !isFelt(b, pair.b, is_felt_b_);
  });
  setAll(0);
  return near_.meeting.size() - felt.size();
}

/// Adds a contact for each connected part of the curve in which the first `unfelt` pairs meet.
void FeatureContacts::addCrossings(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                                   std::size_t unfelt) {
  if (unfelt == 0) return;
  const TriangleMesh &mesh_a = a.tree().mesh(), &mesh_b = b.tree().mesh();
  const auto first_of_b = static_cast<std::uint32_t>(mesh_a.triangleCount());
  groups_.reset(first_of_b + mesh_b.triangleCount());
  const std::span pairs = std::span(near_.meeting).first(unfelt);
  for (const TrianglePair& pair : pairs) groups_.join(first_of_b + pair.b, pair.a);
  std::ranges::sort(pairs, {}, [&](const TrianglePair& pair) {
    return std::tuple(groups_.rootOf(pair.a), pair.a, pair.b);
  });
  for (auto first = pairs.begin(); first != pairs.end();) {
    const TrianglePair of_group = *first;
    const std::uint32_t group = groups_.rootOf(of_group.a);
    curve_.clear();
    for (; first != pairs.end() && groups_.rootOf(first->a) == group; ++first) {
      const auto segment = meetingSegment(mesh_a.triangle(first->a), b_in_a * mesh_b.triangle(first->b));
      if (segment) curve_.push_back(*segment);
    }
    if (!curve_.empty()) addCrossing(of_group);
  }
}

/// Adds a contact along the way out of the curve, as deep as the curve extends along it. A curve that is not
/// closed has none if it would not be felt.
void FeatureContacts::addCrossing(const TrianglePair& pair) {
  Vec3 between = Vec3::Zero();  // the faces
  for (const CurveSegment& segment : curve_) {
    between +=
        (segment.to - segment.from).norm() * (segment.normal_b.normalized() - segment.normal_a.normalized());
  }
  const std::optional<Vec3> of_closed = wayOut(curve_);
  const Vec3 out = of_closed.value_or(between.normalized()), middle = middleOf(curve_);
  const double extent = extentAlong(out, curve_), between_faces = depthAlong(out, curve_);
  // The curve of surfaces that lie along each other extends much farther than they overlap.
  const double depth = between_faces > 0.0 ? std::min(extent, between_faces) : extent;
  if (!of_closed && depth <= not_felt_) return;
  const Vec3 half = 0.5 * depth * out;
  contacts_.push_back({middle - half, middle + half, out, -depth, pair.a, pair.b});
}

/// If the nearest points of the surfaces are much nearer than all contacts, adds theirs. If triangles meet,
/// and no other contact says so, its distance is 0.
void FeatureContacts::addNearest(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a) {
  double least = kFar;
  for (const Contact& contact : contacts_) least = std::min(least, contact.distance);
  if (least <= (near_.meeting.empty() ? not_felt_ : 0.0)) return;
  if (!near_.meeting.empty()) {
    const auto [of_a, of_b] = *std::ranges::min_element(near_.meeting);
    const Contact contact =
        meetingContact(a.tree().mesh().triangle(of_a), b_in_a * b.tree().mesh().triangle(of_b));
    const Vec3 point = 0.5 * (contact.point_on_a + contact.point_on_b);
    contacts_.push_back({point, point, contact.normal, 0.0, of_a, of_b});
    return;
  }
  const Clearance nearest =
      distance(a.tree(), b.tree(), b_in_a, {.upper_bound = std::min(reach_, least - not_felt_)});
  if (!nearest.found()) return;
  contacts_.push_back({nearest.point_on_a, nearest.point_on_b,
                       (nearest.point_on_a - nearest.point_on_b).normalized(), nearest.distance,
                       nearest.triangle_a, nearest.triangle_b});
}

void FeatureContacts::find(const Solid& solid_a, const Solid& solid_b, const Pose& b_in_a, double reach,
                           double spacing, const std::optional<Pose>& before, std::vector<Contact>& found) {
  const MeshFeatures &a = solid_a.features, &b = solid_b.features;
  knows_before_ = before.has_value();
  const PosedSolid posed_a{a, solid_a.mesh, Pose(), Pose()},
      posed_b{b, solid_b.mesh, b_in_a, before.value_or(b_in_a)};
  reach_ = reach;
  not_felt_ = spacing / 40.0;  // contacts are as far apart as the spacing, so this tilts a body by 1/40
  contacts_.clear();
  near_.find(a, b, b_in_a, reach, static_cast<float>(not_felt_));
  addCorners(posed_a, posed_b, near_.corners_of_a, &TrianglePair::a);
  for (Contact& contact : contacts_) {  // from B's frame to A's
    contact.point_on_a = b_in_a * contact.point_on_a;
    contact.point_on_b = b_in_a * contact.point_on_b;
    contact.normal = b_in_a.rotation * contact.normal;
  }
  const std::size_t of_a = contacts_.size();
  addCorners(posed_b, posed_a, near_.corners_of_b, &TrianglePair::b);
  for (std::size_t c = of_a; c < contacts_.size(); ++c) {  // these are of B and A
    Contact& contact = contacts_[c];
    std::swap(contact.point_on_a, contact.point_on_b);
    std::swap(contact.triangle_a, contact.triangle_b);
    contact.normal = -contact.normal;
  }
  addEdges(a, b, b_in_a, before.value_or(b_in_a));
  addCrossings(a, b, b_in_a, countUnfelt(a, b));
  addNearest(a, b, b_in_a);
  found.assign(contacts_.begin(), contacts_.end());
}

}  // namespace octoblisk::detail
