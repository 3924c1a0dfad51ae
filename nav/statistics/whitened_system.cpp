#include "nav/statistics/whitened_system.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace orthonav::nav {
namespace {

/// Columns are eliminated in panels of this many, so that their factors stay in registers.
constexpr std::size_t kPanel = 4;

using Columns = std::array<const double*, kPanel>;
using Factors = std::array<double, kPanel>;

/// Subtracts a panel's columns, times their factors, from two columns at once: each panel entry is
/// loaded once for both.
void subtract_from_two(const Columns& from, const Factors& f, const Factors& g, std::size_t rows,
                       double* __restrict__ out, double* __restrict__ beside) {
  const double* __restrict__ a = from[0];
  const double* __restrict__ b = from[1];
  const double* __restrict__ c = from[2];
  const double* __restrict__ d = from[3];
  for (std::size_t i = 0; i < rows; ++i) {
    out[i] = out[i] - a[i] * f[0] - b[i] * f[1] - c[i] * f[2] - d[i] * f[3];
    beside[i] = beside[i] - a[i] * g[0] - b[i] * g[1] - c[i] * g[2] - d[i] * g[3];
  }
}

void subtract_from_one(const double* __restrict__ column, double factor, std::size_t rows,
                       double* __restrict__ out) {
  for (std::size_t i = 0; i < rows; ++i) {
    out[i] -= column[i] * factor;
  }
}

}  // namespace

void WhitenedSystem::reset(std::size_t size, std::size_t right_sides) {
  size_ = size;
  rows_ = size + right_sides;
  stride_ = (rows_ + 1) / 2 * 2;
  entries_.assign(size_ * stride_, 0.0);
}

bool WhitenedSystem::whiten() {
  for (std::size_t first = 0; first < size_; first += kPanel) {
    const std::size_t end = std::min(first + kPanel, size_);
    if (!factor_panel(first, end)) {
      return false;
    }
    if (end - first == kPanel) {
      subtract_panel(first, end);
    }
  }
  return true;
}

bool WhitenedSystem::factor_panel(std::size_t first, std::size_t end) {
  for (std::size_t k = first; k < end; ++k) {
    double* const own = column_of(k);
    for (std::size_t before = first; before < k; ++before) {
      const double* const other = column_of(before);
      subtract_from_one(other + k, other[k], rows_ - k, own + k);
    }
    if (!(own[k] > 0.0) || !std::isfinite(own[k])) {
      return false;
    }
    own[k] = std::sqrt(own[k]);
    const double inverse = 1.0 / own[k];
    for (std::size_t i = k + 1; i < rows_; ++i) {
      own[i] *= inverse;
    }
  }
  return true;
}

void WhitenedSystem::subtract_panel(std::size_t first, std::size_t from) {
  for (std::size_t j = from; j < size_; j += 2) {
    Columns columns{};
    Factors f{};
    for (std::size_t k = 0; k < kPanel; ++k) {
      columns[k] = column_of(first + k) + j;
      f[k] = columns[k][0];
    }
    const std::size_t rows = rows_ - j;
    if (j + 1 < size_) {
      Factors g{};
      std::transform(columns.begin(), columns.end(), g.begin(),
                     [](const double* column) { return column[1]; });
      // Row j of column j + 1 lies above the diagonal and is never read.
      subtract_from_two(columns, f, g, rows, column_of(j) + j, column_of(j + 1) + j);
    } else {
      for (std::size_t k = 0; k < kPanel; ++k) {
        subtract_from_one(columns[k], f[k], rows, column_of(j) + j);
      }
    }
  }
}

double WhitenedSystem::log_determinant() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < size_; ++k) {
    sum += std::log(entries_[k * stride_ + k]);
  }
  return 2.0 * sum;
}

}  // namespace orthonav::nav
