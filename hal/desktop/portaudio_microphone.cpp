#include "hal/desktop/portaudio_microphone.h"

#include <fcntl.h>
#include <portaudio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

namespace orthonav::desktop {

namespace {

/// Silences standard error for its lifetime. PortAudio queries ALSA and JACK for all possible
/// devices, both print messages for missing ones, and PortAudio offers no way to prevent that.
class QuietStandardError {
 public:
  QuietStandardError() : kept_(::dup(STDERR_FILENO)) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nowhere >= 0) {
      ::dup2(nowhere, STDERR_FILENO);
    }
    if (nowhere >= 0) {
      ::close(nowhere);
    }
  }
  ~QuietStandardError() {
    if (kept_ < 0) {
      return;
    }
    ::dup2(kept_, STDERR_FILENO);
    ::close(kept_);
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int kept_;
};

/// Starts PortAudio and ends it; PortAudio counts the calls.
class PortAudio {
 public:
  PortAudio() {
    const QuietStandardError quiet;
    code_ = Pa_Initialize();
  }
  ~PortAudio() {
    if (code_ == paNoError) {
      Pa_Terminate();
    }
  }
  PortAudio(const PortAudio&) = delete;
  PortAudio& operator=(const PortAudio&) = delete;
  [[nodiscard]] bool ok() const { return code_ == paNoError; }

 private:
  PaError code_ = paNotInitialized;
};

/// One writer (PortAudio's thread) and one reader; neither waits for the other. Samples not read in
/// time are overwritten.
class SoundRing {
 public:
  static constexpr std::size_t kSize = std::size_t{1} << 17U;  // 2.7 s at 48 kHz

  void write(const std::int16_t* samples, std::size_t count, Timestamp newest) {
    const std::uint64_t begin = written_.load(std::memory_order_relaxed);
    for (std::size_t i = 0; i < count; ++i) {
      samples_[(begin + i) % kSize].store(samples[i], std::memory_order_relaxed);
    }
    newest_ = newest;
    written_.store(begin + count, std::memory_order_release);
  }
  /// How many were read, and whether others were overwritten before that.
  std::pair<std::size_t, bool> read(std::span<std::int16_t> samples) {
    const std::uint64_t written = written_.load(std::memory_order_acquire);
    // A margin that the writer can't cross while the reader copies.
    const bool lost = written - read_ > kSize - kMargin;
    if (lost) {
      read_ = written - kSize / 2;
    }
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(samples.size(), written - read_));
    for (std::size_t i = 0; i < count; ++i) {
      samples[i] = samples_[(read_ + i) % kSize].load(std::memory_order_relaxed);
    }
    read_ += count;
    return {count, lost};
  }
  [[nodiscard]] std::uint64_t unread() const { return written_.load() - read_; }
  [[nodiscard]] std::uint64_t taken() const { return read_; }
  [[nodiscard]] Timestamp newest() const { return newest_; }

 private:
  static constexpr std::uint64_t kMargin = 1U << 14U;
  std::vector<std::atomic<std::int16_t>> samples_ = std::vector<std::atomic<std::int16_t>>(kSize);
  std::atomic<std::uint64_t> written_{0};
  std::atomic<Timestamp> newest_{};
  std::uint64_t read_ = 0;
};

std::string name_of(PaDeviceIndex index) {
  const PaDeviceInfo* info = Pa_GetDeviceInfo(index);
  return info && info->maxInputChannels > 0 ? info->name : "";
}

class PortAudioMicrophone : public Microphone {
 public:
  explicit PortAudioMicrophone(const Clock& clock) : clock_(clock) {}
  ~PortAudioMicrophone() override {
    if (stream_) {
      Pa_CloseStream(stream_);
    }
  }
  PortAudioMicrophone(const PortAudioMicrophone&) = delete;
  PortAudioMicrophone& operator=(const PortAudioMicrophone&) = delete;

