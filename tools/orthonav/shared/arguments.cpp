#include "tools/orthonav/shared/arguments.h"

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string>

#include "base/printed.h"
#include "engine/io/text_fields.h"

namespace orthonav::tools {
namespace {

template <class Whole>
CLI::Validator whole(Whole low, Whole high) {
  const auto check = [low, high](const std::string& text) -> std::string {
    Whole value = 0;
    const char* end = text.data() + text.size();
    const auto [rest, code] = std::from_chars(text.data(), end, value);
    if (!text.empty() && code == std::errc() && rest == end && value >= low && value <= high) {
      return {};
    }
    return "\"" + text + "\" must be a whole number from " + std::to_string(low) + " to " +
           std::to_string(high);
  };
  return {check, "", "whole number"};
}

std::string shortest(double value) { return printed("%g", value); }

}  // namespace

CLI::Validator whole_number(std::int64_t low, std::int64_t high) { return whole(low, high); }

CLI::Validator seed_number() {
  return whole<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max());
}

CLI::Validator finite_number(double low, double high) {
  const auto check = [low, high](const std::string& text) -> std::string {
    const auto value = engine::number_from(text);
    if (value && *value >= low && *value <= high) {
      return {};
    }
    return "\"" + text + "\" must be a number from " + shortest(low) + " to " + shortest(high);
  };
  return {check, "", "number"};
}

CLI::Validator some_text() {
  const auto check = [](const std::string& text) -> std::string {
    return text.empty() ? "must not be empty" : "";
  };
  return {check, "", "text"};
}

CLI::Validator folder_of_case() {
  const auto folder_of = [](std::string& path) -> std::string {
    const std::filesystem::path given(path);
    if (given.filename() == "case.json") {
      path = given.has_parent_path() ? given.parent_path().string() : ".";
    }
    return {};
  };
  return {folder_of, "", "folder"};
}

CLI::Option* add_case_option(CLI::App& command, std::string& folder) {
  return command
      .add_option("-c,--case", folder, "folder with a case.json (default: the built-in phantom)")
      ->check(some_text())
      ->transform(folder_of_case())
      ->type_name("DIR");
}

CLI::Option* add_method_option(CLI::App& command, std::string& method, const std::string& what) {
  return command.add_option("-m,--method", method, what)
      ->type_name("best|paper")
      ->capture_default_str();
}

CLI::Option* add_levels_option(CLI::App& command, std::vector<std::string>& levels,
                               const std::string& what) {
  return command.add_option("-l,--levels", levels, what)->delimiter(',')->type_name("L4,L5");
}

void add_rods_only_flag(CLI::App& command, bool& rods_only, CLI::Option& levels) {
  command
      .add_flag("--rods-only", rods_only,
                "the screws are in: bend rods alone, by touching their heads; no registration "
                "(docs/rods.md)")
      ->excludes(&levels);
}

void RodsOnlyArguments::add_to(CLI::App& command, CLI::Option& levels) {
  add_rods_only_flag(command, rods_only, levels);
  command
      .add_option("--seat-mm", seat_mm,
                  "from where a head is touched to the rod's middle, negative away from the bone, "
                  "where the list of screws does not say")
      ->check(finite_number(-15, 30))
      ->capture_default_str();
}

CLI::Option* add_tools_option(CLI::App& command, std::string& file) {
  return command
      .add_option("-t,--tools", file,
                  "tool definitions (default: the headset's own, else the built-in)")
      ->check(some_text())
      ->type_name("FILE");
}

void add_reference_flag(CLI::App& command, bool& reference) {
  command.add_flag("--reference", reference,
                   "positions are relative to the patient reference instead of the headset's map");
}

std::optional<std::array<int, 2>> size_from(const std::string& text) {
  std::array<int, 2> size{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", size.data(), size.data() + 1, &rest) != 2) {
    return std::nullopt;
  }
  return size;
}

CLI::Validator picture_size() {
  const auto check = [](const std::string& text) -> std::string {
    const auto size = size_from(text);
    if (!size) {
      return "\"" + text + "\" is not WIDTHxHEIGHT, as 960x540";
    }
    const auto [width, height] = *size;
    if (width < 160 || width > 3840 || height < 120 || height > 2160) {
      return text + " must lie from 160x120 to 3840x2160";
    }
    if (width % 2 != 0 || height % 2 != 0) {
      return text + " must be even";
    }
    return {};
  };
  return CLI::Validator(check, "WIDTHxHEIGHT");
}

}  // namespace orthonav::tools
