#include "tools/orthonav/command_page.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "base/joined.h"
#include "nav/tracking/marker_detector.h"

namespace orthonav::tools {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) {
    parts.push_back(part);
  }
  return parts;
}

/// What follows options that the commands share, if no more is said of it than that it is text.
std::string usual_value(const std::string& option) {
  static const std::map<std::string, const char*> values = {{"--background", "NAME|FILE"},
                                                            {"--board", "FILE"},
                                                            {"--cases", "DIR"},
                                                            {"--csv", "FILE"},
                                                            {"--db", "PATH"},
                                                            {"--device", "NAME"},
                                                            {"--dir", "DIR"},
                                                            {"--draw", "DIR"},
                                                            {"--family", "NAME"},
                                                            {"--headset", "URI"},
                                                            {"--host", "ADDRESS"},
                                                            {"--ids", "LIST"},
                                                            {"--level", "LEVEL"},
                                                            {"--material", "NAME"},
                                                            {"--models", "DIR"},
                                                            {"--name", "NAME"},
                                                            {"--out", "PATH"},
                                                            {"--pointer", "NAME"},
                                                            {"--record", "DIR"},
                                                            {"--report", "FILE"},
                                                            {"--screws", "FILE"},
                                                            {"--script", "FILE"},
                                                            {"--series", "UID"},
                                                            {"--shard", "I/N"},
                                                            {"--size", "WIDTHxHEIGHT"},
                                                            {"--to-bone", "X,Y,Z"},
                                                            {"--tools", "FILE"}};
  const auto found = values.find(option);
  return found == values.end() ? "TEXT" : found->second;
}

/// A text in a table begins with a small letter, unless its first word is a name, as "URI" and
/// "CT:".
std::string begun_small(std::string text) {
  const auto capital = [](unsigned char c) { return std::isupper(c) != 0; };
  const std::string word = text.substr(0, text.find(' '));
  if (!word.empty() && std::none_of(word.begin() + 1, word.end(), capital)) {
    text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  }
  return text;
}

/// The library's "TEXT:{a,b}" and our own "a|b" are choices; of "NAME|a|b", too long for help, only
/// completion has the choices. The library's words for numbers differ from ours.
void read_value(const CLI::Option& option, OptionRow& row) {
  if (option.get_type_size() == 0) {
    return;
  }
  row.value = option.get_type_name();
  const std::size_t brace = row.value.find('{');
  if (brace != std::string::npos && row.value.back() == '}') {
    row.choices = split(row.value.substr(brace + 1, row.value.size() - brace - 2), ',');
    row.value = joined(row.choices, "|");
  } else if (row.value.find('|') != std::string::npos) {
    row.choices = split(row.value, '|');
    const std::string& first = row.choices.front();
    if (std::all_of(first.begin(), first.end(),
                    [](unsigned char c) { return std::isupper(c) != 0; })) {
      row.value = first;
      row.choices.erase(row.choices.begin());
    }
  } else if (const std::size_t colon = row.value.find(':'); colon != std::string::npos) {
    row.value = row.value.substr(colon + 1);  // "TEXT:WIDTHxHEIGHT"
  }
  // What stands for any text is nothing to choose.
  for (const char* any : {"FILE", "DIR", "LIST"}) {
    std::erase(row.choices, any);
  }
  if (row.value == "INT" || row.value == "UINT") {
    row.value = "N";
  } else if (row.value == "FLOAT") {
    row.value = "NUMBER";
  } else if (row.value == "TEXT") {
    row.value = usual_value(row.name());
    if (row.name() == "--family") {
      row.choices.assign(nav::known_families().begin(), nav::known_families().end());
    }
  }
}

std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) {
    names.push_back(option->get_name());
  }
  std::sort(names.begin(), names.end());
  return names;
}

OptionRow row_of(const CLI::Option& option) {
  OptionRow row;
  if (option.get_positional()) {
    row.names = {option.get_name(true, false)};
  } else {
    for (const std::string& name : option.get_snames()) {
      row.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
      row.names.push_back("--" + name);
    }
  }
  read_value(option, row);
  row.text = begun_small(option.get_description());
  row.default_value = option.get_default_str();
  row.excludes = names_of(option.get_excludes());
  row.needs = names_of(option.get_needs());
  row.required = option.get_required();
  row.repeats = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  return row;
}

}  // namespace

CommandPage page_of(const CLI::App& command, const std::string& way) {
  CommandPage page;
  page.way = way + (way.empty() ? "" : " ") + command.get_name();
  page.text = command.get_description();
  page.notes = command.get_footer();
  page.needs_command = command.get_require_subcommand_min() > 0;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) {
      (option->get_positional() ? page.arguments : page.options).push_back(row_of(*option));
    }
  }
  for (const CLI::App* below : command.get_subcommands({})) {
    page.commands.push_back(page_of(*below, page.way));
  }
  return page;
}

const std::string& OptionRow::name() const {
  const auto is_long = [](const std::string& name) { return name.starts_with("--"); };
  const auto found = std::find_if(names.begin(), names.end(), is_long);
  return found == names.end() ? names.front() : *found;
}

std::string CommandPage::usage() const {
  std::string line = way;
  for (const OptionRow& option : options) {
    if (option.required) {
      line += " " + option.name() + " " + option.value;
    }
  }
  line += " [OPTIONS]";
  for (const OptionRow& argument : arguments) {
    const std::string name = argument.names.front() + (argument.repeats ? "..." : "");
    line += argument.required ? " " + name : " [" + name + "]";
  }
  if (!commands.empty()) {
    line += needs_command ? " COMMAND" : " [COMMAND]";
  }
  return line;
}

std::string heading(const OptionRow& row) {
  std::string out = joined(row.names, ", ");
  const bool is_argument = !out.empty() && out.front() != '-';
  if (!row.value.empty() && !is_argument) {
    out += " " + row.value;
  }
  return out + (row.repeats ? "..." : "");
}

std::string explained(const OptionRow& row) {
  std::string out = row.text;
  std::vector<std::string> more;
  if (!row.default_value.empty() && row.text.find("(default") == std::string::npos) {
    more.push_back("default: " + row.default_value);
  }
  if (row.required && row.names.front().front() == '-') {
    more.push_back("required");
  }
  if (!row.excludes.empty()) {
    more.push_back("not with " + joined(row.excludes, ", "));
  }
  if (!row.needs.empty()) {
    more.push_back("with " + joined(row.needs, ", "));
  }
  return more.empty() ? out : out + (out.empty() ? "(" : " (") + joined(more, "; ") + ")";
}

}  // namespace orthonav::tools
