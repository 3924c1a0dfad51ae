#pragma once

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace orthonav::test {

/// A command's standard output; empty if it can't be run.
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

/// For tests that skip without a browser, which the build does not require.
inline bool has_browser() { return !said_by("command -v chromium").empty(); }
inline constexpr const char* kNoBrowser = "needs chromium";

/// Whether pages may draw with WebGL, on the processor: that takes the browser longer to start.
enum class BrowserDraws { kPlain, kWebGl };

/// The page at an address after its scripts have run for this long; empty if the browser fails or
/// takes more than a minute.
inline std::string page_in_browser(const std::string& address, int script_ms,
                                   BrowserDraws draws = BrowserDraws::kPlain) {
  const TemporaryFolder profile;
  return said_by(
      std::string("timeout 60 chromium --headless --no-sandbox --disable-dev-shm-usage ") +
      (draws == BrowserDraws::kWebGl ? "--use-angle=swiftshader --enable-unsafe-swiftshader "
                                     : "--disable-gpu ") +
      "--allow-file-access-from-files --user-data-dir=" + profile.path().string() +
      " --virtual-time-budget=" + std::to_string(script_ms) + " --dump-dom '" + address + "'");
}

inline constexpr int kPhone_px = 390;

/// The value of a JavaScript expression about the document `d` for a page laid out on a phone's
/// screen; "?" if the browser failed.
inline std::string on_a_phone(const std::string& page, const std::string& expression) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("page.html")) << page;
  std::ofstream(folder.file("phone.html"))
      << "<body><iframe id=f style='width:" << kPhone_px
      << "px;height:800px;border:0' src=page.html></iframe><script>f.onload=()=>{"
         "const d=f.contentDocument;document.title='says '+("
      << expression << ")+';'}</script>";
  const std::string seen = page_in_browser("file://" + folder.file("phone.html"), 3000);
  const std::string begin = "<title>says ";
  const std::size_t from = seen.find(begin);
  return from == std::string::npos
             ? "?"
             : seen.substr(from + begin.size(), seen.find(';', from) - from - begin.size());
}

/// Tables, drawings and charts of a page that run off a phone's screen, by their classes; empty if
/// all fit.
inline std::string too_wide_for_a_phone(const std::string& page) {
  return on_a_phone(page,
                    "[...d.querySelectorAll('table,svg,canvas')].filter(t=>"
                    "t.getBoundingClientRect().right>d.documentElement.clientWidth)"
                    ".map(t=>t.className||t.tagName).join(' ')");
}

}  // namespace orthonav::test
