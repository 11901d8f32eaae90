// Keeps contacts from pulling a body through an open surface.
#pragma once

#include <optional>
#include <vector>

#include "contact/foot_contacts.h"
#include "octoblisk/contact.h"
#include "octoblisk/function_ref.h"
#include "octoblisk/raycast.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// A contact pushes a body out of a triangle by the shortest way. Once the body is more than halfway through
/// an open surface, that way leads to the far side. WayBack remembers on which side of each other's surfaces
/// two bodies A and B were, so that their contacts push them back there.
class WayBack {
 public:
  /// The two triangles of a contact in A's frame: those that belong to an open surface.
  struct OpenTriangles {
    std::optional<Triangle> of_a, of_b;
  };

  /// The poses of B in A at the start of a step and now.
  struct Step {
    Pose start, now;
  };

  /// Whether nothing is known about the bodies.
  bool isNew() const { return state_ == State::fresh; }

  /// The pose of B in A for which noticeApart was called last; none if the bodies have overlapped since.
  std::optional<Pose> lastApart() const {
    return state_ == State::apart ? std::optional(reference_) : std::nullopt;
  }

  /// The pose of B in A when it was last on the right side, if the bodies overlap.
  std::optional<Pose> reference() const {
    return state_ == State::touching || state_ == State::through ? std::optional(reference_) : std::nullopt;
  }

  /// Whether a body is on the wrong side of an open surface.
  bool isThrough() const { return state_ == State::through; }

  /// Discards all that is known.
  void forget() { state_ = State::fresh; }

  /// Call this in each step in which the bodies do not overlap, unless a body is through and near.
  void noticeApart(const Pose& b_in_a) {
    state_ = State::apart;
    reference_ = b_in_a;
  }

  /// Call this if the bodies already overlap at the start of a step, and nothing shows their sides. Contacts
  /// stay as they are until the bodies are apart.
  void noticeOverlap() { state_ = State::unknown; }

  /// B, if it is convex, in its own frame.
  struct ConvexBody {
    Vec3 middle;  ///< a point well inside
    FindFeet feet;
    double radius;
  };

  /// Where the way between two points crosses A first, if that is an open surface; all in A's frame.
  using FindCrossing = FunctionRef<std::optional<RayHit>(const Vec3& from, const Vec3& to)>;

  /// Call this with all contacts in a step with neither of these calls. If isNew(), the bodies must have been
  /// apart at the start of the step; likewise after noticeApart, unless B is convex. Removes the contacts
  /// that push a body through an open surface. Adds contacts of a convex body's feet that are past the
  /// surface: the way from where its middle was to such a foot crosses the surface. If there are none, and no
  /// contact remains that overlaps, the deepest of the removed contacts returns, turned round.
  ///
  /// The right side of a surface is where B was at the start of the step. A convex B is represented by its
  /// middle, any other body by its point at the contact. Once a body is through, the start of that step
  /// remains the reference until a convex body is back. For other bodies, the reference is the start of the
  /// first step in which they overlap. A contact that pushes along the surface, e.g. at its edge, stays,
  /// unless a convex body is known to be on the wrong side.
  void pushBack(std::vector<Contact>& contacts, const Step& step, const ConvexBody* convex,
                FunctionRef<OpenTriangles(const Contact& contact)> triangles_at, FindCrossing crossing);

 private:
  void addFeet(const ConvexBody& body, const Pose& now, const Vec3& towards, FindCrossing crossing,
               std::vector<Contact>& contacts) const;

  enum class State {
    fresh,     ///< nothing is known
    unknown,   ///< the bodies overlapped from the start
    apart,     ///< they do not overlap, or a convex body is on the right side
    touching,  ///< they overlap since reference_
    through    ///< a body was found on the wrong side since reference_
  };

  State state_ = State::fresh;
  Pose reference_;  // B in A when it was last on the right side; unless fresh or unknown
};

}  // namespace octoblisk::detail
