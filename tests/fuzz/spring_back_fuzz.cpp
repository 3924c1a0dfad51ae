#include <cmath>

#include "engine/case/spring_back_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Trial bends of a rod: accepted ones are finite, and a bender either refuses them or answers
/// for each rod that it can bend with a finite angle.
void fuzz_spring_back(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto trials = engine::load_spring_back(file.path());
  if (!trials) {
    insist_one_line(trials.error());
    return;
  }
  for (const nav::SpringBackTrial& trial : *trials) {
    insist(std::isfinite(trial.set_rad) && std::isfinite(trial.kept_rad));
  }
  nav::RodMaterial material;
  material.trials = *trials;
  const auto spring_back = nav::RodSpringBack::of({}, material, 5.5e-3);
  if (!spring_back) {
    insist_one_line(spring_back.error());
    return;
  }
  const auto set = spring_back->set_rad(0.2);
  insist(!set || std::isfinite(*set));
}

}  // namespace orthonav::fuzz
