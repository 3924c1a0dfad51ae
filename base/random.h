#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace orthonav {

/// Random numbers with the same bits on every machine and in every version: xoshiro256** (Blackman
/// and Vigna 2018), seeded by splitmix64. The distributions of std differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed = 0);

  std::uint64_t next();
  /// In [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal: the inverse distribution function of one uniform, so that every draw takes
  /// exactly one number of the stream.
  double normal();
  double normal(double mean, double sd) { return mean + sd * normal(); }

  /// An independent stream. It depends only on the seed and the name, not on how much was drawn, so
  /// a new consumer never changes the numbers of the others.
  [[nodiscard]] Random fork(std::string_view name) const;
  [[nodiscard]] Random fork(std::uint64_t number) const;

 private:
  std::uint64_t seed_;
  std::array<std::uint64_t, 4> state_;
};

/// The quantile of the standard normal distribution for p in (0, 1), to 1e-15 relative
/// (Wichura 1988, algorithm AS 241, PPND16).
[[nodiscard]] double normal_quantile(double p);

/// One step of splitmix64 (Steele, Lea and Flood 2014): advances `state`, returns its hash.
std::uint64_t splitmix64(std::uint64_t& state);

}  // namespace orthonav
