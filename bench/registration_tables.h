#pragma once

#include <string>
#include <vector>

#include "bench/registration_runs.h"

namespace orthonav::bench {

/// Markdown, to standard output: how often each method is right, what it accepts, errors, times.
void print_success(const std::vector<Run>& runs, const std::vector<RegistrationMethod>& methods,
                   const std::vector<test::StrokeVariant>& variants);
/// A row for each method and kind of strokes, with 95 % intervals (Wilson), under its own header.
void print_summary_head();
void print_summary(const std::string& truth, const std::vector<Run>& runs,
                   const std::vector<RegistrationMethod>& methods,
                   const std::vector<test::StrokeVariant>& variants);
/// Errors of each method minus those of the first, over the runs that both get right.
void print_against_first(const std::vector<Run>& runs,
                         const std::vector<RegistrationMethod>& methods,
                         const std::vector<test::StrokeVariant>& variants);
/// How many errors lie within their predictions, for the methods that predict errors.
void print_honesty(const std::vector<Run>& runs, const std::vector<RegistrationMethod>& methods,
                   const std::vector<test::StrokeVariant>& variants);
void print_wrong_levels(const std::vector<WrongLevelRun>& runs,
                        const std::vector<RegistrationMethod>& methods,
                        const std::vector<test::StrokeVariant>& variants);
/// One line per run.
void print_each(const std::vector<Run>& runs, const std::vector<RegistrationMethod>& methods);

}  // namespace orthonav::bench
