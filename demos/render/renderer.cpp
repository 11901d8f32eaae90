#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "render/sampler.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr int kBandRows = 32;
constexpr int kMargin = 4;  // rows around a band that its pixels depend on
constexpr int kGrid = 4;    // samples along each side of a refined pixel
constexpr int kBlurReach =
    2;  // pixels: a window of 5 × 5 whose border counts half holds each pattern equally

const Vec3f kInk(0.012f, 0.016f, 0.024f);  // linear
constexpr float kSilhouetteInk = 0.88f;
constexpr float kCreaseInk = 0.42f;
constexpr float kVeiledInk = 0.45f;  // of the lines behind a transparent surface, or on its rim
constexpr float kHaloWhite = 0.92f;

struct Offset {
  int column;
  int row;
};
/// Circles, in samples: lines are three quarters of a pixel wide on either side, halos a pixel and a half.
constexpr std::array<Offset, 8> kLineCircle = {
    {{3, 0}, {2, 2}, {0, 3}, {-2, 2}, {-3, 0}, {-2, -2}, {0, -3}, {2, -2}}};
constexpr std::array<Offset, 16> kHaloCircle = {{{3, 0},
                                                 {2, 2},
                                                 {0, 3},
                                                 {-2, 2},
                                                 {-3, 0},
                                                 {-2, -2},
                                                 {0, -3},
                                                 {2, -2},
                                                 {6, 0},
                                                 {4, 4},
                                                 {0, 6},
                                                 {-4, 4},
                                                 {-6, 0},
                                                 {-4, -4},
                                                 {0, -6},
                                                 {4, -4}}};

std::uint8_t encoded(float linear) {
  const float clamped = std::clamp(linear, 0.0f, 1.0f);
  const float channel =
      clamped <= 0.0031308f ? 12.92f * clamped : 1.055f * std::pow(clamped, 1.0f / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255.0f * channel));
}

/// Renders one band of rows after another, from the first trace to the finished pixels. Bands are
/// independent: each traces a margin of its neighbours' rows itself. One renderer per thread; it keeps its
/// memory.
class BandRenderer {
 public:
  BandRenderer(const Sampler& sampler, Image& image)
      : sampler_(sampler), image_(image), width_(image.width) {}

  void render(int band) {
    first_row_ = band * kBandRows;
    end_row_ = std::min(first_row_ + kBandRows, image_.height);
    first_traced_ = std::max(first_row_ - kMargin, 0);
    end_traced_ = std::min(end_row_ + kMargin, image_.height);
    traceCenters();
    blurSky();
    refine();
    for (int row = first_row_; row < end_row_; ++row) {
      for (int column = 0; column < width_; ++column) {
        const Vec3f color = pixelColor(column, row);
        image_.at(column, row) = {encoded(color.x()), encoded(color.y()), encoded(color.z()), 255};
      }
    }
  }

 private:
  static constexpr int kNotRefined = -1;

  std::size_t slot(int column, int row) const {
    return static_cast<std::size_t>(row - first_traced_) * width_ + column;
  }

  /// Calls visit(column, row, distance in rows and columns) for the traced pixels of a square around a pixel.
  template <class Visit>
  void forNeighbours(int column, int row, int reach, Visit&& visit) const {
    for (int y = std::max(row - reach, first_traced_); y <= std::min(row + reach, end_traced_ - 1); ++y) {
      for (int x = std::max(column - reach, 0); x <= std::min(column + reach, width_ - 1); ++x) {
        visit(x, y, Offset{x - column, y - row});
      }
    }
  }

  void traceCenters() {
    const std::size_t count = static_cast<std::size_t>(end_traced_ - first_traced_) * width_;
    centers_.clear();
    rough_sky_.clear();
    centers_.reserve(count);
    rough_sky_.reserve(count);
    for (int row = first_traced_; row < end_traced_; ++row) {
      for (int column = 0; column < width_; ++column) {
        const Sample& sample = centers_.emplace_back(sampler_.trace(column + 0.5f, row + 0.5f));
        const auto pattern = static_cast<unsigned>(4 * (row % 4) + column % 4);
        rough_sky_.push_back(sample.back ? sampler_.skyShare(sample.back, pattern) : 1.0f);
      }
    }
  }

