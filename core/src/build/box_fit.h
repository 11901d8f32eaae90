// Fits tight oriented boxes to triangles: the frame from a sample, the extents from every vertex.
#pragma once

#include <span>

#include "build/triangle_record.h"
#include "simd/box8.h"

namespace octoblisk::detail {

/// A sample of vertices, one per row.
inline constexpr int kSampledTriangles = 1024;
using VertexSample = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::ColMajor, 3 * kSampledTriangles, 3>;

/// The vertices of at most kSampledTriangles of the records, taken at equal strides.
void sampleVertices(std::span<const TriangleRecord> records, VertexSample& sample);

/// The same for the records that the indices refer to.
void sampleVertices(std::span<const TriangleRecord> records, std::span<const std::uint32_t> indices,
                    VertexSample& sample);

/// The box of the points in their principal frame, turned about its thinnest axis to the least area (twelve
/// angles over 90°). `slack` is added to each edge when areas are compared, so that the comparison of flat
/// boxes depends on their long edges. The points need not be centred.
BoxF fitBox(const VertexSample& points, float slack);

/// The box in the given frame that contains every vertex of the records. The same for any number of threads.
BoxF enclosingBox(std::span<const TriangleRecord> records, const Eigen::Matrix3f& axes, int threads = 1);

/// The same for the records that the indices refer to.
BoxF enclosingBox(std::span<const TriangleRecord> records, std::span<const std::uint32_t> indices,
                  const Eigen::Matrix3f& axes);

}  // namespace octoblisk::detail
