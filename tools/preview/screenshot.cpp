#include "tools/preview/screenshot.h"

#include "base/printed.h"
#include "engine/io/folders.h"
#include "engine/io/image_file.h"

namespace orthonav::preview {

namespace fs = std::filesystem;

std::string numbered_name(const std::string& folder, const std::string& beginning,
                          const std::string& ending) {
  for (int number = 1;; ++number) {
    const std::string name = beginning + printed("-%03d", number) + ending;
    std::error_code code;
    if (!fs::exists(fs::path(folder) / name, code)) {
      return name;
    }
  }
}

fs::path png_path(const fs::path& folder, const std::string& name) {
  return folder / (fs::path(name).extension() == ".png" ? name : name + ".png");
}

Status write_screenshot(const Window& window, const fs::path& path) {
  const RgbaImage image = window.screenshot();
  if (image.pixels.empty()) {
    return Error{"screenshot: nothing of the window can be seen"};
  }
  if (const auto made = engine::make_folders(path.parent_path().string()); !made) {
    return Error{"--out " + made.error().message, made.error().code};
  }
  return engine::write_png(path, image);
}

}  // namespace orthonav::preview
