#include <cerrno>
#include <cstdio>
#include <cstring>

#include "tests/support/failing_calls/chosen_call.h"

using orthonav::test::failing_calls::fails;
using orthonav::test::failing_calls::is_for_writing;
using orthonav::test::failing_calls::Kind;
using orthonav::test::failing_calls::next;

// libc's streams write and close within libc, where calls can't be intercepted.
extern "C" {

FILE* fopen(const char* path, const char* mode) {
  static const auto real = next<FILE*(const char*, const char*)>("fopen");
  const bool writes = std::strpbrk(mode, "wa+") != nullptr;
  return writes && fails(Kind::kOpen, path) ? nullptr : real(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  static const auto real = next<FILE*(const char*, const char*)>("fopen64");
  const bool writes = std::strpbrk(mode, "wa+") != nullptr;
  return writes && fails(Kind::kOpen, path) ? nullptr : real(path, mode);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  static const auto real = next<size_t(const void*, size_t, size_t, FILE*)>("fwrite");
  return fails(Kind::kWrite, fileno(file)) ? 0 : real(bytes, size, count, file);
}

int fclose(FILE* file) {
  static const auto real = next<int(FILE*)>("fclose");
  if (is_for_writing(fileno(file)) && fails(Kind::kClose, fileno(file))) {
    const int why = errno;
    real(file);
    errno = why;
    return EOF;
  }
  return real(file);
}

}  // extern "C"
