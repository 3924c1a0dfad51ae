#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "tests/support/temporary_folder.h"

namespace orthonav::test {

/// What a command says on its standard output; empty where it can't be run.
inline std::string said_by(const std::string& command) {
  std::string said;
  std::FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) {
    return said;
  }
  std::array<char, 4096> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) {
    said.append(part.data(), n);
  }
  ::pclose(pipe);
  return said;
}

/// For tests that skip without one: it is not among what the build needs.
inline bool has_browser() { return !said_by("command -v chromium").empty(); }
inline constexpr const char* kNoBrowser = "chromium is not installed: the page was not opened";

/// The page at an address as it is once its scripts have run for so long; empty where the browser
/// fails, or takes more than a minute.
inline std::string page_in_browser(const std::string& address, int script_ms) {
  const TemporaryFolder profile;
  return said_by(
      "timeout 60 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage "
      "--allow-file-access-from-files --user-data-dir=" +
      profile.path().string() + " --virtual-time-budget=" + std::to_string(script_ms) +
      " --dump-dom '" + address + "'");
}

}  // namespace orthonav::test
