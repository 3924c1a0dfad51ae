#include "nav/guidance/rod_bend_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nav/statistics/levenberg_marquardt.h"

namespace orthonav::nav {
namespace {

// Weights, as standard deviations: seats and tulips decide; angles and places choose among the
// solutions that these leave. They are orders of magnitude apart, so the exact values do not
// matter.

constexpr double kSeatSd_m = 0.05e-3;
constexpr double kTulipSd_m = 0.05e-3;
constexpr double kLimitSd_rad = 0.002;
/// Factor of stiffness in a second fit, if the first one violated tulips or limits: so stiff that a
/// seat 1 mm off moves them by less than their margins. A fit that is stiff from the start would
/// get stuck there.
constexpr double kStiffer = 20.0;
constexpr double kAngleSd_rad = 0.35;
constexpr double kMiddleSd_m = 0.01;
constexpr double kEndsSd_m = 0.001;
/// The fit keeps this margin inside the limits, so that its result respects them.
constexpr double kTulipMargin_m = 0.1e-3;
constexpr double kLimitMargin_rad = 0.002;
/// Allowance for rounding.
constexpr double kClearance_m = 1e-6;

constexpr std::size_t kPoseParameters = 6;
constexpr std::size_t kBendParameters = 3;  ///< turn towards the line, across it, centre

double wrapped_rad(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

/// Which straight each seat lies on.
std::vector<std::size_t> straights_of_seats(const RodFitTask& task) {
  std::vector<std::size_t> straights;
  for (std::size_t i = 0; i < task.seats_m.size(); ++i) {
    straights.push_back(static_cast<std::size_t>(
        std::count_if(task.gaps.begin(), task.gaps.end(), [&](std::size_t g) { return g < i; })));
  }
  return straights;
}

struct RodGuess {
  Mat3 seats_from_rod = Mat3::identity();
  std::vector<double> parameters;
};

RodFit rod_of(const RodFitTask& task, const std::vector<std::size_t>& straights_of,
              const Mat3& start, std::span<const double> p) {
  RodFit rod;
  rod.seats_from_rod = rotation_from_vector({p[0], p[1], p[2]}) * start;
  rod.rod_in_seats_m = {p[3], p[4], p[5]};
  for (std::size_t i = kPoseParameters; i < p.size(); i += kBendParameters) {
    const double angle_rad = std::hypot(p[i], p[i + 1]);
    rod.arcs.push_back({p[i + 2], task.width_m, angle_rad, std::atan2(p[i + 1], p[i])});
    rod.sharpest_rad = std::max(rod.sharpest_rad, angle_rad);
    rod.sum_of_squares += angle_rad * angle_rad;
  }
  const std::vector<RodStraight> straights = rod_straights(rod.arcs, 0.0);
  const Mat3 rod_from_seats = rod.seats_from_rod.transposed();
  for (std::size_t i = 0; i < task.seats_m.size(); ++i) {
    const RodStraight& straight = straights[straights_of[i]];
    const Vec3 away_m = rod_from_seats * (task.seats_m[i] - rod.rod_in_seats_m) - straight.from_m;
    const double along_m = away_m.dot(straight.direction);
    const double off_m = (away_m - along_m * straight.direction).norm();
    rod.seats.push_back({straight.begin_m + along_m, off_m});
    rod.worst_off_m = std::max(rod.worst_off_m, off_m);
  }
  rod.length_m = rod.seats.back().at_m - rod.seats.front().at_m + 2.0 * task.overhang_m;
  return rod;
}

/// The length of rod that the tulips on either side leave for bend `k`, minus the bend: negative if
/// it reaches into one.
struct TulipRoom {
  double before_m = 0.0;
  double after_m = 0.0;
};

TulipRoom room_of(const RodFitTask& task, const RodFit& rod, std::size_t k) {
  const double half_m = 0.5 * (task.width_m + task.tulip_m);
  return {rod.arcs[k].centre_m - half_m - rod.seats[task.gaps[k]].at_m,
          rod.seats[task.gaps[k] + 1].at_m - half_m - rod.arcs[k].centre_m};
}

bool keeps_clear(const RodFitTask& task, const RodFit& rod) {
  for (std::size_t k = 0; k < rod.arcs.size(); ++k) {
    const TulipRoom room = room_of(task, rod, k);
    if (std::min(room.before_m, room.after_m) < -kClearance_m) {
      return false;
    }
  }
  return true;
}

void write_residuals(const RodFitTask& task, const RodFit& rod,
                     const std::vector<std::size_t>& straights_of, double stiffer,
                     std::vector<double>& out) {
  out.clear();
  // The distance has no derivative at zero, but its three components have.
  const std::vector<RodStraight> straights = rod_straights(rod.arcs, 0.0);
  const Mat3 rod_from_seats = rod.seats_from_rod.transposed();
  for (std::size_t i = 0; i < task.seats_m.size(); ++i) {
    const RodStraight& straight = straights[straights_of[i]];
    const Vec3 away_m = rod_from_seats * (task.seats_m[i] - rod.rod_in_seats_m) - straight.from_m;
    const Vec3 off_m = away_m - away_m.dot(straight.direction) * straight.direction;
    out.insert(out.end(), {off_m.x / kSeatSd_m, off_m.y / kSeatSd_m, off_m.z / kSeatSd_m});
  }
  for (std::size_t k = 0; k < rod.arcs.size(); ++k) {
    const TulipRoom room = room_of(task, rod, k);
    out.push_back(std::min(0.0, room.before_m - kTulipMargin_m) / kTulipSd_m * stiffer);
    out.push_back(std::min(0.0, room.after_m - kTulipMargin_m) / kTulipSd_m * stiffer);
    const RodArc& arc = rod.arcs[k];
    out.push_back(arc.angle_rad * std::cos(arc.roll_rad) / kAngleSd_rad);
    out.push_back(arc.angle_rad * std::sin(arc.roll_rad) / kAngleSd_rad);
    out.push_back(std::max(0.0, arc.angle_rad - task.most_angle_rad + kLimitMargin_rad) /
                  kLimitSd_rad * stiffer);
    out.push_back(0.5 * (room.before_m - room.after_m) / kMiddleSd_m);
  }
  const double first_m = rod.seats.front().at_m;
  out.push_back((first_m - task.overhang_m) / kEndsSd_m);
}

/// The direction of each straight: from its first to its last seat; with a single seat, that of the
/// chord between its neighbours.
std::vector<Vec3> guessed_directions(const RodFitTask& task) {
  const std::vector<std::size_t> straights_of = straights_of_seats(task);
  const std::size_t seats = task.seats_m.size();
  std::vector<Vec3> directions;
  for (std::size_t first = 0; first < seats;) {
    std::size_t last = first;
    while (last + 1 < seats && straights_of[last + 1] == straights_of[first]) {
      ++last;
    }
    const std::size_t from = first == last && first > 0 ? first - 1 : first;
    const std::size_t to = first == last ? std::min(last + 1, seats - 1) : last;
    directions.push_back((task.seats_m[to] - task.seats_m[from]).normalized());
    first = last + 1;
  }
  return directions;
}

Mat3 frame_along(Vec3 along) {
  const Vec3 least = std::abs(along.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 line = (least - least.dot(along) * along).normalized();
  return Mat3::from_columns(line, along.cross(line), along);
}

/// Straights along the guessed directions, bends in the middle of their gaps.
RodGuess guess_from_seats(const RodFitTask& task) {
  const std::vector<Vec3> directions = guessed_directions(task);
  RodGuess guess;
  guess.seats_from_rod = frame_along(directions[0]);
  const Vec3 origin_m = task.seats_m[0] - task.overhang_m * directions[0];
  guess.parameters = {0.0, 0.0, 0.0, origin_m.x, origin_m.y, origin_m.z};
  std::vector<double> places_m = {task.overhang_m};
  for (std::size_t i = 1; i < task.seats_m.size(); ++i) {
    places_m.push_back(places_m.back() + (task.seats_m[i] - task.seats_m[i - 1]).norm());
  }
  Mat3 frame = guess.seats_from_rod;
  for (std::size_t k = 0; k < task.gaps.size(); ++k) {
    const Vec3 across = directions[k].cross(directions[k + 1]);
    const double angle_rad = angle_between_rad(directions[k], directions[k + 1]);
    const Vec3 rotation_rad = across.norm() > 0.0 ? angle_rad * across.normalized() : Vec3{};
    const Vec3 towards_rad = rotation_rad.cross(directions[k]);
    const double centre_m = 0.5 * (places_m[task.gaps[k]] + places_m[task.gaps[k] + 1]);
    guess.parameters.insert(guess.parameters.end(), {towards_rad.dot(frame.column(0)),
                                                     towards_rad.dot(frame.column(1)), centre_m});
    frame = rotation_from_vector(rotation_rad) * frame;
  }
  return guess;
}

/// Puts the first end `overhang_m` before the first seat, and the drawn line on the side to which
/// the first bend goes.
void settle_ends_and_line(const RodFitTask& task, RodFit& rod) {
  const double offset_m = rod.seats.front().at_m - task.overhang_m;
  const double roll_rad = rod.arcs.empty() ? 0.0 : rod.arcs.front().roll_rad;
  for (SeatOnRod& seat : rod.seats) {
    seat.at_m -= offset_m;
  }
  for (RodArc& arc : rod.arcs) {
    arc.centre_m -= offset_m;
    arc.roll_rad = wrapped_rad(arc.roll_rad - roll_rad);
  }
  rod.rod_in_seats_m += offset_m * rod.seats_from_rod.column(2);
  rod.seats_from_rod = rod.seats_from_rod * rotation_from_vector({0.0, 0.0, roll_rad});
}

}  // namespace

Result<RodFit> fit_rod_bends(const RodFitTask& task) {
  const std::vector<std::size_t> straights_of = straights_of_seats(task);
  const RodGuess guess = guess_from_seats(task);
  double stiffer = 1.0;
  const auto residuals = [&](std::span<const double> p, std::vector<double>& out) {
    const RodFit rod = rod_of(task, straights_of, guess.seats_from_rod, p);
    write_residuals(task, rod, straights_of, stiffer, out);
  };
  auto found = levenberg_marquardt(guess.parameters, residuals);
  if (!found) {
    return found.error();
  }
  RodFit rod = rod_of(task, straights_of, guess.seats_from_rod, found->parameters);
  if (!keeps_clear(task, rod) || rod.sharpest_rad > task.most_angle_rad) {
    stiffer = kStiffer;
    found = levenberg_marquardt(std::vector<double>(found->parameters), residuals);
    if (!found) {
      return found.error();
    }
    rod = rod_of(task, straights_of, guess.seats_from_rod, found->parameters);
  }
  rod.clear = keeps_clear(task, rod);
  settle_ends_and_line(task, rod);
  return rod;
}

}  // namespace orthonav::nav
