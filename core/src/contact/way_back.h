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
/// an open surface, that way leads to the far side. WayBack remembers where a body B was when it was on the
/// right side of another body A. It makes the contacts of a convex B push it back there.
class WayBack {
 public:
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

  /// Whether a convex body is on the wrong side of an open surface.
  bool isThrough() const { return state_ == State::through; }

  /// Discards all that is known.
  void forget() { state_ = State::fresh; }

  /// Call this in each step in which the bodies do not overlap, unless a convex body is through and near.
  void noticeApart(const Pose& b_in_a) {
    state_ = State::apart;
    reference_ = b_in_a;
  }

  /// Call this if the bodies already overlap at the start of a step, and nothing shows their sides. Contacts
  /// stay as they are until the bodies are apart.
  void noticeOverlap() { state_ = State::unknown; }

  /// Call this in the other steps. If isNew() or lastApart(), `start` is a pose of B in A in which the bodies
  /// were apart: it remains the reference as long as they overlap.
  void noticeTouch(const Pose& start) {
    if (state_ != State::fresh && state_ != State::apart) return;
    state_ = State::touching;
    reference_ = start;
  }

  /// B, if it is convex, in its own frame.
  struct ConvexBody {
    Vec3 middle;  ///< a point well inside
    FindFeet feet;
    double radius;
  };

  /// Where the way between two points crosses A first, if that is an open surface; all in A's frame.
  using FindCrossing = FunctionRef<std::optional<RayHit>(const Vec3& from, const Vec3& to)>;

  /// Call this after noticeTouch with all contacts of a convex B. Removes the contacts that push B through an
  /// open surface. `open_triangle` returns A's triangle of a contact if it belongs to one. Adds contacts of
  /// B's feet that are past the surface: the way from where its middle was to such a foot crosses the
  /// surface. If there are none, and no contact remains that overlaps, the deepest of the removed contacts
  /// returns, turned round.
  ///
  /// The right side of a surface is where B's middle was at the start of the step. Once B is through, the
  /// start of that step remains the reference until B is back. A contact that pushes along the surface, e.g.
  /// at its edge, stays, unless B is known to be on the wrong side.
  void pushBack(std::vector<Contact>& contacts, const Pose& b_in_a, const ConvexBody& b,
                FunctionRef<std::optional<Triangle>(const Contact& contact)> open_triangle,
                FindCrossing crossing);

 private:
  void addFeet(const ConvexBody& body, const Pose& now, const Vec3& towards, FindCrossing crossing,
               std::vector<Contact>& contacts) const;

  enum class State {
    fresh,     ///< nothing is known
    unknown,   ///< the bodies overlapped from the start
    apart,     ///< they do not overlap, or a convex body is on the right side
    touching,  ///< they overlap since reference_
    through    ///< a convex body was found on the wrong side since reference_
  };

  State state_ = State::fresh;
  Pose reference_;  // B in A when it was last on the right side; unless fresh or unknown
};

}  // namespace octoblisk::detail
