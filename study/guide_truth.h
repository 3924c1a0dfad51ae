#pragma once

#include <string>
#include <vector>

#include "engine/live/frame_loop.h"
#include "engine/report/operation_result.h"
#include "engine/session/session.h"
#include "hal/sim/sim_headset.h"

namespace orthonav::engine {

/// The deviation of the guide from its displayed pose when each wire pierced the bone: tip and axis
/// as tracked and registered, compared with the true ones, both in their vertebra's frame. It
/// contains all errors of navigation together (registration, map, head, tracking, the tool's
/// description) and none of the surgeon or the wire. Observes from outside; nothing flows back.
class GuideTruth : public LoopObserver {
 public:
  /// Headset and session must outlive it.
  GuideTruth(const sim::SimHeadset& headset, const Session& session)
      : headset_(headset), session_(session) {}

  void stepped(const FrameHeader& frame, const Inputs& inputs, const Guidance& guidance) override;

  /// Adds the deviations to the screws.
  void evaluate(OperationResult& result) const;

 private:
  struct Sighting {
    Timestamp time{};
    GuidedError error;
  };
  struct Pierced {
    std::string level;
    nav::Side side = nav::Side::kLeft;
    GuidedError error;
  };
  void look(Timestamp time, const Guidance& guidance);
  void note_wires();

  const sim::SimHeadset& headset_;
  const Session& session_;
  std::vector<Sighting> sightings_;  ///< of the guide at the selected screw, pair by pair
  std::vector<Pierced> pierced_;
  Timestamp newest_wire_{};
};

}  // namespace orthonav::engine
