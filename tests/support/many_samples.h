#pragma once

#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "render/renderer.h"

namespace orthonav::render {

/// Light of a picture: red, green and blue of each pixel, linear.
struct LinearImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> light;
};

/// A scene with `grid` by `grid` samples in each pixel, one picture per view: the mean of that many
/// frames of `hard`, which draws with Edges::kHard, each shifted by a fraction of a pixel.
[[nodiscard]] Result<std::vector<LinearImage>> many_samples(Renderer& hard, const Scene& scene,
                                                            const std::vector<View>& views,
                                                            int grid);

/// How far pictures are from such a reference, in levels of 255 as a display shows them.
struct EdgeError {
  double sum_squares = 0;
  double worst = 0;
  std::size_t channels = 0;
  [[nodiscard]] double rms() const;
};

/// Adds the errors in the channels of pixels that an edge cuts, where `hard`, drawn with one
/// sample, differs from the reference by more than two levels.
void add_error(const LinearImage& reference, const RgbaImage& hard, const RgbaImage& picture,
               EdgeError& error);

}  // namespace orthonav::render
