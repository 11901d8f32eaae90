#include "octoblisk/tree_blob.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string>

#include "base/checksum.h"
#include "base/file.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

constexpr std::size_t kAlignment = 64;
constexpr std::array<char, 8> kMagic = {'O', 'c', 't', 'o', 'B', 'l', 's', 'k'};
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kByteOrder = 0x01020304;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t byte_order = kByteOrder;
  std::uint64_t checksum = 0;  ///< of everything after it
  std::uint64_t bytes = 0;     ///< of the whole blob
  std::uint64_t mesh_vertices = 0;
  std::uint64_t mesh_triangles = 0;
  std::uint64_t mesh_checksum = 0;
  std::uint64_t nodes = 0;
  std::uint64_t parts = 0;  ///< entries of part_of_triangle
  std::uint64_t seed = 0;
  std::uint32_t storage = 0;
  std::uint32_t partition = 0;
  std::uint32_t quality = 0;
  std::int32_t leaf_capacity = 0;
  std::int32_t clusters = 0;
  std::uint32_t zeros[7] = {};
};
static_assert(sizeof(Header) == 128 && offsetof(Header, checksum) == 16 && offsetof(Header, bytes) == 24);

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument(what); }

/// The positions of the arrays.
struct BlobLayout {
  struct Section {
    std::size_t begin = 0, bytes = 0;
  };
  Section nodes, order, leaf_vertices, parts;
  std::size_t bytes;

  BlobLayout(bool is_compact, std::size_t node_count, std::size_t triangles, std::size_t part_count)
      : bytes(sizeof(Header)) {
    nodes = section(node_count * (is_compact ? sizeof(CompactNode) : sizeof(TreeNode)));
    order = section(triangles * sizeof(std::uint32_t));
    leaf_vertices = section(is_compact ? 0 : leafVerticesSize(triangles) * sizeof(float));
    parts = section(part_count * sizeof(std::int32_t));
  }

 private:
  Section section(std::size_t size) {
    const std::size_t begin = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    bytes = begin + size;
    return {begin, size};
  }
};

std::uint64_t checksumOf(const TriangleMesh& mesh) {
  return xxh64(std::as_bytes(std::span(mesh.triangles())), xxh64(std::as_bytes(std::span(mesh.vertices()))));
}

std::uint64_t checksumOf(std::span<const std::byte> blob) {
  return xxh64(blob.subspan(offsetof(Header, bytes)));
}

template <typename Element>
std::span<const Element> elementsOf(std::span<const std::byte> blob, const BlobLayout::Section& section) {
  return {reinterpret_cast<const Element*>(blob.data() + section.begin), section.bytes / sizeof(Element)};
}

/// The header of a blob that is intact and belongs to the mesh.
Header checkedHeader(std::span<const std::byte> blob, const TriangleMesh& mesh) {
  Header header;
  if (blob.size() < sizeof(Header)) {
    fail("is cut off: it has " + std::to_string(blob.size()) + " bytes, less than a header");
  }
  std::memcpy(&header, blob.data(), sizeof(Header));
  if (header.magic != kMagic) fail("is not a tree: it does not begin with the magic OctoBlsk");
  if (header.byte_order != kByteOrder) fail("was made on a machine of another byte order");
  if (header.version != kVersion) {
    fail("has format version " + std::to_string(header.version) + ", but this library reads version " +
         std::to_string(kVersion));
  }
  if (header.bytes != blob.size()) {
    fail("is cut off or padded: it has " + std::to_string(blob.size()) + " bytes of " +
         std::to_string(header.bytes));
  }
  if (header.checksum != checksumOf(blob)) fail("is damaged: its checksum is wrong");
  if (std::ranges::count(header.zeros, 0u) != std::ssize(header.zeros))
    fail("has reserved words that are not 0");
  if (header.mesh_triangles != mesh.triangleCount() || header.mesh_vertices != mesh.vertices().size()) {
    fail("belongs to another mesh, of " + std::to_string(header.mesh_triangles) + " triangles and " +
         std::to_string(header.mesh_vertices) + " vertices: this one has " +
         std::to_string(mesh.triangleCount()) + " and " + std::to_string(mesh.vertices().size()));
  }
  if (header.mesh_checksum != checksumOf(mesh)) {
    fail("belongs to another mesh, with as many triangles and vertices but other indices or coordinates");
  }
  return header;
}

BuildOptions optionsOf(const Header& header) {
  const auto check = [](const char* name, std::uint32_t value) {
    if (value > 1) fail("has the unknown " + std::string(name) + ' ' + std::to_string(value));
  };
  check("storage", header.storage);
  check("partition", header.partition);
  check("quality", header.quality);
  BuildOptions options;
  options.storage = static_cast<Storage>(header.storage);
  options.partition = static_cast<PartitionKind>(header.partition);
  options.quality = static_cast<BuildQuality>(header.quality);
  options.leaf_capacity = header.leaf_capacity;
  options.clusters = header.clusters;
  options.seed = header.seed;
  return options;
}

/// A copy at a properly aligned address.
std::shared_ptr<const std::byte> alignedCopy(std::span<const std::byte> bytes) {
  constexpr std::align_val_t kAligned{kAlignment};
  const std::shared_ptr<std::byte> copy(static_cast<std::byte*>(::operator new(bytes.size() + 1, kAligned)),
                                        [](std::byte* memory) { ::operator delete(memory, kAligned); });
  if (!bytes.empty()) std::memcpy(copy.get(), bytes.data(), bytes.size());
  return copy;
}

