#include "nav/statistics/whitened_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"

namespace orthonav::nav {
namespace {

/// A symmetric, positive definite matrix by rows: a product with its own transpose.
std::vector<double> random_covariance(std::size_t size) {
  Random random(size);
  const std::size_t inner = size + 3;
  std::vector<double> root(size * inner);
  for (double& entry : root) {
    entry = random.normal();
  }
  std::vector<double> out(size * size, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      for (std::size_t k = 0; k < inner; ++k) {
        out[i * size + j] += root[i * inner + k] * root[j * inner + k];
      }
    }
  }
  return out;
}

/// With the unit vectors as right-hand sides: whitened, they are L⁻¹.
WhitenedSystem with_unit_vectors(const std::vector<double>& covariance, std::size_t size) {
  WhitenedSystem system;
  system.reset(size, size);
  for (std::size_t i = 0; i < size; ++i) {
    system.right_side(i, i) = 1.0;
    for (std::size_t j = 0; j <= i; ++j) {
      system.covariance(i, j) = covariance[i * size + j];
    }
  }
  return system;
}

TEST(WhitenedSystem, MakesTheCovarianceTheUnitMatrixAtEverySize) {
  for (std::size_t size = 1; size <= 23; ++size) {
    const std::vector<double> covariance = random_covariance(size);
    WhitenedSystem system = with_unit_vectors(covariance, size);
    ASSERT_TRUE(system.whiten());
    double log_determinant = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      const double* const a = system.right_sides(i);
      log_determinant -= 2.0 * std::log(a[i]);
      for (std::size_t j = 0; j < size; ++j) {
        const double* const b = system.right_sides(j);
        double between = 0.0;
        for (std::size_t k = 0; k < size; ++k) {
          for (std::size_t l = 0; l < size; ++l) {
            between += a[k] * covariance[k * size + l] * b[l];
          }
        }
        EXPECT_NEAR(between, i == j ? 1.0 : 0.0, 1e-9) << size << " " << i << " " << j;
        EXPECT_TRUE(j <= i || a[j] == 0.0) << "lower triangular";
      }
    }
    EXPECT_NEAR(system.log_determinant(), log_determinant, 1e-9) << size;
  }
}

TEST(WhitenedSystem, SolvesAllRightHandSidesAlikeAndIsUsedAgain) {
  constexpr std::size_t kSize = 9;
  const std::vector<double> covariance = random_covariance(kSize);
  WhitenedSystem units = with_unit_vectors(covariance, kSize);
  ASSERT_TRUE(units.whiten());
  WhitenedSystem system = with_unit_vectors(random_covariance(kSize + 4), kSize + 4);
  ASSERT_TRUE(system.whiten());
  system.reset(kSize, 1);
  for (std::size_t i = 0; i < kSize; ++i) {
    system.right_side(i, 0) = static_cast<double>(i) - 3.0;
    for (std::size_t j = 0; j <= i; ++j) {
      system.covariance(i, j) = covariance[i * kSize + j];
    }
  }
  ASSERT_TRUE(system.whiten());
  for (std::size_t i = 0; i < kSize; ++i) {
    double by_units = 0.0;
    for (std::size_t k = 0; k < kSize; ++k) {
      by_units += units.right_sides(i)[k] * (static_cast<double>(k) - 3.0);
    }
    EXPECT_NEAR(system.right_sides(i)[0], by_units, 1e-12) << i;
  }
}

TEST(WhitenedSystem, RefusesWhatIsNoCovariance) {
  constexpr std::size_t kSize = 10;
  for (const double bad : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    std::vector<double> covariance = random_covariance(kSize);
    covariance[7 * kSize + 7] = bad;
    EXPECT_FALSE(with_unit_vectors(covariance, kSize).whiten()) << bad;
  }
}

}  // namespace
}  // namespace orthonav::nav
