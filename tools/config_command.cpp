#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "tools/command.h"
#include "tools/command_page.h"
#include "tools/config_file.h"

namespace orthonav::tools {
namespace {

/// The commands that have an option, and what it is where nothing is said.
struct Users {
  std::string commands;
  std::string default_value;
};

void find_users(const CommandPage& page, std::map<std::string, Users>& users) {
  const bool configured = std::any_of(page.options.begin(), page.options.end(),
                                      [](const auto& o) { return o.names.back() == "--config"; });
  for (const OptionRow& option : page.options) {
    if (configured && option.names.back() != "--config") {
      Users& found = users[option.names.back()];
      const std::string command = page.way.substr(page.way.find(' ') + 1);
      found.commands += (found.commands.empty() ? "" : ", ") + command;
      const bool is_flag = option.value.empty();
      found.default_value = is_flag ? "false" : option.default_value;
    }
  }
  for (const CommandPage& command : page.commands) {
    find_users(command, users);
  }
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
  return out + "\"";
}

/// Numbers, true and false stand as they are.
std::string value_text(const std::string& text) {
  const bool number = !text.empty() && text.find_first_not_of("+-.0123456789") == std::string::npos;
  return number || text == "true" || text == "false" ? text : quoted(text);
}

int show(const CLI::App& app, const std::string& path) {
  ConfigFile file;
  if (!path.empty()) {
    auto loaded = ConfigFile::load(path);
    if (!loaded) {
      return bad_input(loaded.error().message);
    }
    file = std::move(*loaded);
  }
  std::map<std::string, Users> users;
  find_users(page_of(app), users);
  std::string section;
  for (const ConfigKey& key : config_keys()) {
    if (section != key.section) {
      std::printf("%s[%s]\n", section.empty() ? "" : "\n", key.section);
      section = key.section;
    }
    const Users& used = users[key.option];
    std::printf("# %s (%s of %s)\n", key.text, key.option, used.commands.c_str());
    const auto& values = file.values();
    const auto value = std::find_if(values.begin(), values.end(),
                                    [&](const ConfigFile::Value& v) { return v.key == &key; });
    if (value != values.end()) {
      std::printf("%s = %s\n", key.key, value_text(value->text).c_str());
    } else {
      std::printf("#%s = %s\n", key.key, value_text(used.default_value).c_str());
    }
  }
  return kDone;
}

}  // namespace

void add_config_command(CLI::App& app, Action& action) {
  auto* config = app.add_subcommand("config", "Settings in a file");
  config->require_subcommand(1);
  auto path = std::make_shared<std::string>();
  auto* shown = config->add_subcommand(
      "show", "Prints every setting: what a file says, and the defaults as comments");
  shown->add_option("--config", *path, "settings (TOML)")->type_name("FILE");
  shown->footer(
      "What it prints is a file itself: orthonav config show > theatre.toml, then run --config\n"
      "theatre.toml. Files named in it are looked for from where it lies. A flag wins over it.");
  shown->callback([path, &app, &action] { action = [path, &app] { return show(app, *path); }; });
}

}  // namespace orthonav::tools
