#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace orthonav::engine {

/// The command that shows or repeats an operation, by its case and seed.
using ReplayCommand = std::function<std::string(const std::string& case_name, std::uint64_t seed)>;

/// A study as one self-contained HTML page: means with their intervals, the predictions for
/// registrations, the distribution of errors, the worst screws and the incomplete operations, each
/// with the command that repeats it. `study`: its JSON. Without `replay`, the command is the
/// preview of the phantom's operation.
[[nodiscard]] std::string study_html(const std::string& study, const ReplayCommand& replay = {});

}  // namespace orthonav::engine
