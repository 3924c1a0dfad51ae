#include "tools/orthonav/study/study_compare.h"

#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"
#include "engine/io/json_document.h"
#include "study/comparison_page.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/json_output.h"

namespace orthonav::tools {
namespace {

struct CompareArguments {
  std::array<std::string, 2> files;
  JsonOutput json;
  std::string report;  ///< HTML page; empty: none
};

int compare(const CompareArguments& arguments) {
  if (const Status place = arguments.json.check(); !place) {
    return bad_input(place.error().message);
  }
  std::array<std::string, 2> texts;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    auto text = engine::read_text(arguments.files[i]);
    if (!text) {
      return bad_input(text.error().message);
    }
    texts[i] = std::move(*text);
  }
  const auto comparison = engine::compare_studies(texts, arguments.files);
  if (!comparison) {
    return bad_input(comparison.error().message);
  }
  if (!arguments.json.on_stdout()) {
    std::fputs(engine::comparison_table(*comparison).c_str(), stdout);
  }
  if (const Status written = arguments.json.write(engine::comparison_json(*comparison)); !written) {
    return bad_input(written.error().message);
  }
  const Status drawn =
      arguments.report.empty()
          ? Status()
          : engine::write_file(arguments.report, engine::comparison_html(*comparison));
  return drawn ? kDone : bad_input(drawn.error().message);
}

}  // namespace

void add_compare_command(CLI::App& study, Action& action) {
  auto arguments = std::make_shared<CompareArguments>();
  auto* command = study.add_subcommand(
      "compare", "Paired differences of two studies over the same cases and seeds, A less B");
  command->add_option("A", arguments->files[0], "JSON of a study")->required()->check(some_text());
  command->add_option("B", arguments->files[1], "JSON of another")->required()->check(some_text());
  arguments->json.add_to(*command);
  command->add_option("--report", arguments->report, "HTML page to write")->check(some_text());
  command->callback([arguments, &action] { action = [arguments] { return compare(*arguments); }; });
}

}  // namespace orthonav::tools
