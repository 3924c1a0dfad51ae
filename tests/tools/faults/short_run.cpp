#include "tests/tools/faults/short_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/io/posix_env.h"
#include "engine/session/log/operation_log.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/tag_scene.h"
#include "tests/support/test_data.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A command that takes longer hangs.
constexpr unsigned kLongestRunS = 60;

/// Lines that end with their newline.
std::vector<std::string> whole_lines(const std::string& path) {
  std::istringstream in(content_of(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line) && !in.eof();) {
    lines.push_back(line);
  }
  return lines;
}

/// Negative if there is no readable recording.
std::int64_t pairs_in(const std::string& recording) {
  const auto replayed = replay::ReplayHeadset::open(recording);
  return replayed ? (*replayed)->summary().pairs : -1;
}

void expect_readable_recording(const std::string& recording) {
  if (recording.empty()) {
    return;
  }
  const auto lines = static_cast<std::int64_t>(whole_lines(recording + "/frames.csv").size());
  if (lines > 1) {
    EXPECT_EQ(pairs_in(recording), lines - 1) << "pairs behind the header";
  }
}

}  // namespace

void write_one_level_case(const fs::path& folder, const std::string& bone) {
  const fs::path bones = test_data("anatomy/visible-human");
  fs::create_directories(folder);
  fs::copy_file(bones / (bone + ".stl"), folder / "L5.stl");
  json plan = json::parse(content_of(bones / (bone + ".plan.json")));
  plan["level"] = "L5";
  std::ofstream(folder / "L5.plan.json") << plan;
  std::ofstream(folder / "case.json") << R"({"name": "one level", "units": "mm",
             "levels": [{"label": "L5", "model": "L5.stl", "plan": "L5.plan.json"}]})";
}

ShortRun::ShortRun() {
  write_one_level_case(folder_.file("case"));
  record(folder_.file("recorded"), test_calibration(),
         std::vector<std::vector<PlacedTag>>(std::size_t{kPairs}));
}

Called ShortRun::run(const std::function<void()>& prepare) {
  fs::remove_all(written_);
  const std::vector<std::string> arguments = {"run",
                                              "--case",
                                              folder_.file("case"),
                                              "--headset",
                                              "replay:" + folder_.file("recorded"),
                                              "--frames",
                                              std::to_string(kPairs),
                                              "--out",
                                              out(),
                                              "--record",
                                              written_ + "/recording",
                                              "--log",
                                              log()};
  StartedCommand command(arguments, [&prepare] {
    alarm(kLongestRunS);
    prepare();
  });
  return command.wait();
}

std::string ShortRun::recording() const {
  for (const char* name : {"/recording", "/recording.part"}) {
    if (fs::exists(written_ + name)) {
      return written_ + name;
    }
  }
  return {};
}

bool all_is_kept(const ShortRun& run) {
  engine::PosixEnv env;
  const auto found = engine::OperationLog::find(env, run.out());
  return fs::exists(run.out() + "/report.json") && fs::exists(run.out() + "/report.html") &&
         found && found->operation.ended && fs::exists(run.written() + "/recording") &&
         pairs_in(run.recording()) == ShortRun::kPairs;
}

void expect_readable(const ShortRun& run) {
  const std::string report = run.out() + "/report.json";
  EXPECT_TRUE(!fs::exists(report) || json::accept(content_of(report)));
  const std::string page = run.out() + "/report.html";
  EXPECT_TRUE(!fs::exists(page) || content_of(page).find("</html>") != std::string::npos);
  engine::PosixEnv env;
  if (fs::exists(run.out() + "/operation.resume") &&
      fs::file_size(run.out() + "/operation.resume") > 0) {
    const auto found = engine::OperationLog::find(env, run.out());
    EXPECT_TRUE(found.ok()) << found.error().message;
  }
  expect_readable_recording(run.recording());
}

}  // namespace orthonav::test
