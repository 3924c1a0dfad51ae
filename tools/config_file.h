#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::tools {

/// A key of the configuration: the option of those commands that have it.
struct ConfigKey {
  const char* section;
  const char* key;
  const char* option;
  bool is_file = false;  ///< relative names start from the folder of the configuration
};

/// Every key there is, by section.
[[nodiscard]] const std::vector<ConfigKey>& config_keys();

/// What a configuration file (TOML) says, each key checked against the table: sections and keys
/// that are not in it are refused by name and line, and so are values that are neither text, number
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
  /// Gives the command what it has an option for and what the command line left open; keys of other
  /// commands wait for those.
  Status apply_to(CLI::App& command) const;

 private:
  std::string path_;
  std::vector<Value> values_;
};

/// `--config FILE` of a command: a flag wins over the file.
void add_config_option(CLI::App& command);

}  // namespace orthonav::tools
