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

  /// The poses of B in A at the start of a step and now.
  struct Step {
    Pose start, now;
  };

  /// Whether nothing is known about the last step.
  bool isNew() const { return is_new_; }

  /// Discards all that is known.
  void forget() {
    is_new_ = true;
    home_.reset();
  }

  /// Call this in each step in which the bodies do not overlap.
  void areApart() {
    is_new_ = false;
    home_.reset();
  }

  /// Call this in each step in which the bodies overlap, for all contacts. If nothing is known about the last
  /// step, they must have been apart at the start of this one. Removes the contacts that push a body through
  /// an open surface. If no contact remains, turns the deepest of these instead.
  ///
  /// B belongs on the side of a surface where it was at the start of the step: its `center` if B is convex,
  /// or else its point at the contact. For a convex body whose contact was removed, the start of that step
  /// counts until it is back. For other bodies, the start of the first step in which they overlap counts. A
  /// contact that pushes along the surface, e.g. at its edge, stays, unless a convex body is on the wrong
  /// side.
  void pushBack(std::vector<Contact>& contacts, const Step& step, const std::optional<Vec3>& center,
                FunctionRef<Normals(const Contact& contact)> normals_at);

 private:
  bool is_new_ = true;
  bool is_through_ = false;   // whether a contact was removed since home_
  std::optional<Pose> home_;  // of B in A, on the right side
};

}  // namespace octoblisk::detail
