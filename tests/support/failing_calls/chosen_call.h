#pragma once

#include <dlfcn.h>

// Calls of libc that change a disk, taken over to count them and to let one of them fail. It is
// controlled by environment variables:
//   FAILING_CALLS_FOLDER  calls on files below it count, no others
//   FAILING_CALLS_LIST    a file outside of it: gets a line "KIND PATH" for each that counts
//   FAILING_CALLS_KIND    open, write, sync, rename, mkdir, truncate or close; empty: any
//   FAILING_CALLS_NAME    of the file, or a part of it; empty: any
//   FAILING_CALLS_AT      the call that fails, from 1, among those of that kind and name; 0: none
//   FAILING_CALLS_WITH    the number of the error
//   FAILING_CALLS_LASTING 1: all calls behind that one fail too, of any kind and name, as on a disk
//                         that stays full; what frees room or changes nothing does not
namespace orthonav::test::failing_calls {

enum class Kind { kOpen, kWrite, kSync, kRename, kMkdir, kTruncate, kClose };

/// Counts this call; whether it is to fail, with errno set.
bool fails(Kind kind, const char* path);
/// The same for an open file.
bool fails(Kind kind, int file);
/// Whether the file can be written to.
bool is_for_writing(int file);

/// libc's own.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace orthonav::test::failing_calls
