#include "build/triangle_record.h"

#include "base/parallel.h"

namespace octoblisk::detail {
namespace {

TriangleRecord recordOf(const TriangleMesh& mesh, std::size_t index, const Vec3& origin) {
  TriangleRecord record;
  const Triangle corners = mesh.triangle(index);
  for (std::size_t v = 0; v < 3; ++v) record.vertices[v] = (corners[v] - origin).cast<float>();
  record.centroid = (record.vertices[0] + record.vertices[1] + record.vertices[2]) / 3.0f;
  record.normal = unitNormal(corners).cast<float>();
  record.triangle = static_cast<std::uint32_t>(index);
  return record;
}

}  // namespace

TriangleRecords makeRecords(const TriangleMesh& mesh, const Vec3& origin, int threads) {
  constexpr std::size_t kChunk = 8192;
  TriangleRecords records(mesh.triangleCount());
  parallelForChunks(records.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) records.span()[t] = recordOf(mesh, t, origin);
  });
  return records;
}

}  // namespace octoblisk::detail
