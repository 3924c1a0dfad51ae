#include "tools/orthonav/shared/count_progress.h"

#include <algorithm>
#include <memory>

namespace orthonav::tools {

CountProgress::CountProgress(std::string what, std::int64_t total)
    : what_(std::move(what)), total_(total) {
  bar_.draw(0.0, what_);
}

void CountProgress::set(std::int64_t done, std::int64_t total) {
  if (done_ == 0) {
    earlier_ = done - 1;
  }
  const bool another_quarter = done * 4 / total != done_ * 4 / total;
  done_ = done;
  const auto all = static_cast<double>(total);
  bar_.draw(static_cast<double>(done) / all,
            std::to_string(done) + " of " + std::to_string(total) + " " + what_, another_quarter,
            static_cast<double>(earlier_) / all);
}

std::function<void(int, int)> counted(const std::string& what) {
  return [progress = std::make_shared<CountProgress>(what, 1)](int done, int all) {
    progress->set(done, all);
  };
}

}  // namespace orthonav::tools
