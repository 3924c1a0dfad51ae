#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace orthonav::nav {

/// The outcome of a check of calibration or accuracy: good; usable, with a caveat; not to be used.
enum class Verdict { kPass, kNote, kFail };

[[nodiscard]] constexpr std::string_view to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kNote:
      return "note";
    case Verdict::kFail:
      return "fail";
  }
  return "fail";
}

/// A verdict and why: every finding with value and limit, joined by "; ".
struct Judgement {
  Verdict verdict = Verdict::kPass;
  std::string reason;

  /// Adds a finding; the worst verdict stays.
  void add(Verdict found, const std::string& why) {
    verdict = std::max(verdict, found);
    reason += (reason.empty() ? "" : "; ") + why;
  }
  /// States that nothing was found, if there is no finding.
  void conclude() {
    if (reason.empty()) {
      reason = "every figure is within its limit";
    }
  }
};

}  // namespace orthonav::nav
