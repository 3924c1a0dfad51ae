// The least program that guides on a headset: it stands for what such programs have to link.
#include <cstdio>
#include <utility>

#include "engine/live/frame_loop.h"
#include "engine/live/presenter.h"
#include "engine/session/method.h"
#include "hal/openxr/openxr_headset.h"

using namespace orthonav;
using namespace orthonav::engine;

int main() {
  const auto method = method_named("best");
  if (!method) {
    std::fprintf(stderr, "%s\n", method.error().message.c_str());
    return 2;
  }
  // No level is planned: the session says so.
  auto tracker = method->create_tracker({}, {}, {});
  const auto session = tracker ? Session::create({}, std::move(*tracker), *method)
                               : Result<std::unique_ptr<Session>>(tracker.error());
  std::fprintf(stderr, "%s\n", session ? "a session of nothing" : session.error().message.c_str());
  return session ? 1 : 0;
}
