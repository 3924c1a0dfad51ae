#include "study/rod_bench.h"

#include <cmath>
#include <utility>

#include "base/check.h"
#include "hal/sim/room/noise.h"

namespace orthonav::engine {

double rod_log_normal(Random& random, double relative_sd) {
  return std::exp(relative_sd * random.normal() - 0.5 * relative_sd * relative_sd);
}

void RodBench::spend(double mean_s) {
  time_s_ += mean_s * task_.hands * rod_log_normal(random_, options_.durations.scatter);
}

template <class Touch>
nav::RodCut RodBench::cut_through(Touch touch) {
  for (int i = 0; i < kMaxRodDraws; ++i) {
    std::vector<Vec3> heads_m;
    for (const Vec3& head_m : task_.heads_m) {
      heads_m.push_back(touch(head_m));
    }
    const auto rod = nav::rod_template(heads_m, options_.rod_diameter_m);
    if (!rod) {
      continue;
    }
    auto cut =
        nav::rod_cut(*rod, task_.to_bone, {options_.assumed_head_to_seat_m, options_.overhang_m});
    if (cut) {
      return *std::move(cut);
    }
  }
  ORTHONAV_CHECK(false && "touched heads never gave a rod");
  return {};
}

nav::RodCut RodBench::touched() {
  return cut_through([this](Vec3 head_m) {
    spend(options_.durations.touch_head_s);
    return head_m + sim::normal_vector(random_, options_.head_pick_m) +
           sim::normal_vector(random_, options_.navigation_m);
  });
}

int RodBench::touches_of_a_head() const {
  return task_.heads_m.size() >= options_.long_rod_heads ? options_.long_rod_touches
                                                         : options_.head_touches;
}

double RodBench::head_sd_m() const {
  return options_.in_socket ? std::hypot(options_.socket_seating_m / std::sqrt(touches_of_a_head()),
                                         options_.neighbour_navigation_m)
                            : std::hypot(options_.head_pick_m, options_.navigation_m);
}

nav::RodCut RodBench::touched_in_sockets() {
  const int touches = touches_of_a_head();
  return cut_through([this, touches](Vec3 head_m) {
    Vec3 seating_m;
    for (int i = 0; i < touches; ++i) {
      spend(i == 0 ? options_.durations.touch_head_s : options_.durations.touch_again_s);
      seating_m += sim::normal_vector(random_, options_.socket_seating_m) / touches;
    }
    return head_m + seating_m + sim::normal_vector(random_, options_.neighbour_navigation_m);
  });
}

void RodBench::bend(RodInHand& rod, std::size_t joint, Vec3 wanted_rad, double relative_sd) {
  work(options_.durations.bend_s);
  work(options_.durations.compare_s);
  const double eye_rad = relative_sd * wanted_rad.norm();
  const double recovery_rad = options_.recovery_error * elastic_recovery_rad(options_);
  rod.bend(joint, wanted_rad + sim::normal_vector(random_, std::hypot(eye_rad, recovery_rad)));
}

BentRod RodBench::with_template() { return matched(touched()); }

double RodBench::cut_to(double shown_m) {
  work(options_.durations.measure_s);
  work(options_.durations.cut_s);
  return shown_m + random_.normal(0.0, std::hypot(options_.length_reading_m, options_.cutting_m));
}

BentRod RodBench::matched(const nav::RodCut& shown) {
  const double length_m = cut_to(shown.cut_length_m);
  std::vector<Vec3> seen_m;
  for (const Vec3& seat_m : shown.seats_m) {
    seen_m.push_back(seat_m + sim::normal_vector(random_, options_.perception_m));
  }
  RodInHand rod = RodInHand::straight(seen_m);
  for (std::size_t i = 1; i + 1 < seen_m.size(); ++i) {
    for (int bends = 0; bends < options_.most_matching_bends; ++bends) {
      bend(rod, i, rod_rotation_rad(rod.chord_m(i), seen_m[i + 1] - rod.places_m()[i]), 0.0);
      if ((rod.places_m()[i + 1] - seen_m[i + 1]).norm() <= options_.matched_m) {
        break;
      }
    }
  }
  return finished(std::move(rod), length_m, &RodInHand::worst_bend, options_.placing_m);
}

BentRod RodBench::by_eye() {
  const std::vector<Vec3>& seats_m = task_.cut.seats_m;
  work(options_.durations.measure_s);
  work(options_.durations.cut_s);
  const double length_m =
      task_.cut.cut_length_m * (1.0 + options_.eye_length_sd * random_.normal()) +
      random_.normal(0.0, options_.cutting_m);
  RodInHand rod = RodInHand::straight(seats_m);
  for (std::size_t i = 0; i + 1 < seats_m.size(); ++i) {
    rod.lengthen(i, random_.normal(0.0, options_.eye_place_m));
  }
  for (std::size_t i = 1; i + 1 < seats_m.size(); ++i) {
    const Vec3 rotation_rad =
        rod_rotation_rad(seats_m[i] - seats_m[i - 1], seats_m[i + 1] - seats_m[i]);
    const double over_rad = options_.eye_overbend_rad_per_m * rod.chord_m(i - 1).norm();
    const double angle_rad = rotation_rad.norm();
    bend(rod, i, angle_rad > 0.0 ? (1.0 + over_rad / angle_rad) * rotation_rad : rotation_rad,
         options_.eye_bend_sd);
  }
  return finished(std::move(rod), length_m, &RodInHand::worst_bend, options_.placing_m);
}

/// Tries the rod in the heads and bends it again until it fits all of them.
BentRod RodBench::finished(RodInHand rod, double length_m, WorstBend worst_bend, double placing_m) {
  BentRod result;
  const std::vector<Vec3>& seats_m = task_.cut.seats_m;
  work(options_.durations.try_s);
  RodLie lie = rod.lay_on(seats_m);
  result.first_try_m = lie.mean_m;
  while (lie.largest_m > options_.missed_m && seats_m.size() > 2 &&
         result.rebends < options_.most_rebends) {
    work(options_.durations.take_out_s);
    const RodCorrection worst = (rod.*worst_bend)(seats_m);
    bend(rod, worst.joint, worst.rotation_rad, options_.eye_bend_sd);
    work(options_.durations.try_s);
    lie = rod.lay_on(seats_m);
    ++result.rebends;
  }
  const double offset_m = random_.normal(0.0, placing_m);
  const auto right = [&](double overhang_m) {
    return overhang_m >= options_.shortest_overhang_m && overhang_m <= options_.longest_overhang_m;
  };
  result.heads = seats_m.size();
  result.length_m = length_m;
  result.first_overhang_m = 0.5 * (length_m - lie.span_m) + offset_m;
  result.last_overhang_m = 0.5 * (length_m - lie.span_m) - offset_m;
  result.right_length = right(result.first_overhang_m) && right(result.last_overhang_m);
  result.head_distance_m = lie.mean_m;
  result.time_s = time_s_;
  return result;
}

}  // namespace orthonav::engine
