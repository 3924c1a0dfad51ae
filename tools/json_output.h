#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "hal/api/result.h"

namespace orthonav::tools {

/// Where a command's figures go as JSON: nowhere, standard output (`--json` or `--json -`), or a
/// file.
class JsonOutput {
 public:
  /// Adds `--json [OUT]` to the command. Keep this object alive until it is parsed.
  void add_to(CLI::App& command);
  /// Standard output carries the JSON and nothing else.
  [[nodiscard]] bool on_stdout() const;
  /// Refuses a place that can't be written, before the work is done.
  [[nodiscard]] Status check() const;
  [[nodiscard]] Status write(const nlohmann::ordered_json& content) const;

 private:
  [[nodiscard]] bool wanted() const { return option_ != nullptr && option_->count() > 0; }
  CLI::Option* option_ = nullptr;
  std::string place_;
};

}  // namespace orthonav::tools