/// The tree of aligned bytes. Its exceptions lack the name of the blob.
ClusteredOctree octreeOf(std::span<const std::byte> blob, std::shared_ptr<const TriangleMesh> mesh,
                         std::shared_ptr<const void> owner) {
  if (!mesh) fail("needs the mesh that it was built for");
  const Header header = checkedHeader(blob, *mesh);
  BuildOptions options = optionsOf(header);
  const bool is_compact = options.storage == Storage::compact;
  const std::size_t triangles = mesh->triangleCount();
  if (header.nodes == 0 || header.nodes > triangles + 1)
    fail("has " + std::to_string(header.nodes) + " nodes for " + std::to_string(triangles) + " triangles");
  if (header.parts != 0 && header.parts != triangles)
    fail("has " + std::to_string(header.parts) + " parts for " + std::to_string(triangles) + " triangles");
  const BlobLayout layout(is_compact, header.nodes, triangles, header.parts);
  if (layout.bytes != blob.size()) {
    fail("has " + std::to_string(blob.size()) + " bytes, but its arrays need " +
         std::to_string(layout.bytes));
  }
  const auto parts = elementsOf<std::int32_t>(blob, layout.parts);
  options.part_of_triangle.assign(parts.begin(), parts.end());
  TreeArrays arrays;
  if (is_compact) {
    arrays.compact_nodes = elementsOf<CompactNode>(blob, layout.nodes);
  } else {
    arrays.nodes = elementsOf<TreeNode>(blob, layout.nodes);
  }
  arrays.triangle_order = elementsOf<std::uint32_t>(blob, layout.order);
  arrays.leaf_vertices = elementsOf<float>(blob, layout.leaf_vertices);
  try {
    return octreeOver(std::move(mesh), arrays, std::move(owner), options);
  } catch (const std::invalid_argument& error) {
    fail(std::string("is not a tree: ") + error.what());
  }
}

ClusteredOctree namedTree(const std::string& name, std::span<const std::byte> blob,
                          std::shared_ptr<const TriangleMesh> mesh, std::shared_ptr<const void> owner) {
  try {
    return octreeOf(blob, std::move(mesh), std::move(owner));
  } catch (const std::invalid_argument& error) {
    fail(name + ' ' + error.what());
  }
}

}  // namespace

std::vector<std::byte> toBlob(const ClusteredOctree& octree) {
  const Tree& tree = treeOf(octree);
  const TreeArrays& arrays = tree.arrays();
  const BuildOptions& options = tree.options();
  const BlobLayout layout(tree.isCompact(), tree.nodeCount(), tree.triangleOrder().size(),
                          options.part_of_triangle.size());
  std::vector<std::byte> blob(layout.bytes);  // zeros between the sections
  const auto write = [&](const BlobLayout::Section& section, std::span<const std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(blob.data() + section.begin, bytes.data(), section.bytes);
  };
  write(layout.nodes, tree.isCompact() ? std::as_bytes(arrays.compact_nodes) : std::as_bytes(arrays.nodes));
  write(layout.order, std::as_bytes(arrays.triangle_order));
  write(layout.leaf_vertices, std::as_bytes(arrays.leaf_vertices));
  write(layout.parts, std::as_bytes(std::span(options.part_of_triangle)));

  Header header;
  header.bytes = blob.size();
  header.mesh_vertices = tree.mesh().vertices().size();
  header.mesh_triangles = tree.mesh().triangleCount();
  header.mesh_checksum = checksumOf(tree.mesh());
  header.nodes = tree.nodeCount();
  header.parts = options.part_of_triangle.size();
  header.seed = options.seed;
  header.storage = static_cast<std::uint32_t>(options.storage);
  header.partition = static_cast<std::uint32_t>(options.partition);
  header.quality = static_cast<std::uint32_t>(options.quality);
  header.leaf_capacity = options.leaf_capacity;
  header.clusters = options.clusters;
  std::memcpy(blob.data(), &header, sizeof(Header));
  header.checksum = checksumOf(blob);
  std::memcpy(blob.data(), &header, sizeof(Header));
  return blob;
}

ClusteredOctree fromBlob(std::span<const std::byte> blob, std::shared_ptr<const TriangleMesh> mesh,
                         std::shared_ptr<const void> owner) {
  const std::string name = "the tree blob";
  if (!owner) {
    const std::shared_ptr<const std::byte> copy = alignedCopy(blob);
    return namedTree(name, {copy.get(), blob.size()}, std::move(mesh), copy);
  }
  if (reinterpret_cast<std::uintptr_t>(blob.data()) % kAlignment != 0)
    fail(name + " does not begin at a multiple of " + std::to_string(kAlignment));
  return namedTree(name, blob, std::move(mesh), std::move(owner));
}

void saveTree(const ClusteredOctree& tree, const std::filesystem::path& file) {
  writeFile(file, toBlob(tree));
}

ClusteredOctree mapTree(const std::filesystem::path& file, std::shared_ptr<const TriangleMesh> mesh) {
  const auto mapping = std::make_shared<const MappedFile>(file);
  return namedTree(file.string(), mapping->bytes(), std::move(mesh), mapping);
}

}  // namespace octoblisk