  Status start(PaDeviceIndex device) {
    const PaDeviceInfo* info = Pa_GetDeviceInfo(device);
    rate_hz_ = static_cast<int>(info->defaultSampleRate);
    latency_ = from_seconds(info->defaultLowInputLatency);
    const PaStreamParameters wanted{device, 1, paInt16, info->defaultLowInputLatency, nullptr};
    PaError code = Pa_OpenStream(&stream_, &wanted, nullptr, info->defaultSampleRate,
                                 paFramesPerBufferUnspecified, paNoFlag, &heard, this);
    if (code == paNoError) {
      code = Pa_StartStream(stream_);
    }
    if (code == paNoError) {
      return {};
    }
    return Error{
        "microphone \"" + std::string(info->name) + "\" cannot be opened: " + Pa_GetErrorText(code),
        ErrorCode::kUnavailable};
  }

 private:
  PortAudio port_audio_;
  const Clock& clock_;
  PaStream* stream_ = nullptr;
  int rate_hz_ = 48000;
  Duration latency_{};
  SoundRing ring_;

  static int heard(const void* samples, void*, unsigned long count, const PaStreamCallbackTimeInfo*,
                   PaStreamCallbackFlags, void* self_text) {
    auto* self = static_cast<PortAudioMicrophone*>(self_text);
    if (samples) {
      self->ring_.write(static_cast<const std::int16_t*>(samples), count,
                        self->clock_.now() - self->latency_);
    }
    return paContinue;
  }
  [[nodiscard]] int do_sample_rate_hz() const override { return rate_hz_; }
  Result<std::size_t> do_read(std::span<std::int16_t> samples) override {
    const auto [count, lost] = ring_.read(samples);
    if (lost) {
      return Error{"microphone: not read in time, sound was dropped"};
    }
    if (count == 0 && Pa_IsStreamActive(stream_) != 1) {
      return Error{"microphone: is gone", ErrorCode::kLost};
    }
    return count;
  }
  [[nodiscard]] std::optional<Timestamp> do_newest_sample_time() const override {
    if (ring_.taken() == 0) {
      return std::nullopt;
    }
    return ring_.newest() - from_seconds(static_cast<double>(ring_.unread()) / rate_hz_);
  }
};

}  // namespace

std::vector<std::string> microphone_names() {
  const PortAudio port_audio;
  std::vector<std::string> names;
  if (!port_audio.ok()) {
    return names;
  }
  const PaDeviceIndex chosen = Pa_GetDefaultInputDevice();
  if (chosen != paNoDevice) {
    names.push_back(name_of(chosen));
  }
  for (PaDeviceIndex i = 0; i < Pa_GetDeviceCount(); ++i) {
    if (i != chosen && !name_of(i).empty()) {
      names.push_back(name_of(i));
    }
  }
  return names;
}

Result<std::unique_ptr<Microphone>> open_portaudio_microphone(const std::string& name,
                                                              const Clock& clock) {
  const PortAudio port_audio;
  if (!port_audio.ok()) {
    return Error{"microphone: PortAudio cannot be started", ErrorCode::kUnavailable};
  }
  std::optional<PaDeviceIndex> found;
  if (name.empty() && Pa_GetDefaultInputDevice() != paNoDevice) {
    found = Pa_GetDefaultInputDevice();
  }
  for (PaDeviceIndex i = 0; i < Pa_GetDeviceCount() && !found; ++i) {
    if (!name_of(i).empty() && name_of(i).find(name) != std::string::npos) {
      found = i;
    }
  }
  if (!found) {
    std::string known;
    for (const std::string& other : microphone_names()) {
      known += (known.empty() ? "" : ", ") + other;
    }
    return Error{"microphone \"" + name + "\" is not there; there " +
                     (known.empty() ? std::string("is none") : "are " + known),
                 ErrorCode::kNotFound};
  }
  auto microphone = std::make_unique<PortAudioMicrophone>(clock);
  if (Status started = microphone->start(*found); !started) {
    return started.error();
  }
  return std::unique_ptr<Microphone>(std::move(microphone));
}

}  // namespace orthonav::desktop
