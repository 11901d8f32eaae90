// The closest points of two segments.
#pragma once

#include <algorithm>
#include <limits>

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// A point of each of two bodies, and their squared distance.
struct PointPair {
  Vec3 on_a, on_b;
  double squared_distance = std::numeric_limits<double>::infinity();
};

inline void keepCloser(PointPair& best, const Vec3& on_a, const Vec3& on_b) {
  const double squared = (on_a - on_b).squaredNorm();
  if (squared < best.squared_distance) best = {on_a, on_b, squared};
}

/// The closest points of two segments (C. Ericson, Real-Time Collision Detection, 5.1.9); segments may be
/// points. Replaces `best` if they are closer.
inline void closestOnSegments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1,
                              PointPair& best) {
  const Vec3 p = p1 - p0, q = q1 - q0, offset = p0 - q0;
  const double pp = p.squaredNorm(), qq = q.squaredNorm(), pq = p.dot(q);
  const double p_offset = p.dot(offset), q_offset = q.dot(offset);
  const auto onP = [&](double t) { return pp > 0.0 ? std::clamp((pq * t - p_offset) / pp, 0.0, 1.0) : 0.0; };
  const auto onQ = [&](double s) { return qq > 0.0 ? std::clamp((pq * s + q_offset) / qq, 0.0, 1.0) : 0.0; };
  const double denominator = pp * qq - pq * pq;
  double s = 0.0;
  if (denominator > 1e-3 * pp * qq) {
    s = std::clamp((pq * q_offset - p_offset * qq) / denominator, 0.0, 1.0);
  } else {  // nearly parallel: the same value with less rounding
    const Vec3 across = q.cross(p);
    const double squared = across.squaredNorm();
    if (squared > 0.0) s = std::clamp(-across.dot(q.cross(offset)) / squared, 0.0, 1.0);
  }
  s = onP(onQ(s));
  keepCloser(best, p0 + s * p, q0 + onQ(s) * q);
}

}  // namespace octoblisk::detail
