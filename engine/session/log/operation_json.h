#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/io/json_document.h"
#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

// The content of the log of an operation as JSON: SI units, each number to the last bit. Infinite
// values are left out, as is everything that follows from the rest. The readers note errors in the
// node's document. Here is what several records hold, and the operation; what a step tells is in
// its file of steps/.

using LogJson = nlohmann::ordered_json;

struct CalibrationInUse;
struct ErrorsInUse;
struct OperationIdentity;

/// A record of something that happened at `time`, on the device's clock.
[[nodiscard]] LogJson json_at(Timestamp time);
[[nodiscard]] LogJson json_of(const OperationIdentity& identity);
[[nodiscard]] LogJson json_of(const nav::Registration& registration);
[[nodiscard]] LogJson json_of(const nav::ScrewPlan& screw);
[[nodiscard]] LogJson json_of(const nav::ReferencePlace& place);
[[nodiscard]] LogJson json_of(const CalibrationInUse& found);
[[nodiscard]] LogJson json_of(const ErrorsInUse& errors);
[[nodiscard]] LogJson json_of(Vec3 v);

[[nodiscard]] OperationIdentity identity_from(const JsonNode& node);
[[nodiscard]] nav::Registration registration_from(const JsonNode& node);
[[nodiscard]] Side side_from(const JsonNode& node);
/// The value of an enumeration of `count` values that stands there by its name.
template <class Enum>
[[nodiscard]] Enum named(const JsonNode& node, const char* key, std::size_t count) {
  const std::string name = node.text(key);
  for (std::size_t i = 0; i < count; ++i) {
    if (name_of(static_cast<Enum>(i)) == name) {
      return static_cast<Enum>(i);
    }
  }
  node.refuse(key, "\"" + name.substr(0, 40) + "\" is unknown");
  return {};
}
[[nodiscard]] nav::ScrewPlan screw_from(const JsonNode& node);
[[nodiscard]] nav::ReferencePlace place_from(const JsonNode& node);
[[nodiscard]] CalibrationInUse calibration_from(const JsonNode& node);
[[nodiscard]] ErrorsInUse errors_from(const JsonNode& node);

// The values that records are made of.

/// Infinite values are left out, because JSON has no infinity.
void put_bounded(LogJson& json, const char* key, double value);
[[nodiscard]] double bounded(const JsonNode& node, const char* key);
[[nodiscard]] std::size_t count_from(const JsonNode& node, const char* key);
template <std::size_t n>
[[nodiscard]] std::array<double, n> array_from(const JsonNode& node, const char* key) {
  std::array<double, n> values{};
  const std::vector<double> read = node.numbers(key, n);
  std::copy_n(read.begin(), std::min(n, read.size()), values.begin());
  return values;
}
/// The most samples of a region, and places of a registration.
inline constexpr std::size_t kMostSamples = 1'000'000;

}  // namespace orthonav::engine
