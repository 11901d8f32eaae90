// Input of the ranks: read once per node, then shared in the memory of all its ranks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "octoblisk/clustered_octree.h"
#include "study/ranks.h"

namespace octoblisk::demos {

/// The tree of a mesh file. It is built once per node and shared there if possible; each rank has a copy of
/// the mesh. Throws as readMesh and ClusteredOctree::build do, on all ranks.
ClusteredOctree treeOncePerNode(Ranks& ranks, const std::filesystem::path& mesh_file,
                                const BuildOptions& options = {});
/// The same for a mesh that is generated, or read and repaired, on one rank of each node.
ClusteredOctree treeOncePerNode(Ranks& ranks, const std::function<TriangleMesh()>& make_mesh,
                                const BuildOptions& options = {});

/// Poses, and the owner of their memory.
struct SharedPoses {
  std::span<const Pose> poses;
  std::shared_ptr<const void> owner;
};

/// Throws as readPoses does, on all ranks.
SharedPoses posesOncePerNode(Ranks& ranks, const std::filesystem::path& pose_file);

/// Covers the bits of the coordinates, and the triangles in their order.
std::uint64_t fingerprintOf(const TriangleMesh& mesh);
std::uint64_t fingerprintOf(std::span<const Pose> poses);

}  // namespace octoblisk::demos
