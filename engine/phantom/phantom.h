#pragma once

#include <string>
#include <vector>

#include "engine/case/case.h"

namespace orthonav::engine {

/// The built-in case: a lumbar spine L1-L5 generated from published morphometry (data/phantom.json
/// holds the measures and their sources), lying together with lordosis (frame Spine = the frame of
/// L3), with a 45 mm pedicle screw on either side of each level, its entry on the surface. About
/// 16000 triangles a level; the same digits on every run. `labels` picks levels (unknown ones are
/// ignored), none means all five.
[[nodiscard]] Case phantom(const std::vector<std::string>& labels = {});

}  // namespace orthonav::engine
