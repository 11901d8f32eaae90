// The interface of a gallery scene: a world with a time step, a picture and numbers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "octoblisk/build_options.h"
#include "render/picture.h"

namespace octoblisk::gallery {

struct Number {
  std::string name;  ///< with its unit; the name of the table's column
  double value = 0.0;
};

class GalleryScene {
 public:
  virtual ~GalleryScene() = default;

  /// One time step of the world.
  virtual void step() = 0;

  /// The world as it is now, with a fixed camera and, at most, a legend.
  virtual demos::Picture picture() const = 0;

  /// The names must be the same at any time.
  virtual std::vector<Number> numbers() const = 0;
};

/// A scene, and its presentation in the gallery.
struct Exhibit {
  std::string name;           ///< of its files
  std::string title;          ///< over the picture
  std::string caption;        ///< one sentence that describes the scene
  double time_step;           ///< s
  std::vector<double> shown;  ///< the times of the frames, s, ascending; the last is the end
  std::function<std::unique_ptr<GalleryScene>(const BuildOptions& tree)> make;
  int columns = 3;         ///< of frames
  int frame_width = 400;   ///< pixels
  int frame_height = 330;  ///< pixels, with the caption
};

// The scenes, one per file; each file begins with a description. `tree` has the build options of their
// shapes.

std::unique_ptr<GalleryScene> makeHelloShape(const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeChainOfTori(int links, const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makePile(int bodies, const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeTower(int cylinders, const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeClothBesideGimpact(const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeGearTrain(const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeNutOnBolt(const BuildOptions& tree = {});
std::unique_ptr<GalleryScene> makeBliskAndDebris(int bodies, const BuildOptions& tree = {});

}  // namespace octoblisk::gallery
