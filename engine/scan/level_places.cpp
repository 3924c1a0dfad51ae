#include "engine/scan/level_places.h"

#include <algorithm>

#include "base/printed.h"

namespace orthonav::engine {
namespace {

/// From the head down.
const std::vector<std::string>& spine_labels() {
  static const std::vector<std::string> kLabels = [] {
    std::vector<std::string> labels;
    const auto add = [&](char region, int count) {
      for (int i = 1; i <= count; ++i) {
        labels.push_back(region + std::to_string(i));
      }
    };
    add('C', 7);
    add('T', 13);
    add('L', 6);
    labels.push_back("S1");
    return labels;
  }();
  return kLabels;
}

}  // namespace

std::optional<std::size_t> place_in_spine(const std::string& label) {
  const std::vector<std::string>& order = spine_labels();
  const auto found = std::find(order.begin(), order.end(), label);
  return found == order.end()
             ? std::nullopt
             : std::optional<std::size_t>(static_cast<std::size_t>(found - order.begin()));
}

double usual_distance_m(const std::string& upper, const std::string& lower) {
  const auto step_m = [](const std::string& label) {
    const int number = std::stoi(label.substr(1));
    switch (label[0]) {
      case 'C':
        return 0.017;
      case 'T':
        return 0.0175 + 0.0008 * number;
      default:
        return 0.035;
    }
  };
  // Few spines have a T13 or an L6; a missing one does not count as a step.
  std::vector<std::string> order = spine_labels();
  std::erase_if(order, [&](const std::string& label) {
    return (label == "T13" || label == "L6") && label != upper && label != lower;
  });
  const auto from = std::find(order.begin(), order.end(), upper);
  const auto to = std::find(order.begin(), order.end(), lower);
  double sum_m = 0.0;
  for (auto at = from; at < to; ++at) {
    sum_m += step_m(*at);
  }
  return sum_m;
}

Status check_places(const std::vector<LevelPlace>& from_the_head, const std::string& hint,
                    std::string* unusual) {
  constexpr double kLeastRatio = 0.72, kMaxRatio = 1.35;
  if (from_the_head.size() < 2) {
    return {};
  }
  double measured_m = 0.0, usual_m = 0.0;
  for (std::size_t i = 1; i < from_the_head.size(); ++i) {
    const LevelPlace& upper = from_the_head[i - 1];
    const LevelPlace& lower = from_the_head[i];
    const Vec3 down = lower.middle_m - upper.middle_m;
    if (!(down.z < 0.0)) {
      return Error{lower.label + " lies above " + upper.label + ": " + hint};
    }
    measured_m += down.norm();
    usual_m += usual_distance_m(upper.label, lower.label);
  }
  const double ratio = measured_m / usual_m;
  if (!(ratio >= kLeastRatio && ratio <= kMaxRatio)) {
    const std::string said =
        printed("%s to %s measure %.0f mm, usual are %.0f mm", from_the_head.front().label.c_str(),
                from_the_head.back().label.c_str(), measured_m * 1e3, usual_m * 1e3);
    if (unusual == nullptr) {
      return Error{said + ": " + hint +
                   " For four or six lumbar vertebrae, T13 or a child: --unusual"};
    }
    *unusual = said;
  }
  return {};
}

Result<BoneSamples> BoneSamples::in(const Volume& scan) {
  if (scan.layers != 1) {
    return Error{"the scan has " + std::to_string(scan.layers) + " values a voxel, a CT has 1"};
  }
  return BoneSamples(scan);
}

void BoneSamples::add(Vec3 place_m) {
  ++all_;
  if (const auto voxel = scan_->grid.voxel_around(place_m)) {
    ++inside_;
    sum_hu_ += static_cast<double>(scan_->values[*voxel]);
  }
}

Status BoneSamples::check(const std::string& what) const {
  constexpr double kMaxOutside = 0.1, kLeastBone_hu = 50.0;
  constexpr const char* kHint =
      "; are their axes mixed up (LPS, RAS), or are they of another scan?";
  const auto divisor = [](std::size_t n) {
    return static_cast<double>(std::max<std::size_t>(n, 1));
  };
  const double outside = 1.0 - static_cast<double>(inside_) / divisor(all_);
  if (!(outside <= kMaxOutside)) {
    return Error{printed("%.0f %% of the %s lie outside of the scan, limit %.0f %%", outside * 1e2,
                         what.c_str(), kMaxOutside * 1e2) +
                 kHint};
  }
  const double mean_hu = sum_hu_ / divisor(inside_);
  if (!(mean_hu >= kLeastBone_hu)) {
    return Error{printed("the scan has %.0f HU on average where the %s are, bone has %.0f or more",
                         mean_hu, what.c_str(), kLeastBone_hu) +
                 kHint};
  }
  return {};
}

}  // namespace orthonav::engine
