// An engineering picture: a scene seen by a camera, with title, legend and scale bar.
//
//   Picture picture;
//   picture.scene.addMesh(blisk, {}, palette::kSteel);
//   picture.scene.addPoints(contacts, {.color = palette::kContact, .width = 14, .halo = true});
//   picture.camera = frame(picture.scene.points(), {-1, 1, -0.8}, Vec3::UnitZ());
//   picture.annotation = {.title = "Pose 17", .legend = {{palette::kSteel, "blisk"}}, .length_unit = "mm"};
//   writePng(picture, "pose17.png");
#pragma once

#include <string>

#include "render/annotation.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/renderer.h"
#include "render/scene.h"

namespace octoblisk::demos {

/// Colours that the colour-blind can tell apart (after Okabe and Ito, 2008).
namespace palette {
inline constexpr Color kSteel{0.72f, 0.76f, 0.80f};
inline constexpr Color kSand{0.90f, 0.72f, 0.42f};
inline constexpr Color kSky{0.34f, 0.71f, 0.91f};
inline constexpr Color kBlue{0.00f, 0.45f, 0.70f};
inline constexpr Color kGreen{0.00f, 0.62f, 0.45f};
inline constexpr Color kYellow{0.94f, 0.89f, 0.26f};
inline constexpr Color kOrange{0.90f, 0.62f, 0.00f};
inline constexpr Color kVermilion{0.84f, 0.25f, 0.00f};
inline constexpr Color kPurple{0.80f, 0.47f, 0.65f};
inline constexpr Color kSlate{0.36f, 0.40f, 0.46f};
inline constexpr Color kInk{0.13f, 0.15f, 0.18f};
}  // namespace palette

struct Picture {
  Scene scene;
  Camera camera;
  Annotation annotation;
};

/// The default size of a page, in pixels.
inline constexpr int kPageWidth = 1600, kPageHeight = 1200;

/// Renders the whole page. The image is the same, bit for bit, for any number of threads; 0 means one per
/// processor. `progress` is called as by renderScene. Throws std::invalid_argument for a page that is not 1
/// to 16384 pixels wide and high, or an invalid camera, and std::runtime_error if Embree or Cairo fails.
Image render(const Picture& picture, int width, int height, unsigned threads = 0,
             const RenderProgress& progress = {});

/// Renders the page to a PNG file. Throws as above, and std::runtime_error naming the path if it cannot be
/// written.
void writePng(const Picture& picture, const std::string& path, int width = kPageWidth,
              int height = kPageHeight, unsigned threads = 0);

}  // namespace octoblisk::demos
