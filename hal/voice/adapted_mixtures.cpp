#include "hal/voice/adapted_mixtures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/fnv1a.h"
#include "hal/voice/model_bytes.h"

namespace orthonav::voice {

namespace {

constexpr std::string_view kMixturesFileHeader = "orthonav mixture weights change 1\n";
constexpr double kLeastFraction = 1e-7;
const double kUnit = 1024.0 * std::log(1.0001);

std::size_t weights_of_senone(const MixtureWeights& weights) {
  return static_cast<std::size_t>(weights.streams) * static_cast<std::size_t>(weights.densities);
}

/// Calls `each(index of a weight)` for all weights of a senone.
template <class Each>
void for_each_weight(const MixtureWeights& weights, int senone, Each each) {
  for (int stream = 0; stream < weights.streams; ++stream) {
    for (int density = 0; density < weights.densities; ++density) {
      each(weights.at(stream, density, senone));
    }
  }
}

}  // namespace

std::uint8_t quantised_weight(double fraction) {
  return static_cast<std::uint8_t>(
      std::lround(-std::log(std::max(fraction, kLeastFraction)) / kUnit));
}

double fraction_of(std::uint8_t quantised) { return std::exp(-kUnit * quantised); }

Result<MixtureWeights> read_mixture_weights(const std::filesystem::path& path) {
  const std::string content = model_file(path);
  const Error refused{"voice: " + path.string() + " holds no mixture weights of an acoustic model"};
  // Texts, each with its length and a zero at its end; a length of zero ends them.
  std::string_view rest = content;
  MixtureWeights weights;
  int clusters = 0;
  while (true) {
    if (rest.size() < sizeof(std::int32_t)) {
      return refused;
    }
    const auto length = take<std::int32_t>(rest);
    if (length == 0) {
      break;
    }
    if (length < 0 || static_cast<std::size_t>(length) > rest.size()) {
      return refused;
    }
    const std::string text(rest.substr(0, static_cast<std::size_t>(length)));
    rest.remove_prefix(text.size());
    std::sscanf(text.c_str(), "feature_count %d", &weights.streams);
    std::sscanf(text.c_str(), "cluster_count %d", &clusters);
  }
  weights.densities = take<std::int32_t>(rest);
  weights.senones = take<std::int32_t>(rest);
  const auto sane = [](int value) { return value > 0 && value <= 65536; };
  if (clusters != 0 || !sane(weights.streams) || !sane(weights.densities) ||
      !sane(weights.senones) ||
      rest.size() / static_cast<std::size_t>(weights.senones) != weights_of_senone(weights) ||
      rest.size() % static_cast<std::size_t>(weights.senones) != 0) {
    return refused;
  }
  weights.header = content.substr(0, content.size() - rest.size());
  weights.values = rest;
  return weights;
}

std::string mixture_weights_file(const MixtureWeights& weights) {
  return weights.header + weights.values;
}

std::string mixture_weights_change(const MixtureWeights& from, const MixtureWeights& to) {
  std::string change(kMixturesFileHeader);
  put(change, fnv1a(from.values));
  for (int senone = 0; senone < from.senones; ++senone) {
    bool same = true;
    for_each_weight(from, senone,
                    [&](std::size_t at) { same = same && from.values[at] == to.values[at]; });
    if (same) {
      continue;
    }
    put(change, static_cast<std::int32_t>(senone));
    for_each_weight(to, senone, [&](std::size_t at) { change += to.values[at]; });
  }
  return change;
}

Status apply_change(std::string_view change, MixtureWeights& weights) {
  if (!change.starts_with(kMixturesFileHeader)) {
    return Error{"voice: no change of mixture weights"};
  }
  change.remove_prefix(kMixturesFileHeader.size());
  const Error refused = made_for_another_model();
  const std::size_t row = sizeof(std::int32_t) + weights_of_senone(weights);
  if (take<std::uint64_t>(change) != fnv1a(weights.values) || change.size() % row != 0) {
    return refused;
  }
  std::string changed = weights.values;
  while (!change.empty()) {
    const auto senone = take<std::int32_t>(change);
    if (senone < 0 || senone >= weights.senones) {
      return refused;
    }
    for_each_weight(weights, senone, [&](std::size_t at) { changed[at] = take<char>(change); });
  }
  weights.values = std::move(changed);
  return {};
}

}  // namespace orthonav::voice
