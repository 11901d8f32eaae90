// What ranks read: once a node, then in the memory of all its ranks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "study/ranks.h"

namespace octoblisk::demos {

/// The tree of a mesh file. It is built once a node and used by all where it is; each rank has a copy of the
/// mesh. Throws as readMesh and ClusteredOctree::build do, at all ranks.
ClusteredOctree treeOnceANode(Ranks& ranks, const std::filesystem::path& mesh_file,
                              const BuildOptions& options = {});
/// Of a mesh that is made, or read and mended, at one rank of each node.
ClusteredOctree treeOnceANode(Ranks& ranks, const std::function<TriangleMesh()>& make_mesh,
                              const BuildOptions& options = {});

/// Poses, and who keeps them.
struct SharedPoses {
  std::span<const Pose> poses;
  std::shared_ptr<const void> owner;
};

/// Throws as readPoses does, at all ranks.
SharedPoses posesOnceANode(Ranks& ranks, const std::filesystem::path& pose_file);

/// Of the coordinates' bits and the triangles in their order.
std::uint64_t fingerprintOf(const TriangleMesh& mesh);
std::uint64_t fingerprintOf(std::span<const Pose> poses);

}  // namespace octoblisk::demos
