#include "hal/open/open.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "base/mutex.h"
#include "hal/api/uri_query.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/igtl/tracker_headset.h"
#include "hal/open/bad_uri.h"
#include "hal/open/open_openxr.h"
#include "hal/replay/replay_headset.h"

namespace orthonav {

namespace {

constexpr const char* kKnownSimKeys = "known are seed=N, perfect, realtime and depth";

sim::RoomTool default_pointer() {
  sim::RoomTool pointer;
  pointer.name = "pointer";
  pointer.id = 3;
  pointer.size_m = 0.050;
  pointer.tip_in_marker = {{0.0, -0.150, 0.0}};
  return pointer;
}

Status apply_sim_key(const UriItem& item, sim::SimOptions& options) {
  const std::string& key = item.key;
  if (key != "seed" && key != "perfect" && key != "realtime" && key != "depth") {
    return Error{"unknown key \"" + key + "\"; " + kKnownSimKeys};
  }
  if (item.again) {
    return Error{"key \"" + key + "\" is given twice"};
  }
  if (key == "seed") {
    const std::string value = item.value.value_or("");
    const char* end = value.data() + value.size();
    const auto [rest, code] = std::from_chars(value.data(), end, options.seed);
    if (value.empty() || code != std::errc{} || rest != end) {
      return Error{"seed \"" + value + "\" is not a whole number from 0 to 18446744073709551615"};
    }
    return {};
  }
  if (item.value) {
    return Error{"key \"" + key + "\" takes no value"};
  }
  if (key == "perfect") {
    options.error_model = sim::ErrorModel::perfect();
    options.depth_errors = sim::DepthErrors::none();
  }
  if (key == "realtime") {
    options.pace = sim::Pace::kRealtime;
  }
  if (key == "depth") {
    options.depth = {DepthStream::kAhat, DepthStream::kLongThrow};
  }
  return {};
}

Result<sim::SimOptions> sim_options(std::string_view rest, sim::SimOptions options) {
  if (rest.empty()) {
    return options;
  }
  if (rest.front() != '?') {
    return Error{"sim: is followed by nothing or by ?key=value&...; " + std::string(kKnownSimKeys)};
  }
  for (const UriItem& item : uri_items(rest.substr(1))) {
    if (Status status = apply_sim_key(item, options); !status) {
      return status.error();
    }
  }
  return options;
}

Status check_sim(const std::string& rest) {
  const auto options = sim_options(rest, {});
  return options ? Status{} : options.error();
}

/// The simulated operating room.
Result<OpenedHeadset> open_sim(const std::string& rest, const OpenOptions& options) {
  auto chosen = sim_options(rest, options.sim);
  if (!chosen) {
    return chosen.error();
  }
  sim::RoomDescription room = options.room;
  if (room.tools.empty()) {
    room.tools.push_back(default_pointer());
  }
  auto opened = sim::SimHeadset::open(std::move(room), *chosen);
  if (!opened) {
    return opened.error();
  }
  sim::SimHeadset* const seen = opened->get();
  return OpenedHeadset{{std::move(*opened), {}}, seen, {}};
}

/// Those of this library, then those from outside. Without an `open`: sim, which needs a room, and
/// openxr, which opens another URI.
struct Schemes {
  Mutex mutex;
  std::vector<HeadsetScheme> list ORTHONAV_GUARDED_BY(mutex) = {
      {"sim", "sim:", check_sim, nullptr},
      replay::scheme(),
      hl2ss::scheme(),
      igtl::scheme(),
      {"openxr", "openxr:+URI", nullptr, nullptr}};
};

Schemes& schemes() {
  static Schemes all;
  return all;
}

std::optional<HeadsetScheme> scheme_named(const std::string& name) {
  Schemes& all = schemes();
  const MutexLock lock(all.mutex);
  const auto found = std::find_if(all.list.begin(), all.list.end(),
                                  [&](const HeadsetScheme& each) { return each.name == name; });
  return found == all.list.end() ? std::nullopt : std::optional(*found);
}

/// "known are sim:, replay:PATH, ... and mine:SERIAL".
std::string known_schemes() {
  Schemes& all = schemes();
  const MutexLock lock(all.mutex);
  std::string text = "known are ";
  for (std::size_t i = 0; i < all.list.size(); ++i) {
    const HeadsetScheme& scheme = all.list[i];
    text += i == 0 ? "" : i + 1 == all.list.size() ? " and " : ", ";
    text += scheme.usage.empty() ? scheme.name + ":" : scheme.usage;
  }
  return text;
}

bool is_well_formed(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
}

}  // namespace

Result<std::unique_ptr<Headset>> open_headset(const std::string& uri, const OpenOptions& options) {
  auto opened = open_with_room(uri, options);
  if (!opened) {
    return opened.error();
  }
  return std::move(opened->headset);
}

Status check_headset_uri(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string::npos) {
    return bad_uri(uri, "has no scheme; " + known_schemes());
  }
  const std::string name = uri.substr(0, colon);
  const auto scheme = scheme_named(name);
  if (!scheme) {
    return bad_uri(uri, "unknown scheme \"" + name + "\"; " + known_schemes());
  }
  const Status good = scheme->check ? scheme->check(uri.substr(colon + 1)) : Status{};
  return good ? good : Status(bad_uri(uri, good.error().message));
}

Status register_scheme(HeadsetScheme scheme) {
  if (!is_well_formed(scheme.name)) {
    return Error{"scheme \"" + scheme.name + "\": must be lower-case letters and digits"};
  }
  if (!scheme.open) {
    return Error{"scheme \"" + scheme.name + "\": has nothing that opens it"};
  }
  Schemes& all = schemes();
  const MutexLock lock(all.mutex);
  const bool taken = std::any_of(all.list.begin(), all.list.end(), [&scheme](const auto& other) {
    return other.name == scheme.name;
  });
  if (taken) {
    return Error{"scheme \"" + scheme.name + "\": is taken"};
  }
  all.list.push_back(std::move(scheme));
  return {};
}

Result<OpenedHeadset> open_with_room(const std::string& uri, const OpenOptions& options) {
  if (const Status good = check_headset_uri(uri); !good) {
    return good.error();
  }
  const std::size_t colon = uri.find(':');
  const std::string name = uri.substr(0, colon);
  const std::string rest = uri.substr(colon + 1);
  if (name == "sim") {
    return open_sim(rest, options);
  }
  if (name == "openxr") {
    return open_openxr(uri, rest, options);
  }
  auto opened = scheme_named(name)->open(rest, options.phrases);
  if (!opened) {
    return opened.error();
  }
  return OpenedHeadset{std::move(*opened), nullptr, {}};
}

}  // namespace orthonav
