// A headless Bullet world with a blisk in it and a belt grinder that is moved along a path. One a thread.
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
  std::optional<double> belt_speed = {};  ///< m/s, of a belt that runs (belt_loop.h); none: not known
};

/// A contact, or a near miss, of a part with the blisk. A is the blisk, B the part: points and normal are in
/// the blisk's frame (mm), the normal points from the part into the blisk.
struct PartContact {
  std::size_t part = 0;  ///< index of the tool part
  Contact contact;
};

class GrindingCell {
 public:
  /// Contacts are reported up to the distance `reach` (mm, > 0).
  GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts, double reach);

  /// The same with a reach for each part.
  GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
               std::vector<double> reaches);

  /// The same, but with what a part may touch (obstacles.h, which must outlive it) only its touches are
  /// reported or, where there are none, the pair that is nearest: the pairs of a belt and a surface that it
  /// rolls on are many.
  GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
               std::vector<double> reaches, const Obstacles& obstacles);
  ~GrindingCell();
  GrindingCell(const GrindingCell&) = delete;
  GrindingCell& operator=(const GrindingCell&) = delete;

  const ClusteredOctree& blisk() const;
  const std::vector<ToolPart>& parts() const { return parts_; }

  /// Moves the tool there and has Bullet's world detect all collisions: for the pairs that the broadphase
  /// (clustered_octree_broadphase.h) finds, the dispatcher runs the algorithm that registerAlgorithm
  /// (register.h) gave it, and all contacts of that are taken (all_contacts.h), not those few that a manifold
  /// keeps. Part by part, by ascending triangles; with obstacles, those with what a part may touch first. The
  /// answer does not depend on the poses before.
  std::vector<PartContact> contactsAt(const Pose& tool_in_blisk);

  /// Pairs of bodies whose algorithm ran for the last pose.
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
