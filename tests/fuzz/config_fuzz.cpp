#include "tests/fuzz/input_file.h"
#include "tools/orthonav/config/config_file.h"

namespace orthonav::fuzz {

/// Configurations: an accepted one names only keys of the table, each with a value.
void fuzz_config(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto config = tools::ConfigFile::load(file.path());
  if (!config) {
    insist_one_line(config.error());
    return;
  }
  for (const tools::ConfigFile::Value& value : config->values()) {
    insist(value.key != nullptr && !value.text.empty() && value.line > 0);
  }
}

}  // namespace orthonav::fuzz
