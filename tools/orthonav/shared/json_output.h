#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"

namespace orthonav::tools {

/// Where a command's figures go as JSON: nowhere unless asked for, standard output (`--json` or
/// `--json -`), or a file.
class JsonOutput {
 public:
  /// Adds `--json [OUT]` to the command. Keep this object alive until it is parsed.
  void add_to(CLI::App& command);
  [[nodiscard]] bool given() const { return option_ != nullptr && option_->count() > 0; }
  /// Standard output carries the JSON and nothing else.
  [[nodiscard]] bool on_stdout() const;
  /// Refuses a destination that can't be written, before the work is done.
  [[nodiscard]] Status check() const;
  [[nodiscard]] Status write(const nlohmann::ordered_json& content) const;
  /// The same for text that `make` writes piece by piece. If that fails, no file is left, but
  /// output already on standard output stays.
  [[nodiscard]] Status stream(const std::function<Status(std::ostream&)>& make) const;
  /// The same for text that is JSON already.
  [[nodiscard]] Status write_text(const std::string& text) const;

 private:
  CLI::Option* option_ = nullptr;
  std::string place_;
};

}  // namespace orthonav::tools
