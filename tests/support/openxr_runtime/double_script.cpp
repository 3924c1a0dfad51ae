#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/openxr_runtime/double_state.h"

namespace orthonav::test {
namespace {

std::size_t lit_pixels(const std::vector<std::uint8_t>& image) {
  std::size_t lit = 0;
  for (std::size_t i = 0; i + 3 < image.size(); i += 4) {
    lit += image[i] != 0 || image[i + 1] != 0 || image[i + 2] != 0 ? 1 : 0;
  }
  return lit;
}

/// Pixels that are not black, of both eyes and the panel.
std::size_t lit_pixels(const SubmittedFrame& frame) {
  const std::size_t eyes = lit_pixels(frame.pixels[0]) + lit_pixels(frame.pixels[1]);
  return frame.quad && frame.quad->pixels ? eyes + lit_pixels(*frame.quad->pixels) : eyes;
}

std::string report_path;

void obey(Double& d, std::istream& line, const std::string& word) {
  std::int64_t number = 0;
  if (word == "report") {
    line >> report_path;
  }
  if (word == "real_time") {
    d.traits.stepped = false;
  }
  if (!(line >> number)) {
    return;
  }
  if (word == "period_ms") {
    d.traits.period_ns = number * 1'000'000;
  }
  if (word == "width_px") {
    d.traits.width_px = static_cast<std::uint32_t>(number);
  }
  if (word == "height_px") {
    d.traits.height_px = static_cast<std::uint32_t>(number);
  }
  if (word == "keep") {
    d.traits.frames_kept = static_cast<std::size_t>(number);
  }
  if (word == "lose_session_at") {
    d.actions[number] = [&d] { d.lose_session(true); };
  }
  if (word == "lose_instance_at") {
    d.actions[number] = [&d] { d.lose_instance(false); };
  }
  if (word == "end_at") {
    d.actions[number] = [&d] {
      const std::lock_guard lock(d.mutex);
      d.session->exit_requested = true;
      d.enter(*d.session, XR_SESSION_STATE_STOPPING);
    };
  }
  if (word == "recentre_at") {
    d.actions[number] = [&d] { d.recentre({{0, 0, 0, 1}, {0.3f, 0, 0.1f}}, true, 2); };
  }
}

}  // namespace

/// Reads lines of a word and a number, once: a second instance continues where the first one ended.
void take_script(Double& d) {
  if (d.head) {
    return;
  }
  d.reset({});
  const char* path = std::getenv("ORTHONAV_XR_SCRIPT");
  if (path == nullptr) {
    return;
  }
  std::ifstream file(path);
  for (std::string text; std::getline(file, text);) {
    std::istringstream line(text);
    std::string word;
    if (line >> word) {
      obey(d, line, word);
    }
  }
}

void write_report(const Double& d) {
  if (report_path.empty()) {
    return;
  }
  std::ofstream out(report_path);
  std::size_t lit = 0;
  for (const SubmittedFrame& frame : d.kept) {
    lit = std::max(lit, lit_pixels(frame));
  }
  out << "instances " << d.instance_count << "\nsessions " << d.session_count << "\nframes "
      << d.ended << "\nlit " << lit << "\n";
  for (const std::string& violation : d.wrong) {
    out << "violation " << violation << "\n";
  }
}

}  // namespace orthonav::test
