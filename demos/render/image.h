// Colours and images.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octoblisk::demos {

/// An sRGB colour; each channel from 0 to 1.
struct Color {
  float r = 0.0f;
  float g = 0.0f;
  float b = 0.0f;
};

/// Eight-bit sRGB pixels, from the top left, row by row. Alpha is 255 throughout.
struct Image {
  using Pixel = std::array<std::uint8_t, 4>;  ///< red, green, blue, alpha

  Image() = default;
  Image(int columns, int rows, const Pixel& fill)
      : width(columns), height(rows), pixels(static_cast<std::size_t>(columns) * rows, fill) {}

  Pixel& at(int column, int row) { return pixels[static_cast<std::size_t>(row) * width + column]; }
  const Pixel& at(int column, int row) const {
    return pixels[static_cast<std::size_t>(row) * width + column];
  }

  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;
};

}  // namespace octoblisk::demos
