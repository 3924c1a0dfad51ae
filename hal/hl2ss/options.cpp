#include "hal/hl2ss/options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

namespace orthonav::hl2ss {
namespace {

constexpr const char* kKnownKeys =
    "known are profile=raw|h264, stamps=late|exact, scene=on|off, depth=STREAM, port=BASE, "
    "standin=PORT and token=FILE";
constexpr const char* kKnownDepth =
    "must be ahat, ahat-h264, ahat-hevc, long-throw or long-throw-png (research mode runs one of "
    "the "
    "two)";
constexpr int kMaxPort = 65535;

Result<int> port_of(const std::string& key, std::string_view text, int largest) {
  int port = 0;
  const auto [rest, code] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (text.empty() || code != std::errc{} || rest != text.data() + text.size() || port < 1 ||
      port > largest) {
    return Error{key + " \"" + std::string(text) + "\" must be a whole number from 1 to " +
                 std::to_string(largest)};
  }
  return port;
}

template <class T>
struct Choice {
  std::string_view name;
  T value;
};

template <class T>
Status choose(const std::string& key, std::string_view name, const Choice<T>& one,
              const Choice<T>& other, T& chosen) {
  if (name != one.name && name != other.name) {
    return Error{key + " \"" + std::string(name) + "\" must be " + std::string(one.name) + " or " +
                 std::string(other.name)};
  }
  chosen = name == one.name ? one.value : other.value;
  return {};
}

Status choose_depth(std::string_view name, Hl2ssOptions& options) {
  constexpr std::array<Choice<DepthWish>, 5> kWishes = {{
      {"ahat", {DepthStream::kAhat, DepthCoding::kRaw}},
      {"ahat-h264", {DepthStream::kAhat, DepthCoding::kH264}},
      {"ahat-hevc", {DepthStream::kAhat, DepthCoding::kHevc}},
      {"long-throw", {DepthStream::kLongThrow, DepthCoding::kRaw}},
      {"long-throw-png", {DepthStream::kLongThrow, DepthCoding::kPng}},
  }};
  for (const auto& wish : kWishes) {
    if (wish.name == name) {
      options.depth = wish.value;
      return {};
    }
  }
  return Error{"depth \"" + std::string(name) + "\" " + kKnownDepth};
}

Status apply(std::string_view item, std::set<std::string>& seen, Hl2ssOptions& options) {
  const std::size_t equals = item.find('=');
  const std::string key(item.substr(0, equals));
  const bool has_value = equals != std::string_view::npos;
  const std::string_view value = has_value ? item.substr(equals + 1) : std::string_view{};
  constexpr std::array<std::string_view, 7> kKeys = {"profile", "stamps",  "scene", "depth",
                                                     "port",    "standin", "token"};
  if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
    return Error{"unknown key \"" + key + "\"; " + kKnownKeys};
  }
  if (!seen.insert(key).second) {
    return Error{"key \"" + key + "\" is given twice"};
  }
  if (key == "profile") {
    return choose(key, value, {"raw", VideoProfile::kRaw}, {"h264", VideoProfile::kH264Base},
                  options.profile);
  }
  if (key == "stamps") {
    return choose(key, value, {"late", kResearchModeStampsLate}, {"exact", Duration::zero()},
                  options.stamps_late);
  }
  if (key == "scene") {
    return choose(key, value, {"on", true}, {"off", false}, options.scene);
  }
  if (key == "depth") {
    return choose_depth(value, options);
  }
  if (key == "token") {
    if (value.empty()) {
      return Error{"token needs a file"};
    }
    options.token_file = value;
    return {};
  }
  const auto port = port_of(key, value, key == "port" ? kMaxPort - kLastOffset : kMaxPort);
  if (!port) {
    return port.error();
  }
  (key == "port" ? options.first_port : options.standin_port) = *port;
  return {};
}

}  // namespace

Result<Hl2ssOptions> options_of(std::string_view after_scheme) {
  if (!after_scheme.starts_with("//")) {
    return Error{"hl2ss: is followed by //HOST; " + std::string(kKnownKeys)};
  }
  after_scheme.remove_prefix(2);
  const std::size_t question = after_scheme.find('?');
  Hl2ssOptions options;
  options.host = after_scheme.substr(0, question);
  if (options.host.size() > 2 && options.host.front() == '[' && options.host.back() == ']') {
    options.host = options.host.substr(1, options.host.size() - 2);
  }
  if (options.host.empty()) {
    return Error{"names no host after hl2ss://"};
  }
  if (options.host.find_first_of("/@ ") != std::string::npos) {
    return Error{"host \"" + options.host + "\" must be a name or an address"};
  }
  if (question == std::string_view::npos) {
    return options;
  }
  std::string_view rest = after_scheme.substr(question + 1);
  std::set<std::string> seen;
  for (;;) {
    const std::size_t end = rest.find('&');
    if (const Status applied = apply(rest.substr(0, end), seen, options); !applied) {
      return applied.error();
    }
    if (end == std::string_view::npos) {
      return options;
    }
    rest.remove_prefix(end + 1);
  }
}

}  // namespace orthonav::hl2ss
