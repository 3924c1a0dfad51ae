#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "engine/session/method.h"
#include "engine/session/work_watch.h"
#include "nav/registration/digitizer.h"
#include "nav/tracking/worker.h"

namespace orthonav::engine {

/// The expected result of registering the strokes made so far.
struct Coaching {
  bool unique = false;      ///< no other pose explains the strokes nearly as well
  bool enough = false;      ///< it would be accepted, or more strokes over tissue would not help
  bool then_touch = false;  ///< if `enough`: places of the bone must be touched first
  double expected_m = 0.0;  ///< root mean square error at the worst of the screws; may be infinite
  bool registration_only = false;  ///< what all strokes share is not known, so not in it
  /// The reason against it, if it matters more than where to stroke next.
  std::optional<nav::RefusalReason> against;
  std::optional<nav::BonePlace> stroke_next;
};
[[nodiscard]] Coaching coaching_from(const nav::Registration& registration);

/// Runs trial registrations beside the frame loop while the surgeon strokes, to tell what the
/// strokes are worth; the level stays unregistered. A trial starts after `kNewSamples` new samples
/// and is answered exactly `kPairsToAnswer` pairs later, waiting for it if necessary, so the same
/// pairs give the same answers on any machine. One thread at a time.
class Coach {
 public:
  /// 2 s of stroking at 30 pairs a second.
  static constexpr std::size_t kNewSamples = 60;
  static constexpr std::size_t kFewestSamples = 100;
  /// Half a second: several times the duration of a trial, so that waiting is rare.
  static constexpr int kPairsToAnswer = 15;

  explicit Coach(Registrar registrar, const nav::CommonErrors& common = {})
      : registrar_(std::move(registrar)), common_(common) {
    points_.reserve(kReservedPoints);
  }

  /// Sets the watch to be notified when a trial begins and ends, and while this waits for its
  /// answer; null: none. Borrowed.
  void watch(WorkWatch* watch);
  /// Once for each pair of stroking, with everything stroked so far. The level must stay until
  /// `forget` or the end.
  void step(const OperatedLevel& level, std::span<const nav::Region> regions);
  /// A real registration of this many samples was refused; `coaching` is what they are worth.
  void tell(Coaching coaching, std::size_t samples) {
    newest_ = std::move(coaching);
    asked_samples_ = samples;
  }
  /// The strokes are gone or no longer needed; waits for a trial under way and drops its answer.
  void forget();
  [[nodiscard]] const std::optional<Coaching>& newest() const { return newest_; }

 private:
  /// Five minutes of stroking a level: starting a trial does not allocate.
  static constexpr std::size_t kReservedPoints = 9000;

  void start(const OperatedLevel& level, std::span<const nav::Region> regions);
  void take_answer();
  /// Notifies the watch if the trial has ended.
  void look_at_trial();
  void wait();
  void run();

  Registrar registrar_;
  nav::CommonErrors common_;
  WorkWatch* watch_ = nullptr;
  std::optional<Coaching> newest_;
  std::size_t asked_samples_ = 0;  ///< of the last trial
  int pairs_left_ = 0;             ///< until the answer of the trial under way; 0: none is

  std::atomic<bool> answered_ = false;  ///< the trial under way has its answer

  // Inputs and answer of the trial, owned by the worker while it is under way.
  const OperatedLevel* level_ = nullptr;
  std::vector<Point<World>> points_;
  std::optional<Coaching> answer_;
  nav::Worker worker_;  ///< ends first
};

}  // namespace orthonav::engine
