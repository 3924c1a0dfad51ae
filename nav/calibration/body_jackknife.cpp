#include "nav/calibration/body_jackknife.h"

#include <utility>

#include "nav/statistics/blocked_jackknife.h"

namespace orthonav::nav {

std::vector<BodyState> adjusted_without_blocks(const BodyProblem& problem, const BodyState& whole) {
  std::vector<BodyState> states;
  BodyProblem rest = problem;
  for (std::size_t block = 0; block < kJackknifeBlocks; ++block) {
    BodyState state = whole;
    rest.pairs.clear();
    state.rig_from_marker.clear();
    for (const std::size_t i : without_block(problem.pairs.size(), block)) {
      rest.pairs.push_back(problem.pairs[i]);
      state.rig_from_marker.push_back(whole.rig_from_marker[i]);
    }
    if (adjust(rest, state)) {
      states.push_back(std::move(state));
    }
  }
  return states;
}

}  // namespace orthonav::nav
