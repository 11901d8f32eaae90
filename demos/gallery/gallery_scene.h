// What a scene of the gallery is: a world that is stepped, looked at and asked for numbers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "octoblisk/build_options.h"
#include "render/picture.h"

namespace octoblisk::gallery {

struct Number {
  std::string name;  ///< with its unit: a column's name in the table
  double value = 0.0;
};

class GalleryScene {
 public:
  virtual ~GalleryScene() = default;

  /// One time step of the world.
  virtual void step() = 0;

  /// The world as it is now, with a camera that stays where it is and, at most, a legend.
  virtual demos::Picture picture() const = 0;

  /// The same names at any time.
  virtual std::vector<Number> numbers() const = 0;
};

/// A scene, and how the gallery shows it.
struct Exhibit {
  std::string name;           ///< of its files
  std::string title;          ///< over the picture
  std::string caption;        ///< one sentence: what there is to see
  double time_step;           ///< of a step, s
  std::vector<double> shown;  ///< the times of the frames, s; growing; the last is the end
  std::function<std::unique_ptr<GalleryScene>(const BuildOptions& tree)> make;
  int columns = 3;         ///< of frames
  int frame_width = 400;   ///< pixels
  int frame_height = 330;  ///< pixels, with the caption
};

}  // namespace octoblisk::gallery
