#include "tools/orthonav/completion/shell_completion.h"

#include <vector>

#include "base/joined.h"

namespace orthonav::tools {
namespace {

void add_ways(const CommandPage& page, std::string& out) {
  for (const CommandPage& command : page.commands) {
    out += (out.empty() ? "" : "|") + ("\"" + command.way + "\"");
    add_ways(command, out);
  }
}

/// A line each, since a choice may have blanks.
std::string lines(const std::vector<std::string>& words) { return joined(words, "\n"); }

void add_choices(const CommandPage& page, std::string& out) {
  for (const OptionRow& option : page.options) {
    if (option.choices.empty()) {
      continue;
    }
    std::string names;
    for (const std::string& name : option.names) {
      names += (names.empty() ? "\"" : "|\"") + page.way + " " + name + "\"";
    }
    out += "    " + names + ") words=\"" + lines(option.choices) + "\" ;;\n";
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
  for (const OptionRow& argument : page.arguments) {
    words.insert(words.end(), argument.choices.begin(), argument.choices.end());
  }
  for (const OptionRow& option : page.options) {
    words.push_back(option.name());
  }
  out += "      \"" + page.way + "\") words=\"" + lines(words) + "\" ;;\n";
  for (const CommandPage& command : page.commands) {
    add_words(command, out);
  }
}

}  // namespace

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
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} way=orthonav words="" i IFS=$'\n'
  for ((i = 1; i < COMP_CWORD; ++i)); do
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
