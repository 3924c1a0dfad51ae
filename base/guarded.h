#pragma once

#include <exception>
#include <new>
#include <string>

#include "base/result.h"

namespace orthonav {

/// In a catch block: an Error that names who died of what.
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

/// What `work` answers; where an exception leaves it, an Error, for those who end things in order.
/// Around the work of a thread, which would take the whole program with it.
template <class Work>
Status guarded(const char* who, Work&& work) {
  try {
    return work();
  } catch (...) {
    return ended_by_exception(who);
  }
}

}  // namespace orthonav
