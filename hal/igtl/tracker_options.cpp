#include "hal/igtl/tracker_options.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "base/units.h"
#include "hal/api/uri_query.h"
#include "hal/igtl/header.h"
#include "hal/net/host_port.h"

namespace orthonav::igtl {
namespace {

constexpr const char* kForm =
    "igtl: is followed by //HOST[:PORT]?TOOL=TRANSFORM&..., as in "
    "//10.0.0.5?pointer=ProbeToTracker&reference=ReferenceToTracker; further keys are port, "
    "rms_mm, rms_deg and frozen_ms";
constexpr std::size_t kMaxTools = 32;
constexpr double kMaxRms = 10.0;  ///< mm, and degrees
constexpr double kMaxFrozen_ms = 60000.0;

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  return !text.empty() && code == std::errc{} && rest == end ? std::optional(value) : std::nullopt;
}

Error out_of_range(std::string_view key, std::string_view value, const std::string& range) {
  return Error{std::string(key) + " \"" + std::string(value) + "\" must " + range};
}

Status take_port(std::string_view text, TrackerOptions& options) {
  const auto port = net::port_from("port", text);
  if (!port) {
    return port.error();
  }
  options.port = *port;
  return {};
}

Status take_number(std::string_view key, std::string_view text, TrackerOptions& options) {
  const auto value = number_of<double>(text);
  if (key == "frozen_ms") {
    if (!value || !(*value >= 0.0 && *value <= kMaxFrozen_ms)) {
      return out_of_range(key, text, "lie from 0 to 60000 (0: poses may stand still)");
    }
    options.frozen_after = from_seconds(*value * 1e-3);
    return {};
  }
  if (!value || !(*value > 0.0 && *value <= kMaxRms)) {
    return out_of_range(key, text, "be greater than 0 and at most 10");
  }
  if (key == "rms_mm") {
    options.rms_m = *value * kMetresPerMm;
  } else {
    options.rms_rad = *value * kRadiansPerDegree;
  }
  return {};
}

Status take_tool(std::string_view tool, std::string_view transform, TrackerOptions& options) {
  if (tool.empty() || transform.empty()) {
    return Error{"\"" + std::string(tool) + "\" must name a transform; " + kForm};
  }
  const std::string_view sent = transform.substr(0, kNameBytes);
  for (const NamedTransform& other : options.tools) {
    if (other.transform.substr(0, kNameBytes) == sent) {
      return Error{other.tool + " and " + std::string(tool) + " can't both be " +
                   std::string(sent) +
                   (sent == transform ? "" : ": names are sent with 20 bytes at most")};
    }
  }
  if (options.tools.size() == kMaxTools) {
    return Error{"names more than " + std::to_string(kMaxTools) + " tools"};
  }
  options.tools.push_back({std::string(tool), std::string(transform)});
  return {};
}

/// Poses in different frames look right until the patient moves.
Status check_frames(const std::vector<NamedTransform>& tools) {
  std::string listed;
  std::optional<std::string> common;
  bool one_frame = true;
  for (const NamedTransform& each : tools) {
    const std::string which = each.tool + "=" + each.transform;
    const auto named = frames_named(each.transform);
    if (!named && tools.size() > 1) {
      return Error{each.tool + "=" + named.error().message};
    }
    const NamedFrames frames = named ? named->value_or(NamedFrames{}) : NamedFrames{};
    if (!frames.of.empty() && frames.of == frames.in) {
      return Error{which + " is no pose: of a frame in itself. All tools, the patient reference " +
                   "too, are sent in the tracker's own frame, as in " + frames.of + "ToTracker"};
    }
    one_frame = one_frame && frames.in == common.value_or(frames.in);
    common = frames.in;
    listed += (listed.empty() ? "" : ", ") + which +
              (frames.in.empty() ? " in none that it states" : " in \"" + frames.in + "\"");
  }
  if (one_frame) {
    return {};
  }
  return Error{"the tools are in different frames: " + listed +
               "; they must be in one, the tracker's own: name transforms to that frame, and have "
               "the sender send them (PlusServer: TransformNames)"};
}

bool is_number_key(std::string_view key) {
  return key == "rms_mm" || key == "rms_deg" || key == "frozen_ms";
}

}  // namespace

PoseCovariance TrackerOptions::covariance() const {
  PoseCovariance out{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out[7 * axis] = rms_m * rms_m / 3.0;
    out[7 * (axis + 3)] = rms_rad * rms_rad / 3.0;
  }
  return out;
}

Result<TrackerOptions> tracker_options_of(std::string_view after_scheme) {
  if (!after_scheme.starts_with("//")) {
    return Error{kForm};
  }
  after_scheme.remove_prefix(2);
  const std::size_t question = after_scheme.find('?');
  const auto place = net::host_and_port(after_scheme.substr(0, question));
  if (!place) {
    return place.error();
  }
  TrackerOptions options;
  options.host = place->host;
  options.port = place->port.value_or(kUsualPort);
  const auto items = question == after_scheme.npos ? std::vector<UriItem>()
                                                   : uri_items(after_scheme.substr(question + 1));
  for (const UriItem& item : items) {
    if (item.again || (item.key == "port" && place->port)) {
      return Error{"key \"" + item.key + "\" is given twice"};
    }
    const std::string value = item.value.value_or("");
    const Status taken = item.key == "port"        ? take_port(value, options)
                         : is_number_key(item.key) ? take_number(item.key, value, options)
                                                   : take_tool(item.key, value, options);
    if (!taken) {
      return taken.error();
    }
  }
  if (options.tools.empty()) {
    return Error{std::string("names no tool; ") + kForm};
  }
  if (const Status good = check_frames(options.tools); !good) {
    return good.error();
  }
  return options;
}

}  // namespace orthonav::igtl
