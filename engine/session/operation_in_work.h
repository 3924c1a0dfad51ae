#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/case/operation.h"
#include "engine/session/guidance.h"
#include "engine/session/messages.h"
#include "engine/session/method.h"
#include "engine/session/session_observer.h"
#include "engine/session/session_options.h"
#include "engine/session/touch.h"
#include "engine/session/watched_tools.h"

namespace orthonav::engine {

/// What the steps of one operation share. A step is handed it and changes it by its actions; what
/// only one step knows is that step's own.
struct OperationInWork {
  OperationInWork(Operation operation, WatchedTools watched, Method with,
                  const SessionOptions& session_options);
  OperationInWork(const OperationInWork&) = delete;
  OperationInWork& operator=(const OperationInWork&) = delete;

  [[nodiscard]] LevelState& level() { return levels[level_in_work]; }
  [[nodiscard]] const LevelState& level() const { return levels[level_in_work]; }
  /// World is that of a patient reference.
  [[nodiscard]] bool anchored() const { return tools.tracker().anchor() != nullptr; }
  /// Somebody listens.
  [[nodiscard]] bool heard() const { return observer != &nobody; }

  SessionOptions options;
  Method method;
  WatchedTools tools;
  std::vector<LevelState> levels;
  std::size_t level_in_work = 0;  ///< an index into `levels`
  Step step = Step::kSetup;
  std::optional<Part> stalled;  ///< in the newest pair: nothing is guided
  Messages messages;
  SessionObserver nobody;
  SessionObserver* observer = &nobody;  ///< never null. Borrowed.
};

/// Takes the tip of that tool in the newest pair to what is being touched.
void add_tip(Touch& touch, const WatchedTools& tools, std::size_t tool);

/// Where the pointer's tip rested; ends the touch.
[[nodiscard]] TouchedPlace take_place(Touch& touch, const OperationInWork& work, Timestamp time);

/// Of the level's registration, which is there.
[[nodiscard]] RegistrationFigures figures_of(const LevelState& level);

}  // namespace orthonav::engine
