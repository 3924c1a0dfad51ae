#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"
#include "engine/io/posix_env.h"
#include "engine/report/session_report.h"
#include "engine/session/log/operation_log.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/json_output.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string session;
  std::string out;
  std::string records;
  JsonOutput json;
};

/// The log itself, or the one in a folder of results.
Result<std::string> log_at(engine::Env& env, const std::string& session) {
  constexpr const char* kJournal = "session.orthonav";
  std::error_code ignored;
  const bool folder = fs::is_directory(session, ignored);
  auto path = folder ? engine::OperationLog::path_in(env, session) : Result<std::string>(session);
  const bool journal = folder ? !path && fs::exists(fs::path(session) / kJournal, ignored)
                              : fs::path(session).filename().string().starts_with(kJournal);
  if (journal) {
    return Error{session + ": holds a journal (" + kJournal +
                 ") of an earlier version of orthonav, which alone reads it"};
  }
  return path;
}

/// Each record of a log that was read as a line of JSON.
Result<std::string> record_lines(engine::Env& env, const std::string& path) {
  using Json = nlohmann::ordered_json;
  const auto read = engine::read_log(env, path);
  if (!read) {
    return read.error();
  }
  std::string lines;
  for (const engine::Record& record : read->records) {
    Json line{{"record", record.number},
              {"what", name_of(static_cast<engine::OperationRecord>(record.type))}};
    line.update(Json::parse(record.payload));
    lines += line.dump() + "\n";
  }
  return lines;
}

int report(const ReportArguments& arguments) {
  if (const Status place = arguments.json.check(); !place) {
    return bad_input(place.error().message);
  }
  for (const std::string& file : {arguments.out, arguments.records}) {
    if (const Status place = file.empty() ? Status{} : engine::check_place(file); !place) {
      return bad_input(place.error().message);
    }
  }
  engine::PosixEnv env;
  const auto path = log_at(env, arguments.session);
  if (!path) {
    return bad_input(path.error().message);
  }
  const auto session = engine::LoggedOperation::read(env, *path);
  if (!session) {
    return bad_input(session.error().message);
  }
  if (!session->ended) {
    std::fprintf(stderr, "orthonav: warning: %s: %s\n", path->c_str(),
                 engine::ending_of(*session).c_str());
  }
  const std::string page = engine::session_page(*session, *path);
  if (const Status written = engine::write_file(arguments.out, page); !written) {
    return bad_input(written.error().message);
  }
  if (!arguments.records.empty()) {
    const auto lines = record_lines(env, *path);
    const Status written =
        lines ? engine::write_file(arguments.records, *lines) : Status(lines.error());
    if (!written) {
      return bad_input(written.error().message);
    }
  }
  const Status written = arguments.json.write_text(engine::session_json(*session));
  return written ? kDone : bad_input(written.error().message);
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ReportArguments>();
  auto* command = app.add_subcommand(
      "report", "The report of an operation from its log, also of one that was cut off");
  command
      ->add_option("SESSION", arguments->session, "operation.resume, or the folder that holds it")
      ->required()
      ->check(some_text());
  command->add_option("-o,--out", arguments->out, "Where the HTML page goes")
      ->required()
      ->check(some_text());
  command
      ->add_option("--records", arguments->records,
                   "Where every record of the log goes, a line of JSON each")
      ->check(some_text());
  arguments->json.add_to(*command);
  command->callback([arguments, &action] { action = [arguments] { return report(*arguments); }; });
}

}  // namespace orthonav::tools
