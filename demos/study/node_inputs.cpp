#include "study/node_inputs.h"

#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/checksum.h"
#include "io/mesh_file.h"
#include "octoblisk/tree_blob.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

static_assert(sizeof(Pose) == 12 * sizeof(double) && std::is_standard_layout_v<Pose>);

/// Packs arrays one after another, each aligned and preceded by its size.
class Packer {
 public:
  template <typename Element>
  void add(std::span<const Element> elements) {
    const std::uint64_t size = elements.size_bytes();
    addBytes(std::as_bytes(std::span(&size, 1)));
    addBytes(std::as_bytes(elements));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void addBytes(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    bytes_.resize((bytes_.size() + kSharedAlignment - 1) / kSharedAlignment * kSharedAlignment);
  }

  std::vector<std::byte> bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <typename Element>
  std::span<const Element> next() {
    std::uint64_t size = 0;
    std::memcpy(&size, takeBytes(sizeof(size)).data(), sizeof(size));
    const std::span<const std::byte> bytes = takeBytes(size);
    return {reinterpret_cast<const Element*>(bytes.data()), bytes.size() / sizeof(Element)};
  }

 private:
  std::span<const std::byte> takeBytes(std::size_t size) {
    const std::span<const std::byte> taken = rest_.first(size);
    const std::size_t room = (size + kSharedAlignment - 1) / kSharedAlignment * kSharedAlignment;
    rest_ = rest_.subspan(room);
    return taken;
  }

  std::span<const std::byte> rest_;
};

ClusteredOctree builtTree(const std::function<TriangleMesh()>& make_mesh, const BuildOptions& options) {
  return ClusteredOctree::build(std::make_shared<const TriangleMesh>(make_mesh()), options);
}

std::vector<std::byte> packedTree(const ClusteredOctree& tree) {
  Packer packer;
  packer.add(std::span(tree.mesh().vertices()));
  packer.add(std::span(tree.mesh().triangles()));
  packer.add(std::span<const std::byte>(toBlob(tree)));
  return packer.take();
}

template <typename Element>
std::vector<Element> copyOf(std::span<const Element> elements) {
  return {elements.begin(), elements.end()};
}

ClusteredOctree unpackedTree(const SharedBytes& shared) {
  Unpacker unpacker(shared.bytes);
  const auto vertices = unpacker.next<Vec3>();
  const auto triangles = unpacker.next<TriangleMesh::Indices>();
  const auto blob = unpacker.next<std::byte>();
  return fromBlob(blob, std::make_shared<const TriangleMesh>(copyOf(vertices), copyOf(triangles)),
                  shared.owner);
}

}  // namespace

ClusteredOctree treeOncePerNode(Ranks& ranks, const std::filesystem::path& mesh_file,
                                const BuildOptions& options) {
  return treeOncePerNode(
      ranks, [&] { return readMesh(mesh_file); }, options);
}

ClusteredOctree treeOncePerNode(Ranks& ranks, const std::function<TriangleMesh()>& make_mesh,
                                const BuildOptions& options) {
  if (ranks.count() == 1) return builtTree(make_mesh, options);
  const SharedBytes shared = ranks.oncePerNode([&] { return packedTree(builtTree(make_mesh, options)); });
  std::optional<ClusteredOctree> tree;
  ranks.together([&] { tree = unpackedTree(shared); });
  return *std::move(tree);
}

SharedPoses posesOncePerNode(Ranks& ranks, const std::filesystem::path& pose_file) {
  if (ranks.count() == 1) {
    const auto poses = std::make_shared<const std::vector<Pose>>(readPoses(pose_file));
    return {*poses, poses};
  }
  const SharedBytes shared = ranks.oncePerNode([&] {
    Packer packer;
    packer.add(std::span<const Pose>(readPoses(pose_file)));
    return packer.take();
  });
  return {Unpacker(shared.bytes).next<Pose>(), shared.owner};
}

std::uint64_t fingerprintOf(const TriangleMesh& mesh) {
  return xxh64(std::as_bytes(std::span(mesh.triangles())), xxh64(std::as_bytes(std::span(mesh.vertices()))));
}

std::uint64_t fingerprintOf(std::span<const Pose> poses) { return xxh64(std::as_bytes(poses)); }

}  // namespace octoblisk::demos
