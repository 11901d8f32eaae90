// Bullet's contacts between a blisk and a belt grinder that moves along a path. One cell per thread.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "grinding/verdict.h"

namespace octoblisk::demos {

class Obstacles;

class GrindingCell {
 public:
  /// Touches are reported up to the reach of each part (mm, > 0). With the blades that a part may touch
  /// (`obstacles`, which must outlive the cell; null: none), only contacts that touch are reported or, if
  /// there are none, the nearest pair: a belt has too many near pairs with a surface that it rolls on.
  GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
               std::vector<double> reaches, const Obstacles* obstacles = nullptr);
  ~GrindingCell();
  GrindingCell(const GrindingCell&) = delete;
  GrindingCell& operator=(const GrindingCell&) = delete;

  /// The contacts at a pose, found by the algorithms that Bullet's dispatcher has chosen for the pairs of
  /// bodies (register.h): all of them (all_contacts.h), not only the few that a manifold keeps. They are
  /// ordered by part, then by triangle; those with what a part may touch come first. Their triangles are
  /// those of the surroundings (fixture.h); blades, depths and verdicts are not set. The answer does not
  /// depend on earlier poses.
  std::vector<Touch> touchesAt(const Pose& tool_in_blisk);

 private:
  void addAllowed(std::size_t part, const Pose& tool_in_blisk, std::vector<Touch>& found);

  struct World;
  std::shared_ptr<const ClusteredOctree> blisk_;
  std::vector<ToolPart> parts_;
  std::vector<double> reaches_;
  const Obstacles* obstacles_;
  std::unique_ptr<World> world_;
};

/// Reduces the touches of each part with each body to a few of each contact patch
/// (contact/contact_patches.h), ordered by part, then by body, and sets their bodies. The deepest contact of
/// a part with a body is always kept, so a pose's verdict is the same as with all contacts.
/// `body_of_triangle` is that of Surroundings (fixture.h).
std::vector<Touch> reduceContacts(std::span<const Touch> touches, std::span<const int> body_of_triangle);

}  // namespace octoblisk::demos
