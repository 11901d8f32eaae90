#include "render/sampler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace octoblisk::demos {
namespace {

// The light: a sky, two broad lamps over the viewer's shoulders and one at the camera. They add up to 1 for a
// surface that faces the camera under an open sky, so that it has exactly the colour of the legend.
struct BroadLamp {
  float strength;         // for a surface that faces the lamp
  float right, up, back;  // the direction to the lamp, in the camera's axes: of unit length
};
constexpr BroadLamp kKey{0.46f, -0.48f, 0.64f, 0.60f};
constexpr BroadLamp kFill{0.26f, 0.76f, -0.25f, 0.60f};
constexpr float kCameraLight = 0.14f;
constexpr float kSkyLight = 0.40f;
constexpr float kSkyTilt = 0.08f;  // by which the sky is brighter above than ahead

constexpr int kSkyRays = 5;           // per pattern
constexpr float kSkyReach = 0.18f;    // of the scene's half diagonal
constexpr float kSkyOnLamps = 0.45f;  // how much the lamps fade too where the sky is hidden

constexpr int kMaxLayers = 32;  // transparent surfaces one behind another
constexpr float kMinTransmittance = 1.0f / 256.0f;
constexpr float kCreaseCosine = 0.82f;  // normals that differ by more make a crease, about 35°
constexpr float kJumpInPixels = 1.6f;   // a step of this height makes a silhouette
constexpr float kColorStep = 0.02f;     // linear

float linear(float channel) {
  const float clamped = std::clamp(channel, 0.0f, 1.0f);
  return clamped <= 0.04045f ? clamped / 12.92f : std::pow((clamped + 0.055f) / 1.055f, 2.4f);
}

Vec3f linear(Color color) { return {linear(color.r), linear(color.g), linear(color.b)}; }

float fraction(float value) { return value - std::floor(value); }

}  // namespace

Sampler::Sampler(const Scene& scene, const View& view, float pixels_per_point)
    : scene_(scene),
      view_(view),
      pixels_per_point_(pixels_per_point),
      caster_(scene, view, pixels_per_point),
      sky_reach_(scene.solids().empty()
                     ? 0.0f
                     : kSkyReach * static_cast<float>(scene.bounds().halfExtents().norm())) {}

Sample Sampler::trace(float column, float row) const {
  const Ray ray = view_.ray(column, row);
  const auto mark = caster_.nearestMark(ray);
  Sample sample;
  float from = 0.0f;
  for (int layer = 0; layer < kMaxLayers && sample.transmittance > kMinTransmittance; ++layer) {
    const auto hit = caster_.nearestSolid(ray, from);
    if (!hit) break;
    const bool before_mark = !mark || hit->distance < mark->distance;
    const Surface surface{hit->position, hit->normal, hit->solid};
    if (!sample.front) sample.front = surface;
    if (hit->opacity >= 1.0f) {
      sample.back = surface;
      sample.back_color = linear(hit->color);
      if (mark && before_mark) sample.mark_opacity = scene_.marks()[mark->mark].style.hidden_opacity;
      break;
    }
    if (before_mark) {
      sample.veil += sample.transmittance * hit->opacity * lit(linear(hit->color), hit->normal, 1.0f);
      sample.transmittance *= 1.0f - hit->opacity;
    }
    from = hit->distance + caster_.roundingDistance();
  }
  if (!mark) return sample;

  const bool before_back =
      !sample.back || mark->distance < ray.direction.dot(sample.back.position - ray.origin);
  if (before_back) sample.mark_opacity = 1.0f;
  if (sample.mark_opacity <= 0.0f) return sample;
  const Scene::Marks& marks = scene_.marks()[mark->mark];
  sample.mark = mark->mark;
  sample.point = mark->point;
  sample.mark_position = ray.origin + mark->distance * ray.direction;
  sample.mark_color = linear(marks.style.color);
  if (marks.kind != Scene::MarkKind::lines) sample.mark_color = lit(sample.mark_color, mark->normal, 1.0f);
  return sample;
}

Vec3f Sampler::lit(const Vec3f& color, const Vec3f& normal, float sky_share) const {
  const float right = normal.dot(view_.right());
  const float up = normal.dot(view_.up());
  const float back = -normal.dot(view_.forward());
  float lamps = kCameraLight * std::max(0.0f, back);
  for (const BroadLamp& lamp : {kKey, kFill}) {
    // A broad lamp also lights some way around the edge, so that no side looks flat.
    const float towards = 0.5f + 0.5f * (lamp.right * right + lamp.up * up + lamp.back * back);
    lamps += lamp.strength * towards * towards;
  }
  const float sky = kSkyLight + kSkyTilt * up;
  return color * (sky * sky_share + lamps * (1.0f - kSkyOnLamps + kSkyOnLamps * sky_share));
}

