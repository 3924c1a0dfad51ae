#include "hal/desktop/wav_microphone.h"

#include <sndfile.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/file_code.h"

namespace orthonav::desktop {

namespace {

struct CloseSound {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

class WavMicrophone : public Microphone {
 public:
  WavMicrophone(std::vector<std::int16_t> samples, int rate_hz, const Clock& clock)
      : samples_(std::move(samples)), rate_hz_(rate_hz), clock_(clock), start_(clock.now()) {}

 private:
  std::vector<std::int16_t> samples_;
  int rate_hz_;
  const Clock& clock_;
  Timestamp start_;
  std::int64_t next_ = 0;

  [[nodiscard]] int do_sample_rate_hz() const override { return rate_hz_; }
  /// Silence follows the file, so that its last word is recognized as ended.
  Result<std::size_t> do_read(std::span<std::int16_t> samples) override {
    const auto heard = static_cast<std::int64_t>(seconds(clock_.now() - start_) * rate_hz_);
    const std::int64_t end =
        std::clamp(heard, next_, next_ + static_cast<std::int64_t>(samples.size()));
    const auto size = static_cast<std::int64_t>(samples_.size());
    for (std::int64_t i = next_; i < end; ++i) {
      samples[static_cast<std::size_t>(i - next_)] =
          i < size ? samples_[static_cast<std::size_t>(i)] : std::int16_t{0};
    }
    return static_cast<std::size_t>(end - std::exchange(next_, end));
  }
  [[nodiscard]] std::optional<Timestamp> do_newest_sample_time() const override {
    if (next_ == 0) {
      return std::nullopt;
    }
    return start_ + from_seconds(static_cast<double>(next_) / rate_hz_);
  }
};

Error file_error(const std::filesystem::path& path, const std::string& why) {
  return Error{path.string() + ": " + why};
}

/// Refuses what no microphone records.
Status check(const std::filesystem::path& path, const SF_INFO& info) {
  constexpr int kMaxChannels = 16;
  constexpr std::int64_t kMaxSeconds = 3600;
  if (info.channels < 1 || info.channels > kMaxChannels) {
    return file_error(path, "has " + std::to_string(info.channels) + " channels, limit 16");
  }
  if (info.samplerate < 8000 || info.samplerate > 192000) {
    return file_error(path, "has " + std::to_string(info.samplerate) +
                                " samples a second, must lie in [8000, 192000]");
  }
  if (info.frames < 0 || info.frames > kMaxSeconds * info.samplerate) {
    return file_error(
        path, "lasts " + std::to_string(info.frames / info.samplerate) + " s, limit 3600 s");
  }
  return {};
}

/// The mean of the channels, from where the file stands to its end.
std::vector<std::int16_t> mono_samples(SNDFILE& file, const SF_INFO& info) {
  // A float file's full scale becomes that of 16 bits.
  sf_command(&file, SFC_SET_SCALE_FLOAT_INT_READ, nullptr, SF_TRUE);
  const auto channels = static_cast<std::size_t>(info.channels);
  std::vector<std::int16_t> block(4096 * channels);
  std::vector<std::int16_t> samples;
  for (sf_count_t got = 0; (got = sf_readf_short(&file, block.data(), 4096)) > 0;) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(got); ++i) {
      int sum = 0;
      for (std::size_t c = 0; c < channels; ++c) {
        sum += block[i * channels + c];
      }
      samples.push_back(static_cast<std::int16_t>(sum / info.channels));
    }
  }
  return samples;
}

}  // namespace

Result<std::unique_ptr<Microphone>> open_wav_microphone(const std::filesystem::path& path,
                                                        const Clock& clock) {
  // A FIFO would be waited for, and a device never ends.
  std::error_code code;
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code)) {
    return file_error(path, "is not a file");
  }
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, CloseSound> file(sf_open(path.c_str(), SFM_READ, &info));
  if (!file) {
    Error error = file_error(path, std::string("is not a sound file: ") + sf_strerror(nullptr));
    if (sf_error(nullptr) == SF_ERR_SYSTEM) {
      error.code = code_of_unopened(path);
    }
    return error;
  }
  if (const Status usable = check(path, info); !usable) {
    return usable.error();
  }
  std::vector<std::int16_t> samples = mono_samples(*file, info);
  if (samples.empty()) {
    return file_error(path, "holds no sound");
  }
  return std::unique_ptr<Microphone>(
      std::make_unique<WavMicrophone>(std::move(samples), info.samplerate, clock));
}

}  // namespace orthonav::desktop
