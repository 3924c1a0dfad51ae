#include "engine/session/rod_in_hand.h"

#include <cmath>

#include "nav/guidance/rod_shape.h"

namespace orthonav::engine {
namespace {

/// A stroke tells a rod's length to about this.
constexpr double kNotCut_m = 0.004;

}  // namespace

std::vector<std::string> RodInHandRules::check() const {
  std::vector<std::string> problems;
  if (!(most_one_sided > 0.0 && most_one_sided <= 1.0)) {
    problems.emplace_back("rod_in_hand.most_one_sided must lie in (0, 1]");
  }
  if (!(surprise_sds > 0.0 && surprise_sds <= 10.0)) {
    problems.emplace_back("rod_in_hand.surprise_sds must lie in (0, 10]");
  }
  if (shown_for <= Duration::zero() || shown_for > std::chrono::minutes(5)) {
    problems.emplace_back("rod_in_hand.shown_for must lie in (0, 300] s");
  }
  return problems;
}

std::vector<nav::RodArc> first_bends(const nav::RodInstructions& instructions, std::size_t count) {
  std::vector<nav::RodArc> arcs;
  for (std::size_t k = 0; k < count; ++k) {
    arcs.push_back(instructions.bends[k].arc);
  }
  return arcs;
}

std::optional<NextBend> next_bend_of(const nav::RodInstructions& instructions) {
  const std::size_t made = instructions.made;
  if (made >= instructions.bends.size()) {
    return std::nullopt;
  }
  const nav::RodInstruction& bend = instructions.bends[made];
  return NextBend{made + 1, bend.arc.centre_m, bend.arc.roll_rad, bend.set_rad};
}

LyingRod lying_rod(const nav::RodInstructions& instructions, const Mat3& world_from_rod,
                   Vec3 rod_in_world, double length_m) {
  const std::vector<nav::RodArc> made = first_bends(instructions, instructions.made);
  const auto mark = [&](const nav::RodPlace& place) {
    return RodMark{{rod_in_world + world_from_rod * place.at_m}, world_from_rod * place.along};
  };
  LyingRod rod;
  for (const Vec3& at_m : nav::rod_axis(made, length_m)) {
    rod.axis.push_back({rod_in_world + world_from_rod * at_m});
  }
  rod.cut_length_m = instructions.cut_length_m();
  if (length_m > rod.cut_length_m + kNotCut_m) {
    rod.cut = mark(nav::rod_place(made, rod.cut_length_m));
  }
  rod.next = next_bend_of(instructions);
  if (rod.next) {
    const nav::RodPlace place = nav::rod_place(made, rod.next->at_m);
    rod.bend = mark(place);
    if (!made.empty()) {
      const double roll_rad = rod.next->roll_rad;
      rod.towards =
          world_from_rod * (std::cos(roll_rad) * place.line + std::sin(roll_rad) * place.beside);
    }
  }
  return rod;
}

}  // namespace orthonav::engine
