#include "models/outward_mesh.h"

#include <stdexcept>

#include "io/mesh_file.h"
#include "models/orientation.h"

namespace octoblisk::demos {

TriangleMesh readOutward(const std::filesystem::path& file, std::vector<std::string>& notes) {
  TriangleMesh mesh = readMesh(file);
  std::size_t turned_round = 0;
  try {
    mesh = withOneWinding(mesh, turned_round);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  if (turned_round > 0) {
    notes.push_back(file.string() + ": " + std::to_string(turned_round) + " of its " +
                    std::to_string(mesh.triangleCount()) +
                    (turned_round == 1
                         ? " triangles faces the opposite way to its neighbours; it is reversed"
                         : " triangles face the opposite way to their neighbours; they are reversed"));
  }
  if (enclosedVolume(mesh) >= 0.0) return mesh;
  notes.push_back(file.string() + ": its triangles face inward; they are reversed");
  return turned(mesh);
}

}  // namespace octoblisk::demos
