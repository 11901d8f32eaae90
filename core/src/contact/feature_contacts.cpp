#include "contact/feature_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "query/winding.h"

namespace octoblisk::detail {
namespace {

/// Two edges are parallel if the sine of their angle is at most this: corners and faces say more.
constexpr double kParallel = 0.02;

/// Corners are found up to the reach. Those deeper than this part of it might have neighbours that are not.
constexpr double kShallow = 0.5;

struct PosedEdge {
  Vec3 from, along;
  PosedEdge() = default;
  PosedEdge(const SharpEdge& edge, const MeshFeatures& mesh, const Pose& pose) {
    const Triangle triangle = mesh.tree().mesh().triangle(mesh.triangleOf(edge));
    from = pose * triangle[edge.corner];
    along = pose * triangle[(edge.corner + 1) % 3] - from;
  }
};

/// Of the two faces beside an edge, turned.
std::array<Vec3, 2> normalsOf(const SharpEdge& edge, const MeshFeatures& mesh, const Mat3& turn) {
  const TriangleMesh& triangles = mesh.tree().mesh();
  return {turn * unitNormal(triangles.triangle(mesh.triangleOf(edge))),
          turn * unitNormal(triangles.triangle(edge.across))};
}

/// Whether a unit vector perpendicular to an edge is between the normals of its faces.
bool isBetween(const std::array<Vec3, 2>& normals, const Vec3& along, const Vec3& direction) {
  const double least = -kAlike * along.norm();
  return direction.dot(along.cross(normals[0])) >= least && direction.dot(normals[1].cross(along)) >= least &&
         direction.dot(normals[0] + normals[1]) > 0.0;
}

/// Whether the way against a direction leads from an edge into the solid. At an acute edge, some directions
/// between the normals of the faces lead past it.
bool leadsOut(const std::array<Vec3, 2>& normals, const Vec3& direction) {
  return std::min(direction.dot(normals[0]), direction.dot(normals[1])) >= -kAlike;
}

bool isInside(const MeshFeatures& solid, const Vec3& point) {
  return crossingNumber(solid.tree(), point).value_or(0) != 0;
}

}  // namespace

/// Adds a contact whose A is the corner's mesh.
void FeatureContacts::addCorner(const CornerAndFace& pair, const Vec3& point, const Vec3& normal,
                                double height) {
  contacts_.push_back({point, point - height * normal, normal, height, pair.triangle, pair.face});
}

/// Adds the contacts of corners with the faces of the other mesh, in its frame.
void FeatureContacts::addCorners(const MeshFeatures& own, const MeshFeatures& other, const Pose& own_in_other,
                                 std::span<const CornerAndFace> pairs) {
  const TriangleMesh& faces = other.tree().mesh();
  const Mat3 turn = own_in_other.rotation.transpose();
  if (heights_.size() < own.cornerCount()) heights_.resize(own.cornerCount());
  pushes_.clear();
  for (const CornerAndFace& pair : pairs) {
    const Triangle face = faces.triangle(pair.face);
    const Vec3 normal = unitNormal(face), point = own_in_other * own.position(pair.corner);
    if (normal.isZero(0.0)) continue;
    const double height = normal.dot(point - face[0]);
    Heights& heights = heights_[pair.corner];
    const bool is_pushed = height <= reach_ && own.isPushedAlong(pair.corner, turn * normal);
    if (std::abs(height) < std::abs(heights.nearest)) heights = {height, pair.face, is_pushed};
    if (is_pushed) pushes_.push_back({pair, point, normal, height});
  }
  for (const CornerAndFace& pair : pairs) {
    Heights& heights = heights_[pair.corner];
    if (heights.nearest < -not_felt_ && !heights.is_located)
      locateCorner(own, other, own_in_other, pair, heights);
  }
  for (const Push& push : pushes_) {
    const Heights& heights = heights_[push.pair.corner];
    // Past the middle of a thin part, the nearest face is on the far side, and does not push.
    const bool is_past_middle = heights.nearest < 0.0 && !heights.is_pushed &&
                                push.normal.dot(scaledNormal(faces.triangle(heights.face))) < 0.0;
    if (push.height >= -std::abs(heights.nearest) || is_past_middle)
      addCorner(push.pair, push.point, push.normal, push.height);
  }
  for (const CornerAndFace& pair : pairs) heights_[pair.corner] = {};
}

/// Finds out whether a corner that is under a face is inside the solid, and which point of its surface is
/// nearest. At an edge of the surface, that point may be on no face under which the corner is.
void FeatureContacts::locateCorner(const MeshFeatures& own, const MeshFeatures& other,
                                   const Pose& own_in_other, const CornerAndFace& pair, Heights& heights) {
  heights.is_located = true;
  const Vec3 point = own_in_other * own.position(pair.corner);
  if (meeting_.empty() || !isInside(other, point)) {
    heights.nearest = 0.0;  // no face pushes it
    return;
  }
  is_deep_ |= heights.nearest < -kShallow * reach_;
  constexpr double kNearer = 0.99;  // not the same point again
  const auto out = closestPoint(other.tree(), point, -kNearer * heights.nearest);
  if (!out) return;
  const Vec3 normal = (out->point - point).normalized();
  const bool is_pushed = own.isPushedAlong(pair.corner, own_in_other.rotation.transpose() * normal);
  heights = {-out->distance, out->triangle, is_pushed, true};
  if (is_pushed) addCorner({pair.corner, pair.triangle, out->triangle}, point, normal, -out->distance);
}

void FeatureContacts::addEdges(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a) {
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
    const auto normals_of_b = normalsOf(*pair.of_b, b, b_in_a.rotation);
    if (normal.dot(normals_of_b[0] + normals_of_b[1]) < 0.0) normal = -normal, distance = -distance;
    const auto normals_of_a = normalsOf(*pair.of_a, a, Mat3::Identity());
    if (!isBetween(normals_of_b, of_b.along, normal) || !isBetween(normals_of_a, of_a.along, -normal))
      continue;
    const bool may_overlap =
        !meeting_.empty() && leadsOut(normals_of_b, normal) && leadsOut(normals_of_a, -normal);
    if (distance < 0.0 && !may_overlap) continue;
    const Vec3 point = of_a.from + s * of_a.along, point_on_b = point - distance * normal;
    contacts_.push_back(
        {point, point_on_b, normal, distance, a.triangleOf(*pair.of_a), b.triangleOf(*pair.of_b)});
  }
}

