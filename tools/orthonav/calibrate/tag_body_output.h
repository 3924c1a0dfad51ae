#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "base/result.h"
#include "nav/calibration/tag_body.h"

namespace orthonav::tools {

/// A calibrated body, or why there is none, as JSON. `pairs`: of the recording.
nlohmann::ordered_json tag_body_json(const Result<nav::TagBody>& body, std::size_t pairs);
/// The same for people, on standard output.
void print_tag_body(const nav::TagBody& body);

}  // namespace orthonav::tools
