#include "render/picture.h"

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace octoblisk::demos {

Image render(const Picture& picture, int width, int height, unsigned threads,
             const RenderProgress& progress) {
  constexpr int kLargestSide = 16384;
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestSide) {
    throw std::invalid_argument("the picture's size of " + std::to_string(width) + " × " +
                                std::to_string(height) + " pixels is out of range: 1 to 16384 each");
  }
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());

  const Layout layout(picture.annotation, width, height);
  const Image scene = renderScene(picture.scene, picture.camera, width, layout.sceneHeight(),
                                  static_cast<float>(layout.scale()), threads, progress);
  Image page(width, height, {255, 255, 255, 255});
  std::copy(scene.pixels.begin(), scene.pixels.end(),
            page.pixels.begin() + static_cast<std::ptrdiff_t>(layout.sceneTop()) * width);

  const View view(picture.camera, width, layout.sceneHeight(), picture.scene.bounds());
  const bool perspective = picture.camera.projection == Projection::perspective;
  annotate(page, picture.annotation, layout, 1.0 / view.pixelSize(), perspective ? " at the centre" : "");
  return page;
}

void writePng(const Picture& picture, const std::string& path, int width, int height, unsigned threads) {
  writePng(render(picture, width, height, threads), path);
}

}  // namespace octoblisk::demos
