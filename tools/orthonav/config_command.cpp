#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "tools/orthonav/command.h"
#include "tools/orthonav/command_page.h"
#include "tools/orthonav/config/config_file.h"

namespace orthonav::tools {
namespace {

/// An option of the commands that take settings from a file.
struct Setting {
  std::string commands;
  std::string text;
  std::string default_value;
};

void find_settings(const CommandPage& page, std::map<std::string, Setting>& settings) {
  constexpr const char* kConfig = "--config";
  const auto takes_file = [](const OptionRow& option) { return option.name() == kConfig; };
  if (std::any_of(page.options.begin(), page.options.end(), takes_file)) {
    const std::string command = page.way.substr(page.way.find(' ') + 1);
    for (const OptionRow& option : page.options) {
      Setting& found = settings[option.name()];
      found.commands += (found.commands.empty() ? "" : ", ") + command;
      found.text = option.text;
      found.default_value = option.is_flag() ? "false" : option.default_value;
    }
  }
  for (const CommandPage& command : page.commands) {
    find_settings(command, settings);
  }
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
  return out + "\"";
}

/// Numbers, true and false are written without quotes.
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
  std::map<std::string, Setting> settings;
  find_settings(page_of(app), settings);
  std::string section;
  for (const ConfigKey& key : config_keys()) {
    if (section != key.section) {
      std::printf("%s[%s]\n", section.empty() ? "" : "\n", key.section);
      section = key.section;
    }
    const Setting& setting = settings[key.option];
    std::printf("# %s (%s of %s)\n", setting.text.c_str(), key.option, setting.commands.c_str());
    const auto& values = file.values();
    const auto value = std::find_if(values.begin(), values.end(),
                                    [&](const ConfigFile::Value& v) { return v.key == &key; });
    if (value != values.end()) {
      std::printf("%s = %s\n", key.key, value_text(value->text).c_str());
    } else {
      std::printf("#%s = %s\n", key.key, value_text(setting.default_value).c_str());
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
      "What it prints can be used as it is: orthonav config show > theatre.toml, edit it, then\n"
      "orthonav run --config theatre.toml. Relative file names start from the folder of the TOML\n"
      "file. A flag wins over it.");
  shown->callback([path, &app, &action] { action = [path, &app] { return show(app, *path); }; });
}

}  // namespace orthonav::tools
