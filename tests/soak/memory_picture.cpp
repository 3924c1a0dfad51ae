#include "tests/soak/memory_picture.h"

#include <algorithm>
#include <cmath>

#include "engine/report/html_text.h"

namespace orthonav::soak {
namespace {

using engine::formatted;

constexpr double kWidth = 720.0;
constexpr double kHeight = 300.0;
constexpr double kLeft = 60.0;
constexpr double kTop = 20.0;
constexpr double kRight = 20.0;
constexpr double kBottom = 50.0;

/// A round step with which at most eight lines reach `most`.
double step_to(double most) {
  double step = std::pow(10.0, std::floor(std::log10(std::max(most, 1.0) / 8.0)));
  for (const double factor : {2.0, 2.5, 2.0, 2.0}) {
    step *= most / step > 8.0 ? factor : 1.0;
  }
  return step;
}

class Axes {
 public:
  Axes(std::size_t operations, double most_mib)
      : operations_(static_cast<double>(std::max<std::size_t>(operations, 2))),
        step_mib_(step_to(most_mib)),
        top_mib_(step_mib_ * std::ceil(1.1 * most_mib / step_mib_)) {}
  /// Of the n-th operation, from 1.
  [[nodiscard]] double x(double operation) const {
    return kLeft + (kWidth - kLeft - kRight) * (operation - 1.0) / (operations_ - 1.0);
  }
  [[nodiscard]] double y(double mib) const {
    return kHeight - kBottom - (kHeight - kTop - kBottom) * mib / top_mib_;
  }
  [[nodiscard]] std::string drawn() const {
    std::string out;
    for (double mib = 0.0; mib <= top_mib_ * 1.001; mib += step_mib_) {
      out += formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\"", kLeft, y(mib), kWidth - kRight);
      out += formatted(" y2=\"%.1f\" stroke=\"#ddd\"/>\n", y(mib));
      out += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%.0f</text>\n", kLeft - 8.0,
                       y(mib) + 4.0, mib);
    }
    const double every = std::max(1.0, step_to(operations_));
    for (double operation = 1.0; operation <= operations_;
         operation += operation == 1.0 && every > 1.0 ? every - 1.0 : every) {
      out += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%.0f</text>\n",
                       x(operation), kHeight - kBottom + 18.0, operation);
    }
    return out;
  }

 private:
  double operations_;
  double step_mib_;
  double top_mib_;
};

/// Through the median of what came after the warm-up.
std::string line_of_growth(const Axes& axes, const std::vector<double>& resident_kib,
                           std::size_t warm_up, double growth_kib) {
  std::vector<double> warm(resident_kib.begin() + static_cast<std::ptrdiff_t>(warm_up),
                           resident_kib.end());
  const double half_kib = 0.5 * static_cast<double>(warm.size() - 1) * growth_kib;
  const auto middle = warm.begin() + static_cast<std::ptrdiff_t>(warm.size() / 2);
  std::nth_element(warm.begin(), middle, warm.end());
  return formatted(
      "<path d=\"M%.1f %.1f L%.1f %.1f\" stroke=\"#c0392b\"/>\n",
      axes.x(static_cast<double>(warm_up) + 1.0), axes.y((*middle - half_kib) / 1024.0),
      axes.x(static_cast<double>(resident_kib.size())), axes.y((*middle + half_kib) / 1024.0));
}

}  // namespace

std::string memory_picture(const std::vector<double>& resident_kib, std::size_t warm_up,
                           double growth_kib) {
  const double most_kib =
      resident_kib.empty() ? 0.0 : *std::max_element(resident_kib.begin(), resident_kib.end());
  const Axes axes(resident_kib.size(), std::max(most_kib / 1024.0, 1.0));
  std::string svg = formatted(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" "
      "fill=\"#fff\"/>\n",
      kWidth, kHeight);
  svg += axes.drawn();
  for (std::size_t i = 0; i < resident_kib.size(); ++i) {
    svg += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2\" fill=\"",
                     axes.x(static_cast<double>(i) + 1.0), axes.y(resident_kib[i] / 1024.0));
    svg += i < warm_up ? "#bbb\"/>\n" : "#1f5fa8\"/>\n";
  }
  if (resident_kib.size() > warm_up + 1) {
    svg += line_of_growth(axes, resident_kib, warm_up, growth_kib);
  }
  svg += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">operation</text>\n",
                   0.5 * (kLeft + kWidth - kRight), kHeight - 8.0);
  svg += formatted(
      "<text transform=\"translate(16 %.1f) rotate(-90)\" text-anchor=\"middle\">resident memory "
      "[MiB], %+.1f KiB an operation</text>\n</svg>\n",
      0.5 * (kTop + kHeight - kBottom), growth_kib);
  return svg;
}

}  // namespace orthonav::soak
