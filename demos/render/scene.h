// The content of a picture: meshes, and marks (lines, points, arrows) of a constant width on paper.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"
#include "render/image.h"

namespace octoblisk::demos {

/// The look of a mark. Widths are in points of a picture 1200 points high, so pictures of any size look
/// alike.
struct MarkStyle {
  Color color;
  float width = 2.0f;           ///< of a line; the diameter of a point
  float hidden_opacity = 0.0f;  ///< opacity where opaque surfaces hide the mark, 0 to 1
  bool halo = false;            ///< whether a white outline separates it from the background
};

/// Everything in the picture, in the scene's frame. It keeps copies, so arguments need not outlive a call.
class Scene {
 public:
  /// A surface of one colour. An opacity below 1 makes it transparent. Throws std::invalid_argument if the
  /// opacity is not in (0, 1].
  void addMesh(const TriangleMesh& mesh, const Pose& mesh_in_scene, Color color, float opacity = 1.0f);

  /// A surface with one colour per triangle. Throws std::invalid_argument if the numbers of colours and
  /// triangles differ, or as above.
  void addMesh(const TriangleMesh& mesh, const Pose& mesh_in_scene, std::span<const Color> triangle_colors,
               float opacity = 1.0f);

  /// The twelve edges of each box.
  void addBoxes(std::span<const Obb> boxes, const MarkStyle& style);

  /// A ball at each point.
  void addPoints(std::span<const Vec3> points, const MarkStyle& style);

  /// The line through the points, in order.
  void addPolyline(std::span<const Vec3> points, const MarkStyle& style);

  /// An arrow whose tip is at `to`. The size of the head depends on the style's width, not on the arrow's
  /// length.
  void addArrow(const Vec3& from, const Vec3& to, const MarkStyle& style);

  /// The bounds of all meshes and marks; empty for an empty scene.
  const Aabb& bounds() const { return bounds_; }

  /// The vertices of all meshes and the ends of all marks: everything that a camera must see.
  std::vector<Vec3> points() const;

  /// A mesh in the scene's frame.
  struct Solid {
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Indices> triangles;
    std::vector<Color> colors;  ///< one, or one per triangle
    float opacity;
  };

  enum class MarkKind { lines, points, arrows };

  /// Marks of one kind and style. Points: the points. Lines and arrows: their two ends, alternating.
  struct Marks {
    MarkKind kind;
    MarkStyle style;
    std::vector<Vec3> points;
  };

  const std::vector<Solid>& solids() const { return solids_; }
  const std::vector<Marks>& marks() const { return marks_; }

 private:
  void addMarks(Marks marks);

  std::vector<Solid> solids_;
  std::vector<Marks> marks_;
  Aabb bounds_;
};

}  // namespace octoblisk::demos
