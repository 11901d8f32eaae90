// A headless Bullet world with a blisk, in which a belt grinder moves along a path. One per thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"

namespace octoblisk::demos {

class Obstacles;

/// A part of the tool. Its mesh is in the tool's frame, mm.
struct ToolPart {
  std::string name;
  std::shared_ptr<const ClusteredOctree> tree;
  std::optional<double> belt_speed = {};  ///< m/s, if the part is a running belt (belt_loop.h); none: unknown
};

/// A contact, or a near miss, of a part with the blisk. A is the blisk, B the part. Points and normal are in
/// the blisk's frame (mm); the normal points from the part into the blisk.
struct PartContact {
  std::size_t part = 0;  ///< index of the tool part
  Contact contact;
};

class GrindingCell {
 public:
  /// Contacts are reported up to the distance `reach` (mm, > 0).
  GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts, double reach);

  /// The same with one reach per part.
  GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
               std::vector<double> reaches);

  /// The same, except for the blades that a part may touch (obstacles.h, which must outlive it): with these
  /// only its touches are reported or, if there are none, the nearest pair. A belt has too many near pairs
  /// with a surface that it rolls on.
  GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
               std::vector<double> reaches, const Obstacles& obstacles);
  ~GrindingCell();
  GrindingCell(const GrindingCell&) = delete;
  GrindingCell& operator=(const GrindingCell&) = delete;

  const ClusteredOctree& blisk() const;
  const std::vector<ToolPart>& parts() const { return parts_; }

  /// Moves the tool to the pose and has Bullet's world detect all collisions. For the pairs that the
  /// broadphase (clustered_octree_broadphase.h) finds, the dispatcher runs the algorithm set by
  /// registerAlgorithm (register.h); all its contacts are returned (all_contacts.h), not only the few that a
  /// manifold keeps. They are ordered by part, then by triangle; with obstacles, contacts with what a part
  /// may touch come first. The answer does not depend on earlier poses.
  std::vector<PartContact> contactsAt(const Pose& tool_in_blisk);

  /// The number of pairs of bodies whose algorithm ran for the last pose.
  std::size_t pairsDispatched() const;

 private:
  void addTouches(std::size_t part, const Pose& tool_in_blisk, std::vector<PartContact>& found);

  class World;
  std::vector<ToolPart> parts_;
  std::vector<double> reaches_;
  const Obstacles* obstacles_ = nullptr;
  std::unique_ptr<World> world_;
};

}  // namespace octoblisk::demos
