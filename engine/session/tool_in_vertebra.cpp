#include "engine/session/tool_in_vertebra.h"

#include "nav/guidance/clearance_spread.h"

namespace orthonav::engine {

ToolInVertebra in_vertebra(const nav::Registration& registration, const nav::TrackedPose& pose,
                           const nav::ToolGeometry& tool) {
  const auto vertebra_from_world = registration.world_from_vertebra.inverse();
  const auto vertebra_from_marker = vertebra_from_world * pose.value;
  ToolInVertebra found{
      {vertebra_from_marker * tool.tip_in_marker, -(vertebra_from_marker * tool.axis_in_marker).v},
      std::nullopt};
  if (registration.uncertainty) {
    found.uncertainty = nav::with_tool(*registration.uncertainty, vertebra_from_world,
                                       vertebra_from_marker * Point<Marker>{}, pose.covariance);
  }
  return found;
}

}  // namespace orthonav::engine
