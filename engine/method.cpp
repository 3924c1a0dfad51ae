#include "engine/method.h"

namespace orthonav::engine {

Result<Registrar> registrar_named(const std::string& name) {
  if (name == "best")
    return Error{"--method best: not available in this version (available: paper)"};
  if (name != "paper") return Error{"--method " + name + ": unknown (available: paper)"};
  return Registrar(
      [](const nav::VertebraModel& model, std::span<const Point<World>> points_in_world) {
        return nav::register_paper(model, points_in_world);
      });
}

Result<Method> method_named(const std::string& name) {
  if (name == "best") return Method{name, &nav::create_best_tracker, *registrar_named("paper")};
  if (name == "paper") return Method{name, &nav::create_paper_tracker, *registrar_named("paper")};
  return Error{"--method " + name + ": unknown (available: best, paper)"};
}

}  // namespace orthonav::engine
