#pragma once

#include <CLI/App.hpp>
#include <string>

#include "base/result.h"

namespace orthonav::tools {

/// `--language` and `--colours`, of the commands that show holograms to somebody.
class WearerArguments {
 public:
  void add_to(CLI::App& command);
  /// From now on holograms and status line are like that. Before any thread is started that writes
  /// or draws them.
  [[nodiscard]] Status use() const;

 private:
  std::string language_ = "en";
  std::string colours_ = "standard";
};

}  // namespace orthonav::tools
