#include "tools/count_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace orthonav::tools {
namespace {

constexpr auto kRedrawEvery = std::chrono::milliseconds(100);
constexpr int kBarColumns = 30;

}  // namespace

CountProgress::CountProgress(std::string what, std::int64_t total)
    : what_(std::move(what)), total_(total), terminal_(isatty(STDERR_FILENO) != 0) {}

CountProgress::~CountProgress() {
  if (terminal_ && done_ > 0) std::fprintf(stderr, "\r\033[K");
}

void CountProgress::add_one() {
  ++done_;
  if (terminal_) return draw_bar();
  if (done_ * 4 / std::max<std::int64_t>(total_, 1) !=
      (done_ - 1) * 4 / std::max<std::int64_t>(total_, 1))
    std::fprintf(stderr, "%lld of %lld %s\n", static_cast<long long>(done_),
                 static_cast<long long>(total_), what_.c_str());
}

void CountProgress::draw_bar() {
  const auto now = std::chrono::steady_clock::now();
  if (now - drawn_ < kRedrawEvery && done_ != total_) return;
  drawn_ = now;
  const double share = std::clamp(
      static_cast<double>(done_) / static_cast<double>(std::max<std::int64_t>(total_, 1)), 0.0,
      1.0);
  const double spent_s = std::chrono::duration<double>(now - start_).count();
  const int full = static_cast<int>(share * kBarColumns);
  std::fprintf(stderr, "\r[%s%s] %lld/%lld %s, %.0f s left ",
               std::string(static_cast<std::size_t>(full), '#').c_str(),
               std::string(static_cast<std::size_t>(kBarColumns - full), '.').c_str(),
               static_cast<long long>(done_), static_cast<long long>(total_), what_.c_str(),
               share > 0.0 ? spent_s * (1.0 - share) / share : 0.0);
}

}  // namespace orthonav::tools
