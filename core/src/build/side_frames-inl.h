// The principal frames of the two sides of all candidates for a split, eight at once. Included once for each
// target (simd-inl.h).
#if defined(OCTOBLISK_BUILD_SIDE_FRAMES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_BUILD_SIDE_FRAMES_INL_H
#undef OCTOBLISK_BUILD_SIDE_FRAMES_INL_H
#else
#define OCTOBLISK_BUILD_SIDE_FRAMES_INL_H
#endif

#include "build/split_search.h"
#include "simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// For each triangle and for all of them: sums over the corners of x, y, z, xx, xy, xz, yy, yz, zz.
HWY_INLINE void computeMoments(SplitSearch& search, float total[9]) {
  Float8 totals[9];
  for (Float8& sum_of_all : totals) sum_of_all = Float8(0.0f);
  for (std::size_t b = 0; b < search.blockCount(); ++b) {
    Float8 row[9];
    for (Float8& moment : row) moment = Float8(0.0f);
    for (const auto& corner : search.blocks[b].corner) {
      const Float8 x = Float8::load(corner[0]), y = Float8::load(corner[1]), z = Float8::load(corner[2]);
      const Float8 terms[9] = {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
      for (int k = 0; k < 9; ++k) row[k] = row[k] + terms[k];
    }
    for (std::size_t k = 0; k < 9; ++k) {
      row[k].store(&search.moments[(b * 9 + k) * kLanes]);
      totals[k] = totals[k] + row[k];
    }
  }
  for (int k = 0; k < 9; ++k) total[k] = sum(totals[k]);
}

/// Rotates the plane of axes p and q of eight symmetric matrices so that their element pq vanishes.
HWY_INLINE void rotate(Float8 matrix[3][3], Vec8 axes[3], int p, int q) {
  const int r = 3 - p - q;
  const Float8 off = matrix[p][q], zero(0.0f), one(1.0f), tiny(1e-30f);
  const Float8 theta = (matrix[q][q] - matrix[p][p]) / (Float8(2.0f) * select(abs(off), tiny, one, off));
  const Float8 size = one / (abs(theta) + sqrt(theta * theta + one));
  const Float8 tangent = select(abs(off), tiny, zero, select(theta, zero, zero - size, size));
  const Float8 cosine = one / sqrt(tangent * tangent + one), sine = tangent * cosine;
  matrix[p][p] = matrix[p][p] - tangent * off;
  matrix[q][q] = matrix[q][q] + tangent * off;
  matrix[p][q] = matrix[q][p] = zero;
  const Float8 rp = matrix[r][p], rq = matrix[r][q];
  matrix[r][p] = matrix[p][r] = cosine * rp - sine * rq;
  matrix[r][q] = matrix[q][r] = sine * rp + cosine * rq;
  const Vec8 axis_p = axes[p], axis_q = axes[q];
  axes[p] = axis_p * cosine - axis_q * sine;
  axes[q] = axis_p * sine + axis_q * cosine;
}

/// Makes eight frames orthonormal to about the last bit, as the boxes' separation test requires.
HWY_INLINE void orthonormalize(Vec8 axes[3]) {
  const Float8 one(1.0f);
  axes[1] = axes[1] - axes[0] * (dot(axes[0], axes[1]) / dot(axes[0], axes[0]));
  for (int k = 0; k < 2; ++k) axes[k] = axes[k] * (one / sqrt(dot(axes[k], axes[k])));
  axes[2] = cross(axes[0], axes[1]);
}

/// The principal frames of eight covariances (xx, xy, xz, yy, yz, zz), thinnest axis last.
HWY_INLINE void principalFrames(const float covariance[6][kLanes], Vec8 axes[3]) {
  const auto row = [&](int k) HWY_ATTR { return Float8::load(covariance[k]); };
  Float8 matrix[3][3] = {{row(0), row(1), row(2)}, {row(1), row(3), row(4)}, {row(2), row(4), row(5)}};
  const Float8 zero(0.0f), one(1.0f);
  axes[0] = {one, zero, zero};
  axes[1] = {zero, one, zero};
  axes[2] = {zero, zero, one};
  for (int sweep = 0; sweep < 3; ++sweep) {
    rotate(matrix, axes, 0, 1);
    rotate(matrix, axes, 0, 2);
    rotate(matrix, axes, 1, 2);
  }
  // A cyclic permutation puts the thinnest axis last and keeps the frame right-handed.
  const Float8 x = matrix[0][0], y = matrix[1][1], z = matrix[2][2], least_yz = min(y, z);
  const auto exchanged = [&](const Vec8& if_x, const Vec8& if_y, const Vec8& if_z) HWY_ATTR {
    const auto chosen = [&](const Float8& by_x, const Float8& by_y, const Float8& by_z)
                            HWY_ATTR { return select(x, least_yz, by_x, select(y, z, by_y, by_z)); };
    return Vec8(chosen(if_x.x, if_y.x, if_z.x), chosen(if_x.y, if_y.y, if_z.y),
                chosen(if_x.z, if_y.z, if_z.z));
  };
  const Vec8 a = axes[0], b = axes[1], c = axes[2];
  axes[0] = exchanged(b, c, a);
  axes[1] = exchanged(c, a, b);
  axes[2] = exchanged(a, b, c);
  orthonormalize(axes);
}

/// Writes the frames of both sides of all candidates.
HWY_INLINE void findFrames(SplitSearch& search) {
  float total[9];
  computeMoments(search, total);
  static_assert(2 * SplitSearch::kMaxSeeds == kLanes);
  float covariance[6][kLanes] = {};
  for (int c = 0; c < search.candidate_count; ++c) {
    Float8 sums[9], lows(0.0f);
    for (Float8& moment : sums) moment = Float8(0.0f);
    for (std::size_t b = 0; b < search.blockCount(); ++b) {
      const Float8 is_low = Float8::load(&search.is_low[c][b * kLanes]);
      lows = lows + is_low;
      for (std::size_t k = 0; k < 9; ++k) {
        sums[k] = sums[k] + is_low * Float8::load(&search.moments[(b * 9 + k) * kLanes]);
      }
    }
    const float low_count = sum(lows);
    float low[9];
    for (int k = 0; k < 9; ++k) low[k] = sum(sums[k]);
    for (int side = 0; side < 2; ++side) {
      const float per =
          1.0f / (3.0f * (side == 0 ? low_count : static_cast<float>(search.count) - low_count));
      float m[9];
      for (int k = 0; k < 9; ++k) m[k] = (side == 0 ? low[k] : total[k] - low[k]) * per;
      const int lane = 2 * c + side;
      covariance[0][lane] = m[3] - m[0] * m[0];
      covariance[1][lane] = m[4] - m[0] * m[1];
      covariance[2][lane] = m[5] - m[0] * m[2];
      covariance[3][lane] = m[6] - m[1] * m[1];
      covariance[4][lane] = m[7] - m[1] * m[2];
      covariance[5][lane] = m[8] - m[2] * m[2];
    }
  }
  Vec8 axes[3];
  principalFrames(covariance, axes);
  for (int k = 0; k < 3; ++k) {
    float component[3][kLanes];
    axes[k].x.store(component[0]);
    axes[k].y.store(component[1]);
    axes[k].z.store(component[2]);
    for (int lane = 0; lane < 2 * search.candidate_count; ++lane) {
      for (int i = 0; i < 3; ++i) search.candidates[lane / 2].sides[lane % 2].axes[k][i] = component[i][lane];
    }
  }
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
