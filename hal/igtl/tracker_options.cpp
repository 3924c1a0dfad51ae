#include "hal/igtl/tracker_options.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "base/units.h"
#include "hal/api/uri_query.h"

namespace orthonav::igtl {
namespace {

constexpr const char* kForm =
    "igtl: is followed by //HOST[:PORT]?TOOL=TRANSFORM&..., as in "
    "//10.0.0.5?pointer=ProbeToTracker&reference=ReferenceToTracker; further keys are rms_mm, "
    "rms_deg and frozen_ms";
constexpr int kMostPort = 65535;
constexpr std::size_t kMostTools = 32;
constexpr double kMostRms = 10.0;  ///< mm, and degrees
constexpr double kMostFrozen_ms = 60000.0;

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

Status take_address(std::string_view address, TrackerOptions& options) {
  std::string_view host = address;
  std::string_view port;
  // [::1]:18944: the address of version 6 holds colons of its own.
  if (const std::size_t bracket = address.find(']');
      address.starts_with('[') && bracket != address.npos) {
    host = address.substr(1, bracket - 1);
    port = address.substr(bracket + 1);
  } else if (const std::size_t colon = address.find(':'); colon != address.npos) {
    host = address.substr(0, colon);
    port = address.substr(colon);
  }
  if (host.empty()) {
    return Error{std::string("names no host; ") + kForm};
  }
  if (host.find_first_of("/@ ") != host.npos) {
    return Error{"host \"" + std::string(host) + "\" must be a name or an address"};
  }
  options.host = host;
  if (port.empty()) {
    return {};
  }
  const auto number = number_of<int>(port.substr(1));
  if (!port.starts_with(':') || !number || *number < 1 || *number > kMostPort) {
    return out_of_range("port", port.substr(1), "be a whole number from 1 to 65535");
  }
  options.port = *number;
  return {};
}

Status take_number(std::string_view key, std::string_view text, TrackerOptions& options) {
  const auto value = number_of<double>(text);
  if (key == "frozen_ms") {
    if (!value || !(*value >= 0.0 && *value <= kMostFrozen_ms)) {
      return out_of_range(key, text, "lie from 0 to 60000 (0: poses may stand still)");
    }
    options.frozen_after = from_seconds(*value * 1e-3);
    return {};
  }
  if (!value || !(*value > 0.0 && *value <= kMostRms)) {
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
  for (const NamedTransform& other : options.tools) {
    if (other.transform == transform) {
      return Error{other.tool + " and " + std::string(tool) + " can't both be " +
                   std::string(transform)};
    }
  }
  if (options.tools.size() == kMostTools) {
    return Error{"names more than " + std::to_string(kMostTools) + " tools"};
  }
  options.tools.push_back({std::string(tool), std::string(transform)});
  return {};
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
  TrackerOptions options;
  if (const Status taken = take_address(after_scheme.substr(0, question), options); !taken) {
    return taken.error();
  }
  const auto items = question == after_scheme.npos ? std::vector<UriItem>()
                                                   : uri_items(after_scheme.substr(question + 1));
  for (const UriItem& item : items) {
    if (item.again) {
      return Error{"key \"" + item.key + "\" is given twice"};
    }
    const std::string value = item.value.value_or("");
    const Status taken = is_number_key(item.key) ? take_number(item.key, value, options)
                                                 : take_tool(item.key, value, options);
    if (!taken) {
      return taken.error();
    }
  }
  if (options.tools.empty()) {
    return Error{std::string("names no tool; ") + kForm};
  }
  return options;
}

}  // namespace orthonav::igtl
