#include "hal/open/open.h"

#include <charconv>
#include <string_view>
#include <utility>

#include "hal/api/uri_query.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/open/bad_uri.h"
#include "hal/open/open_openxr.h"
#include "hal/open/registered_schemes.h"
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

Status apply_sim_key(const std::string& uri, const UriItem& item, sim::SimOptions& options) {
  const std::string& key = item.key;
  if (key != "seed" && key != "perfect" && key != "realtime" && key != "depth") {
    return bad_uri(uri, "unknown key \"" + key + "\"; " + kKnownSimKeys);
  }
  if (item.again) {
    return bad_uri(uri, "key \"" + key + "\" is given twice");
  }
  if (key == "seed") {
    const std::string value = item.value.value_or("");
    const char* end = value.data() + value.size();
    const auto [rest, code] = std::from_chars(value.data(), end, options.seed);
    if (value.empty() || code != std::errc{} || rest != end) {
      return bad_uri(uri,
                     "seed \"" + value + "\" is not a whole number from 0 to 18446744073709551615");
    }
    return {};
  }
  if (item.value) {
    return bad_uri(uri, "key \"" + key + "\" takes no value");
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

Result<sim::SimOptions> sim_options(const std::string& uri, std::string_view rest,
                                    sim::SimOptions options) {
  if (rest.empty()) {
    return options;
  }
  if (rest.front() != '?') {
    return bad_uri(
        uri, "sim: is followed by nothing or by ?key=value&...; " + std::string(kKnownSimKeys));
  }
  for (const UriItem& item : uri_items(rest.substr(1))) {
    if (Status status = apply_sim_key(uri, item, options); !status) {
      return status.error();
    }
  }
  return options;
}

constexpr const char* kReplayKeys = "known are pace=fast|realtime|step and stamps=recorder|exact";

Status apply_replay_key(const std::string& uri, std::string_view item,
                        replay::ReplayOptions& options) {
  if (item == "pace=realtime") {
    options.pace = replay::ReplayPace::kRealtime;
  } else if (item == "pace=step") {
    options.pace = replay::ReplayPace::kStepped;
  } else if (item == "stamps=exact") {
    options.stamps = replay::RecordedStamps::kExact;
  } else if (item.starts_with("pace") && item != "pace=fast") {
    return bad_uri(uri, "pace is unknown; known are fast, realtime and step");
  } else if (item != "pace=fast" && item != "stamps=recorder") {
    return bad_uri(uri, "\"" + std::string(item) + "\" is unknown; " + kReplayKeys);
  }
  return {};
}

/// Folder and options of "PATH?pace=...&stamps=...".
Result<std::pair<std::string, replay::ReplayOptions>> replay_options(const std::string& uri,
                                                                     const std::string& rest) {
  // A folder's name may hold a question mark.
  std::size_t question = rest.rfind('?');
  if (question != std::string::npos && rest.compare(question, 5, "?pace") != 0 &&
      rest.compare(question, 7, "?stamps") != 0) {
    question = std::string::npos;
  }
  const std::string folder = rest.substr(0, question);
  if (folder.empty()) {
    return bad_uri(uri, "names no folder after replay:");
  }
  replay::ReplayOptions options;
  if (question == std::string::npos) {
    return std::pair(folder, options);
  }
  std::string_view items = std::string_view(rest).substr(question + 1);
  while (!items.empty()) {
    const std::size_t end = items.find('&');
    if (Status status = apply_replay_key(uri, items.substr(0, end), options); !status) {
      return status.error();
    }
    items = end == std::string_view::npos ? std::string_view{} : items.substr(end + 1);
  }
  return std::pair(folder, options);
}

/// The simulated operating room.
Result<OpenedHeadset> open_sim(const std::string& uri, const std::string& rest,
                               const OpenOptions& options) {
  auto chosen = sim_options(uri, rest, options.sim);
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
  return OpenedHeadset{std::move(*opened), seen, {}, {}};
}

/// A headset whose cameras see no simulated room.
template <class T>
Result<OpenedHeadset> without_room(Result<std::unique_ptr<T>> opened) {
  if (!opened) {
    return opened.error();
  }
  return OpenedHeadset{std::move(*opened), nullptr, {}, {}};
}

Result<OpenedHeadset> open_replay(const std::string& uri, const std::string& rest) {
  const auto chosen = replay_options(uri, rest);
  if (!chosen) {
    return chosen.error();
  }
  auto opened = replay::ReplayHeadset::open(chosen->first, chosen->second);
  std::string warning = opened ? replay::cut_warning((*opened)->summary()) : "";
  auto headset = without_room(std::move(opened));
  if (headset) {
    headset->warning = std::move(warning);
  }
  return headset;
}

Result<OpenedHeadset> open_hl2ss(const std::string& rest, const OpenOptions& options) {
  hl2ss::Hl2ssOptions wanted = *hl2ss::options_of(rest);
  wanted.phrases = options.phrases;
  auto opened = hl2ss::Hl2ssHeadset::open(wanted);
  std::string warning = opened ? (*opened)->depth_trouble() : "";
  auto headset = without_room(std::move(opened));
  if (headset) {
    headset->warning = std::move(warning);
  }
  return headset;
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
  const std::string scheme = uri.substr(0, colon);
  const std::string rest = uri.substr(colon + 1);
  if (scheme == "sim") {
    const auto options = sim_options(uri, rest, {});
    return options ? Status{} : options.error();
  }
  if (scheme == "replay") {
    const auto options = replay_options(uri, rest);
    return options ? Status{} : options.error();
  }
  if (scheme == "hl2ss") {
    const auto options = hl2ss::options_of(rest);
    return options ? Status{} : Status(bad_uri(uri, options.error().message));
  }
  if (scheme == "openxr") {
    return {};
  }
  const auto registered = registered_scheme(scheme);
  if (!registered) {
    return bad_uri(uri, "unknown scheme \"" + scheme + "\"; " + known_schemes());
  }
  const Status good = registered->check ? registered->check(rest) : Status{};
  return good ? good : Status(bad_uri(uri, good.error().message));
}

Result<OpenedHeadset> open_with_room(const std::string& uri, const OpenOptions& options) {
  if (const Status good = check_headset_uri(uri); !good) {
    return good.error();
  }
  const std::size_t colon = uri.find(':');
  const std::string scheme = uri.substr(0, colon);
  const std::string rest = uri.substr(colon + 1);
  if (scheme == "sim") {
    return open_sim(uri, rest, options);
  }
  if (scheme == "replay") {
    return open_replay(uri, rest);
  }
  if (scheme == "hl2ss") {
    return open_hl2ss(rest, options);
  }
  if (const auto registered = registered_scheme(scheme)) {
    return without_room(registered->open(rest));
  }
  return open_openxr(uri, rest, options);
}

}  // namespace orthonav
