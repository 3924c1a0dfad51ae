#include "tools/orthonav/operation/stopped_run.h"

#include <cstdio>

namespace orthonav::tools {

void explain_stop(const StopSignals& signals, engine::OperationResult& result) {
  const auto signal = signals.caught();
  if (signal && !result.completed) {
    result.why_not = "stopped by " + *signal + ", " + result.why_not;
  }
}

void tell_what_is_kept(const StopSignals& signals, const std::vector<std::string>& folders) {
  const auto signal = signals.caught();
  if (!signal) {
    return;
  }
  std::string kept;
  for (const std::string& folder : folders) {
    if (!folder.empty()) {
      kept += (kept.empty() ? "; kept: " : ", ") + folder;
    }
  }
  std::fprintf(stderr, "orthonav: stopped by %s%s\n", signal->c_str(), kept.c_str());
}

}  // namespace orthonav::tools
