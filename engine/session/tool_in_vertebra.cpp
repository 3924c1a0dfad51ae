#include "engine/session/tool_in_vertebra.h"

#include "nav/registration/tre.h"

namespace orthonav::engine {
namespace {

nav::PoseUncertainty bone_against_tool(const nav::Registration& registration,
                                       const ToolErrors& errors) {
  nav::CommonErrors more;
  more.map_m = errors.drift_sd_m;
  if (!errors.unshared_sd_m) {
    return nav::with_common(*registration.uncertainty, more);
  }
  // The map drifted while the bone was stroked, but not while the tool is seen.
  nav::CommonErrors shared = registration.common;
  shared.map_m = 0.0;
  more.tip_m = *errors.unshared_sd_m;
  return nav::with_common(nav::without_common(*registration.uncertainty, shared), more);
}

}  // namespace

ToolInVertebra in_vertebra(const nav::Registration& registration, const nav::TrackedPose& pose,
                           const nav::ToolGeometry& tool, const ToolErrors& errors) {
  const auto vertebra_from_world = registration.world_from_vertebra.inverse();
  const auto vertebra_from_marker = vertebra_from_world * pose.value;
  ToolInVertebra found{
      {vertebra_from_marker * tool.tip_in_marker, -(vertebra_from_marker * tool.axis_in_marker).v},
      std::nullopt};
  if (registration.uncertainty) {
    const auto of_tool =
        nav::with_tool(bone_against_tool(registration, errors), vertebra_from_world,
                       vertebra_from_marker * Point<Marker>{}, pose.covariance);
    found.uncertainty =
        nav::with_turn(of_tool, found.axis.point, found.axis.direction, errors.axis_sd_rad);
  }
  return found;
}

}  // namespace orthonav::engine
