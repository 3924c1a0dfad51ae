#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace orthonav::voice {

/// The weight of each Gaussian in each senone (a third of a sound, given its neighbours) of an
/// acoustic model: PocketSphinx's file "sendump".
struct MixtureWeights {
  int streams = 0;
  int densities = 0;  ///< Gaussians of each stream
  int senones = 0;
  std::string header;  ///< of the file, as it was read
  /// [stream][density][senone], each as `quantised_weight` gives it.
  std::string values;

  [[nodiscard]] std::size_t at(int stream, int density, int senone) const {
    return (static_cast<std::size_t>(stream) * static_cast<std::size_t>(densities) +
            static_cast<std::size_t>(density)) *
               static_cast<std::size_t>(senones) +
           static_cast<std::size_t>(senone);
  }
};

/// A weight as 8 bits of its logarithm, to the base 1.0001 and in units of 1024. Weights below 1e-7
/// become the smallest one.
[[nodiscard]] std::uint8_t quantised_weight(double fraction);
[[nodiscard]] double fraction_of(std::uint8_t quantised);

/// Refuses a file of another format, or one with clusters (which Debian's en-us does not have).
Result<MixtureWeights> read_mixture_weights(const std::filesystem::path& path);
/// The content of such a file, as PocketSphinx reads it.
[[nodiscard]] std::string mixture_weights_file(const MixtureWeights& weights);

/// The change from the weights of one model to those of another of the same shape: the senones that
/// differ.
[[nodiscard]] std::string mixture_weights_change(const MixtureWeights& from,
                                                 const MixtureWeights& to);
/// Refuses a change that was made for other weights, and then leaves these as they are.
Status apply_change(std::string_view change, MixtureWeights& weights);

}  // namespace orthonav::voice
