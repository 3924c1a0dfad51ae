#pragma once

#include <exception>
#include <new>
#include <string>
#include <type_traits>

#include "base/result.h"

namespace orthonav {

/// For a catch block: an Error that says which exception ended `who`.
[[nodiscard]] inline Error ended_by_exception(const std::string& who) {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return Error{who + ": out of memory"};
  } catch (const std::exception& error) {
    return Error{who + ": ended by an exception: " + error.what()};
  } catch (...) {
    return Error{who + ": ended by an unknown exception"};
  }
}

/// Calls `work`, which answers a Status or nothing; an exception becomes an Error. For the body of
/// a thread: an exception that leaves a thread ends the whole program.
template <class Work>
Status guarded(const char* who, Work&& work) {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Work>>) {
      work();
      return {};
    } else {
      return work();
    }
  } catch (...) {
    return ended_by_exception(who);
  }
}

}  // namespace orthonav
