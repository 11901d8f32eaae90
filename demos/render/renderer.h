// Renders a scene as seen by a camera.
#pragma once

#include <cstddef>
#include <functional>

#include "render/camera.h"
#include "render/image.h"
#include "render/scene.h"

namespace octoblisk::demos {

using RenderProgress = std::function<void(std::size_t done, std::size_t bands)>;

/// The scene on a white background. Surfaces are lit by a sky and two lamps that move with the camera;
/// silhouettes and creases are drawn as dark lines; edges are smooth. `pixels_per_point` scales the widths of
/// the marks.
///
/// The image is the same, bit for bit, for any number of threads (≥ 1). `progress` is called in the caller's
/// thread from time to time with the number of finished bands of rows and their total. Throws
/// std::invalid_argument for an invalid camera, std::runtime_error if Embree fails.
Image renderScene(const Scene& scene, const Camera& camera, int width, int height, float pixels_per_point,
                  unsigned threads, const RenderProgress& progress = {});

}  // namespace octoblisk::demos
