#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/random.h"
#include "base/vec.h"
#include "nav/guidance/rod_bends.h"
#include "nav/guidance/rod_cut.h"
#include "study/rod_experiment.h"
#include "study/rod_in_hand.h"

namespace orthonav::engine {

/// Draws of heads or touches that do not allow a rod are repeated; with valid options this is rare.
inline constexpr int kMaxRodDraws = 1000;

/// A factor of mean 1.
[[nodiscard]] double rod_log_normal(Random& random, double relative_sd);

/// Where one rod has to lie, and the skills of the person who bends it.
struct RodTask {
  std::vector<Vec3> heads_m;
  std::vector<Vec3> to_bone;
  nav::RodCut cut;  ///< the true seats and the right length
  double hands = 1.0;
};

/// The work on one rod, and the time it takes. One bench per rod.
class RodBench {
 public:
  RodBench(const RodExperimentOptions& options, const RodTask& task, Random random)
      : options_(options), task_(task), random_(random) {}

  [[nodiscard]] BentRod with_template();
  [[nodiscard]] BentRod by_eye();
  /// Bent as instructed (nav/guidance/rod_bends.h); without instructions, with the template.
  [[nodiscard]] InstructedRod with_instructions();

 private:
  void spend(double mean_s);
  void work(double mean_s) { spend(mean_s * options_.pace); }
  /// Touches every head, `touch` one of them, until the touched places allow a rod.
  template <class Touch>
  [[nodiscard]] nav::RodCut cut_through(Touch touch);
  [[nodiscard]] nav::RodCut touched();
  [[nodiscard]] nav::RodCut touched_in_sockets();
  [[nodiscard]] int touches_of_a_head() const;
  /// Of a touched head, along an axis.
  [[nodiscard]] double head_sd_m() const;
  /// Cut and bent against the hologram.
  [[nodiscard]] BentRod matched(const nav::RodCut& shown);
  void bend(RodInHand& rod, std::size_t joint, Vec3 wanted_rad, double relative_sd);
  /// Measured off by the displayed length, and cut.
  [[nodiscard]] double cut_to(double shown_m);
  using WorstBend = RodCorrection (RodInHand::*)(std::span<const Vec3> seats_m) const;
  [[nodiscard]] BentRod finished(RodInHand rod, double length_m, WorstBend worst_bend,
                                 double placing_m);
  [[nodiscard]] nav::RodArc bent_as_told(const nav::RodInstruction& told,
                                         const nav::RodSpringBack& spring_back, double stiffness);

  const RodExperimentOptions& options_;
  const RodTask& task_;
  Random random_;
  double time_s_ = 0.0;
};

}  // namespace orthonav::engine
