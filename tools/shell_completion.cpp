#include "tools/shell_completion.h"

#include <algorithm>
#include <vector>

namespace orthonav::tools {
namespace {

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
    words.push_back(option.name());
  }
  out += "      \"" + page.way + "\") words=\"" + spaced(words) + "\" ;;\n";
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
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} way=orthonav words="" i
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
