#include "contact/feature_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "geometry/triangle_pair.h"
#include "octoblisk/distance.h"

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

void FeatureContacts::addCorners(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                                 const std::optional<Pose>& b_when_apart) {
  const Pose a_in_b = b_in_a.inverse();
  std::optional<Pose> a_when_apart;
  if (b_when_apart) a_when_apart = b_when_apart->inverse();
  for (const Contact& c : corners_.find({a, b, Pose(), b_in_a, a_in_b, a_when_apart, near_.corners_of_a,
                                         near_.meeting, &TrianglePair::a, &TrianglePair::b},
                                        reach_, not_felt_)) {
    contacts_.push_back({b_in_a * c.point_on_a, b_in_a * c.point_on_b, b_in_a.rotation * c.normal, c.distance,
                         c.triangle_a, c.triangle_b});
  }
  for (const Contact& c : corners_.find({b, a, b_in_a, Pose(), b_in_a, b_when_apart, near_.corners_of_b,
                                         near_.meeting, &TrianglePair::b, &TrianglePair::a},
                                        reach_, not_felt_)) {
    contacts_.push_back({c.point_on_b, c.point_on_a, -c.normal, c.distance, c.triangle_b, c.triangle_a});
  }
}

void FeatureContacts::addEdges(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                               const std::optional<Pose>& b_when_apart) {
  const bool do_meet = !near_.meeting.empty();
  const auto isOfSheet = [](const MeshFeatures& mesh, const SharpEdge& edge) {
    return mesh.hasSheets() && mesh.isSheet(mesh.triangleOf(edge));
  };
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
    const Vec3 across = of_a.along.cross(of_b.along).normalized();
    const double distance = across.dot(between);
    if (!(std::abs(distance) <= reach_)) continue;
    const auto normals_of_a = normalsOf(*pair.of_a, a, Mat3::Identity()),
               normals_of_b = normalsOf(*pair.of_b, b, b_in_a.rotation);
    const bool is_sheet_a = isOfSheet(a, *pair.of_a), is_sheet_b = isOfSheet(b, *pair.of_b);
    const double here = std::copysign(1.0, distance);
    double side = here;  // where the edges of sheets belong
    if (do_meet && b_when_apart && (is_sheet_a || is_sheet_b)) {
      const double before = across.dot(of_a.from - *b_when_apart * (b_in_a.inverse() * of_b.from));
      if (std::abs(before) > not_felt_) side = std::copysign(1.0, before);
    }
    for (const double sense : {side, here, -here}) {
      const Vec3 normal = sense * across;
      if (!isBetween(normals_of_b, of_b.along, normal) || !isBetween(normals_of_a, of_a.along, -normal))
        continue;
      const bool may_overlap = do_meet && (is_sheet_a || leadsOut(normals_of_a, -normal)) &&
                               (is_sheet_b || leadsOut(normals_of_b, normal));
      const double over = sense * distance;
      if (over < 0.0 && !may_overlap) continue;
      const Vec3 point = of_a.from + s * of_a.along;
      contacts_.push_back(
          {point, point - over * normal, normal, over, a.triangleOf(*pair.of_a), b.triangleOf(*pair.of_b)});
      break;
    }
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

/// Turns the normals of sheets to the side where the other mesh belongs: where its point at the segment was
/// when the meshes were apart, or where its middle is. So a sheet is taken for a solid behind it.
void FeatureContacts::turnSheets(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                                 const std::optional<Pose>& b_when_apart, const TrianglePair& pair,
                                 CurveSegment& segment) const {
  const auto turn = [&](Vec3& normal, const Pose& sheet_moved, const Pose& other_moved, const Vec3& middle) {
    const Vec3 place = 0.5 * (segment.from + segment.to);
    // In a frame in which the sheet does not move.
    const auto heightOf = [&](const Vec3& point) {
      return normal.dot(sheet_moved.inverse() * (other_moved * point) - place);
    };
    double height = heightOf(place);
    if (!(std::abs(height) > not_felt_ * normal.norm())) height = heightOf(middle);
    if (!(height < 0.0)) return;
    normal = -normal;
    std::swap(segment.from, segment.to);
  };
  // From where the meshes are to where they were when apart, in A's frame.
  const Pose b_moved = b_when_apart ? *b_when_apart * b_in_a.inverse() : Pose();
  if (a.hasSheets() && a.isSheet(pair.a))
    turn(segment.normal_a, Pose(), b_moved, b_in_a * b.tree().mesh().bounds().center());
  if (b.hasSheets() && b.isSheet(pair.b))
    turn(segment.normal_b, b_moved, Pose(), a.tree().mesh().bounds().center());
}

/// Adds a contact for each connected part of the curve in which the first `unfelt` pairs meet.
void FeatureContacts::addCrossings(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                                   const std::optional<Pose>& b_when_apart, std::size_t unfelt) {
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
      if (!segment) continue;
      curve_.push_back(*segment);
      turnSheets(a, b, b_in_a, b_when_apart, *first, curve_.back());
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
  double least = std::numeric_limits<double>::infinity();
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

void FeatureContacts::find(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                           const std::optional<Pose>& b_when_apart, double reach, double spacing,
                           std::vector<Contact>& found) {
  reach_ = reach;
  not_felt_ = spacing / 40.0;  // contacts are as far apart as the spacing, so this tilts a body by 1/40
  contacts_.clear();
  near_.find(a, b, b_in_a, reach, static_cast<float>(not_felt_));
  addCorners(a, b, b_in_a, b_when_apart);
  addEdges(a, b, b_in_a, b_when_apart);
  addCrossings(a, b, b_in_a, b_when_apart, countUnfelt(a, b));
  addNearest(a, b, b_in_a);
  found.assign(contacts_.begin(), contacts_.end());
}

}  // namespace octoblisk::detail