  /// The mean of the sky shares around a pixel, only from the same smooth surface.
  void blurSky() {
    sky_ = rough_sky_;
    for (int row = first_traced_; row < end_traced_; ++row) {
      for (int column = 0; column < width_; ++column) {
        const Surface& here = centers_[slot(column, row)].back;
        if (here) sky_[slot(column, row)] = meanSky(rough_sky_, here, column, row, kBlurReach).value_or(1.0f);
      }
    }
  }

  std::optional<float> meanSky(const std::vector<float>& sky, const Surface& here, int column, int row,
                               int reach) const {
    float sum = 0.0f;
    float weights = 0.0f;
    forNeighbours(column, row, reach, [&](int x, int y, Offset offset) {
      const Surface& there = centers_[slot(x, y)].back;
      if (there.solid != here.solid) return;
      const auto apart = static_cast<float>(std::max(std::abs(offset.column), std::abs(offset.row)));
      if (sampler_.edgeBetween(here, there, apart) != Edge::none) return;
      const float weight =
          (std::abs(offset.column) == reach ? 0.5f : 1.0f) * (std::abs(offset.row) == reach ? 0.5f : 1.0f);
      sum += weight * sky[slot(x, y)];
      weights += weight;
    });
    if (weights == 0.0f) return std::nullopt;
    return sum / weights;
  }

  /// Traces a grid of samples in each pixel at a border, and where a line beside a border may reach.
  void refine() {
    findEnds();
    grids_.clear();
    grid_of_.assign(centers_.size(), kNotRefined);
    for (int row = std::max(first_row_ - 2, 0); row < std::min(end_row_ + 2, image_.height); ++row) {
      for (int column = 0; column < width_; ++column) {
        bool refined = ends_[slot(column, row)] != Ending::none;
        forNeighbours(column, row, 1,
                      [&](int x, int y, Offset) { refined |= ends_[slot(x, y)] == Ending::outlined; });
        if (refined) traceGrid(column, row);
      }
    }
  }

  void findEnds() {
    ends_.assign(centers_.size(), Ending::none);
    for (int row = first_traced_; row < end_traced_; ++row) {
      for (int column = 0; column < width_; ++column) {
        // Each pair of neighbours once.
        for (const Offset& offset : {Offset{1, 0}, Offset{-1, 1}, Offset{0, 1}, Offset{1, 1}}) {
          const int x = column + offset.column;
          const int y = row + offset.row;
          if (x < 0 || x >= width_ || y >= end_traced_) continue;
          const Ending ending = sampler_.endingBetween(centers_[slot(column, row)], centers_[slot(x, y)]);
          for (Ending* end : {&ends_[slot(column, row)], &ends_[slot(x, y)]}) *end = std::max(*end, ending);
        }
      }
    }
  }

  void traceGrid(int column, int row) {
    grid_of_[slot(column, row)] = static_cast<int>(grids_.size()) / (kGrid * kGrid);
    for (int y = 0; y < kGrid; ++y) {
      for (int x = 0; x < kGrid; ++x) {
        grids_.push_back(sampler_.trace(column + (x + 0.5f) / kGrid, row + (y + 0.5f) / kGrid));
      }
    }
  }

  /// The sample of the fine grid, if its pixel was refined; counted from the image's corner.
  const Sample* fineSample(int fine_column, int fine_row) const {
    if (fine_column < 0 || fine_column >= kGrid * width_) return nullptr;
    const int row = fine_row < 0 ? -1 : fine_row / kGrid;
    if (row < first_traced_ || row >= end_traced_) return nullptr;
    const int grid = grid_of_[slot(fine_column / kGrid, row)];
    if (grid == kNotRefined) return nullptr;
    return &grids_[(static_cast<std::size_t>(grid) * kGrid + fine_row % kGrid) * kGrid + fine_column % kGrid];
  }

  Vec3f pixelColor(int column, int row) const {
    if (grid_of_[slot(column, row)] == kNotRefined) {
      return sampler_.color(centers_[slot(column, row)], sky_[slot(column, row)]);
    }
    Vec3f sum = Vec3f::Zero();
    for (int y = 0; y < kGrid; ++y) {
      for (int x = 0; x < kGrid; ++x) sum += fineColor(kGrid * column + x, kGrid * row + y).cwiseMin(1.0f);
    }
    return sum / (kGrid * kGrid);
  }

