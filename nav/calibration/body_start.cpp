#include "nav/calibration/body_start.h"

#include <algorithm>
#include <limits>
#include <map>

#include "nav/calibration/corner_residual.h"
#include "nav/calibration/pose_mean.h"

namespace orthonav::nav {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;
using RelativePoses = std::map<Edge, std::vector<Transform<Tag, Tag>>>;

/// The pose of a tag, typed so that one tag's frame can be related to another's.
Transform<Rig, Tag> rig_from_tag(const TagPose& pose) {
  return {pose.rig_from_marker.rotation(), pose.rig_from_marker.translation()};
}

/// Relative poses from a later tag to an earlier one, from pairs in which both cameras saw both.
RelativePoses relative_poses(std::span<const PairSightings> pairs) {
  RelativePoses poses;
  for (const PairSightings& pair : pairs) {
    for (const TagSighting& a : pair) {
      for (const TagSighting& b : pair) {
        if (a.tag < b.tag && a.pose && b.pose) {
          poses[{a.tag, b.tag}].push_back(rig_from_tag(*a.pose).inverse() * rig_from_tag(*b.pose));
        }
      }
    }
  }
  return poses;
}

/// Sum of the corners' residuals; infinite when one does not project.
double cost_px(const BodyProblem& problem, const BodyState& state, const PairSightings& pair,
               const Transform<Rig, Marker>& rig_from_marker) {
  double sum = 0.0;
  for (const TagSighting& seen : pair) {
    const auto corners = corners_in_marker(problem.size_m[seen.tag]);
    const auto add = [&](std::size_t i, const auto& model, const auto& camera_from_rig, Vec2 px) {
      const auto residual =
          corner_residual(model, camera_from_rig, rig_from_marker, state.marker_from_tag[seen.tag],
                          Point<Tag>{corners[i]}, px, false);
      sum += residual ? residual->off_px.norm() : std::numeric_limits<double>::infinity();
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (seen.left_px) {
        add(i, problem.calibration.left, problem.calibration.left_from_rig, (*seen.left_px)[i]);
      }
      if (seen.right_px) {
        add(i, problem.calibration.right, state.right_from_rig, (*seen.right_px)[i]);
      }
    }
  }
  return sum;
}

}  // namespace

TagLayout first_layout(std::span<const PairSightings> pairs, std::size_t tags,
                       std::size_t min_pairs) {
  const RelativePoses poses = relative_poses(pairs);
  TagLayout layout{std::vector<Transform<Marker, Tag>>(tags), std::vector<bool>(tags, false)};
  layout.reached.at(0) = true;
  for (;;) {
    // Of all connections from the tags reached so far, the one seen most often (Prim 1957).
    auto best = poses.end();
    for (auto edge = poses.begin(); edge != poses.end(); ++edge) {
      if (layout.reached[edge->first.first] != layout.reached[edge->first.second] &&
          edge->second.size() >= min_pairs &&
          (best == poses.end() || edge->second.size() > best->second.size())) {
        best = edge;
      }
    }
    if (best == poses.end()) {
      return layout;
    }
    const auto& [a, b] = best->first;
    const Transform<Tag, Tag> a_from_b = median_pose(best->second);
    if (layout.reached[a]) {
      layout.marker_from_tag[b] = layout.marker_from_tag[a] * a_from_b;
    } else {
      layout.marker_from_tag[a] = layout.marker_from_tag[b] * a_from_b.inverse();
    }
    layout.reached[a] = layout.reached[b] = true;
  }
}

std::optional<Transform<Rig, Marker>> first_pose(const BodyProblem& problem, const BodyState& state,
                                                 const PairSightings& pair) {
  std::optional<Transform<Rig, Marker>> best;
  double least_px = std::numeric_limits<double>::infinity();
  for (const TagSighting& seen : pair) {
    if (!seen.pose) {
      continue;
    }
    const Transform<Rig, Marker> candidate =
        rig_from_tag(*seen.pose) * state.marker_from_tag[seen.tag].inverse();
    const double now_px = cost_px(problem, state, pair, candidate);
    if (!(now_px < least_px)) {
      continue;
    }
    least_px = now_px;
    best = candidate;
  }
  return best;
}

void take_pairs(std::span<const PairSightings> pairs, std::size_t most, BodyProblem& problem,
                BodyState& state) {
  std::vector<const PairSightings*> useful;
  for (const PairSightings& pair : pairs) {
    if (pair.size() >= 2) {
      useful.push_back(&pair);
    }
  }
  const std::size_t kept = std::min(most, useful.size());
  for (std::size_t i = 0; i < kept; ++i) {
    const PairSightings& pair = *useful[i * useful.size() / kept];
    const auto pose = first_pose(problem, state, pair);
    if (!pose) {
      continue;
    }
    problem.pairs.push_back(pair);
    state.rig_from_marker.push_back(*pose);
  }
}

}  // namespace orthonav::nav
