#include "tools/orthonav/shared/screw_arguments.h"

#include <CLI/CLI.hpp>

#include "engine/case/screw_sizes_file.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {

void ScrewArguments::add_to(CLI::App& command) {
  command
      .add_option("--screws,--sizes", file,
                  "list of screw sizes (default: 4.5 to 8.5 mm, 25 to 60 mm long; "
                  "docs/file-formats.md)")
      ->check(some_text());
}

Result<engine::ScrewSizes> ScrewArguments::sizes() const {
  return file.empty() ? Result<engine::ScrewSizes>(engine::ScrewSizes::built_in())
                      : engine::load_screw_sizes(file);
}

void warn_of_sizes(const engine::Operation& operation, const engine::ScrewSizes& sizes) {
  for (const std::string& line : engine::sizes_not_listed(operation, sizes)) {
    print_warning(line);
  }
}

}  // namespace orthonav::tools
