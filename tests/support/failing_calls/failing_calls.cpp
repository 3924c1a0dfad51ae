#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>

#include "tests/support/failing_calls/chosen_call.h"

namespace orthonav::test::failing_calls {
namespace {

bool writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT) != 0; }

/// `open` has its third argument only if it creates a file.
mode_t mode_in(int flags, va_list& more) {
  const bool makes = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  return makes ? va_arg(more, mode_t) : 0;
}

}  // namespace
}  // namespace orthonav::test::failing_calls

using orthonav::test::failing_calls::fails;
using orthonav::test::failing_calls::is_for_writing;
using orthonav::test::failing_calls::Kind;
using orthonav::test::failing_calls::mode_in;
using orthonav::test::failing_calls::next;
using orthonav::test::failing_calls::writes;

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_in(flags, more);
  va_end(more);
  static const auto real = next<int(const char*, int, ...)>("open");
  return writes(flags) && fails(Kind::kOpen, path) ? -1 : real(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_in(flags, more);
  va_end(more);
  static const auto real = next<int(const char*, int, ...)>("open64");
  return writes(flags) && fails(Kind::kOpen, path) ? -1 : real(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_in(flags, more);
  va_end(more);
  static const auto real = next<int(int, const char*, int, ...)>("openat");
  return writes(flags) && fails(Kind::kOpen, path) ? -1 : real(folder, path, flags, mode);
}

ssize_t write(int file, const void* bytes, size_t count) {
  static const auto real = next<ssize_t(int, const void*, size_t)>("write");
  return fails(Kind::kWrite, file) ? -1 : real(file, bytes, count);
}

ssize_t writev(int file, const iovec* parts, int count) {
  static const auto real = next<ssize_t(int, const iovec*, int)>("writev");
  return fails(Kind::kWrite, file) ? -1 : real(file, parts, count);
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  static const auto real = next<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return fails(Kind::kWrite, file) ? -1 : real(file, bytes, count, at);
}

int fsync(int file) {
  static const auto real = next<int(int)>("fsync");
  return fails(Kind::kSync, file) ? -1 : real(file);
}

int fdatasync(int file) {
  static const auto real = next<int(int)>("fdatasync");
  return fails(Kind::kSync, file) ? -1 : real(file);
}

int rename(const char* from, const char* to) {
  static const auto real = next<int(const char*, const char*)>("rename");
  return fails(Kind::kRename, to) ? -1 : real(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  static const auto real = next<int(int, const char*, int, const char*, unsigned)>("renameat2");
  return fails(Kind::kRename, to) ? -1 : real(from_folder, from, to_folder, to, flags);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  static const auto real = next<int(int, const char*, int, const char*, int)>("linkat");
  return fails(Kind::kRename, to) ? -1 : real(from_folder, from, to_folder, to, flags);
}

int mkdir(const char* path, mode_t mode) {
  static const auto real = next<int(const char*, mode_t)>("mkdir");
  return fails(Kind::kMkdir, path) ? -1 : real(path, mode);
}

int ftruncate(int file, off_t length) {
  static const auto real = next<int(int, off_t)>("ftruncate");
  return fails(Kind::kTruncate, file) ? -1 : real(file, length);
}

int ftruncate64(int file, off64_t length) {
  static const auto real = next<int(int, off64_t)>("ftruncate64");
  return fails(Kind::kTruncate, file) ? -1 : real(file, length);
}

/// Fails like a network file system that reports a failed write late.
int close(int file) {
  static const auto real = next<int(int)>("close");
  if (is_for_writing(file) && fails(Kind::kClose, file)) {
    const int why = errno;
    real(file);
    errno = why;
    return -1;
  }
  return real(file);
}

}  // extern "C"
