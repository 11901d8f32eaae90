#include "build/box_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "base/turn.h"

namespace octoblisk::detail {
namespace {

/// A type of its own, so that this instance of Eigen's solver is the project's alone.
using Covariance = Eigen::Matrix<float, 3, 3, Eigen::DontAlign>;
using CovarianceSolver = Eigen::SelfAdjointEigenSolver<Covariance>;

}  // namespace
}  // namespace octoblisk::detail

/// Eigen's computation of the eigenvalues from the characteristic equation x³ - c2·x² + c1·x - c0 = 0,
/// without the C library's sines (base/turn.h).
template <>
inline void
Eigen::internal::direct_selfadjoint_eigenvalues<octoblisk::detail::CovarianceSolver, 3, false>::computeRoots(
    const octoblisk::detail::Covariance& m, VectorType& roots) {
  const float c0 = m(0, 0) * m(1, 1) * m(2, 2) + 2.0f * m(1, 0) * m(2, 0) * m(2, 1) -
                   m(0, 0) * m(2, 1) * m(2, 1) - m(1, 1) * m(2, 0) * m(2, 0) - m(2, 2) * m(1, 0) * m(1, 0);
  const float c1 = m(0, 0) * m(1, 1) - m(1, 0) * m(1, 0) + m(0, 0) * m(2, 2) - m(2, 0) * m(2, 0) +
                   m(1, 1) * m(2, 2) - m(2, 1) * m(2, 1);
  const float c2 = m(0, 0) + m(1, 1) + m(2, 2);
  const float third = 1.0f / 3.0f, c2_third = c2 * third;
  const float a_third = std::max((c2 * c2_third - c1) * third, 0.0f);
  const float half_b = 0.5f * (c0 + c2_third * (2.0f * c2_third * c2_third - c1));
  const float q = std::max(a_third * a_third * a_third - half_b * half_b, 0.0f);
  const float rho = std::sqrt(a_third), root3 = std::sqrt(3.0f);
  const auto [sine, cosine] =
      octoblisk::detail::sineCosine(octoblisk::detail::angleOf(std::sqrt(q), half_b) * third);
  roots << c2_third - rho * (cosine + root3 * sine), c2_third - rho * (cosine - root3 * sine),
      c2_third + 2.0f * rho * cosine;
}

namespace octoblisk::detail {
namespace {

// The code below gives the same bits for every register width, with or without fused multiply-add. Eigen's
// own sums and products of many rows do not.

/// Sums in four lanes: f(i) of the first four rows, of the next four, …, and of the remaining rows.
template <typename Four, typename One>
float sumOfRows(Eigen::Index rows, const Four& four, const One& one) {
  Eigen::Array4f lanes = Eigen::Array4f::Zero();
  Eigen::Index row = 0;
  for (; row + 4 <= rows; row += 4) lanes += four(row);
  for (Eigen::Index lane = 0; row < rows; ++row, ++lane) lanes[lane] += one(row);
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

Eigen::RowVector3f meanOf(const VertexSample& points) {
  Eigen::RowVector3f sum;
  for (int k = 0; k < 3; ++k) {
    const auto column = points.col(k).array();
    sum[k] = sumOfRows(
        points.rows(), [&](Eigen::Index row) { return column.segment<4>(row); },
        [&](Eigen::Index row) { return column[row]; });
  }
  return sum / static_cast<float>(points.rows());
}

Eigen::Matrix3f covarianceOf(const VertexSample& centred) {
  Eigen::Matrix3f covariance;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const auto one = centred.col(i).array(), other = centred.col(j).array();
      covariance(i, j) = covariance(j, i) = sumOfRows(
          centred.rows(), [&](Eigen::Index row) { return one.segment<4>(row) * other.segment<4>(row); },
          [&](Eigen::Index row) { return one[row] * other[row]; });
    }
  }
  return covariance / static_cast<float>(centred.rows());
}

void project(const VertexSample& points, const Eigen::Matrix3f& axes, VertexSample& local) {
  local.resize(points.rows(), 3);
  for (int k = 0; k < 3; ++k) {
    local.col(k) = points.col(0) * axes(0, k) + points.col(1) * axes(1, k) + points.col(2) * axes(2, k);
  }
}

Eigen::Matrix3f principalFrame(const VertexSample& centred) {
  const Eigen::Matrix3f covariance = covarianceOf(centred);
  CovarianceSolver solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3f longest = solver.eigenvectors().col(2);
  // computeDirect is not orthonormal to the last bit, but the boxes' separation test requires it.
  Eigen::Vector3f middle = solver.eigenvectors().col(1) - longest * longest.dot(solver.eigenvectors().col(1));
  if (!(middle.squaredNorm() > 0.25f)) middle = longest.unitOrthogonal();
  Eigen::Matrix3f axes;
  axes << longest.normalized(), middle.normalized(), Eigen::Vector3f::Zero();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes.allFinite() ? axes : Eigen::Matrix3f::Identity();
}

/// The turn of the axes u, v about their normal that minimises the area of the points' box.
SineCosineF leastAreaTurn(const Eigen::Ref<const Eigen::ArrayXf>& u,
                          const Eigen::Ref<const Eigen::ArrayXf>& v, float slack) {
  constexpr int kAngles = 12;
  constexpr float kWorthwhile = 0.999f;  // a turn must gain at least this much
  SineCosineF best;
  float least = std::numeric_limits<float>::infinity();
  for (int i = 0; i < kAngles; ++i) {
    const float angle = std::numbers::pi_v<float> / 2.0f * static_cast<float>(i) / kAngles;
    const SineCosineF turn = sineCosine(angle);
    const auto along_u = turn.cosine * u + turn.sine * v;
    const auto along_v = turn.cosine * v - turn.sine * u;
    const float width = along_u.maxCoeff() - along_u.minCoeff() + slack;
    const float height = along_v.maxCoeff() - along_v.minCoeff() + slack;
    if (width * height < least * (i == 0 ? 1.0f : kWorthwhile)) {
      least = width * height;
      best = turn;
    }
  }
  return best;
}

/// The bounds of triangles along three axes. Measuring from an origin near the triangles keeps the rounding
/// error small.
class LocalBounds {
 public:
  LocalBounds(const Eigen::Matrix3f& axes, const Eigen::Vector3f& origin) : axes_(axes), origin_(origin) {
    for (int k = 0; k < 3; ++k) to_local_.col(k).head<3>() = axes.row(k).transpose().array();
  }

