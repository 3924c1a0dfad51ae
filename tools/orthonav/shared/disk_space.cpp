#include "tools/orthonav/shared/disk_space.h"

#include <filesystem>

#include "base/printed.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {

namespace fs = std::filesystem;

double recording_bytes(double duration_s) {
  constexpr double kPair_bytes = 2.0 * 640.0 * 480.0;
  constexpr double kRate_hz = 30.0;
  constexpr double kUsual_s = 1200.0;
  return kPair_bytes * kRate_hz * (duration_s > 0.0 ? duration_s : kUsual_s);
}

std::string short_of_space(const std::string& option, const std::string& folder,
                           double needed_bytes) {
  std::error_code code;
  fs::path there = fs::absolute(folder, code);
  while (there.has_relative_path() && !fs::exists(there, code)) {
    there = there.parent_path();
  }
  const fs::space_info space = fs::space(there, code);
  const auto free_bytes = static_cast<double>(space.available);
  if (code || free_bytes >= needed_bytes) {
    return {};
  }
  return option + " " + folder +
         printed(": %.1f GB free, up to %.1f GB needed", 1e-9 * free_bytes, 1e-9 * needed_bytes);
}

void warn_of_space(const std::string& option, const std::string& folder, double needed_bytes) {
  if (folder.empty()) {
    return;
  }
  if (const std::string line = short_of_space(option, folder, needed_bytes); !line.empty()) {
    print_warning(line);
  }
}

}  // namespace orthonav::tools
