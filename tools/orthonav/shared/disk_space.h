#pragma once

#include <string>

namespace orthonav::tools {

/// How much a folder of results may take, in bytes: report, log; a film.
inline constexpr double kResultBytes = 1e8;
inline constexpr double kFilmBytes = 4e8;
/// A recording of that long at 30 pairs a second; 0: of a usual operation, 20 minutes. Its images
/// are counted as they come from the cameras.
[[nodiscard]] double recording_bytes(double duration_s);

/// A line where less is free than needed at a folder, which may still have to be made:
/// "--record session: 3.2 GB free, up to 22.1 GB needed". Empty: enough, or not known.
[[nodiscard]] std::string short_of_space(const std::string& option, const std::string& folder,
                                         double needed_bytes);

/// That line as a warning on standard error; nothing for an empty folder name.
void warn_of_space(const std::string& option, const std::string& folder, double needed_bytes);

}  // namespace orthonav::tools
