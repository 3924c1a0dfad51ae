#include "tools/voice/sphinx_mixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <vector>

#include "hal/voice/model_bytes.h"

namespace orthonav::bench {
namespace {

using namespace orthonav::voice;

/// sphinxtrain moves the weights of a senone without training data by half of this.
constexpr double kUntouched = 1e-3;

/// The weights of one stream of a senone.
std::vector<double> fractions_of(const MixtureWeights& weights, int stream, int senone) {
  std::vector<double> fractions;
  for (int density = 0; density < weights.densities; ++density) {
    fractions.push_back(fraction_of(
        static_cast<std::uint8_t>(weights.values[weights.at(stream, density, senone)])));
  }
  const double sum = std::accumulate(fractions.begin(), fractions.end(), 0.0);
  for (double& fraction : fractions) {
    fraction /= sum;
  }
  return fractions;
}

/// The numbers that precede the weights in a file of sphinxtrain's.
std::array<std::int32_t, 4> sphinx_shape_of(const MixtureWeights& weights) {
  return {weights.senones, weights.streams, weights.densities,
          static_cast<std::int32_t>(weights.values.size())};
}

}  // namespace

std::string sphinx_mixture_weights(const MixtureWeights& own) {
  std::string out = sphinx_file_start();
  for (const int number : sphinx_shape_of(own)) {
    put(out, number);
  }
  for (int senone = 0; senone < own.senones; ++senone) {
    for (int stream = 0; stream < own.streams; ++stream) {
      for (const double fraction : fractions_of(own, stream, senone)) {
        put(out, static_cast<float>(fraction));
      }
    }
  }
  return out;
}

Result<std::string> sphinx_mixture_change(const MixtureWeights& own, const std::string& path,
                                          double fraction) {
  const std::string content = model_file(path);
  std::string_view rest = after_sphinx_file_start(content).value_or("");
  bool fits = true;
  for (const int number : sphinx_shape_of(own)) {
    fits = fits && take<std::int32_t>(rest) == number;
  }
  if (!fits || rest.size() < own.values.size() * sizeof(float)) {
    return Error{path + " is another model's"};
  }
  MixtureWeights adapted = own;
  for (int senone = 0; senone < own.senones; ++senone) {
    for (int stream = 0; stream < own.streams; ++stream) {
      const std::vector<double> before = fractions_of(own, stream, senone);
      std::vector<double> after;
      for (int i = 0; i < own.densities; ++i) {
        after.push_back(take<float>(rest));
      }
      const double sum = std::accumulate(after.begin(), after.end(), 0.0);
      double most = 0.0;
      for (std::size_t i = 0; i < after.size(); ++i) {
        after[i] = sum > 0.0 ? after[i] / sum : before[i];
        most = std::max(most, std::abs(after[i] - before[i]));
        after[i] = std::lerp(before[i], after[i], fraction);
      }
      if (most < kUntouched) {
        continue;
      }
      for (int i = 0; i < own.densities; ++i) {
        adapted.values[own.at(stream, i, senone)] =
            static_cast<char>(quantised_weight(after[static_cast<std::size_t>(i)]));
      }
    }
  }
  return mixture_weights_change(own, adapted);
}

}  // namespace orthonav::bench
