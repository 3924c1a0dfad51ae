#pragma once

#include <string>
#include <vector>

#include "bench/tag_sequences.h"

namespace orthonav::bench {

/// Pairs from a renderer, cameras and scenes that share nothing with hal/sim: two tools in front of
/// a cluttered board, two cameras side by side, 1280×960 (f = 900 px) or 640×480 (450 px), 10 cm
/// apart, with different axes and lenses. Each name says what the sequence tests;
/// docs/lab/tracking.md lists them.
[[nodiscard]] std::vector<std::string> other_sequence_names();
[[nodiscard]] Sequence make_other_sequence(const std::string& name, int pairs, std::uint64_t seed);

}  // namespace orthonav::bench
