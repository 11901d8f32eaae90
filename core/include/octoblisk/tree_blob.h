// Built trees as bytes: saved to a file, and used where they lie there: read once to be checked, never
// copied.
//
// A blob holds the tree and a fingerprint of the mesh, not the mesh. It is bound to this format's version, to
// the machine's byte order and to the mesh, and carries a checksum (XXH64, checksum.h) over all of it: a
// blob that was cut, changed or made for another mesh is refused, and so is one that is forged so that a
// query could fail on it. That its boxes are right, validate() tells.
//
// Layout: a header of 128 bytes (magic "OctoBlsk", version, byte order, at byte 16 the checksum of all bytes
// from 24 on, counts, options), then nodes, triangle order, corners in leaves, and the parts of BuildOptions;
// each begins at a multiple of 64. The same tree gives the same bytes; `threads` of its options is not kept.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

/// The tree as bytes, with a version, a checksum and the fingerprint of its mesh, which is not among them.
std::vector<std::byte> toBlob(const ClusteredOctree& tree);

/// The tree of a blob, over the mesh that it was built for. Without an owner the bytes are copied; with one,
/// which keeps them and never changes them, they are used where they are and must begin at a multiple of 64.
/// Throws std::invalid_argument that tells what is wrong with the blob, or for no mesh.
ClusteredOctree fromBlob(std::span<const std::byte> blob, std::shared_ptr<const TriangleMesh> mesh,
                         std::shared_ptr<const void> owner = nullptr);

/// Writes the blob to a file: to a new one beside it, which then takes its name, so that trees mapped from
/// the file as it was stay whole. Throws std::runtime_error that names the file where it cannot be written.
void saveTree(const ClusteredOctree& tree, const std::filesystem::path& file);

/// The tree in a file, used where it is: the file is mapped to memory until the last tree over it is gone,
/// and must not be changed meanwhile but by saveTree. Throws std::runtime_error where it cannot be opened,
/// std::invalid_argument as fromBlob does; both name the file.
ClusteredOctree mapTree(const std::filesystem::path& file, std::shared_ptr<const TriangleMesh> mesh);

}  // namespace octoblisk
