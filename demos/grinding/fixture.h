// The bodies around the blisk: the tool's parts, and what they must not touch, for example a clamp.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// A part of the tool. Its mesh is in the tool's frame, mm.
struct ToolPart {
  std::string name;
  std::shared_ptr<const ClusteredOctree> tree;
  std::optional<double> belt_speed = {};  ///< m/s, if the part is a running belt (belt_loop.h); none: unknown
};

/// A body that the tool must not touch. Its mesh is in the blisk's frame, in mm, and does not move in it.
struct Fixture {
  std::string name;
  std::shared_ptr<const ClusteredOctree> tree;
};

/// The names of the numbered bodies: 0 is the hub or shroud, then come the blades from 1, then the fixtures.
class BodyNames {
 public:
  explicit BodyNames(int blade_count, std::span<const Fixture> fixtures = {});

  /// "hub or shroud", "blade 3", or the fixture's name.
  std::string nameOf(int body) const;
  /// For a table's column: "0", "3", or the fixture's name.
  std::string cellOf(int body) const;
  bool isFixture(int body) const {
    return body > blade_count_ && body <= blade_count_ + static_cast<int>(fixtures_.size());
  }

 private:
  int blade_count_;
  std::vector<std::string> fixtures_;
};

/// The blisk and the fixtures as one mesh: the blisk's triangles in their order, then those of each fixture.
struct Surroundings {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<int> body_of_triangle;
};

/// The blisk's own mesh if there are no fixtures. `blade_of_triangle` is for the blisk's mesh. Throws
/// std::invalid_argument if blisk and fixtures have too many triangles together.
Surroundings surroundingsOf(const std::shared_ptr<const TriangleMesh>& blisk,
                            std::span<const int> blade_of_triangle, int blade_count,
                            std::span<const Fixture> fixtures);

}  // namespace octoblisk::demos
