#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/number_bytes.h"
#include "base/result.h"

namespace orthonav::voice {

/// Empty if there is no such file.
[[nodiscard]] std::string model_file(const std::filesystem::path& path);

/// The beginning of a file of sphinxtrain's: a header in lines, and a number for the byte order.
[[nodiscard]] std::string sphinx_file_start();
/// The content after that beginning; nothing if a file begins differently.
[[nodiscard]] std::optional<std::string_view> after_sphinx_file_start(std::string_view file);

[[nodiscard]] Error made_for_another_model();

}  // namespace orthonav::voice