/// Puts first the triangles that meet and are not connected, by others that meet, with a contact that pushes
/// them apart. Returns their number.
std::size_t FeatureContacts::countUnfelt(const MeshFeatures& a, const MeshFeatures& b) {
  const auto set = [](const MeshFeatures& mesh, std::uint32_t triangle, std::vector<char>& is_felt, char to) {
    for (const std::uint32_t corner : mesh.cornersOf(triangle)) is_felt[corner] = to;
  };
  const auto setBoth = [&](std::uint32_t of_a, std::uint32_t of_b, char to) {
    set(a, of_a, is_felt_a_, to);
    set(b, of_b, is_felt_b_, to);
  };
  const auto isFelt = [](const MeshFeatures& mesh, std::uint32_t triangle, const std::vector<char>& is_felt) {
    return std::ranges::any_of(mesh.cornersOf(triangle),
                               [&](std::uint32_t corner) { return is_felt[corner] != 0; });
  };
  if (is_felt_a_.size() < a.cornerCount()) is_felt_a_.resize(a.cornerCount(), 0);
  if (is_felt_b_.size() < b.cornerCount()) is_felt_b_.resize(b.cornerCount(), 0);
  for (const Contact& contact : contacts_) {
    if (contact.distance <= not_felt_) setBoth(contact.triangle_a, contact.triangle_b, 1);
  }
  std::size_t left = meeting_.size(), before;
  do {  // those that are felt go to the end
    before = left;
    for (std::size_t i = 0; i < left;) {
      const TrianglePair pair = meeting_[i];
      if (isFelt(a, pair.a, is_felt_a_) && isFelt(b, pair.b, is_felt_b_)) {
        setBoth(pair.a, pair.b, 1);
        std::swap(meeting_[i], meeting_[--left]);
      } else {
        ++i;
      }
    }
  } while (left > 0 && left < before);
  for (const Contact& contact : contacts_) setBoth(contact.triangle_a, contact.triangle_b, 0);
  for (const TrianglePair& pair : meeting_) setBoth(pair.a, pair.b, 0);
  return left;
}

