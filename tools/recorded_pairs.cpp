#include "tools/recorded_pairs.h"

#include "engine/method.h"
#include "tools/count_progress.h"

namespace orthonav::tools {

Status for_each_pair(replay::ReplayHeadset& recording,
                     const std::function<void(const StereoFrame&)>& use) {
  CountProgress progress("stereo pairs", recording.summary().pairs);
  StereoFrame frame;
  for (;;) {
    const Result<Next> next = recording.cameras().next(frame);
    if (!next) return next.error();
    if (*next == Next::kEnd) return {};
    if (*next == Next::kNone) continue;
    use(frame);
    progress.add_one();
  }
}

std::string default_method() { return "best"; }

}  // namespace orthonav::tools
