#include <memory>
#include <string>

#include "engine/io/atomic_file.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/command_page.h"
#include "tools/orthonav/manual/manual_page.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/out_folder.h"

namespace orthonav::tools {
namespace {

int write_manual(const CLI::App& app, const std::string& out) {
  const auto folder = OutFolder::create("--out", out);
  if (!folder) {
    return bad_input(folder.error().message);
  }
  for (const ManualPage& page : manual_pages(page_of(app), "orthonav " ORTHONAV_VERSION)) {
    if (const Status written = engine::write_file(folder->file(page.file_name), page.roff);
        !written) {
      return bad_input(written.error().message);
    }
  }
  return kDone;
}

}  // namespace

void add_manual_command(CLI::App& app, Action& action) {
  auto out = std::make_shared<std::string>();
  auto* manual = app.add_subcommand("manual", "Writes the manual pages of every command");
  manual->add_option("-o,--out", *out, "folder for orthonav.1 and the others")
      ->required()
      ->check(some_text())
      ->type_name("DIR");
  manual->footer("To read one: man ./orthonav-run.1. Packages install them.");
  manual->callback(
      [out, &app, &action] { action = [out, &app] { return write_manual(app, *out); }; });
}

}  // namespace orthonav::tools
