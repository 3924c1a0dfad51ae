#include "engine/holograms/optical_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "base/srgb.h"

namespace orthonav::engine {
namespace {

const std::array<double, 256>& linear_table() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = linear_from_srgb(static_cast<double>(i) / 255.0);
    }
    return values;
  }();
  return table;
}

std::uint8_t encoded(double v) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(srgb_from_linear(v), 0.0, 1.0)));
}

double grey_at(const RgbaImage& image, std::size_t pixel) {
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    sum += kLuminance[c] * linear_table()[image.pixels[4 * pixel + c]];
  }
  return sum;
}

/// Even a dark room has some light.
constexpr double kDarkest_cd_m2 = 0.01;

}  // namespace

double OpticalModel::white_sheet_cd_m2() const {
  return combiner_fraction * ambient_lux / std::numbers::pi;
}

std::vector<std::string> OpticalModel::check() const {
  std::vector<std::string> problems;
  if (!(display_cd_m2 > 0.0 && display_cd_m2 <= 1e5)) {
    problems.push_back("display luminance must lie in (0, 100000] cd/m2");
  }
  if (!(ambient_lux >= 0.0 && ambient_lux <= 2e5)) {
    problems.push_back("ambient light must lie in [0, 200000] lux");
  }
  if (!(combiner_fraction > 0.0 && combiner_fraction <= 1.0)) {
    problems.push_back("combiner transmission must lie in (0, 1]");
  }
  return problems;
}

std::vector<HologramContrast> contrasts(const RgbaImage& light, const LabelImage& labels,
                                        const RgbaImage& background, const OpticalModel& model) {
  std::map<render::Label, std::vector<double>> ratios;
  const double white = model.white_sheet_cd_m2();
  for (std::size_t i = 0; i < labels.labels.size(); ++i) {
    if (labels.labels[i] == 0) {
      continue;
    }
    const double behind = std::max(white * grey_at(background, i), kDarkest_cd_m2);
    ratios[labels.labels[i]].push_back(1.0 + model.display_cd_m2 * grey_at(light, i) / behind);
  }
  std::vector<HologramContrast> out;
  for (auto& [label, values] : ratios) {
    std::sort(values.begin(), values.end());
    out.push_back({label, static_cast<int>(values.size()), values[values.size() / 2],
                   values[values.size() / 10]});
  }
  return out;
}

WorldBehindCombiner::WorldBehindCombiner(const OpticalModel& model) {
  const double fraction =
      model.white_sheet_cd_m2() / (model.display_cd_m2 + model.white_sheet_cd_m2());
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    seen_[i] = encoded(fraction * linear_table()[i]);
  }
}

void WorldBehindCombiner::dim(RgbaImage& world) const {
  for (std::size_t i = 0; i < world.pixels.size(); ++i) {
    if (i % 4 != 3) {
      world.pixels[i] = seen_[world.pixels[i]];
    }
  }
}

RgbaImage through_combiner(const RgbaImage& light, const RgbaImage& background,
                           const OpticalModel& model) {
  const double white = model.white_sheet_cd_m2();
  std::vector<double> seen(light.pixels.size(), 0.0);
  double brightest = kDarkest_cd_m2;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (i % 4 == 3) {
      continue;
    }
    seen[i] = model.display_cd_m2 * linear_table()[light.pixels[i]] +
              white * linear_table()[background.pixels[i]];
    brightest = std::max(brightest, seen[i]);
  }
  RgbaImage out{light.width_px, light.height_px, {}};
  out.pixels.resize(seen.size(), 255);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (i % 4 != 3) {
      out.pixels[i] = encoded(seen[i] / brightest);
    }
  }
  return out;
}

}  // namespace orthonav::engine
