#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/report/operation_result.h"
#include "engine/session/log/session_observer.h"
#include "engine/session/session.h"
#include "hal/sim/sim_headset.h"

namespace orthonav::engine {

/// Observes a session from outside and records the truth in the simulated room at the relevant
/// moments. Nothing flows back: the session only calls it. The map drifts, so a truth in World is
/// valid only at its moment.
class GroundTruthRecorder : public SessionObserver {
 public:
  /// Both must outlive it.
  GroundTruthRecorder(const sim::SimHeadset& headset, const Session& session)
      : headset_(headset), session_(session) {}

  void registered(Timestamp time, const LevelState& level,
                  const RegistrationOutcome& outcome) override;
  void accepted(Timestamp time, const LevelState& level, std::string_view shown) override;
  void head_recorded(Timestamp time, nav::Side side, const HeadTouch& touch) override;
  void head_dropped(Timestamp time, nav::Side side, const HeadTouch& touch) override;

  /// Adds the true errors to the result: the TRE of each accepted registration at its screws'
  /// entries and targets; the angle and entry error of each driven wire; the rods'.
  void evaluate(OperationResult& result) const;

 private:
  struct TruePose {
    std::string label;
    Transform<World, Vertebra> estimated;
    Transform<World, Vertebra> truth;
  };
  struct TouchedHead {
    nav::Side side;
    std::size_t head;  ///< which one of this side
    Point<sim::Room> position;
  };
  void note(const LevelState& level, const Transform<World, Vertebra>& estimated);
  [[nodiscard]] LevelTruth truth_of(const LevelState& level) const;
  [[nodiscard]] std::vector<Point<sim::Room>> touched_heads(nav::Side side) const;
  [[nodiscard]] RodTruth truth_of(const RodState& rod) const;
  /// From the session's World, which may be relative to a patient reference, to the headset's map.
  /// The head's noise in the pair that showed the reference is left out: it moves the bone and
  /// everything else that is seen in that pair alike.
  [[nodiscard]] Transform<World, World> map_from_session() const;

  const sim::SimHeadset& headset_;
  const Session& session_;
  std::vector<TruePose> registrations_;
  std::vector<TouchedHead> touched_;
};

}  // namespace orthonav::engine
