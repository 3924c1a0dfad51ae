#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "engine/io/json_document.h"
#include "engine/session/calibration_in_use.h"
#include "engine/session/guidance.h"
#include "engine/session/guide_checks.h"
#include "engine/session/operation_identity.h"

namespace orthonav::engine {

// The content of the log of an operation as JSON: SI units, each number to the last bit. Infinite
// values are left out, as is everything that follows from the rest. The readers note errors in the
// node's document.

using LogJson = nlohmann::ordered_json;

/// A record of something that happened at `time`, on the device's clock.
[[nodiscard]] LogJson json_at(Timestamp time);
[[nodiscard]] LogJson json_of(const OperationIdentity& identity);
[[nodiscard]] LogJson json_of(const nav::Region& region);
[[nodiscard]] LogJson json_of(const nav::Registration& registration);
[[nodiscard]] LogJson json_of(const nav::ScrewPlan& screw);
[[nodiscard]] LogJson json_of(const nav::ExecutedTrajectory& executed);
[[nodiscard]] LogJson json_of(const nav::ScrewClearance& clearance);
[[nodiscard]] LogJson json_of(const PlacedWire& wire);
[[nodiscard]] LogJson json_of(const Landmark& landmark);
[[nodiscard]] LogJson json_of(const nav::ReferencePlace& place);
[[nodiscard]] LogJson json_of(const TipDifference& difference);
[[nodiscard]] LogJson json_of(const AxisDifference& difference);
[[nodiscard]] LogJson json_of(const CalibrationInUse& found);
[[nodiscard]] LogJson json_of(const ErrorsInUse& errors);
/// The tool against its screw: of it only the figures that a report has.
[[nodiscard]] LogJson json_of(const nav::ScrewGuidance& at_depth);
/// A rod that is done: of its template and its instructions only what a report has. Its heads are
/// told as they are touched.
[[nodiscard]] LogJson json_of(const RodState& rod);
[[nodiscard]] LogJson json_of(Vec3 v);

[[nodiscard]] OperationIdentity identity_from(const JsonNode& node);
[[nodiscard]] nav::Region region_from(const JsonNode& node);
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
[[nodiscard]] nav::ExecutedTrajectory executed_from(const JsonNode& node);
[[nodiscard]] nav::ScrewClearance clearance_from(const JsonNode& node);
[[nodiscard]] PlacedWire wire_from(const JsonNode& node);
[[nodiscard]] nav::CheckPoint check_point_from(const JsonNode& node);
[[nodiscard]] Landmark landmark_from(const JsonNode& node);
[[nodiscard]] nav::ReferencePlace place_from(const JsonNode& node);
[[nodiscard]] TipDifference tips_from(const JsonNode& node);
[[nodiscard]] AxisDifference axis_from(const JsonNode& node);
[[nodiscard]] CalibrationInUse calibration_from(const JsonNode& node);
[[nodiscard]] ErrorsInUse errors_from(const JsonNode& node);
[[nodiscard]] nav::ScrewGuidance at_depth_from(const JsonNode& node);
/// Adds to a rod, whose heads are known, what `json_of` told of it.
void read_rod(const JsonNode& node, RodState& rod);

/// The hash of the points that a registration was computed from.
[[nodiscard]] std::string hash_of(std::span<const Point<World>> points);

}  // namespace orthonav::engine
