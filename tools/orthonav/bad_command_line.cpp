#include "tools/orthonav/bad_command_line.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "tools/orthonav/command.h"
#include "tools/orthonav/config/did_you_mean.h"

namespace orthonav::tools {
namespace {

/// The command that was meant, as far as known, and the words that lead to it.
struct Asked {
  const CLI::App* command;
  std::string way;
};

Asked asked_of(const CLI::App& app) {
  Asked asked{&app, app.get_name()};
  while (!asked.command->get_subcommands().empty()) {
    asked.command = asked.command->get_subcommands().front();
    asked.way += " " + asked.command->get_name();
  }
  return asked;
}

/// What may follow these words: commands, or options if the word should be one.
std::vector<std::string> possible(const CLI::App& command, bool option) {
  std::vector<std::string> names;
  if (!option) {
    for (const CLI::App* below : command.get_subcommands({})) {
      names.push_back(below->get_name());
    }
    return names;
  }
  for (const CLI::Option* known : command.get_options()) {
    for (const std::string& name : known->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The one command below whose description has a part of this word, as "to-slicer" of "plan
/// export"; empty: none, or several.
std::string described_by(const std::string& word, const CLI::App& command) {
  constexpr std::size_t kShortestPart = 4;
  std::vector<std::string> found;
  for (const CLI::App* below : command.get_subcommands({})) {
    const std::string description = lower_case(below->get_description());
    std::istringstream parts(lower_case(word));
    for (std::string part; std::getline(parts, part, '-');) {
      if (part.size() >= kShortestPart && description.find(part) != std::string::npos) {
        found.push_back(below->get_name());
        break;
      }
    }
  }
  return found.size() == 1 ? found.front() : "";
}

/// Names the unexpected word, and what was probably meant.
std::string about_word(const std::string& word, const Asked& asked) {
  const bool option = word.size() > 1 && word.front() == '-';
  const bool command = !option && !asked.command->get_subcommands({}).empty();
  std::string meant = closest(word, possible(*asked.command, option));
  if (meant.empty() && command) {
    meant = described_by(word, *asked.command);
  }
  return (option    ? "unknown option: "
          : command ? "unknown command: "
                    : "unexpected argument: ") +
         word + (meant.empty() ? "" : "; did you mean " + meant + "?");
}

/// The parser omits the name of a hidden option from its message, which then begins with the colon
/// after it.
std::string with_hidden_name(std::string message, const CLI::App& command) {
  const auto is_told_of = [&message](const CLI::Option* option) {
    const std::vector<std::string>& given = option->results();
    return option->get_group().empty() && !option->get_lnames().empty() &&
           (given.empty() || message.find("\"" + given.front() + "\"") != std::string::npos);
  };
  if (message.starts_with(':')) {
    const std::vector<const CLI::Option*> told = command.get_options(is_told_of);
    if (!told.empty()) {
      message.insert(0, "--" + told.front()->get_lnames().front());
    }
  }
  return message;
}

/// "SHELL: fish not in {bash,zsh}" and "A subcommand is required", as the parser says, in our
/// words.
std::string in_our_words(std::string message) {
  if (message.starts_with("A subcommand")) {
    message.replace(0, std::string("A subcommand").size(), "a command");
  }
  const std::string before = " not in {";
  const std::size_t at = message.find(before);
  if (at != std::string::npos && message.ends_with('}')) {
    std::string choices = message.substr(at + before.size());
    choices.pop_back();
    for (std::size_t i = choices.find(','); i != std::string::npos; i = choices.find(',', i + 1)) {
      choices.insert(i + 1, " ");
    }
    message.replace(at, std::string::npos, " is not one of " + choices);
  }
  return message;
}

}  // namespace

int bad_command_line(const CLI::App& app, const CLI::ParseError& error) {
  const Asked asked = asked_of(app);
  std::string message = in_our_words(with_hidden_name(error.what(), *asked.command));
  // Without a known command the library reports a missing one; the word that was written says more.
  const std::vector<std::string> unknown = app.remaining(true);
  const auto option = std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
    return !word.empty() && word.front() == '-';
  });
  const bool extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  if (!unknown.empty() && (extra || asked.command->get_require_subcommand_min() > 0)) {
    message = about_word(extra && option != unknown.end() ? *option : unknown.front(), asked);
  }
  return bad_input(message + " (see " + asked.way + " --help)");
}

}  // namespace orthonav::tools
