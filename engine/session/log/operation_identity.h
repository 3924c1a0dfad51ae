#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/session/guidance.h"
#include "engine/session/known_errors.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// Identifies an operation well enough to tell whether another program continues the same one.
struct OperationIdentity {
  std::string case_name;
  std::vector<std::string> levels;  ///< to be operated, in order
  std::string models_hash;          ///< of every model of the case (BitHash)
  std::string plan_hash;            ///< of the screws as planned before surgery
  std::string tools_hash;
  std::string method;
  bool patient_reference = false;
  std::string room;   ///< identifies a simulated patient; empty: a real one
  std::string begun;  ///< wall-clock time of the start, for human readers only
  // Of no operation in particular, but what its report has to tell.
  std::string orthonav;               ///< the version that began it
  std::string device;                 ///< the headset's name
  std::uint64_t seed = 0;             ///< of a simulated room; 0: nothing was drawn
  std::int64_t epoch_100ns = 0;       ///< Headset::epoch_ticks_100ns when it began
  std::optional<ErrorsInUse> errors;  ///< that all strokes share, as assumed at the start
};

/// Fills in what tells operations apart, but for `room`; uses the preoperative plan.
[[nodiscard]] OperationIdentity identity_of(const std::string& case_name,
                                            std::span<const LevelState> levels,
                                            std::span<const nav::ToolGeometry> tools,
                                            const std::string& method, bool patient_reference);

/// "levels L4, L5", or "rods alone".
[[nodiscard]] std::string levels_text(const OperationIdentity& identity);

/// Refuses, in one line, to continue `recorded` as `now` if patient, plan, tools or method differ.
/// `name` is the file that `recorded` was read from.
Status check_same(const OperationIdentity& recorded, const OperationIdentity& now,
                  const std::string& name);

}  // namespace orthonav::engine
