// Two triangles that are near each other, and where they are closest.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/triangle_feature.h"
#include "geometry/triangle_pair.h"
#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// A point of a triangle, and the corners of the feature it lies on (triangle_feature.h).
struct PlaceOnTriangle {
  unsigned feature;
  Vec3 point;
};

/// The closest features of two triangles A and B that do not meet, in single precision: an edge of each, or
/// a corner of one and the face of the other.
struct ClosestFeatures {
  static constexpr std::uint8_t kUnknown = 15;
  std::uint8_t which = kUnknown;
  float along_a = 0.0f, along_b = 0.0f;  ///< of two edges: the fraction of the way along each; 0, 1: its ends

  // Edge v runs from corner v to the next one.
  static constexpr int ofEdges(int of_a, int of_b) { return 3 * of_a + of_b; }
  static constexpr int ofCornerOfA(int corner) { return 9 + corner; }
  static constexpr int ofCornerOfB(int corner) { return 12 + corner; }

  bool areKnown() const { return which != kUnknown; }

  /// The closest points, computed in double precision from these features, which must be known.
  std::pair<PlaceOnTriangle, PlaceOnTriangle> places(const Triangle& a, const Triangle& b) const {
    if (which >= 12) {
      const auto [on_b, on_a] = cornerAndFoot(which - 12u, b, a);
      return {on_a, on_b};
    }
    if (which >= 9) return cornerAndFoot(which - 9u, a, b);
    return {onEdge(a, which / 3u, along_a), onEdge(b, which % 3u, along_b)};
  }

 private:
  static PlaceOnTriangle onEdge(const Triangle& triangle, std::size_t edge, float along) {
    const std::size_t next = (edge + 1) % 3;
    if (along <= 0.0f) return {1u << edge, triangle[edge]};
    if (along >= 1.0f) return {1u << next, triangle[next]};
    return {1u << edge | 1u << next, triangle[edge] + double(along) * (triangle[next] - triangle[edge])};
  }
  static std::pair<PlaceOnTriangle, PlaceOnTriangle> cornerAndFoot(std::size_t corner, const Triangle& of,
                                                                   const Triangle& face) {
    const Vec3 &point = of[corner], normal = scaledNormal(face);
    const Vec3 foot = point - normal * (normal.dot(point - face[0]) / normal.squaredNorm());
    return {{1u << corner, point}, {kFace, foot}};
  }
};

enum class Meeting : std::uint8_t { no, maybe, yes };

/// Two triangles that may be near each other.
struct NearPair {
  TrianglePair triangles;
  Meeting meeting = Meeting::maybe;
  ClosestFeatures features;     ///< unknown where single precision did not show that the triangles are apart
  float least_distance = 0.0f;  ///< a lower bound
  float most_distance = std::numeric_limits<float>::infinity();  ///< an upper bound
};

/// The contact of two near triangles; none if they are farther apart than `threshold`.
inline std::optional<Contact> contactWithin(double threshold, const NearPair& near, const Triangle& a,
                                            const Triangle& b) {
  const bool meet = near.meeting == Meeting::yes || (near.meeting == Meeting::maybe && intersects(a, b));
  if (!meet && !(threshold > 0.0)) return std::nullopt;
  Contact contact = meet ? meetingContact(a, b) : closestPoints(a, b);
  if (contact.distance > threshold) return std::nullopt;
  contact.triangle_a = near.triangles.a;
  contact.triangle_b = near.triangles.b;
  return contact;
}

}  // namespace octoblisk::detail
