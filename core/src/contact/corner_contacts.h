// The contacts of one mesh's corners with another mesh's faces.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "contact/inside_corners.h"
#include "contact/mesh_features.h"
#include "contact/near_features.h"
#include "octoblisk/contact.h"
#include "octoblisk/raycast.h"

namespace octoblisk::detail {

/// A corner outside a solid has a contact with each face over which it is. A corner inside has one with the
/// nearest point of the surface. If that point cannot push the corner, the contact is with the face straight
/// ahead along the normal of a face that a triangle at the corner meets. A corner near a sheet has a contact
/// with each face over which it is, on the side where it belongs, and a corner past a sheet has one straight
/// back. All normals are in the corners' cones of directions, except straight back.
class CornerContacts {
 public:
  /// The mesh of the corners, the other mesh, and what NearFeatures has found of them.
  struct Meshes {
    const MeshFeatures &own, &other;
    Pose own_in_a, other_in_a;  ///< those of the search
    Pose own_in_other;
    std::optional<Pose> when_apart;  ///< own_in_other before the meshes met, if that is known
    std::span<const CornerAndFace> pairs;
    std::span<const TrianglePair> meeting;
    std::uint32_t TrianglePair::*own_triangle, TrianglePair::*other_triangle;

    Vec3 position(std::uint32_t corner) const { return own_in_other * own.position(corner); }
    bool isPushedAlong(std::uint32_t corner, const Vec3& direction) const {
      return own.isPushedAlong(corner, own_in_other.rotation.transpose() * direction);
    }
  };

  /// Finds the contacts of the corners (A) with the other mesh (B), in its frame, within `reach`. Lengths up
  /// to `not_felt` have no effect. The result is valid until the next call. Allocates nothing once warm.
  std::span<const Contact> find(const Meshes& meshes, double reach, double not_felt) &;

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  /// A face that can push a corner.
  struct Push {
    CornerAndFace pair;
    Vec3 normal;
    double height;
  };
  /// A corner inside that the nearest point of the surface cannot push, and a face that can.
  struct WayBack {
    std::uint32_t corner;
    Vec3 to_nearest;  ///< the direction to that point
    std::uint32_t face = kNoTriangle;
    Vec3 normal = Vec3::Zero();
    double length = kFar;  ///< of the way
    double height = 0.0;   ///< over the face
  };
  /// A corner past a sheet, and the direction back.
  struct Past {
    std::uint32_t corner;
    Vec3 out;
    double depth;  ///< under the plane of the triangle that meets the sheet
  };

  bool isOver(const Triangle& face, const Vec3& foot, double height) const;
  void add(const Meshes& meshes, const CornerAndFace& pair, const Vec3& normal, double height);
  void addOverSheet(const Meshes& meshes, const CornerAndFace& pair, const Triangle& face,
                    const Vec3& normal);
  double sideOf(const Meshes& meshes, std::uint32_t corner, const Vec3& on_plane, const Vec3& normal);
  void addPastSheets(const Meshes& meshes);
  void findInside(const Meshes& meshes);
  std::optional<Vec3> wayOfSheet(const Meshes& meshes, std::uint32_t corner) const;
  void addWayOut(const Meshes& meshes, std::uint32_t corner);
  void addWaysBack(const Meshes& meshes);

  double reach_ = 0.0, not_felt_ = 0.0;
  std::vector<double> least_height_;  // per corner: the nearest to 0, over a solid's face that can push it
  std::vector<Push> pushes_;
  std::vector<std::uint32_t> seeds_;
  InsideCorners inside_;
  std::vector<WayBack> ways_back_;
  std::vector<Past> past_;
  std::vector<RayHit> hits_;
  std::vector<Contact> contacts_;
};

}  // namespace octoblisk::detail