/// Adds a contact for each connected part of the curve in which the first `unfelt` pairs meet. Returns false
/// if a part does not say the way out.
bool FeatureContacts::addCrossings(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a,
                                   std::size_t unfelt) {
  if (unfelt == 0) return true;
  const TriangleMesh &mesh_a = a.tree().mesh(), &mesh_b = b.tree().mesh();
  const auto first_of_b = static_cast<std::uint32_t>(mesh_a.triangleCount());
  groups_.reset(first_of_b + mesh_b.triangleCount());
  const std::span pairs = std::span(meeting_).first(unfelt);
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
    if (!curve_.empty() && !addCrossing(of_group)) return false;
  }
  return true;
}

/// Adds a contact along the way out of the curve, as deep as the curve extends along it, unless that would
/// not be felt. Returns false if the curve is planar and does not show how deep the overlap is.
bool FeatureContacts::addCrossing(const TrianglePair& pair) {
  Vec3 between = Vec3::Zero();  // the faces
  for (const CurveSegment& segment : curve_) {
    between +=
        (segment.to - segment.from).norm() * (segment.normal_b.normalized() - segment.normal_a.normalized());
  }
  const std::optional<Vec3> of_closed = wayOut(curve_);
  const Vec3 out = of_closed.value_or(between.normalized());
  const double extent = extentAlong(out, curve_), between_faces = depthAlong(out, curve_);
  if (extent <= not_felt_) return !of_closed && between_faces <= not_felt_;
  // The curve of surfaces that lie along each other extends much farther than they overlap.
  const double depth = between_faces > 0.0 ? std::min(extent, between_faces) : extent;
  const Vec3 middle = middleOf(curve_), half = 0.5 * depth * out;
  contacts_.push_back({middle - half, middle + half, out, -depth, pair.a, pair.b});
  return true;
}

bool FeatureContacts::find(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, double reach,
                           double spacing, std::vector<Contact>& found) {
  reach_ = reach;
  not_felt_ = spacing / 40.0;  // contacts are as far apart as the spacing, so this tilts a body by 1/40
  is_deep_ = false;
  contacts_.clear();
  found.clear();
  touchingPairs(a.tree(), b.tree(), b_in_a, meeting_);
  near_.find(a, b, b_in_a, reach, static_cast<float>(not_felt_));
  addCorners(a, b, b_in_a.inverse(), near_.corners_of_a);
  for (Contact& contact : contacts_) {  // from B's frame to A's
    contact.point_on_a = b_in_a * contact.point_on_a;
    contact.point_on_b = b_in_a * contact.point_on_b;
    contact.normal = b_in_a.rotation * contact.normal;
  }
  const std::size_t of_a = contacts_.size();
  addCorners(b, a, b_in_a, near_.corners_of_b);
  for (std::size_t c = of_a; c < contacts_.size(); ++c) {  // these are of B and A
    Contact& contact = contacts_[c];
    std::swap(contact.point_on_a, contact.point_on_b);
    std::swap(contact.triangle_a, contact.triangle_b);
    contact.normal = -contact.normal;
  }
  addEdges(a, b, b_in_a);
  double least = kFar;
  for (const Contact& contact : contacts_) least = std::min(least, contact.distance);
  if (!meeting_.empty()) {
    if (is_deep_ || least < -kShallow * reach) return false;
    if (!addCrossings(a, b, b_in_a, countUnfelt(a, b))) return false;
  }
  if (meeting_.empty() && least > not_felt_) {
    const Clearance nearest =
        distance(a.tree(), b.tree(), b_in_a, {.upper_bound = std::min(reach, least - not_felt_)});
    if (nearest.found()) {
      contacts_.push_back({nearest.point_on_a, nearest.point_on_b,
                           (nearest.point_on_a - nearest.point_on_b).normalized(), nearest.distance,
                           nearest.triangle_a, nearest.triangle_b});
    }
  }
  found.assign(contacts_.begin(), contacts_.end());
  return true;
}

}  // namespace octoblisk::detail
