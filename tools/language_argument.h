#pragma once

#include <CLI/App.hpp>
#include <string>

#include "base/result.h"

namespace orthonav::tools {

/// `--language`, of the commands that show holograms to somebody.
class LanguageArgument {
 public:
  void add_to(CLI::App& command);
  /// From now on holograms and status line are in that language. Before any thread is started that
  /// writes them.
  [[nodiscard]] Status use() const;

 private:
  std::string name_ = "en";
};

}  // namespace orthonav::tools
