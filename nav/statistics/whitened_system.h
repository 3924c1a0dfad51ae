#pragma once

#include <cstddef>
#include <vector>

namespace orthonav::nav {

/// A covariance matrix C = L·Lᵀ (L lower triangular) with right-hand sides B, for generalised least
/// squares: `whiten` turns B into L⁻¹·B. Storage is kept from one system to the next. Of C only the
/// lower triangle is read.
class WhitenedSystem {
 public:
  /// Every entry zero.
  void reset(std::size_t size, std::size_t right_sides);

  [[nodiscard]] double& covariance(std::size_t row, std::size_t column) {
    return column_of(column)[row];
  }
  [[nodiscard]] double& right_side(std::size_t row, std::size_t side) {
    return column_of(row)[size_ + side];
  }
  /// The right-hand sides of one row, beside each other.
  [[nodiscard]] const double* right_sides(std::size_t row) const {
    return entries_.data() + row * stride_ + size_;
  }
  /// Row `column` and those below it.
  [[nodiscard]] double* column_of(std::size_t column) { return entries_.data() + column * stride_; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Blocked Cholesky factorization (Golub & Van Loan, Matrix Computations, section 4.2.6); the
  /// right-hand sides are carried along as further rows. False where C is not positive definite;
  /// the contents are then undefined.
  [[nodiscard]] bool whiten();
  /// log det C, after `whiten`.
  [[nodiscard]] double log_determinant() const;

 private:
  [[nodiscard]] bool factor_panel(std::size_t first, std::size_t end);
  void subtract_panel(std::size_t first, std::size_t from);

  std::size_t size_ = 0;
  std::size_t rows_ = 0;    ///< of a column: those of C and one for each right-hand side
  std::size_t stride_ = 0;  ///< rows_ rounded up to an even number
  std::vector<double> entries_;
};

}  // namespace orthonav::nav