  void extend(const TriangleRecord& record) {
    for (const Eigen::Vector3f& vertex : record.vertices) {
      const Eigen::Vector3f offset = vertex - origin_;
      const Eigen::Array4f local =
          to_local_.col(0) * offset[0] + to_local_.col(1) * offset[1] + to_local_.col(2) * offset[2];
      low_ = low_.min(local);
      high_ = high_.max(local);
    }
  }
  void extend(const LocalBounds& other) {
    low_ = low_.min(other.low_);
    high_ = high_.max(other.high_);
  }
  BoxF box() const {
    const Eigen::Vector3f low = low_.head<3>(), high = high_.head<3>();
    return {origin_ + axes_ * (0.5f * (low + high)), axes_, 0.5f * (high - low)};
  }

 private:
  Eigen::Matrix3f axes_;
  Eigen::Vector3f origin_;
  // Four components, so that the compiler uses vector instructions; the last is 0.
  Eigen::Array<float, 4, 3> to_local_ = Eigen::Array<float, 4, 3>::Zero();
  Eigen::Array4f low_ = Eigen::Array4f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array4f high_ = Eigen::Array4f::Constant(-std::numeric_limits<float>::infinity());
};

/// Writes the vertices of at most kSampledTriangles of `count` triangles.
template <typename RecordAt>
void sampleVerticesOf(std::size_t count, const RecordAt& record_at, VertexSample& sample) {
  const std::size_t stride = (count + kSampledTriangles - 1) / kSampledTriangles;
  sample.resize(static_cast<Eigen::Index>(3 * ((count + stride - 1) / stride)), 3);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < count; i += stride) {
    for (const Eigen::Vector3f& vertex : record_at(i).vertices) sample.row(row++) = vertex.transpose();
  }
}

}  // namespace

void sampleVertices(std::span<const TriangleRecord> records, VertexSample& sample) {
  sampleVerticesOf(
      records.size(), [&](std::size_t i) -> const TriangleRecord& { return records[i]; }, sample);
}

void sampleVertices(std::span<const TriangleRecord> records, std::span<const std::uint32_t> indices,
                    VertexSample& sample) {
  sampleVerticesOf(
      indices.size(), [&](std::size_t i) -> const TriangleRecord& { return records[indices[i]]; }, sample);
}

BoxF fitBox(const VertexSample& points, float slack) {
  const Eigen::RowVector3f mean = meanOf(points);
  const VertexSample centred = points.rowwise() - mean;
  BoxF box;
  box.axes = principalFrame(centred);
  VertexSample local;
  project(centred, box.axes, local);

  Eigen::RowVector3f extent = local.colwise().maxCoeff() - local.colwise().minCoeff();
  int thinnest = 0;
  extent.minCoeff(&thinnest);
  const int u = (thinnest + 1) % 3, v = (thinnest + 2) % 3;
  const SineCosineF turn = leastAreaTurn(local.col(u), local.col(v), slack);
  const Eigen::Vector3f axis_u = box.axes.col(u), axis_v = box.axes.col(v);
  box.axes.col(u) = turn.cosine * axis_u + turn.sine * axis_v;
  box.axes.col(v) = turn.cosine * axis_v - turn.sine * axis_u;

  project(centred, box.axes, local);
  const Eigen::Vector3f low = local.colwise().minCoeff(), high = local.colwise().maxCoeff();
  box.half_extents = 0.5f * (high - low);
  box.center = mean.transpose() + box.axes * (0.5f * (low + high));
  return box;
}

BoxF enclosingBox(std::span<const TriangleRecord> records, const Eigen::Matrix3f& axes, int threads) {
  constexpr std::size_t kChunk = 8192;
  const LocalBounds none(axes, records.front().centroid);
  std::vector<LocalBounds> parts((records.size() + kChunk - 1) / kChunk, none);
  parallelFor(parts.size(), threads, [&](std::size_t part, std::size_t) {
    LocalBounds bounds = none;
    const std::size_t end = std::min(records.size(), (part + 1) * kChunk);
    for (std::size_t i = part * kChunk; i < end; ++i) bounds.extend(records[i]);
    parts[part] = bounds;
  });
  LocalBounds all = none;
  for (const LocalBounds& part : parts) all.extend(part);
  return all.box();
}

BoxF enclosingBox(std::span<const TriangleRecord> records, std::span<const std::uint32_t> indices,
                  const Eigen::Matrix3f& axes) {
  LocalBounds bounds(axes, records[indices.front()].centroid);
  for (const std::uint32_t index : indices) bounds.extend(records[index]);
  return bounds.box();
}

}  // namespace octoblisk::detail
