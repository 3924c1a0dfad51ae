#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace orthonav::engine {

/// The command that shows or makes an operation again, by its case and seed.
using ReplayCommand = std::function<std::string(const std::string& case_name, std::uint64_t seed)>;

/// A study as one HTML page that needs nothing else: means with their intervals, what was predicted
/// of registrations, how the errors spread, the worst screws and the operations that were not
/// completed, each with the command that repeats it. `study`: its JSON. Without `replay`, the
/// command is the preview of the phantom's operation.
[[nodiscard]] std::string study_html(const std::string& study, const ReplayCommand& replay = {});

}  // namespace orthonav::engine
