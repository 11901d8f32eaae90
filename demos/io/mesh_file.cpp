#include "io/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <bit>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/mesh_file_check.h"
#include "io/new_file.h"

namespace octoblisk::demos {
namespace {

struct Format {
  const char* extension;
  const char* exporter;  ///< assimp's name of the format that we write
  void (*check)(std::string_view bytes, const std::string& file);
};

constexpr Format kFormats[] = {
    {".stl", "stlb", checkStl}, {".obj", "objnomtl", checkObj}, {".ply", "plyb", checkPly}};

const Format& formatOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& letter : extension) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw std::runtime_error(file.string() + ": unknown mesh format '" + extension +
                           "'; the known formats are .stl, .obj and .ply");
}

std::string readBytes(const std::filesystem::path& file) {
  std::ifstream stream = openForReading(file);
  std::string bytes;
  if (std::filesystem::is_regular_file(file)) {
    bytes.resize(std::filesystem::file_size(file));
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream) throw std::runtime_error(file.string() + ": could not be read to its end");
  } else {  // a device or a pipe has no size
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
  }
  if (bytes.empty()) throw std::runtime_error(file.string() + ": the file is empty: export the mesh again");
  return bytes;
}

/// Gives equal points the same number, in order of first occurrence. A hash table with linear probing.
class PointIndex {
 public:
  explicit PointIndex(std::size_t most_points) : slots_(std::bit_ceil(2 * most_points + 1), kFree) {}

  std::uint32_t indexOf(const aiVector3D& point) {
    const aiVector3D key(point.x + 0.0f, point.y + 0.0f, point.z + 0.0f);  // turns -0 into 0
    std::size_t slot = hash(key) & (slots_.size() - 1);
    while (slots_[slot] != kFree && keys_[slots_[slot]] != key) slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] == kFree) {
      slots_[slot] = static_cast<std::uint32_t>(keys_.size());
      keys_.push_back(key);
    }
    return slots_[slot];
  }

  std::vector<Vec3> points() const {
    std::vector<Vec3> result;
    result.reserve(keys_.size());
    for (const aiVector3D& key : keys_) result.emplace_back(key.x, key.y, key.z);
    return result;
  }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  static std::size_t hash(const aiVector3D& key) {
    std::uint64_t mixed = 0;
    for (const float coordinate : {key.x, key.y, key.z}) {
      mixed = (mixed ^ std::bit_cast<std::uint32_t>(coordinate)) * 0x9E3779B97F4A7C15u;
      mixed ^= mixed >> 29;
    }
    return mixed;
  }

  std::vector<std::uint32_t> slots_;
  std::vector<aiVector3D> keys_;
};

/// Calls visit(mesh, transform) for the meshes of a node and of all nodes below it.
template <typename Visit>
void forEachMesh(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, const Visit& visit) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) visit(*scene.mMeshes[node.mMeshes[m]], transform);
  for (unsigned c = 0; c < node.mNumChildren; ++c) forEachMesh(scene, *node.mChildren[c], transform, visit);
}

/// Assimp turns coordinates beyond single precision into infinity.
void requireUsable(float coordinate, std::size_t triangle, const std::string& file) {
  if (std::abs(coordinate) <= TriangleMesh::kMaxCoordinate) return;
  std::ostringstream message;
  message << file << ": triangle " << triangle << " (counted from 0) has a coordinate that is ";
  if (std::isnan(coordinate)) {
    message << "NaN";
  } else if (std::isinf(coordinate)) {
    message << "infinite, or beyond the range of 32-bit floats";
  } else {
    message << coordinate << ", beyond " << TriangleMesh::kMaxCoordinate;
  }
  throw std::runtime_error(message.str());
}

