#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::tools {

/// A key of the configuration: an option of the commands that have it.
struct ConfigKey {
  const char* section;
  const char* key;
  const char* option;
  bool is_file = false;  ///< relative names start from the folder of the configuration
  bool or_word = false;  ///< a value without dot and slash is a word, not a file
};

/// All keys, by section.
[[nodiscard]] const std::vector<ConfigKey>& config_keys();

/// The content of a configuration file (TOML), with each key checked against the table: unknown
/// sections and keys are refused by name and line, and so are values that are neither text, number
/// nor true or false.
class ConfigFile {
 public:
  static Result<ConfigFile> load(const std::string& path);

  struct Value {
    const ConfigKey* key;
    std::string text;
    int line;
  };
  [[nodiscard]] const std::vector<Value>& values() const { return values_; }
  /// Sets the command's options that the command line did not give; keys of other commands are
  /// ignored here.
  Status apply_to(CLI::App& command) const;

 private:
  std::string path_;
  std::vector<Value> values_;
};

/// `--config FILE` of a command: a flag wins over the file.
void add_config_option(CLI::App& command);

}  // namespace orthonav::tools
