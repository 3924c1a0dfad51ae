#include "hal/open/open_parts.h"

#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "hal/api/absent_devices.h"
#include "hal/api/uri_query.h"
#include "hal/desktop/evdev_clicker.h"
#include "hal/desktop/portaudio_microphone.h"
#include "hal/desktop/wav_microphone.h"
#include "hal/voice/spotted_voice.h"

namespace orthonav {

namespace {

constexpr const char* kClickers = "known are headset, none, evdev:[PATH|NAME] and keyboard:[NAME]";
constexpr const char* kVoices = "known are headset, none, mic:[NAME], headset-mic: and wav:FILE";
constexpr const char* kClickerKeys =
    "known are keys=NAME,..., double_ms=N, hold_ms=N, debounce_ms=N and share";

/// The parts of "scheme:rest?key=value&key".
struct PartUri {
  std::string scheme;
  std::string rest;
  std::vector<std::pair<std::string, std::optional<std::string>>> items;
};

Error bad_part(const char* part, const std::string& uri, const std::string& why) {
  return Error{std::string(part) + " \"" + uri + "\": " + why};
}

Result<PartUri> cut_up(const char* part, const std::string& uri) {
  PartUri cut;
  const std::size_t colon = uri.find(':');
  cut.scheme = uri.substr(0, colon);
  if (colon == std::string::npos) {
    return cut;
  }
  const std::size_t question = uri.find('?', colon);
  cut.rest = uri.substr(colon + 1, question == std::string::npos ? question : question - colon - 1);
  if (question == std::string::npos) {
    return cut;
  }
  for (const UriItem& item : uri_items(std::string_view(uri).substr(question + 1))) {
    if (item.again) {
      return bad_part(part, uri, "key \"" + item.key + "\" is given twice");
    }
    cut.items.emplace_back(item.key, item.value);
  }
  return cut;
}

std::optional<Duration> milliseconds_in(const std::optional<std::string>& value) {
  int ms = 0;
  if (!value) {
    return std::nullopt;
  }
  const char* end = value->data() + value->size();
  const auto [rest, code] = std::from_chars(value->data(), end, ms);
  if (value->empty() || code != std::errc{} || rest != end) {
    return std::nullopt;
  }
  return std::chrono::milliseconds(ms);
}

/// Refuses an unknown key by name.
Result<std::vector<int>> codes_of(const std::string& names) {
  std::vector<int> codes;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    const std::string name = names.substr(begin, end - begin);
    const int code = desktop::key_code(name);
    if (code < 0) {
      return Error{"key \"" + name + "\" is unknown; names are those of linux/input-event-codes.h"};
    }
    codes.push_back(code);
    begin = end + 1;
  }
  return codes;
}

Status apply(const std::string& key, const std::optional<std::string>& value,
             desktop::ClickerOptions& options) {
  if (key == "share" && !value) {
    options.keys.grab = false;
    return {};
  }
  if (key == "keys" && value) {
    auto codes = codes_of(*value);
    if (!codes) {
      return codes.error();
    }
    options.keys.codes = std::move(*codes);
    return {};
  }
  Duration* wanted = key == "double_ms"     ? &options.double_within
                     : key == "hold_ms"     ? &options.hold_after
                     : key == "debounce_ms" ? &options.debounce
                                            : nullptr;
  if (!wanted) {
    return Error{"unknown key \"" + key + "\"; " + kClickerKeys};
  }
  const auto ms = milliseconds_in(value);
  if (!ms) {
    return Error{key + " must be a whole number of milliseconds"};
  }
  *wanted = *ms;
  return {};
}

/// A headset's microphone, which the headset still owns.
class BorrowedMicrophone final : public Microphone {
 public:
  explicit BorrowedMicrophone(Microphone& owned) : owned_(owned) {}

 private:
  [[nodiscard]] int do_sample_rate_hz() const override { return owned_.sample_rate_hz(); }
  Result<std::size_t> do_read(std::span<std::int16_t> samples) override {
    return owned_.read(samples);
  }
  [[nodiscard]] std::optional<Timestamp> do_newest_sample_time() const override {
    return owned_.newest_sample_time();
  }
  Microphone& owned_;
};

Result<std::unique_ptr<Microphone>> microphone_of(const std::string& uri, Headset* headset) {
  Microphone* owned = headset ? headset->microphone() : nullptr;
  if (!owned) {
    return bad_part("voice", uri, "this headset has no microphone to listen to");
  }
  return std::unique_ptr<Microphone>(std::make_unique<BorrowedMicrophone>(*owned));
}

}  // namespace

Result<std::unique_ptr<Clicker>> open_clicker(const std::string& uri, const Clock& clock) {
  if (uri == "headset") {
    return std::unique_ptr<Clicker>();
  }
  if (uri == "none") {
    return std::unique_ptr<Clicker>(std::make_unique<AbsentClicker>());
  }
  const auto cut = cut_up("clicker", uri);
  if (!cut) {
    return cut.error();
  }
  if (cut->scheme != "evdev" && cut->scheme != "keyboard") {
    return bad_part("clicker", uri, std::string("is unknown; ") + kClickers);
  }
  desktop::ClickerOptions options;
  options.device = cut->rest;
  options.full_keyboard = cut->scheme == "keyboard";
  for (const auto& [key, value] : cut->items) {
    if (Status applied = apply(key, value, options); !applied) {
      return bad_part("clicker", uri, applied.error().message);
    }
  }
  auto clicker = desktop::EvdevClicker::open(options, clock);
  if (!clicker) {
    return clicker.error();
  }
  return std::unique_ptr<Clicker>(std::move(*clicker));
}

Result<std::unique_ptr<Voice>> open_voice(const std::string& uri,
                                          const std::vector<std::string>& commands,
                                          const Clock& clock, Headset* headset) {
  if (uri == "headset") {
    return std::unique_ptr<Voice>();
  }
  if (uri == "none") {
    return std::unique_ptr<Voice>(std::make_unique<AbsentVoice>());
  }
  const auto cut = cut_up("voice", uri);
  if (!cut) {
    return cut.error();
  }
  if (cut->scheme != "mic" && cut->scheme != "wav" && cut->scheme != "headset-mic") {
    return bad_part("voice", uri, std::string("is unknown; ") + kVoices);
  }
  if (!cut->items.empty()) {
    return bad_part("voice", uri,
                    "unknown key \"" + cut->items.front().first + "\": a voice has none");
  }
  voice::SpotterOptions options;
  options.commands = commands;
  const bool file = cut->scheme == "wav";
  auto microphone = file ? desktop::open_wav_microphone(cut->rest, clock)
                    : cut->scheme == "headset-mic"
                        ? microphone_of(uri, headset)
                        : desktop::open_portaudio_microphone(cut->rest, clock);
  if (!microphone) {
    return microphone.error();
  }
  return voice::open_spotted_voice(
      std::move(*microphone), options,
      file ? voice::Listening::kInPoll : voice::Listening::kOnItsOwnThread);
}

}  // namespace orthonav
