#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "tools/preview/window.h"

namespace orthonav::preview {

/// The first of "BEGINNING-001ENDING", "BEGINNING-002ENDING", ... that is not in that folder.
[[nodiscard]] std::string numbered_name(const std::string& folder, const std::string& beginning,
                                        const std::string& ending);

/// A file of this name in that folder; ".png" is added where the name lacks it.
[[nodiscard]] std::filesystem::path png_path(const std::filesystem::path& folder,
                                             const std::string& name);

/// What the window shows, as PNG; its folder is made.
Status write_screenshot(const Window& window, const std::filesystem::path& path);

}  // namespace orthonav::preview
