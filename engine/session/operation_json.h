#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "engine/io/json_document.h"
#include "engine/session/guidance.h"
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
[[nodiscard]] LogJson json_of(Vec3 v);

[[nodiscard]] OperationIdentity identity_from(const JsonNode& node);
[[nodiscard]] nav::Region region_from(const JsonNode& node);
[[nodiscard]] nav::Registration registration_from(const JsonNode& node);
[[nodiscard]] Side side_from(const JsonNode& node);
/// A number of things, not negative.
[[nodiscard]] std::size_t count_of(const JsonNode& line, const char* key);
/// The number of heads after a line that says that one was touched, or that the last touch was
/// taken back, from the number before it. Lines from before heads were touched several times do not
/// count touches: each was of another head.
[[nodiscard]] std::size_t heads_after(const JsonNode& line, bool touched, std::size_t heads);
[[nodiscard]] nav::ScrewPlan screw_from(const JsonNode& node);
[[nodiscard]] nav::ExecutedTrajectory executed_from(const JsonNode& node);
[[nodiscard]] nav::ScrewClearance clearance_from(const JsonNode& node);
[[nodiscard]] PlacedWire wire_from(const JsonNode& node);
[[nodiscard]] nav::CheckPoint check_point_from(const JsonNode& node);
[[nodiscard]] Landmark landmark_from(const JsonNode& node);
[[nodiscard]] nav::ReferencePlace place_from(const JsonNode& node);

/// The hash of the points that a registration was computed from.
[[nodiscard]] std::string hash_of(std::span<const Point<World>> points);

}  // namespace orthonav::engine
