#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/session/coach.h"
#include "engine/session/guidance.h"
#include "engine/session/method.h"
#include "engine/session/registration_outcome.h"
#include "engine/session/session_options.h"

namespace orthonav::engine {

/// Of a registration that does not count: why, with what to do about it, if that is known.
[[nodiscard]] Message message_about(const RegistrationOutcome& outcome);

/// The step in which the bone is stroked: the strokes, what they are worth so far, and their
/// registration. The strokes outlive the step: they stay visible while they are verified.
class Digitizing {
 public:
  Digitizing(const Method& method, const SessionOptions& options);

  void press(LevelState& level, Timestamp time);
  void release(Timestamp time) { strokes_.digitizer.release(time); }
  void collect(const nav::TrackedPose& pose, const nav::ToolGeometry& pointer);
  /// Is told while this waits for the coach; null: nobody. Borrowed.
  void watch_work(WorkWatch* watch);
  /// Once for each pair of the step.
  void coach(const OperatedLevel& plan);
  void save() { strokes_.digitizer.save(); }
  /// A saved region goes when "delete" is said twice. Returns what the surgeon must be
  /// told, which may be nothing.
  [[nodiscard]] Message drop_region(Timestamp time);
  /// Of what is saved; the rest is dropped. What passes is the level's from now on.
  [[nodiscard]] RegistrationOutcome register_level(LevelState& level, const Registrar& registrar,
                                                   Timestamp time);
  /// Another level, or this one anew.
  void clear();
  /// Takes over the saved regions of a resumed operation.
  void restore(std::vector<nav::Region> saved) { strokes_.digitizer.restore(std::move(saved)); }
  /// The map moved: nothing in it may be shown or asked for any more.
  void forget_map();

  [[nodiscard]] std::span<const nav::Region> regions() const {
    return strokes_.digitizer.regions();
  }
  /// The region that was deleted less than `fade` ago, or null.
  [[nodiscard]] const DroppedRegion* dropped(Timestamp display_time, Duration fade) const;
  [[nodiscard]] StrokesSoFar state() const;

 private:
  /// What was measured in one map.
  struct Strokes {
    nav::Digitizer digitizer;
    DroppedRegion dropped;
    std::optional<Timestamp> asked_to_drop_saved;  ///< "delete" with nothing unsaved
  };

  /// Ends a trial under way: its strokes are gone or done with.
  void forget_coaching();

  Strokes strokes_;
  std::unique_ptr<Coach> coach_;  ///< null: nobody is coached
  Verification verification_;
  SessionOptions options_;
};

}  // namespace orthonav::engine
