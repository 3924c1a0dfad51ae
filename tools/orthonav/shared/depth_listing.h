#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "hal/replay/replay_headset.h"

namespace orthonav::tools {

/// A depth stream of a recording, in words: "320x288 px, 120 frames in 24.3 s, 3 without a pose";
/// or why it can't be read.
[[nodiscard]] std::string in_words(const replay::DepthSummary& summary);
/// The same figures as JSON.
[[nodiscard]] nlohmann::ordered_json as_json(const replay::DepthSummary& summary);

}  // namespace orthonav::tools
