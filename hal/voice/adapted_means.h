#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace orthonav::voice {

/// Means of an acoustic model: PocketSphinx's file "means" (Sphinx-3 format), without its header.
struct AcousticMeans {
  int codebooks = 0;               ///< one for each sound
  std::vector<int> stream_widths;  ///< cepstra, their differences, and the differences of those
  int densities = 0;               ///< Gaussians of each stream of a codebook
  /// [codebook][stream][density][component]
  std::vector<float> values;
};

/// Refuses a file of another format.
Result<AcousticMeans> read_means(const std::filesystem::path& path);
/// The content of such a file, as PocketSphinx reads it.
[[nodiscard]] std::string means_file(const AcousticMeans& means);

/// The change from the means of one model to those of another, small enough to be stored with the
/// code: 8 bits each, in steps of `kStepOfSpread` of the component's spread over all means.
inline constexpr float kStepOfSpread = 1.0F / 32.0F;
[[nodiscard]] std::string means_change(const AcousticMeans& from, const AcousticMeans& to);
/// Refuses a change that was made for other means.
Status apply_change(std::string_view change, AcousticMeans& means);

}  // namespace orthonav::voice
