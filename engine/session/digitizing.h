#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/session/coach.h"
#include "engine/session/operation_in_work.h"
#include "engine/session/registering.h"
#include "engine/session/registration_outcome.h"

namespace orthonav::engine {

/// The step in which the bone is stroked: the strokes, what they are worth so far, and their
/// registration. The strokes outlive the step: they stay visible while they are verified.
class Digitizing {
 public:
  explicit Digitizing(const OperationInWork& work);

  /// Sets the watch to be notified of what is computed beside the session; null: none. Borrowed.
  void watch_work(WorkWatch* watch);
  /// Once for each pair of any step: the answer of a registration that is computed beside it.
  [[nodiscard]] std::optional<Event> look(OperationInWork& work, Timestamp time);

  void press(LevelState& level, Timestamp time);
  void release(Timestamp time) { strokes_.digitizer.release(time); }
  /// Once for each pair of the step.
  void collect(const OperationInWork& work);
  void save_region(OperationInWork& work, Timestamp time);
  /// A saved region is deleted only when "delete" is said twice.
  void drop_region(OperationInWork& work, Timestamp time);
  /// Registers the saved regions and drops the rest. A registration that passes becomes the
  /// level's. Absent: it is computed beside the session, and `look` has the answer.
  [[nodiscard]] std::optional<Event> register_level(OperationInWork& work, Timestamp time);
  /// Another level, or this one anew.
  void clear();
  /// Takes over the saved regions of a resumed operation.
  void restore(std::vector<nav::Region> saved) { strokes_.digitizer.restore(std::move(saved)); }
  /// The map moved: nothing measured in it may be shown or used any more.
  void forget_map();

  /// Writes the strokes, and the region that was just deleted.
  void write(Guidance& out) const;
  [[nodiscard]] StrokesSoFar state() const;

 private:
  /// What was measured in one map.
  struct Strokes {
    nav::Digitizer digitizer;
    DroppedRegion dropped;
    std::optional<Timestamp> asked_to_drop_saved;  ///< "delete" with nothing unsaved
  };

  [[nodiscard]] std::span<const nav::Region> regions() const {
    return strokes_.digitizer.regions();
  }
  [[nodiscard]] Message dropped(Timestamp time);
  [[nodiscard]] Event take(OperationInWork& work, RegistrationJob job, Timestamp time);
  /// Drops trials and registrations under way: their strokes are gone or no longer needed.
  void forget_work();

  Strokes strokes_;
  Registering registering_;
  std::unique_ptr<Coach> coach_;  ///< null: no coaching
};

}  // namespace orthonav::engine
