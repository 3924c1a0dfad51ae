#include "tools/orthonav/shared/depth_listing.h"

#include <nlohmann/json.hpp>

#include "base/how_many.h"
#include "base/printed.h"

namespace orthonav::tools {

std::string in_words(const replay::DepthSummary& summary) {
  if (!summary.trouble.empty()) {
    return "can't be read: " + summary.trouble;
  }
  constexpr double kSecondsATick = 1e-7;
  const double span_s =
      kSecondsATick * static_cast<double>(summary.last_ticks_100ns - summary.first_ticks_100ns);
  return printed("%dx%d px, %s in %.1f s, %lld without a pose", summary.width_px, summary.height_px,
                 how_many(summary.frames, "frame").c_str(), span_s, summary.frames_without_pose);
}

nlohmann::ordered_json as_json(const replay::DepthSummary& summary) {
  nlohmann::ordered_json out = {{"stream", name_of(summary.stream)}};
  if (!summary.trouble.empty()) {
    out["trouble"] = summary.trouble;
    return out;
  }
  out.update({{"width_px", summary.width_px},
              {"height_px", summary.height_px},
              {"frames", summary.frames},
              {"frames_without_pose", summary.frames_without_pose},
              {"brightness_unpaired", summary.brightness_unpaired},
              {"repeated", summary.repeated},
              {"first_100ns", summary.first_ticks_100ns},
              {"last_100ns", summary.last_ticks_100ns}});
  return out;
}

}  // namespace orthonav::tools
