#include "hal/voice/adapted_means.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/fnv1a.h"
#include "hal/voice/model_bytes.h"

namespace orthonav::voice {

namespace {

constexpr std::string_view kMeansFileHeader = "orthonav means change 1\n";

std::uint64_t hash_of_means(const AcousticMeans& means) {
  return fnv1a(std::string_view(reinterpret_cast<const char*>(means.values.data()),
                                means.values.size() * sizeof(float)));
}

/// Calls `each(value's index, component)`, with components counted over all streams.
template <class Each>
void for_each_value(const AcousticMeans& means, Each each) {
  std::size_t at = 0;
  for (int codebook = 0; codebook < means.codebooks; ++codebook) {
    std::size_t first = 0;
    for (const int width : means.stream_widths) {
      for (int density = 0; density < means.densities; ++density) {
        for (int i = 0; i < width; ++i) {
          each(at++, first + static_cast<std::size_t>(i));
        }
      }
      first += static_cast<std::size_t>(width);
    }
  }
}

/// The size of one step of a change, for each component.
std::vector<float> steps_of(const AcousticMeans& means) {
  std::size_t components = 0;
  for (const int width : means.stream_widths) {
    components += static_cast<std::size_t>(width);
  }
  std::vector<double> count(components), sum(components), square(components);
  for_each_value(means, [&](std::size_t at, std::size_t component) {
    const double value = means.values[at];
    count[component] += 1.0;
    sum[component] += value;
    square[component] += value * value;
  });
  std::vector<float> steps;
  for (std::size_t i = 0; i < components; ++i) {
    const double mean = sum[i] / count[i];
    const double variance = std::max(square[i] / count[i] - mean * mean, 1e-6);
    steps.push_back(kStepOfSpread * static_cast<float>(std::sqrt(variance)));
  }
  return steps;
}

}  // namespace

Result<AcousticMeans> read_means(const std::filesystem::path& path) {
  const std::string content = model_file(path);
  const Error refused{"voice: " + path.string() + " holds no means of an acoustic model"};
  const auto numbers = after_sphinx_file_start(content);
  if (!numbers) {
    return refused;
  }
  std::string_view rest = *numbers;
  AcousticMeans means;
  means.codebooks = take<std::int32_t>(rest);
  const auto streams = take<std::int32_t>(rest);
  means.densities = take<std::int32_t>(rest);
  const auto sane = [](int value) { return value > 0 && value <= 65536; };
  if (!sane(means.codebooks) || !sane(means.densities) || streams < 1 || streams > 16) {
    return refused;
  }
  std::int64_t width = 0;
  for (int i = 0; i < streams; ++i) {
    means.stream_widths.push_back(take<std::int32_t>(rest));
    if (!sane(means.stream_widths.back())) {
      return refused;
    }
    width += means.stream_widths.back();
  }
  const auto count = take<std::int32_t>(rest);
  if (count != width * means.codebooks * means.densities ||
      rest.size() < static_cast<std::size_t>(count) * sizeof(float)) {
    return refused;
  }
  means.values.resize(static_cast<std::size_t>(count));
  std::memcpy(means.values.data(), rest.data(), means.values.size() * sizeof(float));
  return means;
}

std::string means_file(const AcousticMeans& means) {
  std::string file = sphinx_file_start();
  put(file, static_cast<std::int32_t>(means.codebooks));
  put(file, static_cast<std::int32_t>(means.stream_widths.size()));
  put(file, static_cast<std::int32_t>(means.densities));
  for (const int width : means.stream_widths) {
    put(file, static_cast<std::int32_t>(width));
  }
  put(file, static_cast<std::int32_t>(means.values.size()));
  for (const float value : means.values) {
    put(file, value);
  }
  return file;
}

std::string means_change(const AcousticMeans& from, const AcousticMeans& to) {
  std::string change(kMeansFileHeader);
  put(change, hash_of_means(from));
  const std::vector<float> steps = steps_of(from);
  for_each_value(from, [&](std::size_t at, std::size_t component) {
    const float moved = (to.values[at] - from.values[at]) / steps[component];
    put(change, static_cast<std::int8_t>(std::lround(std::clamp(moved, -127.0F, 127.0F))));
  });
  return change;
}

Status apply_change(std::string_view change, AcousticMeans& means) {
  if (!change.starts_with(kMeansFileHeader)) {
    return Error{"voice: no change of acoustic means"};
  }
  change.remove_prefix(kMeansFileHeader.size());
  if (take<std::uint64_t>(change) != hash_of_means(means) || change.size() != means.values.size()) {
    return made_for_another_model();
  }
  const std::vector<float> steps = steps_of(means);
  for_each_value(means, [&](std::size_t at, std::size_t component) {
    means.values[at] += steps[component] * static_cast<float>(static_cast<std::int8_t>(change[at]));
  });
  return {};
}

}  // namespace orthonav::voice
