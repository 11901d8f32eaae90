#include "octoblisk/triangle_record.h"

namespace octoblisk {

std::vector<TriangleRecord> makeRecords(const TriangleMesh& mesh, const Vec3& origin) {
  std::vector<TriangleRecord> records(mesh.triangleCount());
  for (std::size_t t = 0; t < records.size(); ++t) {
    TriangleRecord& record = records[t];
    const Triangle corners = mesh.triangle(t);
    for (std::size_t v = 0; v < 3; ++v) record.vertices[v] = (corners[v] - origin).cast<float>();
    record.centroid = (record.vertices[0] + record.vertices[1] + record.vertices[2]) / 3.0f;
    record.normal = scaledNormal(corners).normalized().cast<float>();  // zero stays zero
    record.triangle = static_cast<std::uint32_t>(t);
  }
  return records;
}

}  // namespace octoblisk
