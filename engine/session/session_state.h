#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/case/operation.h"
#include "engine/session/guidance.h"
#include "engine/session/log/session_observer.h"
#include "engine/session/method.h"
#include "engine/session/session_options.h"
#include "engine/session/text/messages.h"
#include "engine/session/touch.h"
#include "engine/session/watched_tools.h"

namespace orthonav::engine {

/// The state that the steps of one operation share. Each step receives it and changes it by its
/// actions; state of a single step is kept in that step.
struct SessionState {
  SessionState(Operation operation, WatchedTools watched, Method with,
               const SessionOptions& session_options);
  SessionState(const SessionState&) = delete;
  SessionState& operator=(const SessionState&) = delete;

  /// Not where rods alone are bent.
  [[nodiscard]] LevelState& level() { return state.levels[level_in_work]; }
  [[nodiscard]] const LevelState& level() const { return state.levels[level_in_work]; }
  /// There is nothing to register: the screws are in, and rods alone are bent.
  [[nodiscard]] bool rods_alone() const { return state.levels.empty(); }
  /// Whether World is attached to a patient reference.
  [[nodiscard]] bool anchored() const { return tools.tracker().anchor() != nullptr; }
  /// Whether there is an observer.
  [[nodiscard]] bool heard() const { return observer != &nobody; }

  SessionOptions options;
  Method method;
  WatchedTools tools;
  OperationState state;
  std::size_t level_in_work = 0;  ///< an index into the levels
  Step step = Step::kSetup;
  std::optional<Part> stalled;  ///< in the newest pair; nothing is guided then
  bool waits = true;            ///< for what is computed beside it: time stands still meanwhile
  bool no_clicker = false;      ///< in the newest pair
  Touches touches;              ///< of the present step, with the present press
  Messages messages;
  SessionObserver nobody;
  SessionObserver* observer = &nobody;  ///< never null. Borrowed.
};

/// Adds the tip of that tool in the newest pair to the touch.
void add_tip(Touch& touch, const WatchedTools& tools, std::size_t tool);

/// Where the pointer's tip rested; ends the touch.
[[nodiscard]] TouchedPlace take_place(SessionState& work, Timestamp time);

}  // namespace orthonav::engine
