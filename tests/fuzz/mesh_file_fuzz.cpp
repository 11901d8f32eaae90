// Reads any bytes as an STL, OBJ or PLY file; the first byte selects the format. The file is refused with a
// one-line message, or gives a mesh with finite coordinates whose triangle count survives writing and
// reading.
#include <iterator>

#include "fuzz/fuzz_input.h"
#include "io/mesh_file.h"

using namespace octoblisk;
using namespace octoblisk::demos;

// Assimp itself leaks memory if a file is truncated.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kNames[] = {"a.stl", "a.obj", "a.ply"};
  if (size < 2) return 0;
  const std::filesystem::path file = kNames[data[0] % std::size(kNames)];
  try {
    const TriangleMesh mesh = readMesh(file, fuzz::textOf(data + 1, size - 1));
    if (mesh.vertices().size() > 3 * mesh.triangleCount()) fuzz::fail("vertices that no triangle uses");
    for (const Vec3& vertex : mesh.vertices()) {
      if (!vertex.allFinite()) fuzz::fail("a coordinate that is not finite");
      if (vertex != vertex.cast<float>().cast<double>()) fuzz::fail("a coordinate that is no float");
    }
  } catch (const std::runtime_error& refusal) {
    fuzz::requireClear(refusal, file);
  }
  return 0;
}
