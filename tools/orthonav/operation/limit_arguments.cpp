#include "tools/orthonav/operation/limit_arguments.h"

#include <array>
#include <cstdio>

#include "base/angle.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

struct Limit {
  const char* option;
  double LimitArguments::*value;
  const char* text;
};

constexpr std::array<Limit, 4> kLimits = {
    {{"--good-deg", &LimitArguments::good_deg, "angle below which the triangle is good"},
     {"--poor-deg", &LimitArguments::poor_deg, "angle above which the triangle is poor and dashed"},
     {"--wire-deg", &LimitArguments::wire_deg, "angle beyond which a placed wire is questioned"},
     {"--wire-mm", &LimitArguments::wire_mm,
      "entry error beyond which a placed wire is questioned"}}};

}  // namespace

void LimitArguments::add_to(CLI::App& command) {
  constexpr double kWidest = 10.0;
  for (const Limit& limit : kLimits) {
    command.add_option(limit.option, this->*limit.value, limit.text)
        ->check(finite_number(0.1, kWidest))
        ->capture_default_str();
  }
}

engine::GradeLimits LimitArguments::grades() const {
  return {good_deg * kRadiansPerDegree, poor_deg * kRadiansPerDegree};
}

void LimitArguments::set_in(engine::AssemblyOptions& options) const {
  const LimitArguments usual;
  for (const Limit& limit : kLimits) {
    if (this->*limit.value > usual.*limit.value) {
      std::fprintf(stderr, "orthonav: warning: %s %g is wider than the usual %g\n", limit.option,
                   this->*limit.value, usual.*limit.value);
    }
  }
  options.visibility.grades = grades();
  options.session.placed.angle_limit_rad = wire_deg * kRadiansPerDegree;
  options.session.placed.entry_limit_m = wire_mm * 1e-3;
}

}  // namespace orthonav::tools
