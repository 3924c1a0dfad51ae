#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace orthonav::tools {

/// The paper, and where the PDF goes.
struct PageArguments {
  std::string page = "A4";
  bool landscape = false;
  std::string out;

  void add_to(CLI::App& command) {
    command.add_option("--page", page, "Paper")->type_name("A4|Letter|A3")->capture_default_str();
    command.add_flag("--landscape", landscape, "The paper on its side");
    command.add_option("-o,--out", out, "The PDF file")->required()->type_name("FILE");
  }
};

}  // namespace orthonav::tools
