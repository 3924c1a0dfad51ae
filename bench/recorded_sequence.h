#pragma once

#include <optional>

#include "bench/tag_sequences.h"

namespace orthonav::bench {

/// The sequence "recorded": a sample of two tools with 40 mm tags, rendered by others with a real
/// unit's stereo geometry. It has no Cramér-Rao bound. Empty if the sample is absent.
[[nodiscard]] std::optional<Sequence> recorded_sequence();

}  // namespace orthonav::bench
