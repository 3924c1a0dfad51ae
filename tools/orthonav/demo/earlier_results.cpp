#include "tools/orthonav/demo/earlier_results.h"

#include <regex>

#include "base/file_code.h"

namespace orthonav::tools {

Status remove_earlier_results(const std::filesystem::path& folder) {
  static const std::regex kOurs(
      "report\\.html|report\\.json|timing\\.json|session\\.orthonav|operation\\.mp4|"
      "[0-9]{2,}-(setup|digitize|verify|accepted|guide|rod|done)(-[^/]*)?\\.png");
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code)) {
    if (!std::regex_match(entry.path().filename().string(), kOurs)) {
      continue;
    }
    if (!entry.is_directory()) {
      std::filesystem::remove(entry.path(), code);
    }
    if (code) {
      return Error{entry.path().string() + ": cannot be replaced: " + code.message(),
                   file_code(code)};
    }
  }
  if (code) {
    return Error{folder.string() + ": cannot be read: " + code.message(), file_code(code)};
  }
  return {};
}

}  // namespace orthonav::tools