  Vec3f fineColor(int fine_column, int fine_row) const {
    const Sample& sample = *fineSample(fine_column, fine_row);
    Vec3f color = sampler_.color(sample, fineSky(sample.back, fine_column / kGrid, fine_row / kGrid));
    color += inkAt(sample, fine_column, fine_row) * (kInk - color);
    for (const Offset& offset : kHaloCircle) {
      const Sample* other = fineSample(fine_column + offset.column, fine_row + offset.row);
      if (other != nullptr && other->mark != sample.mark && sampler_.liesInHaloOf(sample, *other)) {
        return color + kHaloWhite * (Vec3f::Ones() - color);
      }
    }
    return color;
  }

  float fineSky(const Surface& surface, int column, int row) const {
    if (!surface) return 1.0f;
    if (const auto mean = meanSky(sky_, surface, column, row, 1)) return *mean;
    // A surface too small to be hit at any pixel's centre.
    float sum = 0.0f;
    constexpr unsigned kStride = 5;
    for (unsigned pattern = 0; pattern < Sampler::kPatterns; pattern += kStride) {
      sum += sampler_.skyShare(surface, pattern);
    }
    return sum / (1.0f + (Sampler::kPatterns - 1) / kStride);
  }

  /// The share of the sample that the dark lines cover, 0 to 1.
  float inkAt(const Sample& sample, int fine_column, int fine_row) const {
    float ink = 0.0f;
    for (const Offset& offset : kLineCircle) {
      const Sample* other = fineSample(fine_column + offset.column, fine_row + offset.row);
      if (other == nullptr) continue;
      if (sampler_.liesBehindBallOf(sample, *other)) return kCreaseInk;
      const bool veiled = sample.transmittance < 1.0f || other->transmittance < 1.0f;
      const float strength = veiled ? kVeiledInk : 1.0f;
      ink = std::max(ink, strength * inkOf(sampler_.edgeBetween(sample.back, other->back, 1.0f)));
      if (veiled)
        ink = std::max(ink, strength * inkOf(sampler_.edgeBetween(sample.front, other->front, 1.0f)));
    }
    return sample.mark == Sample::kNoMark ? ink : ink * (1.0f - sample.mark_opacity);
  }

  static float inkOf(Edge edge) {
    switch (edge) {
      case Edge::none:
        return 0.0f;
      case Edge::crease:
        return kCreaseInk;
      case Edge::silhouette:
        return kSilhouetteInk;
    }
    return 0.0f;
  }

  const Sampler& sampler_;
  Image& image_;
  int width_;
  int first_row_ = 0;  ///< of the finished rows: [first_row_, end_row_)
  int end_row_ = 0;
  int first_traced_ = 0;  ///< of the traced rows: [first_traced_, end_traced_)
  int end_traced_ = 0;

  std::vector<Sample> centers_;   ///< one per traced pixel, at its centre
  std::vector<float> rough_sky_;  ///< share of the sky, one pattern per pixel
  std::vector<float> sky_;        ///< the same, smoothed
  std::vector<Ending> ends_;      ///< the strongest between the pixel and its neighbours
  std::vector<int> grid_of_;      ///< the pixel's place in grids_, or kNotRefined
  std::vector<Sample> grids_;     ///< kGrid × kGrid samples per refined pixel
};

}  // namespace

Image renderScene(const Scene& scene, const Camera& camera, int width, int height, float pixels_per_point,
                  unsigned threads, const RenderProgress& progress) {
  const View view(camera, width, height, scene.bounds());
  const Sampler sampler(scene, view, pixels_per_point);
  Image image(width, height, {255, 255, 255, 255});
  const auto bands = static_cast<std::size_t>((height + kBandRows - 1) / kBandRows);
  std::vector<BandRenderer> renderers(threads, BandRenderer(sampler, image));  // one per thread
  std::atomic<std::size_t> done = 0;
  parallelFor(bands, static_cast<int>(threads), [&](std::size_t band, std::size_t worker) {
    renderers[worker].render(static_cast<int>(band));
    ++done;
    if (progress && worker == 0) progress(done, bands);
  });
  return image;
}

}  // namespace octoblisk::demos
