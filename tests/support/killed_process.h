#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <functional>
#include <tuple>

namespace orthonav::test {

/// Another process does `work` and is killed by SIGKILL once it has called the given function this
/// many times. False if it ended before that.
inline bool kill_after(int times, const std::function<void(const std::function<void()>&)>& work) {
  std::array<int, 2> pipe{};
  EXPECT_EQ(::pipe(pipe.data()), 0);
  const pid_t child = ::fork();
  EXPECT_GE(child, 0);
  if (child == 0) {
    work([&pipe] { std::ignore = ::write(pipe[1], "x", 1); });
    ::_exit(1);
  }
  ::close(pipe[1]);
  char byte = 0;
  int told = 0;
  while (told < times && ::read(pipe[0], &byte, 1) == 1) {
    ++told;
  }
  ::close(pipe[0]);
  if (child < 0) {
    return false;  // a signal to -1 would go to every process
  }
  ::kill(child, SIGKILL);
  int how = 0;
  ::waitpid(child, &how, 0);
  return told == times && WIFSIGNALED(how);
}

}  // namespace orthonav::test