float Sampler::skyShare(const Surface& surface, unsigned pattern) const {
  constexpr float kGoldenRatio = 0.618034f;
  // The patterns' shifts, far apart for neighbouring pixels (an ordered dither).
  constexpr std::array<unsigned, kPatterns> kShift = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  const float shift = (static_cast<float>(kShift[pattern]) + 0.5f) / kPatterns;

  const Vec3f tangent = surface.normal.unitOrthogonal();
  const Vec3f bitangent = surface.normal.cross(tangent);
  const Vec3f start = surface.position + 4.0f * caster_.roundingDistance() * surface.normal;
  int open = 0;
  for (int index = 0; index < kSkyRays; ++index) {
    // Directions whose density is proportional to the cosine to the normal, stratified in both angles.
    const float square_sine = (static_cast<float>(index) + shift) / kSkyRays;
    const float turn =
        2.0f * std::numbers::pi_v<float> * fraction(kGoldenRatio * static_cast<float>(index) + 5.0f * shift);
    const float sine = std::sqrt(square_sine);
    const Vec3f direction = sine * std::cos(turn) * tangent + sine * std::sin(turn) * bitangent +
                            std::sqrt(1.0f - square_sine) * surface.normal;
    if (!caster_.isBlocked({start, direction}, sky_reach_)) ++open;
  }
  return static_cast<float>(open) / kSkyRays;
}

Vec3f Sampler::color(const Sample& sample, float sky_share) const {
  Vec3f back = sample.back ? lit(sample.back_color, sample.back.normal, sky_share) : sample.back_color;
  if (sample.mark != Sample::kNoMark) back += sample.mark_opacity * (sample.mark_color - back);
  return sample.veil + sample.transmittance * back;
}

Edge Sampler::edgeBetween(const Surface& a, const Surface& b, float pixels_apart) const {
  if (a.solid != b.solid) return Edge::silhouette;
  if (!a) return Edge::none;
  const Vec3f step = b.position - a.position;
  const float jump = kJumpInPixels * std::max(1.0f, pixels_apart) * view_.pixelSizeAt(a.position);
  if (std::abs(a.normal.dot(step)) > jump && std::abs(b.normal.dot(step)) > jump) return Edge::silhouette;
  return a.normal.dot(b.normal) < kCreaseCosine ? Edge::crease : Edge::none;
}

Ending Sampler::endingBetween(const Sample& a, const Sample& b) const {
  if (edgeBetween(a.back, b.back, 1.0f) != Edge::none) return Ending::outlined;
  const bool veiled = a.transmittance < 1.0f || b.transmittance < 1.0f;
  if (veiled && edgeBetween(a.front, b.front, 1.0f) != Edge::none) return Ending::outlined;
  if (a.mark != b.mark || a.point != b.point || a.mark_opacity != b.mark_opacity) {
    return hasHalo(a) || hasHalo(b) ? Ending::outlined : Ending::plain;
  }
  const bool same_color = (a.back_color - b.back_color).cwiseAbs().maxCoeff() <= kColorStep &&
                          std::abs(a.transmittance - b.transmittance) <= kColorStep;
  return same_color ? Ending::none : Ending::plain;
}

bool Sampler::hasHalo(const Sample& sample) const {
  return sample.mark_opacity >= 1.0f && scene_.marks()[sample.mark].style.halo;
}

bool Sampler::liesBehindBallOf(const Sample& sample, const Sample& neighbour) const {
  return sample.mark_opacity >= 1.0f && sample.mark == neighbour.mark && sample.point != neighbour.point &&
         view_.forward().dot(sample.mark_position - neighbour.mark_position) > 0.0f;
}

bool Sampler::liesInHaloOf(const Sample& sample, const Sample& neighbour) const {
  if (!hasHalo(neighbour) || sample.mark == neighbour.mark) return false;
  const float depth = view_.forward().dot(neighbour.mark_position);
  if (sample.mark != Sample::kNoMark) return depth < view_.forward().dot(sample.mark_position);
  if (!sample.back) return true;
  // A mark on a surface gets its halo even if the surface rises slightly in front of it.
  const float slack = 2.0f * scene_.marks()[neighbour.mark].style.width * pixels_per_point_ *
                      view_.pixelSizeAt(neighbour.mark_position);
  return depth < view_.forward().dot(sample.back.position) + slack;
}

}  // namespace octoblisk::demos
