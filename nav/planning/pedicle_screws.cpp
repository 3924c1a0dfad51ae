#include "nav/planning/pedicle_screws.h"

#include <algorithm>
#include <string>

#include "base/length_text.h"
#include "base/printed.h"

namespace orthonav::nav {
namespace {

/// A tip lies at least this far in the body.
constexpr double kInBody_m = 0.005;

/// Clearance given up per degree by which the two sides lean differently.
constexpr double kMirrored_m = 0.00003;

/// The available sizes.
class Sizes {
 public:
  Sizes(std::span<const ImplantSize> all, double thickest_m) {
    for (const ImplantSize& size : all) {
      if (size.diameter_m <= thickest_m + 1e-9) {
        sizes_.push_back(size);
      }
    }
    std::stable_sort(sizes_.begin(), sizes_.end(), [](const ImplantSize& a, const ImplantSize& b) {
      return a.diameter_m < b.diameter_m ||
             (a.diameter_m == b.diameter_m && a.length_m < b.length_m);
    });
  }
  [[nodiscard]] bool empty() const { return sizes_.empty(); }
  [[nodiscard]] double thinnest_m() const { return sizes_.front().diameter_m; }
  [[nodiscard]] double longest_m() const {
    double longest_m = 0.0;
    for (const ImplantSize& size : sizes_) {
      longest_m = std::max(longest_m, size.length_m);
    }
    return longest_m;
  }
  /// The thickest that leaves this clearance in a pedicle with that room; otherwise the thinnest.
  [[nodiscard]] double diameter_m(double room_m, double clearance_m) const {
    double best_m = thinnest_m();
    for (const ImplantSize& size : sizes_) {
      best_m = size.diameter_m <= room_m - 2.0 * clearance_m ? size.diameter_m : best_m;
    }
    return best_m;
  }
  /// The longest of that diameter that is at most `most_m`; 0: none.
  [[nodiscard]] double length_m(double diameter_m, double most_m) const {
    double best_m = 0.0;
    for (const ImplantSize& size : sizes_) {
      if (size.diameter_m == diameter_m && size.length_m <= most_m) {
        best_m = std::max(best_m, size.length_m);
      }
    }
    return best_m;
  }

 private:
  std::vector<ImplantSize> sizes_;
};

/// The best axis of one side for the thinnest screw.
struct Start {
  PedicleSearch::Found found;
  ImplantSize size;  ///< the largest that suits this side alone
};

Error too_narrow(double room_m, double diameter_m) {
  return Error{"pedicle too narrow: room for a screw of " +
               beside_limit("%.1f mm, must be %.1f mm", room_m * 1e3, diameter_m * 1e3)};
}

Result<Start> start_of(const PedicleSearch& search, Side side, const Sizes& sizes,
                       double wanted_m) {
  const auto coarse = search.coarse(side, sizes.longest_m());
  if (!coarse) {
    return Error{"no way through a pedicle from behind"};
  }
  const PedicleSearch::Way way = search.way(side, *coarse).value();
  const double thinnest_m = sizes.thinnest_m();
  const double length_m = std::min(sizes.longest_m(), PedicleSearch::safe_length_m(way));
  const auto found = search.fine(side, {&*coarse, 1}, {0.5 * thinnest_m, length_m});
  if (!found) {
    return Error{"no way through a pedicle from behind"};
  }
  const double room_m = thinnest_m + 2.0 * found->clearance.clearance_m;
  if (room_m < thinnest_m) {
    return too_narrow(room_m, thinnest_m);
  }
  const double diameter_m = sizes.diameter_m(room_m, wanted_m);
  const double safe_m = PedicleSearch::safe_length_m(found->way);
  const ImplantSize size{diameter_m, sizes.length_m(diameter_m, safe_m)};
  if (size.length_m < found->way.to_body_m + kInBody_m) {
    return Error{"no length in the list suits: " + in_mm(found->way.to_body_m + kInBody_m) +
                 " reach the body, " + in_mm(safe_m) + " end safely before the far cortex"};
  }
  return Start{*found, size};
}

/// One size for both sides: the thinner diameter with the shorter length, if it exists in that
/// diameter.
ImplantSize common_size(const ImplantSize& a, const ImplantSize& b, const Sizes& sizes) {
  const double diameter_m = std::min(a.diameter_m, b.diameter_m);
  const double length_m = sizes.length_m(diameter_m, std::min(a.length_m, b.length_m));
  return {diameter_m, length_m > 0.0 ? length_m : std::min(a.length_m, b.length_m)};
}

Result<PlannedScrew> finished(const PedicleSearch& search, Side side,
                              std::span<const PedicleAxis> starts,
                              const PedicleSearch::Wanted& wanted) {
  const auto found = search.fine(side, starts, wanted);
  if (!found) {
    return Error{"no way through a pedicle from behind"};
  }
  const double clearance_m = found->clearance.clearance_m;
  if (clearance_m < 0.0) {
    return too_narrow(2.0 * (wanted.radius_m + clearance_m), 2.0 * wanted.radius_m);
  }
  const Point<Vertebra> target{found->way.entry.v + wanted.length_m * found->way.direction};
  return PlannedScrew{{side, found->way.entry, target, wanted.radius_m, {}},
                      found->clearance,
                      2.0 * (wanted.radius_m + clearance_m),
                      found->axis.convergence_rad,
                      found->axis.cranial_rad,
                      found->way.to_front_m - wanted.length_m};
}

}  // namespace

Result<PedicleScrews> plan_pedicle_screws(const TriangleMesh& mesh, const SurfaceIndex& bone,
                                          std::span<const ImplantSize> sizes,
                                          const PlanningRules& rules) {
  const Sizes listed(sizes, rules.thickest_m);
  if (listed.empty()) {
    return Error{"the list of screws has none up to " + in_mm(rules.thickest_m)};
  }
  const auto canal = find_canal(mesh, bone);
  if (!canal) {
    return Error{
        "no vertebral canal found: the model must be a whole vertebra, its axes the patient's"};
  }
  const PedicleSearch search(bone, *canal, rules.steepest_rad);
  const Result<Start> left = start_of(search, Side::kLeft, listed, rules.wanted_clearance_m);
  const Result<Start> right = start_of(search, Side::kRight, listed, rules.wanted_clearance_m);
  const auto side = [&](const Result<Start>& own, const Result<Start>& other,
                        Side which) -> Result<PlannedScrew> {
    if (!own) {
      return own.error();
    }
    const ImplantSize size = other ? common_size(own->size, other->size, listed) : own->size;
    const PedicleAxis& a = own->found.axis;
    const PedicleAxis& b = other ? other->found.axis : a;
    return finished(
        search, which, std::array{a, b},
        {0.5 * size.diameter_m, size.length_m, 0.5 * (a.convergence_rad + b.convergence_rad),
         0.5 * (a.cranial_rad + b.cranial_rad), kMirrored_m});
  };
  return PedicleScrews{*canal, {side(left, right, Side::kLeft), side(right, left, Side::kRight)}};
}

}  // namespace orthonav::nav
