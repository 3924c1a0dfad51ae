#include "hal/hl2ss/options.h"

#include <algorithm>
#include <array>
#include <set>

#include "hal/net/host_port.h"

namespace orthonav::hl2ss {
namespace {

constexpr const char* kKnownKeys =
    "known are profile=raw|h264, stamps=late|exact, scene=on|off, depth=STREAM, port=BASE "
    "and standin=PORT";
constexpr const char* kKnownDepth =
    "must be ahat, ahat-h264, long-throw or long-throw-png (research mode runs one of "
    "the "
    "two)";
constexpr int kMaxFirstPort = net::kMaxPort - kLastOffset;

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
  constexpr std::array<Choice<DepthWish>, 4> kWishes = {{
      {"ahat", {DepthStream::kAhat, DepthCoding::kRaw}},
      {"ahat-h264", {DepthStream::kAhat, DepthCoding::kH264}},
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
  constexpr std::array<std::string_view, 6> kKeys = {"profile", "stamps", "scene",
                                                     "depth",   "port",   "standin"};
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
  const auto port = net::port_from(key, value, 1, key == "port" ? kMaxFirstPort : net::kMaxPort);
  if (!port) {
    return port.error();
  }
  (key == "port" ? options.first_port : options.standin_port) = *port;
  return {};
}

}  // namespace

Result<Hl2ssOptions> options_of(std::string_view after_scheme) {
  if (!after_scheme.starts_with("//")) {
    return Error{"hl2ss: is followed by //HOST[:PORT]; " + std::string(kKnownKeys)};
  }
  after_scheme.remove_prefix(2);
  const std::size_t question = after_scheme.find('?');
  const auto place = net::host_and_port(after_scheme.substr(0, question));
  if (!place) {
    return place.error();
  }
  Hl2ssOptions options;
  options.host = place->host;
  std::set<std::string> seen;
  if (place->port) {
    if (*place->port > kMaxFirstPort) {
      return net::port_from("port", std::to_string(*place->port), 1, kMaxFirstPort).error();
    }
    options.first_port = *place->port;
    seen.insert("port");
  }
  if (question == std::string_view::npos) {
    return options;
  }
  std::string_view rest = after_scheme.substr(question + 1);
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
