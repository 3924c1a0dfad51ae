#include "tools/manual_page.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace orthonav::tools {
namespace {

std::string dashed(std::string way) {
  std::replace(way.begin(), way.end(), ' ', '-');
  return way;
}

/// As roff takes it: no escapes and no requests by accident, hyphens of options as they are typed.
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

void add_ways(const CommandPage& page, std::string& out) {
  for (const CommandPage& command : page.commands) {
    out += (out.empty() ? "" : "|") + ("\"" + command.way + "\"");
    add_ways(command, out);
  }
}

std::string spaced(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) {
    out += (out.empty() ? "" : " ") + word;
  }
  return out;
}

void add_choices(const CommandPage& page, std::string& out) {
  for (const OptionRow& option : page.options) {
    const bool has_blanks =
        std::any_of(option.choices.begin(), option.choices.end(),
                    [](const std::string& s) { return s.find(' ') != std::string::npos; });
    if (option.choices.empty() || has_blanks) {
      continue;
    }
    std::string names;
    for (const std::string& name : option.names) {
      names += (names.empty() ? "\"" : "|\"") + page.way + " " + name + "\"";
    }
    out += "    " + names + ") words=\"" + spaced(option.choices) + "\" ;;\n";
  }
  for (const CommandPage& command : page.commands) {
    add_choices(command, out);
  }
}

void add_words(const CommandPage& page, std::string& out) {
  std::vector<std::string> words;
  for (const CommandPage& command : page.commands) {
    words.push_back(command.way.substr(page.way.size() + 1));
  }
  for (const OptionRow& option : page.options) {
    words.push_back(option.names.back());
  }
  out += "      \"" + page.way + "\") words=\"" + spaced(words) + "\" ;;\n";
  for (const CommandPage& command : page.commands) {
    add_words(command, out);
  }
}

}  // namespace

std::vector<ManualPage> manual_pages(const CommandPage& page, const std::string& release) {
  std::vector<ManualPage> pages;
  add_pages(page, release, pages);
  return pages;
}

std::string bash_completion(const CommandPage& page) {
  std::string ways;
  add_ways(page, ways);
  std::string choices;
  add_choices(page, choices);
  std::string words;
  add_words(page, words);
  return R"(# Completes orthonav in bash: source this, or put it into ~/.local/share/bash-completion/completions/orthonav.
# In zsh: autoload -U +X bashcompinit && bashcompinit first.
_orthonav() {
  local word=${COMP_WORDS[COMP_CWD]} before=${COMP_WORDS[COMP_CWD-1]} way=orthonav words="" i
  for ((i = 1; i < COMP_CWD; ++i)); do
    case "$way ${COMP_WORDS[i]}" in
      )" +
         ways + R"() way="$way ${COMP_WORDS[i]}" ;;
    esac
  done
  COMPREPLY=()
  case "$way $before" in
)" + choices +
         R"(  esac
  if [ -z "$words" ]; then
    case "$way" in
)" + words +
         R"(    esac
    # Files for arguments and for the values of options.
    case "$word" in -*) ;; *) COMPREPLY=($(compgen -f -- "$word")) ;; esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word") "${COMPREPLY[@]}")
}
complete -o filenames -F _orthonav orthonav
)";
}

}  // namespace orthonav::tools
