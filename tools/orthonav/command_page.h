#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace orthonav::tools {

/// One option or argument of a command, as described to people.
struct OptionRow {
  std::vector<std::string> names;  ///< "-o", "--out"; of an argument "RECORDING"
  std::string value;               ///< its value: "FILE", "best|paper"; empty: a flag
  std::vector<std::string> choices;
  std::string text;
  std::string default_value;  ///< empty: none, or stated in the text
  std::vector<std::string> excludes;
  std::vector<std::string> needs;
  bool required = false;
  bool repeats = false;  ///< takes several values

  /// The name that explains itself: its first long one.
  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] bool is_flag() const { return value.empty(); }
};

/// The table of a command, from which its help, its manual page and shell completion are made.
struct CommandPage {
  std::string way;  ///< "orthonav case make"
  std::string text;
  std::string notes;  ///< paragraphs under the options
  std::vector<OptionRow> arguments;
  std::vector<OptionRow> options;
  std::vector<CommandPage> commands;
  bool needs_command = false;

  [[nodiscard]] std::string usage() const;
};

/// The page of a command and all its subcommands; `way` is that of its parent.
[[nodiscard]] CommandPage page_of(const CLI::App& command, const std::string& way = "");

/// The names of a row and its value: "-o, --out FILE".
[[nodiscard]] std::string heading(const OptionRow& row);
/// Its text with its default, the options it excludes and those it needs.
[[nodiscard]] std::string explained(const OptionRow& row);

}  // namespace orthonav::tools
