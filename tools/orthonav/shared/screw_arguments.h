#pragma once

#include <CLI/App.hpp>
#include <string>

#include "engine/case/screw_sizes.h"

namespace orthonav::tools {

/// The argument for the available screws.
struct ScrewArguments {
  std::string file;  ///< empty: the built-in list

  void add_to(CLI::App& command);
  /// Reads the file, where there is one.
  [[nodiscard]] Result<engine::ScrewSizes> sizes() const;
};

/// Warns on standard error of every planned screw that is not among them.
void warn_of_sizes(const engine::Operation& operation, const engine::ScrewSizes& sizes);

}  // namespace orthonav::tools
