#include "nav/calibration/body_residuals.h"

namespace orthonav::nav {

BodyUnknowns::BodyUnknowns(const BodyProblem& problem) {
  if (problem.find_right_camera) {
    camera = count++;
  }
  for (const bool find : problem.find_tag) {
    tags.push_back(find ? count++ : -1);
  }
}

std::vector<std::optional<BodyResidual>> residuals_of_pair(const BodyProblem& problem,
                                                           const BodyUnknowns& unknowns,
                                                           const BodyState& at, std::size_t pair,
                                                           bool derivatives) {
  const StereoCalibration& cameras = problem.calibration;
  std::vector<std::optional<BodyResidual>> all;
  for (const TagSighting& sighting : problem.pairs[pair]) {
    const std::size_t tag = sighting.tag;
    const auto corners = corners_in_marker(problem.size_m[tag]);
    const auto add = [&](std::size_t i, const auto& model, const auto& camera_from_rig,
                         Vec2 seen_px, int camera) {
      const auto corner =
          corner_residual(model, camera_from_rig, at.rig_from_marker[pair], at.marker_from_tag[tag],
                          Point<Tag>{corners[i]}, seen_px, derivatives);
      all.push_back(corner ? std::optional(BodyResidual{*corner, unknowns.tags[tag], camera})
                           : std::nullopt);
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (sighting.left_px) {
        add(i, cameras.left, cameras.left_from_rig, (*sighting.left_px)[i], -1);
      }
      if (sighting.right_px) {
        add(i, cameras.right, at.right_from_rig, (*sighting.right_px)[i], unknowns.camera);
      }
    }
  }
  return all;
}

std::optional<std::vector<double>> residual_lengths_px(const BodyProblem& problem,
                                                       const BodyUnknowns& unknowns,
                                                       const BodyState& at) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < problem.pairs.size(); ++i) {
    for (const auto& residual : residuals_of_pair(problem, unknowns, at, i, false)) {
      if (!residual) {
        return std::nullopt;
      }
      lengths.push_back(residual->corner.off_px.norm());
    }
  }
  return lengths;
}

}  // namespace orthonav::nav
