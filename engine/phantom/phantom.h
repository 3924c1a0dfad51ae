#pragma once

#include <string>
#include <vector>

#include "engine/case/case.h"

namespace orthonav::engine {

/// The built-in case: a lumbar spine L1-L5 generated from published morphometry (data/phantom.json
/// holds the measures and their sources), in lordosis (frame Spine = the frame of L3), with a 45 mm
/// pedicle screw on either side of each level, its entry on the surface. About 16000 triangles per
/// level; the same digits in every run. `labels` picks levels (unknown ones are ignored); none
/// means all five.
[[nodiscard]] Case phantom(const std::vector<std::string>& labels = {});

/// The labels of its levels, from the top down; nothing is generated.
[[nodiscard]] std::vector<std::string> phantom_labels();

}  // namespace orthonav::engine
