#include <cstdio>
#include <filesystem>
#include <memory>

#include "engine/io/atomic_file.h"
#include "engine/report/session_report.h"
#include "engine/session/journal_reader.h"
#include "tools/arguments.h"
#include "tools/command.h"
#include "tools/json_output.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string session;
  std::string out;
  JsonOutput json;
};

/// The journal itself, or the one in a folder of results.
Result<std::string> journal_at(const std::string& session) {
  std::error_code ignored;
  if (!fs::is_directory(session, ignored)) {
    return session;
  }
  const std::string whole = (fs::path(session) / "session.orthonav").string();
  const std::string part = whole + ".part";
  const bool has_whole = fs::exists(whole, ignored);
  const bool has_part = fs::exists(part, ignored);
  if (has_whole && has_part) {
    return Error{session + ": holds session.orthonav and session.orthonav.part, name one of them"};
  }
  if (!has_whole && !has_part) {
    return Error{session + ": holds no session.orthonav and no session.orthonav.part"};
  }
  return has_whole ? whole : part;
}

int report(const ReportArguments& arguments) {
  if (const Status place = arguments.json.check(); !place) {
    return bad_input(place.error().message);
  }
  if (const Status place = engine::check_place(arguments.out); !place) {
    return bad_input(place.error().message);
  }
  const auto path = journal_at(arguments.session);
  if (!path) {
    return bad_input(path.error().message);
  }
  const auto session = engine::read_journal(*path);
  if (!session) {
    return bad_input(session.error().message);
  }
  if (session->cut) {
    std::fprintf(stderr, "orthonav: warning: %s: %s\n", path->c_str(),
                 engine::ending_of(*session).c_str());
  }
  const std::string page = engine::session_page(*session, *path);
  if (const Status written = engine::write_file(arguments.out, page); !written) {
    return bad_input(written.error().message);
  }
  const Status written = arguments.json.write_text(engine::session_json(*session));
  return written ? kDone : bad_input(written.error().message);
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ReportArguments>();
  auto* command = app.add_subcommand(
      "report", "The report of a session from its journal, also of one that was cut off");
  command
      ->add_option("SESSION", arguments->session,
                   "session.orthonav, session.orthonav.part, or the folder that holds it")
      ->required()
      ->check(some_text());
  command->add_option("-o,--out", arguments->out, "Where the HTML page goes")
      ->required()
      ->check(some_text());
  arguments->json.add_to(*command);
  command->callback([arguments, &action] { action = [arguments] { return report(*arguments); }; });
}

}  // namespace orthonav::tools
