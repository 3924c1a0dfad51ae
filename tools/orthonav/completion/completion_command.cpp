#include <cstdio>
#include <memory>
#include <string>

#include "tools/orthonav/command.h"
#include "tools/orthonav/command_page.h"
#include "tools/orthonav/completion/shell_completion.h"

namespace orthonav::tools {

void add_completion_command(CLI::App& app, Action& action) {
  auto shell = std::make_shared<std::string>();
  auto* completion = app.add_subcommand("completion", "Prints what a shell completes");
  completion->add_option("SHELL", *shell, "bash or zsh")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  completion->footer(
      "bash: source <(orthonav completion bash). zsh: autoload -U +X bashcompinit && "
      "bashcompinit,\n"
      "then the same with zsh.");
  completion->callback([&app, &action] {
    action = [&app] {
      std::fputs(bash_completion(page_of(app)).c_str(), stdout);
      return kDone;
    };
  });
}

}  // namespace orthonav::tools
