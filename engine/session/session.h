#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/case/operation.h"
#include "engine/session/axis_check.h"
#include "engine/session/digitizing.h"
#include "engine/session/guidance.h"
#include "engine/session/guiding.h"
#include "engine/session/landmarking.h"
#include "engine/session/logged_operation.h"
#include "engine/session/messages.h"
#include "engine/session/method.h"
#include "engine/session/placing.h"
#include "engine/session/replanning.h"
#include "engine/session/request.h"
#include "engine/session/rod_templating.h"
#include "engine/session/saving.h"
#include "engine/session/session_observer.h"
#include "engine/session/session_options.h"
#include "engine/session/tip_check.h"
#include "engine/session/tool_in_use.h"
#include "engine/session/tools_in_hand.h"
#include "engine/session/verifying.h"
#include "engine/session/watched_tools.h"
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
  void observe(SessionObserver* observer) { observer_ = observer; }

  /// Goes on with an operation as its log tells it, before the first step; the tracker was given
  /// the places of its references. Nothing restored is guided on before it was verified. Refuses
  /// other levels or screws, and references elsewhere.
  Status resume(const LoggedOperation& logged);
  /// What the status line says of saving from now on; null: nothing. Borrowed.
  void show_saving(const SaveWatch* saving) { saving_ = saving; }
  /// Is told what the session waits for; null: nobody. Borrowed.
  void watch_work(WorkWatch* watch) { digitizing_.watch_work(watch); }

  /// One stereo pair: events up to it are answered in order of time, tools are tracked, the step's
  /// work is done. The result is valid until the next call.
  const Guidance& step(const StereoFrame& frame, const Inputs& inputs);

  /// No pair has come for longer than guidance may stand: takes back what was guided on the last
  /// one. The next step goes on as ever.
  const Guidance& expire(Timestamp display_time);
  /// Nothing more will come: only the status line is left.
  const Guidance& end(Timestamp display_time);

  [[nodiscard]] const SessionOptions& options() const { return options_; }
  [[nodiscard]] Step current_step() const { return step_; }
  [[nodiscard]] std::span<const LevelState> levels() const { return levels_; }
  [[nodiscard]] std::span<const RodState> rods() const { return rod_templating_.rods(); }
  [[nodiscard]] std::span<const nav::ToolState> tool_states() const { return tools_.states(); }
  [[nodiscard]] const nav::ToolTracker& tracker() const { return tools_.tracker(); }
  /// The index of the guide among the tools, and the guide as it is believed to be: as described,
  /// or corrected since.
  [[nodiscard]] std::size_t guide() const { return tools_.guide(); }
  [[nodiscard]] const nav::ToolGeometry& guide_geometry() const {
    return tools_.geometry(tools_.guide());
  }

 private:
  Session(Operation operation, WatchedTools tools, Method method, const SessionOptions& options);

  // session.cpp: the order of one step.
  void answer_inputs(const Inputs& inputs);
  void handle(Event event, Timestamp time);
  void watch_map(const StereoFrame& frame);
  void watch_reference(Timestamp now);
  void watch_tool_in_use(Timestamp now);
  void watch_drift(Timestamp now);
  [[nodiscard]] ToolErrors guide_errors(Timestamp now) const;
  void collect_samples();
  void collect_guide_tip();
  void collect_sleeve();
  [[nodiscard]] std::optional<std::size_t> tool_of_step() const;
  /// World is that of a patient reference.
  [[nodiscard]] bool anchored() const { return tools_.tracker().anchor() != nullptr; }
  [[nodiscard]] bool by_touch(Step step) const;
  [[nodiscard]] bool is_touched_in() const;

  // session_hearing.cpp: what is said, and what other programs ask.
  void hear(const Phrase& phrase, const std::string& from = {});
  void hear(const Request& request);
  void hear_replan(const Phrase& phrase, const Result<Replan>& replan, const std::string& from);

  // session_publication.cpp: what the surgeon is shown after it.
  void publish(const StereoFrame& frame, Timestamp display_time);
  void publish_steps(Timestamp now, Timestamp display_time);
  void publish_status();
  void publish_instruments();
  [[nodiscard]] StepOnDisplay step_on_display() const;
  [[nodiscard]] StepState state_of_step() const;
  [[nodiscard]] std::optional<std::size_t> hidden_reference() const;

  // session_actions.cpp: what the table asks for.
  void act(Action action, Event event, Timestamp time);
  void begin_level(Timestamp time);
  void register_level(Timestamp time);
  void show_registration(Timestamp time);
  void clear_level(Timestamp time);
  void judge_checks(Timestamp time);
  void record_check(Timestamp time);
  void drop_check(Timestamp time);
  void accept(Timestamp time);
  void touch_landmark(Timestamp time);
  void note_bone_found(const LandmarkTouch& touch, Timestamp time);
  [[nodiscard]] nav::PressedPlace touched_landmark() const;
  [[nodiscard]] std::optional<nav::PressedPlace> guide_tip_in_landmark(const TouchedPlace& pointer);
  void compare_tips(const nav::PressedPlace& guide_tip, Timestamp time);
  void correct_guide(Timestamp time);
  void correct_tip(Timestamp time);
  void correct_axis(Timestamp time);
  void drop_landmark(Timestamp time);
  void judge_landmark(Timestamp time);
  void verify_again(Timestamp time);
  void begin_touch();
  void end_touch();
  // session_resume.cpp
  void restore_level(LevelState& level, const LoggedLevel& logged) const;
  void go_on(Timestamp time);
  // session_saving.cpp
  void save_region(Timestamp time);
  void drop_region(Timestamp time);
  void tell_places(Timestamp now);
  [[nodiscard]] Saved saved(Timestamp now) const;
  // session_replan.cpp
  void replan(Timestamp time);
  void consent(Timestamp time);
  [[nodiscard]] bool consents_to_breach(Timestamp time);
  [[nodiscard]] std::variant<std::size_t, ReplanRefusal> screw_to_replan() const;
  void take_replan(const Replanning::Outcome& outcome, Timestamp time);
  void drop_touch(Timestamp time);
  void record_head(Timestamp time);
  void drop_head(Timestamp time);
  void bend_rod(Timestamp time);
  void finish_rod(Timestamp time);
  void forget_places(Event why, Timestamp time);
  [[nodiscard]] TouchedPlace touched_place(Timestamp time);
  [[nodiscard]] Touch& touch_of_step();

  // session_screws.cpp: a screw is guided, its wire measured, finished or redone.
  void act_on_screw(Action action, Timestamp time);
  void select_screw();
  void measure_wire(Timestamp time);
  void tell_wire(Timestamp time);
  void keep_wire(Timestamp time);
  void judge_redo(Timestamp time);
  void finish_screw(Timestamp time);

  [[nodiscard]] LevelState& level() { return levels_[level_]; }
  [[nodiscard]] const LevelState& level() const { return levels_[level_]; }

  WatchedTools tools_;
  Method method_;
  SessionOptions options_;
  Workflow workflow_;
  SessionObserver* observer_ = nullptr;
  const SaveWatch* saving_ = nullptr;
  std::optional<Part> stalled_;            ///< in the newest step
  std::string shown_;                      ///< the status line, while a registration is verified
  std::int64_t places_changed_ = 0;        ///< of the patient references, as they were told
  std::optional<std::int64_t> map_epoch_;  ///< of the newest pair
  std::int64_t reference_moves_ = 0;       ///< that were answered
  bool reference_hidden_ = true;           ///< where one is in use
  ToolInUse in_use_;
  ToolsInHand in_hand_;

  Step step_ = Step::kSetup;
  std::vector<LevelState> levels_;
  std::size_t level_ = 0;
  bool resumed_ = false;
  std::vector<std::vector<nav::Region>> restored_regions_;  ///< of each level, until it is begun
  Digitizing digitizing_;  ///< ends before the levels: a trial may be reading one
  Verifying verifying_;
  Landmarking landmarking_;
  TipCheck tip_check_;
  AxisCheck axis_check_;
  Guiding guiding_;
  Placing placing_;
  Replanning replanning_;
  RodTemplating rod_templating_;

  Messages messages_;
  Message why_no_guidance_;  ///< stands in place of any other message once no pair comes
  Guidance guidance_;
};

}  // namespace orthonav::engine