TriangleMesh joined(const aiScene& scene, const std::string& file) {
  std::size_t corners = 0;
  forEachMesh(scene, *scene.mRootNode, aiMatrix4x4(),
              [&](const aiMesh& mesh, const aiMatrix4x4&) { corners += mesh.mNumVertices; });
  PointIndex points(corners);
  std::vector<TriangleMesh::Indices> triangles;
  forEachMesh(scene, *scene.mRootNode, aiMatrix4x4(), [&](const aiMesh& mesh, const aiMatrix4x4& transform) {
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // a point or a line
      TriangleMesh::Indices indices{};
      for (int corner = 0; corner < 3; ++corner) {
        aiVector3D point = mesh.mVertices[face.mIndices[corner]];
        if (!transform.IsIdentity()) point = transform * point;
        for (const float coordinate : {point.x, point.y, point.z}) {
          requireUsable(coordinate, triangles.size(), file);
        }
        indices[corner] = points.indexOf(point);
      }
      triangles.push_back(indices);
    }
  });
  if (triangles.empty()) throw std::runtime_error(file + ": the file has no triangles");
  try {
    return TriangleMesh(points.points(), std::move(triangles));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

/// A scene of one mesh, as assimp's exporters need it.
std::unique_ptr<aiScene> sceneOf(const TriangleMesh& mesh) {
  auto scene = std::make_unique<aiScene>();
  scene->mNumMaterials = 1;
  scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene->mNumMeshes = 1;
  scene->mMeshes = new aiMesh* [1] { new aiMesh };
  scene->mRootNode = new aiNode("mesh");
  scene->mRootNode->mNumMeshes = 1;
  scene->mRootNode->mMeshes = new unsigned[1]{0};

  aiMesh& target = *scene->mMeshes[0];
  target.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  target.mNumVertices = static_cast<unsigned>(mesh.vertices().size());
  target.mVertices = new aiVector3D[mesh.vertices().size()];
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v) {
    const Eigen::Vector3f point = mesh.vertices()[v].cast<float>();
    target.mVertices[v] = {point.x(), point.y(), point.z()};
  }
  target.mNumFaces = static_cast<unsigned>(mesh.triangleCount());
  target.mFaces = new aiFace[mesh.triangleCount()];
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleMesh::Indices& corners = mesh.triangles()[t];
    target.mFaces[t].mNumIndices = 3;
    target.mFaces[t].mIndices = new unsigned[3]{corners[0], corners[1], corners[2]};
  }
  return scene;
}

/// assimp's error messages, on one line.
std::string oneLine(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return message;
}

/// Throws if a face has a corner that is not a vertex: assimp does not check this.
void requireVertices(const aiScene& scene, const std::string& file) {
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
      for (const unsigned corner : std::span(face.mIndices, face.mNumIndices)) {
        if (corner < mesh->mNumVertices) continue;
        throw std::runtime_error(file + ": a face has the vertex " + std::to_string(corner) + ", of " +
                                 std::to_string(mesh->mNumVertices));
      }
    }
  }
}

bool hasPolygons(const aiScene& scene) {
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
      if (face.mNumIndices > 3) return true;
    }
  }
  return false;
}

}  // namespace

TriangleMesh readMesh(const std::filesystem::path& file) { return readMesh(file, readBytes(file)); }

TriangleMesh readMesh(const std::filesystem::path& file, std::string_view bytes) {
  const Format& format = formatOf(file);
  format.check(bytes, file.string());
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, format.extension + 1);
  if (scene) requireVertices(*scene, file.string());
  // Assimp treats faces without corners as polygons, and aborts if it has none to divide.
  if (scene && hasPolygons(*scene)) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) {
    throw std::runtime_error(file.string() + ": " + oneLine(importer.GetErrorString()));
  }
  return joined(*scene, file.string());
}

void requireMeshFormat(const std::filesystem::path& file) { formatOf(file); }

void writeMesh(const std::filesystem::path& file, const TriangleMesh& mesh) {
  const Format& format = formatOf(file);
  const std::unique_ptr<aiScene> scene = sceneOf(mesh);
  Assimp::Exporter exporter;
  const aiExportDataBlob* const blob = exporter.ExportToBlob(scene.get(), format.exporter);
  if (!blob)
    throw std::runtime_error(file.string() + ": cannot be written: " + oneLine(exporter.GetErrorString()));
  writeFile(file, {static_cast<const char*>(blob->data), blob->size});
}

}  // namespace octoblisk::demos
