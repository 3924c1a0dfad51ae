#include "tools/orthonav/shared/recorded_pairs.h"

#include <cstdio>
#include <string>
#include <utility>

#include "base/how_many.h"
#include "base/joined.h"
#include "engine/session/method.h"
#include "tools/orthonav/shared/count_progress.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {

Status for_each_pair(replay::ReplayHeadset& recording,
                     const std::function<void(const StereoFrame&)>& use) {
  if (const std::string cut = replay::cut_warning(recording.summary()); !cut.empty()) {
    print_warning(cut);
  }
  CountProgress progress("stereo pairs", recording.summary().pairs);
  StereoFrame frame;
  std::int64_t repeated = 0;
  for (;;) {
    const Result<Next> next = recording.cameras()->next(frame);
    if (!next && frame.repeats) {
      ++repeated;
      progress.add_one();
      continue;
    }
    if (!next) {
      return next.error();
    }
    if (*next == Next::kEnd) {
      if (repeated > 0) {
        std::fprintf(stderr,
                     "orthonav: warning: %s left out, since a picture or the head's pose repeats; "
                     "where no sensor was recorded, device.csv says so (docs/recordings.md)\n",
                     how_many(repeated, "pair").c_str());
      }
      return {};
    }
    if (*next == Next::kNone) {
      continue;
    }
    use(frame);
    progress.add_one();
  }
}

void add_measured(std::span<const nav::ToolState> states, MeasuredPoses& poses) {
  for (const nav::ToolState& state : states) {
    if (state.world_from_marker.status == PoseStatus::kMeasured) {
      poses.world_from_marker.push_back(state.world_from_marker);
    }
  }
}

Result<MeasuredPoses> measured_poses(const std::string& recording, const std::string& method,
                                     const nav::ToolGeometry& tool,
                                     const nav::TrackerOptions& options) {
  const auto known = engine::method_named(method);
  if (!known) {
    return known.error();
  }
  const auto headset = replay::ReplayHeadset::open(recording);
  if (!headset) {
    return headset.error();
  }
  const auto tracker = known->create_tracker((*headset)->cameras()->calibration(), {tool}, options);
  if (!tracker) {
    return tracker.error();
  }
  MeasuredPoses poses;
  const Status read = for_each_pair(**headset, [&](const StereoFrame& frame) {
    ++poses.pairs;
    add_measured((*tracker)->track(frame), poses);
  });
  if (!read) {
    return read.error();
  }
  const nav::SeenTags* seen = (*tracker)->seen_tags();
  if (const std::string never = seen != nullptr ? seen->never_seen(tool) : ""; !never.empty()) {
    return Error{recording + ": " + never};
  }
  return poses;
}

Result<RecordedSightings> recorded_sightings(const std::string& recording,
                                             std::vector<nav::MarkerDefinition> tags) {
  const auto headset = replay::ReplayHeadset::open(recording);
  if (!headset) {
    return headset.error();
  }
  const StereoCalibration& calibration = (*headset)->cameras()->calibration();
  auto collector = nav::SightingCollector::create(calibration, std::move(tags));
  if (!collector) {
    return collector.error();
  }
  const Status read =
      for_each_pair(**headset, [&](const StereoFrame& frame) { collector->add(frame); });
  if (!read) {
    return read.error();
  }
  std::vector<std::string> never;
  for (const nav::MarkerDefinition& tag : collector->tags()) {
    if (std::string problem = collector->seen_tags().never_seen(tag); !problem.empty()) {
      never.push_back(std::move(problem));
    }
  }
  return RecordedSightings{calibration, collector->pairs(), joined(never)};
}

void warn_of_never_seen(const nav::ToolTracker& tracker) {
  const nav::SeenTags* seen = tracker.seen_tags();
  if (seen == nullptr || !seen->has_other_than(tracker.tools())) {
    return;  // it may just not have been used
  }
  for (const nav::ToolGeometry& tool : tracker.tools()) {
    if (const std::string never = seen->never_seen(tool); !never.empty()) {
      print_warning(never);
    }
  }
}

std::string default_method() { return "best"; }

}  // namespace orthonav::tools
