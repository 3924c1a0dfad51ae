#pragma once

#include <memory>
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
  std::optional<Point<World>> stroke_at;  ///< the middle of that place, if the pose is unique
  double progress = 0.0;  ///< in [0, 1]: how small the expected error is, against its limit
};
[[nodiscard]] Coaching coaching_from(const nav::Registration& registration);

/// Runs trial registrations beside the frame loop while the surgeon strokes, to tell what the
/// strokes are worth; the level stays unregistered. A trial starts after `kNewSamples` new samples
/// and is answered `kPairsToAnswer` pairs later: exactly then where it is waited for, so that the
/// same pairs give the same answers on any machine, otherwise once it has ended. One thread at a
/// time.
class Coach {
 public:
  /// 2 s of stroking at 30 pairs a second.
  static constexpr std::size_t kNewSamples = 60;
  static constexpr std::size_t kFewestSamples = 100;
  /// Half a second: several times the duration of a trial, so that its answer is usually there.
  static constexpr int kPairsToAnswer = 15;

  explicit Coach(Registrar registrar, const nav::CommonErrors& common = {})
      : registrar_(std::move(registrar)), common_(common) {
    points_.reserve(kReservedPoints);
    times_.reserve(kReservedPoints);
    screws_.reserve(kReservedScrews);
  }

  /// Sets the watch to be notified when a trial begins and ends, and while this waits for its
  /// answer; null: none. Borrowed.
  void watch(WorkWatch* watch);
  /// Once for each pair of any step: whether trials are waited for from now on. At first they are.
  void look(bool waits);
  /// Once for each pair of stroking, with everything stroked so far.
  void step(const OperatedLevel& level, std::span<const nav::Region> regions);
  /// A real registration of this many samples was refused; `coaching` is what they are worth.
  void tell(Coaching coaching, std::size_t samples) {
    newest_ = std::move(coaching);
    asked_samples_ = samples;
  }
  /// The strokes are gone or no longer needed: drops the answer of a trial under way.
  void forget();
  [[nodiscard]] const std::optional<Coaching>& newest() const { return newest_; }

 private:
  /// Five minutes of stroking a level: starting a trial does not allocate.
  static constexpr std::size_t kReservedPoints = 9000;
  static constexpr std::size_t kReservedScrews = 8;

  void start(const OperatedLevel& level, std::span<const nav::Region> regions);
  /// Whether no trial is under way, forgotten ones included.
  [[nodiscard]] bool is_free();
  void wait();
  void tell_ended();
  void run();

  Registrar registrar_;
  nav::CommonErrors common_;
  WorkWatch* watch_ = nullptr;
  std::optional<Coaching> newest_;
  std::size_t asked_samples_ = 0;  ///< of the last trial
  bool waits_ = true;
  bool awaited_ = false;     ///< the answer of a trial
  int pairs_left_ = 0;       ///< until it is taken
  bool under_way_ = false;   ///< a trial that was not waited for yet
  bool told_begun_ = false;  ///< the watch knows of it

  // Inputs and answer of the trial, owned by the worker while it is under way. A trial may outlast
  // the step, in which screws are changed.
  std::shared_ptr<const nav::VertebraModel> model_;
  std::vector<nav::ScrewPlan> screws_;
  std::vector<Point<World>> points_;
  std::vector<Timestamp> times_;
  std::optional<Coaching> answer_;
  nav::Worker worker_;  ///< ends first
};

}  // namespace orthonav::engine
