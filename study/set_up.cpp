#include "study/set_up.h"

#include "hal/sim/room/instruments.h"
#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::engine {

SetUp SetUp::best() { return {"best", true, sim::GuidanceProfile::kClosedLoop, "sleeved drill"}; }

SetUp SetUp::published() { return {"paper", false, sim::GuidanceProfile::kPublished, "wire"}; }

Status SetUp::tell(sim::SimOptions& room) const {
  room.surgeon = sim::ScriptedSurgeon::bring;
  room.guidance = guidance;
  room.relies_on_reference = reference;
  return sim::use_instrument(instrument, room.error_model);
}

}  // namespace orthonav::engine
