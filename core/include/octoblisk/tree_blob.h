// Built trees as bytes (blobs). A tree can be saved to a file and used in place: the bytes are read once to
// check them, but never copied.
//
// A blob holds the tree and a fingerprint of the mesh, but not the mesh. It is bound to the format version,
// to the machine's byte order and to the mesh. A checksum (XXH64) covers all of it. fromBlob refuses a blob
// that was truncated, changed, made for another mesh, or forged so that a query could fail on it.
// Only validate() checks that the boxes are right.
//
// Layout: a header of 128 bytes (magic "OctoBlsk", version, byte order, at byte 16 the checksum of all bytes
// from 24 on, counts, options), then nodes, triangle order, corners in leaves, and the parts of BuildOptions.
// Each section begins at a multiple of 64. Equal trees give equal bytes. BuildOptions::threads is not stored.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

/// The tree as bytes.
std::vector<std::byte> toBlob(const ClusteredOctree& tree);

/// The tree of a blob, over the mesh that it was built for. Without an owner, the bytes are copied. With an
/// owner, which must keep the bytes unchanged, they are used in place and must begin at a multiple of 64.
/// Throws std::invalid_argument if the mesh is null or the blob is invalid; the message names the defect.
ClusteredOctree fromBlob(std::span<const std::byte> blob, std::shared_ptr<const TriangleMesh> mesh,
                         std::shared_ptr<const void> owner = nullptr);

/// Writes the blob to a new file beside `file` and then renames it to `file`, so that trees mapped from the
/// old file stay intact. Throws std::runtime_error, which names the file, if it cannot be written.
void saveTree(const ClusteredOctree& tree, const std::filesystem::path& file);

/// The tree in a file, used in place. The file stays mapped to memory until the last tree over it is
/// destroyed; until then only saveTree may replace it, and on Windows nothing can. Throws std::runtime_error
/// if the file cannot be opened, and std::invalid_argument like fromBlob. Both messages name the file.
ClusteredOctree mapTree(const std::filesystem::path& file, std::shared_ptr<const TriangleMesh> mesh);

}  // namespace octoblisk
