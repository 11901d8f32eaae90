#include "build/box_fit.h"

#include <limits>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "base/trigonometry.h"
#include "geometry/principal_axes.h"

namespace octoblisk::detail {
namespace {

Vec3 meanOf(const VertexSample& points) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index row = 0; row < points.rows(); ++row) sum += points.row(row).transpose().cast<double>();
  return sum / static_cast<double>(points.rows());
}

void project(const VertexSample& points, const Eigen::Matrix3f& axes, VertexSample& local) {
  local.resize(points.rows(), 3);
  for (int k = 0; k < 3; ++k) {
    local.col(k) = points.col(0) * axes(0, k) + points.col(1) * axes(1, k) + points.col(2) * axes(2, k);
  }
}

/// Sums in loops, because the order of Eigen's own sums of many rows depends on the register width.
Eigen::Matrix3f principalFrame(const VertexSample& centred) {
  Mat3 sum = Mat3::Zero();
  for (Eigen::Index row = 0; row < centred.rows(); ++row) {
    const Vec3 point = centred.row(row).transpose().cast<double>();
    sum += point * point.transpose();
  }
  return principalAxes(sum).cast<float>();
}

/// The turn of the axes u, v about their normal that minimises the area of the points' box: cosine and sine.
Eigen::Vector2f leastAreaTurn(const Eigen::Ref<const Eigen::ArrayXf>& u,
                              const Eigen::Ref<const Eigen::ArrayXf>& v, float slack) {
  constexpr int kAngles = 12;
  constexpr float kWorthwhile = 0.999f;  // a turn must gain at least this much
  Eigen::Vector2f best(1.0f, 0.0f);
  float least = std::numeric_limits<float>::infinity();
  for (int i = 0; i < kAngles; ++i) {
    const SineCosine turn = sineCosine(std::numbers::pi / 2.0 * i / kAngles);
    const auto cosine = static_cast<float>(turn.cosine), sine = static_cast<float>(turn.sine);
    const auto along_u = cosine * u + sine * v;
    const auto along_v = cosine * v - sine * u;
    const float width = along_u.maxCoeff() - along_u.minCoeff() + slack;
    const float height = along_v.maxCoeff() - along_v.minCoeff() + slack;
    if (width * height < least * (i == 0 ? 1.0f : kWorthwhile)) {
      least = width * height;
      best = {cosine, sine};
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
  const Eigen::Vector3f mean = meanOf(points).cast<float>();
  const VertexSample centred = points.rowwise() - mean.transpose();
  BoxF box;
  box.axes = principalFrame(centred);
  VertexSample local;
  project(centred, box.axes, local);

  Eigen::RowVector3f extent = local.colwise().maxCoeff() - local.colwise().minCoeff();
  int thinnest = 0;
  extent.minCoeff(&thinnest);
  const int u = (thinnest + 1) % 3, v = (thinnest + 2) % 3;
  const Eigen::Vector2f turn = leastAreaTurn(local.col(u), local.col(v), slack);
  const Eigen::Vector3f axis_u = box.axes.col(u), axis_v = box.axes.col(v);
  box.axes.col(u) = turn.x() * axis_u + turn.y() * axis_v;
  box.axes.col(v) = turn.x() * axis_v - turn.y() * axis_u;

  project(centred, box.axes, local);
  const Eigen::Vector3f low = local.colwise().minCoeff(), high = local.colwise().maxCoeff();
  box.half_extents = 0.5f * (high - low);
  box.center = mean + box.axes * (0.5f * (low + high));
  return box;
}

BoxF enclosingBox(std::span<const TriangleRecord> records, const Eigen::Matrix3f& axes, int threads) {
  constexpr std::size_t kChunk = 8192;
  const LocalBounds none(axes, records.front().centroid);
  std::vector<LocalBounds> parts((records.size() + kChunk - 1) / kChunk, none);
  parallelForChunks(records.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    LocalBounds bounds = none;
    for (std::size_t i = begin; i < end; ++i) bounds.extend(records[i]);
    parts[begin / kChunk] = bounds;
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
