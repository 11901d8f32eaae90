// One sample of a picture: the visible surfaces and marks at a point, their light, and the borders between
// samples.
#pragma once

#include <cstdint>

#include "render/camera.h"
#include "render/ray_caster.h"
#include "render/scene.h"

namespace octoblisk::demos {

/// A visible piece of surface.
struct Surface {
  static constexpr std::int32_t kNone = -1;

  Vec3f position = Vec3f::Zero();  ///< local to the view
  Vec3f normal = Vec3f::Zero();    ///< unit, towards the camera
  std::int32_t solid = kNone;      ///< index into Scene::solids()

  explicit operator bool() const { return solid != kNone; }
};

/// What is visible at one point. Colours are linear, not sRGB.
struct Sample {
  static constexpr std::int32_t kNoMark = -1;

  Surface front;                        ///< the first surface, transparent or not
  Surface back;                         ///< the first opaque surface
  Vec3f veil = Vec3f::Zero();           ///< light of the transparent surfaces in front
  float transmittance = 1.0f;           ///< share of light that they let through
  Vec3f back_color = Vec3f::Ones();     ///< of the opaque surface or the background, unlit
  Vec3f mark_color = Vec3f::Zero();     ///< lit
  float mark_opacity = 0.0f;            ///< 1 if the mark is in front of the opaque surface
  Vec3f mark_position = Vec3f::Zero();  ///< local to the view
  std::int32_t mark = kNoMark;          ///< index into Scene::marks()
  std::int32_t point = 0;               ///< index of the mark's point
};

/// The border between two surfaces.
enum class Edge { none, crease, silhouette };

/// The border between two neighbouring samples: none; plain, so that more samples are needed; or outlined, so
/// that a line or halo is drawn there too.
enum class Ending : std::uint8_t { none, plain, outlined };

class Sampler {
 public:
  /// Keeps references to the scene and view. Throws std::runtime_error if the ray tracing library fails.
  Sampler(const Scene& scene, const View& view, float pixels_per_point);

  /// The sample at a point of the picture, in pixels from its top left corner.
  Sample trace(float column, float row) const;

  static constexpr unsigned kPatterns = 16;
  /// The share of the sky visible from a surface, 0 to 1, estimated with a few rays. Each pattern is another
  /// set of rays; together they cover the sky evenly.
  float skyShare(const Surface& surface, unsigned pattern) const;

  /// The sample's linear colour if its opaque surface sees this share of the sky.
  Vec3f color(const Sample& sample, float sky_share) const;

  /// The line, if any, to draw between two surfaces this many pixels apart.
  Edge edgeBetween(const Surface& a, const Surface& b, float pixels_apart) const;

  /// The border between two samples a pixel apart.
  Ending endingBetween(const Sample& a, const Sample& b) const;

  /// Whether `sample` is on a ball behind the ball of `neighbour`, which belongs to the same marks.
  bool liesBehindBallOf(const Sample& sample, const Sample& neighbour) const;

  /// Whether `sample` lies in the white halo of the mark at `neighbour`.
  bool liesInHaloOf(const Sample& sample, const Sample& neighbour) const;

 private:
  bool hasHalo(const Sample& sample) const;
  Vec3f lit(const Vec3f& color, const Vec3f& normal, float sky_share) const;

  const Scene& scene_;
  const View& view_;
  float pixels_per_point_;
  RayCaster caster_;
  float sky_reach_;  ///< farther objects do not hide the sky (mesh units)
};

}  // namespace octoblisk::demos
