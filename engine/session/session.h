#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/case/operation.h"
#include "engine/session/guidance.h"
#include "engine/session/guide_checks.h"
#include "engine/session/log/logged_operation.h"
#include "engine/session/log/resuming.h"
#include "engine/session/log/saving.h"
#include "engine/session/log/session_observer.h"
#include "engine/session/method.h"
#include "engine/session/session_options.h"
#include "engine/session/session_state.h"
#include "engine/session/steps/digitizing.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/landmarking.h"
#include "engine/session/steps/placing.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/steps/rod_templating.h"
#include "engine/session/steps/verifying.h"
#include "engine/session/text/messages.h"
#include "engine/session/tools_in_hand.h"
#include "engine/session/watching.h"
#include "engine/session/work_watch.h"
#include "engine/session/workflow/commands.h"
#include "engine/session/workflow/workflow.h"
#include "hal/api/devices.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// Inputs other than images since the last step.
struct Inputs {
  std::span<const ClickerEvent> clicks;  ///< in order of time
  std::span<const Phrase> phrases;       ///< in order of time
  Timestamp display_time{};              ///< of the frame made from this step
  std::optional<Part> stalled;           ///< hides all guidance
  bool no_clicker = false;               ///< none is there now; the status line says so
  std::span<const Request> requests{};   ///< of other programs, in order of time
  /// Time passes by itself (`Clock::runs_by_itself`), so that no pair waits for a registration or
  /// the coach. Otherwise their answers come at fixed pairs, however fast the machine is.
  bool time_runs = false;
};

/// One operation from setup to done: values in, guidance out. Reads no clock and no device, so the
/// same inputs give the same outputs, live, simulated or replayed. One thread at a time.
class Session {
 public:
  /// Refuses invalid operations and options, and tools without a pointer, or without a guide where
  /// screws are placed.
  static Result<std::unique_ptr<Session>> create(Operation operation,
                                                 std::unique_ptr<nav::ToolTracker> tracker,
                                                 Method method, const SessionOptions& options = {});

  /// Sets the observer; null: none. Borrowed.
  void observe(SessionObserver* observer) {
    work_.observer = observer != nullptr ? observer : &work_.nobody;
  }

  /// Continues an operation from its log, before the first step; the tracker has been given the
  /// places of its references. Nothing restored is guided on before it is verified. Refuses
  /// different levels or screws, and references in other places.
  Status resume(const LoggedOperation& logged);
  /// Sets the source of what the status line says about saving; null: none. Borrowed.
  void show_saving(const SaveWatch* saving) { saving_ = saving; }
  /// Sets the watch to be notified of what the session waits for; null: none. Borrowed.
  void watch_work(WorkWatch* watch) { digitizing_.watch_work(watch); }

  /// Processes one stereo pair: answers events up to it in order of time, tracks the tools and does
  /// the step's work. The result is valid until the next call.
  const Guidance& step(const StereoFrame& pair, const Inputs& inputs);
  /// The same with the poses of a device that measures tools itself; the session's tracker is one
  /// that takes them.
  const Guidance& step(const ToolPoses& poses, const Inputs& inputs);

  /// No pair has arrived for longer than guidance may stay, or only such that repeat what came
  /// before: withdraws the guidance of the last one. The next step continues normally.
  const Guidance& expire(Timestamp display_time, std::optional<Repeated> repeats = std::nullopt);
  /// The session is over: only the status line remains.
  const Guidance& end(Timestamp display_time);

  [[nodiscard]] const SessionOptions& options() const { return work_.options; }
  [[nodiscard]] Step current_step() const { return work_.step; }
  [[nodiscard]] const OperationState& operation() const { return work_.state; }
  [[nodiscard]] std::span<const LevelState> levels() const { return work_.state.levels; }
  [[nodiscard]] std::span<const RodState> rods() const { return work_.state.rods; }
  [[nodiscard]] std::span<const nav::ToolState> tool_states() const { return work_.tools.states(); }
  [[nodiscard]] const nav::ToolTracker& tracker() const { return work_.tools.tracker(); }
  /// A tool's geometry as described, or, of the guide, as since corrected.
  [[nodiscard]] const nav::ToolGeometry& geometry(std::size_t tool) const {
    return work_.tools.geometry(tool);
  }
  /// The index of the guide among the tools. There must be one: not where rods alone are bent.
  [[nodiscard]] std::size_t guide() const { return work_.tools.guide(); }

 private:
  Session(Operation operation, WatchedTools tools, Method method, const SessionOptions& options);

  template <class Frame>
  const Guidance& step_with(const Frame& frame, const Inputs& inputs);
  void answer_inputs(const Inputs& inputs);
  void answer_request(const Request& request);
  /// The event that a phrase or a request of another program stands for; none if it was not
  /// understood, which the surgeon is told. `change`: a new plan instead of words; `from`: who
  /// asked, unless it was said in the room.
  [[nodiscard]] std::optional<Event> hear(const Phrase& phrase,
                                          const std::optional<Replan>& change = {},
                                          const std::string& from = {});
  /// Whether the present step is in that state, at the time of an event.
  [[nodiscard]] bool holds(State state, Timestamp time) const;
  /// The table's answer to an event, and to those that its action raises.
  void handle(std::optional<FollowUpEvent> raised, Timestamp time);
  /// Does what the table asks for. Returns the event that results, if any.
  [[nodiscard]] std::optional<FollowUpEvent> act(Action action, Event event, Timestamp time);

  // Actions that concern several steps.
  [[nodiscard]] std::optional<FollowUpEvent> begin_level(Timestamp time);
  void show_registration(Timestamp time);
  void clear_level(Timestamp time);
  void forget_places(Event why, Timestamp time);
  void accept(Timestamp time);
  void expect_landmark();
  void select_screw();
  /// Discards the registration of the current level and everything based on it.
  void forget_registration();
  /// The button was held too long, so no click will follow.
  void drop_touch(Timestamp time);

  /// Passes the newest pair to the present step.
  void collect();
  /// The tool that the present step works with, if any.
  [[nodiscard]] std::optional<std::size_t> tool() const;
  [[nodiscard]] StepOnDisplay on_display() const;
  [[nodiscard]] StepState state() const;

  // What the surgeon is shown after a pair, assembled from what each step shows.
  void publish(const FrameHeader& frame, Timestamp display_time);
  void publish_status();
  /// Withdraws the guidance of the last pair, and says why.
  const Guidance& withdraw(Timestamp display_time, Message why);
  [[nodiscard]] Saved saved() const;

  SessionState work_;
  Workflow workflow_;

  // The steps, each with its state and actions, and what several of them share: the checks of the
  // guide, and changes of the screw. A step that begins anew is a new object.
  Digitizing digitizing_;
  Verifying verifying_;
  Landmarking landmarking_;
  GuideChecks guide_checks_;
  Guiding guiding_;
  Placing placing_;
  Replanning replanning_;
  RodTemplating rods_;

  Watching watching_;
  Resuming resuming_;
  const SaveWatch* saving_ = nullptr;
  ToolsInHand in_hand_;
  Message why_no_guidance_;  ///< replaces any other message once no pair arrives
  Guidance guidance_;
};

}  // namespace orthonav::engine
