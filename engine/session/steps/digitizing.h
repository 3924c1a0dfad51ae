#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/session/coach.h"
#include "engine/session/log/logged_operation.h"
#include "engine/session/log/operation_json.h"
#include "engine/session/method.h"
#include "engine/session/operation_state.h"
#include "engine/session/session_state.h"
#include "engine/session/work_watch.h"
#include "nav/tracking/worker.h"

namespace orthonav::engine {

/// What a registration is computed from, as it was when it was asked for, and what was found.
struct RegistrationJob {
  OperatedLevel level;
  std::vector<Point<World>> points;
  std::vector<Vec3> shafts;
  std::vector<Timestamp> times;
  nav::CommonErrors common;
  Timestamp asked{};
  /// How many of the points were refused before. If all of them are refused again, those that
  /// follow are tried alone: a surgeon who was told to scrape to the bone presses harder.
  std::size_t refused = 0;
  std::optional<Result<nav::Registration>> found;
  std::size_t left_out = 0;  ///< points before those of which it was found
};

/// Computes registrations beside the frame loop, one after the other. One thread at a time.
class Registering {
 public:
  explicit Registering(Registrar registrar) : registrar_(std::move(registrar)) {}
  Registering(const Registering&) = delete;
  Registering& operator=(const Registering&) = delete;

  /// Sets the watch to be notified when a registration begins and ends; null: none. Borrowed.
  void watch(WorkWatch* watch);
  /// Computes it at once, on this thread.
  [[nodiscard]] RegistrationJob now(RegistrationJob job) const;
  /// Begins it beside this thread, once an earlier one that was forgotten has ended.
  void begin(RegistrationJob job);
  /// Its answer is no longer wanted.
  void forget();
  /// Once for each pair: the answer, when it is there. Never waits. What ended a registration by an
  /// exception is thrown here.
  [[nodiscard]] std::optional<RegistrationJob> answer();

 private:
  void start();

  Registrar registrar_;
  WorkWatch* watch_ = nullptr;
  std::optional<RegistrationJob> asked_;  ///< and not begun yet
  bool wanted_ = false;                   ///< the answer of the one under way
  bool under_way_ = false;
  RegistrationJob job_;                  ///< the worker's while under way
  std::unique_ptr<nav::Worker> worker_;  ///< from the first one on; ends first
};

/// The step in which the bone is stroked: the strokes, what they are worth so far, and their
/// registration. The strokes outlive the step: they stay visible while they are verified.
class Digitizing {
 public:
  explicit Digitizing(const SessionState& work);

  /// Sets the watch to be notified of what is computed beside the session; null: none. Borrowed.
  void watch_work(WorkWatch* watch);
  /// Once for each pair of any step: the answer of a registration that is computed beside it.
  [[nodiscard]] std::optional<Event> look(SessionState& work, Timestamp time);

  void press(LevelState& level, Timestamp time);
  void release(Timestamp time) { strokes_.digitizer.release(time); }
  /// Once for each pair of the step.
  void collect(const SessionState& work);
  void save_region(SessionState& work, Timestamp time);
  /// A saved region is deleted only when "delete" is said twice.
  void drop_region(SessionState& work, Timestamp time);
  /// Registers the saved regions and drops the rest. A registration that passes becomes the
  /// level's. Absent: it is computed beside the session, and `look` has the answer.
  [[nodiscard]] std::optional<Event> register_level(SessionState& work, Timestamp time);
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
  [[nodiscard]] Event take(SessionState& work, RegistrationJob job, Timestamp time);
  /// Drops trials and registrations under way: their strokes are gone or no longer needed.
  void forget_work();

  Strokes strokes_;
  Registering registering_;
  std::unique_ptr<Coach> coach_;  ///< null: no coaching
};

// Its records in the log; `json` holds time and level already.

[[nodiscard]] nav::Region region_from(const JsonNode& node);
/// The hash of the points that a registration was computed from.
[[nodiscard]] std::string hash_of(std::span<const Point<World>> points);
/// Of a saved region.
void log_region(LogJson& json, const nav::Region& region);
/// `strokes`: the level's saved regions.
void read_region(const JsonNode& node, std::vector<nav::Region>& strokes);
void read_region_dropped(const JsonNode& node, std::vector<nav::Region>& strokes);
/// Of a registration that was asked for, passed or not.
void log_registration(LogJson& json, const LevelState& level, const RegistrationOutcome& outcome);
/// One that passed becomes the level's.
[[nodiscard]] LoggedRegistration read_registration(const JsonNode& node, LevelState& level,
                                                   const std::vector<nav::Region>& strokes);
void read_level_cleared(LevelState& level, std::vector<nav::Region>& strokes);

/// "expected error 0.6 mm, digitize the left lamina".
void append(std::string& out, const Coaching& coaching);
/// The same in parts; the separator comes before the first.
void write_coaching(PartedText text, const Coaching& coaching, std::string_view separator);
void write(PartedText text, const ConfirmDelete& m);
void write(PartedText text, const RegistrationRefused& m);

}  // namespace orthonav::engine
