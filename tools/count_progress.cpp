#include "tools/count_progress.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

namespace orthonav::tools {

CountProgress::CountProgress(std::string what, std::int64_t total)
    : what_(std::move(what)), total_(std::max<std::int64_t>(total, 1)) {}

void CountProgress::add_one() {
  ++done_;
  const std::string text = std::to_string(done_) + " of " + std::to_string(total_) + " " + what_;
  if (bar_.on_terminal()) {
    bar_.draw(static_cast<double>(done_) / static_cast<double>(total_), text, done_ == total_);
  } else if (done_ * 4 / total_ != (done_ - 1) * 4 / total_) {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
}

std::function<void(int, int)> counted(const std::string& what) {
  return
      [what, progress = std::make_shared<std::optional<CountProgress>>()](int /*done*/, int all) {
        if (!*progress) {
          progress->emplace(what, all);
        }
        (*progress)->add_one();
      };
}

}  // namespace orthonav::tools
