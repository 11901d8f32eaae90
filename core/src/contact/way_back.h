// Keeps contacts from pulling a body through an open surface.
#pragma once

#include <optional>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/function_ref.h"
#include "octoblisk/types.h"

namespace octoblisk::detail {

/// A contact of a triangle pushes a body out by the shortest way. If the body is more than halfway through an
/// open surface, this is the way through it. WayBack follows two bodies A and B from step to step, so that
/// their contacts push them back the way they came.
class WayBack {
 public:
  /// The normals of a contact's triangles in A's frame, of any length: of those triangles that belong to an
  /// open surface. The others are zero.
  struct Normals {
    Vec3 of_a = Vec3::Zero();
    Vec3 of_b = Vec3::Zero();
  };

  /// Call this for all contacts of bodies that overlap. Removes those that do not push the bodies back. If no
  /// contact remains, turns the deepest of these instead. The way back is perpendicular to the open surface.
  /// It leads to the side
  /// - to which the nearest contact of the last step pushed, or if there was none,
  /// - from which B has come since the last step, in which they were apart.
  /// If that contact pushed along the surface, or B came along the surface, the way back is unknown, and the
  /// contact stays. `to_last` takes points of B, in A's frame, to where they were in the last step. Allocates
  /// nothing once warm.
  void pushBack(std::vector<Contact>& contacts, const Pose& to_last,
                FunctionRef<Normals(const Contact& contact)> normals_at) const;

  /// Call this in each step for all contacts, after pushBack.
  void endStep(const std::vector<Contact>& contacts) { last_ = contacts; }

  /// Whether the last step had no contacts, or is not known.
  bool isNew() const { return last_.empty(); }

  /// Discards the last step.
  void forget() { last_.clear(); }

 private:
  struct Way {
    Vec3 direction;   ///< of A; unit
    double distance;  ///< of the bodies along the direction; <= 0
  };

  std::optional<Way> wayAt(const Contact& contact, const Normals& normals, const Pose& to_last) const;

  std::vector<Contact> last_;  // of the last step
};

}  // namespace octoblisk::detail
