#include "tests/tools/command_line.h"
#include "tests/support/test_data.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace orthonav::test {
namespace {

void redirect(const std::string& path, int descriptor) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, descriptor) < 0) {
    _exit(126);
  }
}

}  // namespace

StartedCommand::StartedCommand(const std::vector<std::string>& arguments,
                               const std::function<void()>& prepare) {
  const std::string out = folder_.file("out");
  const std::string err = folder_.file("err");
  std::vector<std::string> words = {ORTHONAV_COMMAND};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  child_ = fork();
  if (child_ == 0) {
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    if (prepare) {
      prepare();
    }
    execv(ORTHONAV_COMMAND, pointers.data());
    _exit(127);
  }
}

StartedCommand::~StartedCommand() {
  if (child_ > 0) {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
}

void StartedCommand::send(int signal) const {
  if (child_ > 0) {
    kill(child_, signal);
  }
}

bool StartedCommand::takes_signals() const {
  std::ifstream status("/proc/" + std::to_string(child_) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("SigBlk:")) {
      const std::uint64_t blocked = std::strtoull(line.c_str() + 7, nullptr, 16);
      return (blocked >> (SIGTERM - 1) & 1U) != 0;
    }
  }
  return false;
}

std::string StartedCommand::err_so_far() const { return content_of(folder_.file("err")); }

Called StartedCommand::wait() {
  int status = 0;
  Called called;
  if (child_ > 0 && waitpid(child_, &status, 0) == child_ && WIFEXITED(status)) {
    called.code = WEXITSTATUS(status);
  }
  child_ = -1;
  called.out = content_of(folder_.file("out"));
  called.err = content_of(folder_.file("err"));
  return called;
}

Called orthonav(const std::vector<std::string>& arguments) {
  return StartedCommand(arguments).wait();
}

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "orthonav-test-XXXXXX").string();
  if (!mkdtemp(name.data())) {
    std::abort();
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string ScratchFolder::with(const std::string& name, const std::string& content) const {
  std::ofstream(file(name), std::ios::binary) << content;
  return file(name);
}

std::vector<std::string> ScratchFolder::names() const {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    found.push_back(entry.path().filename().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string shared(const std::string& name) {
  const std::string path = test_data(name).string();
  return std::filesystem::exists(path) ? path : std::string();
}

}  // namespace orthonav::test
