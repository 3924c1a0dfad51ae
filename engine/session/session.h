#pragma once

#include <memory>
#include <optional>
#include <span>

#include "engine/case/operation.h"
#include "engine/session/guidance.h"
#include "engine/session/logged_operation.h"
#include "engine/session/method.h"
#include "engine/session/operation_in_work.h"
#include "engine/session/publication.h"
#include "engine/session/raised.h"
#include "engine/session/request.h"
#include "engine/session/resuming.h"
#include "engine/session/saving.h"
#include "engine/session/session_observer.h"
#include "engine/session/session_options.h"
#include "engine/session/session_steps.h"
#include "engine/session/watching.h"
#include "engine/session/work_watch.h"
#include "engine/session/workflow.h"
#include "hal/api/devices.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// What came in beside the images since the last step.
struct Inputs {
  std::span<const ClickerEvent> clicks;  ///< in order of time
  std::span<const Phrase> phrases;       ///< in order of time
  Timestamp display_time{};              ///< of a frame made of this step
  std::optional<Part> stalled;           ///< hides all guidance
  std::span<const Request> requests{};   ///< of other programs, in order of time
};

/// One operation from setup to done: values in, guidance out. Reads no clock and no device, so the
/// same inputs give the same outputs, live, simulated or replayed. One thread at a time.
class Session {
 public:
  /// Refuses an operation or options with problems, and tools without a pointer and a guide.
  static Result<std::unique_ptr<Session>> create(Operation operation,
                                                 std::unique_ptr<nav::ToolTracker> tracker,
                                                 Method method, const SessionOptions& options = {});

  /// Hears everything from now on; null: nobody. Borrowed.
  void observe(SessionObserver* observer) {
    work_.observer = observer != nullptr ? observer : &work_.nobody;
  }

  /// Goes on with an operation as its log tells it, before the first step; the tracker was given
  /// the places of its references. Nothing restored is guided on before it was verified. Refuses
  /// other levels or screws, and references elsewhere.
  Status resume(const LoggedOperation& logged);
  /// What the status line says of saving from now on; null: nothing. Borrowed.
  void show_saving(const SaveWatch* saving) { publication_.show_saving(saving); }
  /// Is told what the session waits for; null: nobody. Borrowed.
  void watch_work(WorkWatch* watch) { steps_.digitizing.watch_work(watch); }

  /// One stereo pair: events up to it are answered in order of time, tools are tracked, the step's
  /// work is done. The result is valid until the next call.
  const Guidance& step(const StereoFrame& frame, const Inputs& inputs);

  /// No pair has come for longer than guidance may stand: takes back what was guided on the last
  /// one. The next step goes on as ever.
  const Guidance& expire(Timestamp display_time);
  /// Nothing more will come: only the status line is left.
  const Guidance& end(Timestamp display_time);

  [[nodiscard]] const SessionOptions& options() const { return work_.options; }
  [[nodiscard]] Step current_step() const { return work_.step; }
  [[nodiscard]] std::span<const LevelState> levels() const { return work_.levels; }
  [[nodiscard]] std::span<const RodState> rods() const { return steps_.rods.rods(); }
  [[nodiscard]] std::span<const nav::ToolState> tool_states() const { return work_.tools.states(); }
  [[nodiscard]] const nav::ToolTracker& tracker() const { return work_.tools.tracker(); }
  /// The index of the guide among the tools, and the guide as it is believed to be: as described,
  /// or corrected since.
  [[nodiscard]] std::size_t guide() const { return work_.tools.guide(); }
  [[nodiscard]] const nav::ToolGeometry& guide_geometry() const {
    return work_.tools.geometry(work_.tools.guide());
  }

 private:
  Session(Operation operation, WatchedTools tools, Method method, const SessionOptions& options);

  void answer_inputs(const Inputs& inputs);
  /// The table's answer to an event, and to those that its action raises.
  void handle(std::optional<Raised> raised, Timestamp time);
  /// session_actions.cpp: what the table asks for. Returns an event that comes of it.
  [[nodiscard]] std::optional<Raised> act(Action action, Event event, Timestamp time);
  [[nodiscard]] Message why_not(Action action, Event event) const;

  // What concerns several steps.
  [[nodiscard]] std::optional<Raised> begin_level(Timestamp time);
  void show_registration(Timestamp time);
  void clear_level(Timestamp time);
  void consent(Action action, Timestamp time);
  void forget_places(Event why, Timestamp time);

  OperationInWork work_;
  Workflow workflow_;
  SessionSteps steps_;  ///< ends before the levels: a trial of the coach may be reading one
  Watching watching_;
  Resuming resuming_;
  Publication publication_;
};

}  // namespace orthonav::engine
