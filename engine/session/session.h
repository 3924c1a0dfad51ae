#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/case/operation.h"
#include "engine/session/coach.h"
#include "engine/session/guidance.h"
#include "engine/session/method.h"
#include "engine/session/session_observer.h"
#include "engine/session/tool_watch.h"
#include "engine/session/workflow.h"
#include "hal/api/devices.h"
#include "nav/registration/digitizer.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

struct SessionOptions {
  /// Guidance on a pose older than this is hidden, never frozen.
  Duration stale_after = std::chrono::milliseconds(100);
  /// A phrase understood less surely than this is not acted upon: a wrong "accept" is worse than
  /// one said twice.
  double min_voice_confidence = 0.5;
  double rod_diameter_m = 0.0055;
  /// A screw head or a check point whose tips scatter more than this over one click (root mean
  /// square about their mean) was not touched at rest. Noise and tremor at the end of a 130 mm
  /// lever already make up to 2.5 mm over three pairs in the simulated room; a moving tip makes 5
  /// mm and more.
  double max_touch_spread_m = 0.003;
  nav::CheckPointRules check_points;
  /// A message to the surgeon goes by itself after so long.
  Duration message_for = std::chrono::seconds(3);
  /// What was heard stays on the status line for so long.
  Duration heard_for = std::chrono::seconds(2);
  /// A deleted path fades for so long.
  Duration fade = std::chrono::milliseconds(300);

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// What came in beside the images since the last step.
struct Inputs {
  std::span<const ClickerEvent> clicks;  ///< in order of time
  std::span<const Phrase> phrases;       ///< in order of time
  Timestamp display_time{};              ///< when a frame made of this step lights up
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
  [[nodiscard]] std::span<const RodState> rods() const { return rods_; }
  [[nodiscard]] std::span<const nav::ToolState> tool_states() const { return states_; }
  [[nodiscard]] const nav::ToolTracker& tracker() const { return *tracker_; }

 private:
  enum class Seen { kNever, kMeasured, kLost, kStale };

  Session(Operation operation, std::unique_ptr<nav::ToolTracker> tracker, Method method,
          const SessionOptions& options, std::size_t pointer, std::size_t guide);

  // session.cpp: the order of one step.
  void answer_inputs(const Inputs& inputs);
  void hear(const Phrase& phrase);
  void echo(const Phrase& phrase, bool sure);
  [[nodiscard]] bool precedes_the_hologram(Event event, Timestamp spoken) const;
  void click(const ClickerEvent& event);
  void handle(Event event, Timestamp time);
  void track(const StereoFrame& frame);
  void watch_map(const StereoFrame& frame);
  void watch_active_tool(Timestamp now);
  void collect_samples();
  void publish(const StereoFrame& frame, Timestamp display_time);
  void publish_tool_guidance(Timestamp now, Timestamp display_time);
  [[nodiscard]] std::optional<std::size_t> active_tool() const;

  // session_status.cpp: the status line.
  void write_step_text();
  void write_detail();
  void write_state_of_step();
  [[nodiscard]] std::string tag_size_warning() const;

  void write_what_to_check();
  [[nodiscard]] bool checks_by_touch() const;

  // session_actions.cpp: what the table asks for.
  void act(Action action, Event event, Timestamp time);
  void act_on_regions(Action action, Timestamp time);
  void act_on_level(Action action, Timestamp time);
  void try_registration(Timestamp time);
  void refuse_registration(const std::string& reason, const nav::Registration* result,
                           Timestamp time);
  void finish_screw(Timestamp time);
  void drop_region(Timestamp time);
  void begin_level();
  void say(std::string message, Timestamp time);

  // session_touch.cpp: places that the pointer's tip rests on.
  void act_on_touch(Action action, Timestamp time);
  void act_on_checks(Action action, Timestamp time);
  void act_on_rod(Action action, Timestamp time);
  [[nodiscard]] Result<Point<World>> touched_place(Timestamp time) const;
  void end_touch();
  void measure_residuals();
  void propose_checks();
  void record_check(Timestamp time);
  void drop_check(Timestamp time);
  void judge_checks(Timestamp time);
  void record_head(Timestamp time);
  void drop_head(Timestamp time);
  void finish_rod(Timestamp time);
  void update_rod(Timestamp time);

  // session_map.cpp: the map that everything in World depends on.
  void forget_map(Timestamp time);
  [[nodiscard]] LevelState& level() { return levels_[level_]; }

  std::unique_ptr<nav::ToolTracker> tracker_;
  Method method_;
  SessionOptions options_;
  SessionObserver* observer_ = nullptr;
  std::size_t pointer_ = 0;  ///< indices into the tracker's tools
  std::size_t guide_ = 0;

  std::optional<std::int64_t> map_epoch_;  ///< of the newest pair

  Step step_ = Step::kSetup;
  std::vector<LevelState> levels_;
  std::size_t level_ = 0;
  std::size_t screw_ = 0;
  std::vector<RodState> rods_;  ///< left, right
  std::size_t rod_ = 0;
  bool rods_moved_away_ = false;
  bool twin_ = false;
  std::vector<float> unstroked_;
  std::vector<float> residuals_m_;             ///< of the points of the registration to be verified
  std::vector<Point<World>> places_to_check_;  ///< on the level to be verified
  std::vector<Point<World>> to_check_;         ///< of them those that were not touched yet

  nav::Digitizer digitizer_;
  DroppedRegion dropped_;
  std::optional<Timestamp> asked_to_drop_saved_;  ///< "delete" with nothing unsaved
  std::vector<Point<World>> touch_;               ///< tips while the button is down
  bool touching_ = false;                         ///< the button is down
  bool touch_begun_ = false;  ///< in this step, by a press that no click has used yet

  std::span<const nav::ToolState> states_;
  std::vector<ToolWatch> watches_;
  std::vector<ToolSight> sights_;
  Seen seen_ = Seen::kNever;
  std::optional<std::size_t> seen_tool_;
  bool guidance_hidden_ = false;

  /// When the registration to be verified lights up for the first time. What was said before that
  /// can't be a judgement of it.
  std::optional<Timestamp> verify_visible_at_;

  /// What the surgeon must be told, until he does something that is taken, or for a while.
  std::string message_;
  Timestamp message_until_{};
  std::string heard_;  ///< the newest phrase, for a while
  Timestamp heard_until_{};
  std::optional<ToolGuidance> last_guidance_;  ///< newest of the selected screw
  Guidance guidance_;
  std::unique_ptr<Coach> coach_;  ///< null: nobody is coached
};

}  // namespace orthonav::engine
