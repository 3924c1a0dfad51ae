#include "engine/method.h"

namespace orthonav::engine {

Result<Method> method_named(const std::string& name) {
  // Registration has one method so far.
  const Registrar registrar = [](const nav::VertebraModel& model,
                                 std::span<const Point<World>> points_in_world) {
    return nav::register_paper(model, points_in_world);
  };
  if (name == "best") return Method{name, &nav::create_best_tracker, registrar};
  if (name == "paper") return Method{name, &nav::create_paper_tracker, registrar};
  return Error{"--method " + name + ": unknown (available: best, paper)"};
}

}  // namespace orthonav::engine
