#include "tools/orthonav/manual/manual_page.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace orthonav::tools {
namespace {

std::string dashed(std::string way) {
  std::replace(way.begin(), way.end(), ' ', '-');
  return way;
}

/// Escaped for roff, so that no text becomes an escape or a request, and hyphens stay hyphens.
std::string roff(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) {
      out += "\\&";
    }
    line_begins = c == '\n';
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }

void add_rows(const char* title, const std::vector<OptionRow>& rows, std::string& out) {
  if (rows.empty()) {
    return;
  }
  out += std::string(".SH ") + title + "\n";
  for (const OptionRow& row : rows) {
    out += ".TP\n" + bold(heading(row)) + "\n" + roff(explained(row)) + "\n";
  }
}

/// Paragraphs; lines that begin with blanks are examples and stay as they are.
void add_notes(const std::string& notes, std::string& out) {
  std::istringstream lines(notes);
  bool kept = false;
  bool begun = false;
  for (std::string line; std::getline(lines, line);) {
    const bool example = !line.empty() && line.front() == ' ';
    if (!line.empty() && !begun) {
      out += ".SH NOTES\n";
      begun = true;
    }
    if (example != kept && !line.empty()) {
      out += example ? ".nf\n" : ".fi\n";
      kept = example;
    }
    if (!line.empty()) {
      out += roff(line) + "\n";
    } else if (begun && lines.peek() != std::istringstream::traits_type::eof()) {
      out += ".PP\n";
    }
  }
  out += kept ? ".fi\n" : "";
}

void add_commands(const CommandPage& page, std::string& out) {
  if (page.commands.empty()) {
    return;
  }
  out += ".SH COMMANDS\n";
  for (const CommandPage& command : page.commands) {
    out += ".TP\n\\fB" + roff(dashed(command.way)) + "\\fR(1)\n" + roff(command.text) + "\n";
  }
}

std::string title_of(const CommandPage& page) {
  std::string title = dashed(page.way);
  std::transform(title.begin(), title.end(), title.begin(), [](char c) {
    return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  });
  return title;
}

void add_pages(const CommandPage& page, const std::string& release,
               std::vector<ManualPage>& pages) {
  const std::string name = dashed(page.way);
  const std::string above = name.substr(0, name.rfind('-'));
  std::string out = ".TH " + roff(title_of(page)) + " 1 \"\" \"" + roff(release) +
                    "\" \"orthonav\"\n.SH NAME\n" + roff(name) + " \\- " + roff(page.text) +
                    "\n.SH SYNOPSIS\n" + bold(page.usage()) + "\n";
  add_commands(page, out);
  add_rows("ARGUMENTS", page.arguments, out);
  add_rows("OPTIONS", page.options, out);
  add_notes(page.notes, out);
  out +=
      ".SH EXIT STATUS\n0: done. 1: the answer is no. 2: bad arguments or input, said in one "
      "line on standard error.\n";
  if (above != name && above.find("orthonav") == 0) {
    out +=
        ".SH SEE ALSO\n\\fB" + roff(dashed(page.way.substr(0, page.way.rfind(' ')))) + "\\fR(1)\n";
  }
  pages.push_back({name + ".1", out});
  for (const CommandPage& command : page.commands) {
    add_pages(command, release, pages);
  }
}

}  // namespace

std::vector<ManualPage> manual_pages(const CommandPage& page, const std::string& release) {
  std::vector<ManualPage> pages;
  add_pages(page, release, pages);
  return pages;
}

}  // namespace orthonav::tools
