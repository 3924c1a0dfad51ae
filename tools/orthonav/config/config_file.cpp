#include "tools/orthonav/config/config_file.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>

#include <toml++/toml.h>

#include "base/one_line.h"
#include "engine/io/json_document.h"
#include "tools/orthonav/config/did_you_mean.h"

namespace orthonav::tools {
namespace {

std::string at(const std::string& path, const toml::source_region& where) {
  return path + ":" + std::to_string(where.begin.line) + ": ";
}

Error unknown(const std::string& place, const std::string& what, const std::string& name,
              const std::vector<std::string>& known) {
  const std::string meant = closest(name, known);
  return Error{place + "unknown " + what + " \"" + one_line(name) + "\"" +
               (meant.empty() ? "" : "; did you mean " + meant + "?") +
               " (see orthonav config show)"};
}

std::vector<std::string> known_sections() {
  std::vector<std::string> names;
  for (const ConfigKey& key : config_keys()) {
    if (names.empty() || names.back() != key.section) {
      names.emplace_back(key.section);
    }
  }
  return names;
}

std::vector<std::string> known_keys(const std::string& section) {
  std::vector<std::string> names;
  for (const ConfigKey& key : config_keys()) {
    if (section == key.section) {
      names.emplace_back(key.key);
    }
  }
  return names;
}

const ConfigKey* key_named(const std::string& section, const std::string& name) {
  const auto& keys = config_keys();
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const ConfigKey& key) {
    return section == key.section && name == key.key;
  });
  return found == keys.end() ? nullptr : &*found;
}

std::string number_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return {text, end.ptr};
}

/// The value as it would be typed; empty if it is of another type.
std::string text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) {
    return text->get();
  }
  if (const auto* flag = node.as_boolean()) {
    return flag->get() ? "true" : "false";
  }
  if (const auto* whole = node.as_integer()) {
    return std::to_string(whole->get());
  }
  if (const auto* number = node.as_floating_point()) {
    return number_text(number->get());
  }
  return {};
}

Result<ConfigFile::Value> value_of(const std::string& path, const std::string& section,
                                   const std::string& name, const toml::node& node) {
  const std::string place = at(path, node.source());
  const ConfigKey* key = key_named(section, name);
  if (key == nullptr) {
    return unknown(place, "key of [" + section + "]", name, known_keys(section));
  }
  std::string text = text_of(node);
  if (text.empty()) {
    return Error{
        place + section + "." + name +
        (node.is_string() ? " must not be empty" : " must be a text, a number, true or false")};
  }
  const bool word = key->or_word && text.find_first_of("./") == text.npos;
  if (key->is_file && !word) {
    text = (std::filesystem::path(path).parent_path() / text).string();
  }
  return ConfigFile::Value{key, std::move(text), static_cast<int>(node.source().begin.line)};
}

}  // namespace

const std::vector<ConfigKey>& config_keys() {
  static const std::vector<ConfigKey> keys = {
      {"tools", "file", "--tools", true},
      {"tools", "screws", "--screws", true},
      {"tools", "reference", "--reference"},
      {"rig", "headset", "--headset"},
      {"rig", "calibration", "--calibration", true},
      {"clicker", "device", "--clicker"},
      {"voice", "device", "--voice"},
      {"limits", "good_deg", "--good-deg"},
      {"limits", "poor_deg", "--poor-deg"},
      {"limits", "wire_deg", "--wire-deg"},
      {"limits", "wire_mm", "--wire-mm"},
      {"limits", "tip_sd_mm", "--tip-sd-mm"},
      {"limits", "cameras_sd_mm", "--cameras-sd-mm"},
      {"limits", "map_sd_mm", "--map-sd-mm"},
      {"display", "device", "--device"},
      {"display", "size", "--size"},
      {"display", "language", "--language", true, true},
      {"display", "colours", "--colours"},
      {"log", "file", "--log", true},
      {"log", "verbose", "--verbose"},
  };
  return keys;
}

Result<ConfigFile> ConfigFile::load(const std::string& path) {
  constexpr std::size_t kMostBytes = 1u << 20u;
  const auto text = engine::read_text(path, kMostBytes);
  if (!text) {
    return text.error();
  }
  toml::table sections;
  try {
    sections = toml::parse(std::string_view(*text), path);
  } catch (const toml::parse_error& error) {
    return Error{at(path, error.source()) + one_line(std::string(error.description()))};
  }
  ConfigFile file;
  file.path_ = path;
  const std::vector<std::string> known = known_sections();
  for (const auto& [section, content] : sections) {
    const std::string name(section.str());
    const toml::table* keys = content.as_table();
    if (keys == nullptr || std::find(known.begin(), known.end(), name) == known.end()) {
      return unknown(at(path, content.source()), "section", name, known);
    }
    for (const auto& [key, node] : *keys) {
      auto value = value_of(path, name, std::string(key.str()), node);
      if (!value) {
        return value.error();
      }
      file.values_.push_back(std::move(*value));
    }
  }
  return file;
}

Status ConfigFile::apply_to(CLI::App& command) const {
  for (const Value& value : values_) {
    CLI::Option* option = command.get_option_no_throw(value.key->option);
    if (option == nullptr || option->count() > 0) {
      continue;
    }
    try {
      option->add_result(value.text);
      option->run_callback();
    } catch (const CLI::ParseError& error) {
      return Error{path_ + ":" + std::to_string(value.line) + ": " + value.key->section + "." +
                   value.key->key + " (" + one_line(error.what()) + ")"};
    }
  }
  return {};
}

void add_config_option(CLI::App& command) {
  auto path = std::make_shared<std::string>();
  command.add_option("--config", *path, "settings (TOML); a flag wins over the file")
      ->type_name("FILE");
  command.parse_complete_callback([path, &command] {
    if (command.get_option("--config")->count() == 0) {
      return;
    }
    const auto file = ConfigFile::load(*path);
    const Status applied = file ? file->apply_to(command) : Status(file.error());
    if (!applied) {
      throw CLI::ValidationError("--config", applied.error().message);
    }
  });
}

}  // namespace orthonav::tools
