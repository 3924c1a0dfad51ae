#include "tools/orthonav/help_text.h"
#include "tools/orthonav/shared/terminal_width.h"

#include <unistd.h>

#include <algorithm>
#include <memory>
#include <sstream>

namespace orthonav::tools {
namespace {

constexpr std::size_t kIndent = 2;
/// Where the texts of a table begin; a longer heading has a line of its own.
constexpr std::size_t kTextColumn = 30;

/// Columns that UTF-8 takes where every character is one wide.
std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

/// Adds words to `out`, which stands at `column`; further lines begin at `indent`.
void wrap(const std::string& text, std::size_t column, std::size_t indent, std::size_t width,
          std::string& out) {
  std::istringstream words(text);
  bool first = true;
  for (std::string word; words >> word; first = false) {
    const std::size_t wide = columns(word);
    if (!first && column + 1 + wide > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      out += ' ';
      ++column;
    }
    out += word;
    column += wide;
  }
  out += '\n';
}

void add_row(const std::string& heading, const std::string& text, std::size_t width,
             std::string& out) {
  std::string line = std::string(kIndent, ' ') + heading;
  if (columns(line) + 2 > kTextColumn) {
    line += "\n" + std::string(kTextColumn, ' ');
  } else {
    line.append(kTextColumn - columns(line), ' ');
  }
  out += line;
  wrap(text, kTextColumn, kTextColumn, width, out);
}

void add_rows(const char* title, const std::vector<OptionRow>& rows, std::size_t width,
              std::string& out) {
  if (rows.empty()) {
    return;
  }
  out += std::string("\n") + title + ":\n";
  for (const OptionRow& row : rows) {
    add_row(heading(row), explained(row), width, out);
  }
}

class HelpFormatter : public CLI::FormatterBase {
 public:
  [[nodiscard]] std::string make_help(const CLI::App* app, std::string /*name*/,
                                      CLI::AppFormatMode /*mode*/) const override {
    std::string way;
    for (const CLI::App* above = app->get_parent(); above != nullptr; above = above->get_parent()) {
      way = above->get_name() + (way.empty() ? "" : " ") + way;
    }
    return help_text(page_of(*app, way), output_width());
  }
};

void use_formatter(CLI::App& app, const std::shared_ptr<HelpFormatter>& formatter) {
  app.formatter(formatter);
  for (CLI::App* below : app.get_subcommands({})) {
    use_formatter(*below, formatter);
  }
}

}  // namespace

std::string help_text(const CommandPage& page, std::size_t width) {
  std::string out;
  wrap(page.text, 0, 0, width, out);
  out += "\nUsage: ";
  wrap(page.usage(), 7, 9, width, out);
  if (!page.commands.empty()) {
    out += "\nCommands:\n";
    for (const CommandPage& command : page.commands) {
      add_row(command.way.substr(page.way.size() + 1), command.text, width, out);
    }
  }
  add_rows("Arguments", page.arguments, width, out);
  add_rows("Options", page.options, width, out);
  if (!page.notes.empty()) {
    const std::size_t begin = page.notes.find_first_not_of('\n');
    out += "\n" + page.notes.substr(begin == std::string::npos ? 0 : begin) + "\n";
  }
  return out;
}

std::size_t output_width() {
  constexpr std::size_t kNarrowest = 60;
  constexpr std::size_t kWidest = 120;
  return std::clamp(terminal_columns(STDOUT_FILENO).value_or(100), kNarrowest, kWidest);
}

void use_help_text(CLI::App& app) { use_formatter(app, std::make_shared<HelpFormatter>()); }

}  // namespace orthonav::tools
