// SPDX-License-Identifier: Apache-2.0
//
// Time of contact, for the checkers of certificates.
// Of the searches for certificates only that of overlaps uses it, through its checker
// (certified_clearance.h).
#pragma once

#include <string>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_polynomial.h>

namespace trisect::detail::certified {

/// The only root of a polynomial in an open interval.
class RootTime {
public:
    RootTime() = default;
    RootTime(const std::vector<ExactRational>& polynomial, ExactRational lower, ExactRational upper)
        : polynomial_(polynomial), lower_(std::move(lower)), upper_(std::move(upper)) {}

    /// Why this is no such root, or none from 0 to 1; or "".
    [[nodiscard]] std::string wrong() const;

    [[nodiscard]] const ExactRational& lower() const { return lower_; }
    [[nodiscard]] const ExactRational& upper() const { return upper_; }
    /// Whether p is 0 at this time.
    [[nodiscard]] bool is_root_of(const Polynomial& p) const;
    /// The sign of p at this time; 2 when the bracket must be too narrow to see it.
    [[nodiscard]] int sign_of(const Polynomial& p) const;
    /// Whether p is positive from a time below the bracket up to this one, itself excluded.
    [[nodiscard]] bool is_positive_before(const Polynomial& p, const ExactRational& from) const;
    /// Whether p is nowhere negative from a time below the bracket up to this one.
    [[nodiscard]] bool is_not_negative_before(const Polynomial& p, const ExactRational& from) const;
    /// Whether p is positive from this time on, itself excluded, up to a time above the bracket.
    [[nodiscard]] bool is_positive_after(const Polynomial& p, const ExactRational& until) const;

private:
    Polynomial polynomial_;
    ExactRational lower_;
    ExactRational upper_;
};

/// Whether p is positive in a closed range.
[[nodiscard]] bool is_positive(const Polynomial& p, const ExactRational& from,
                               const ExactRational& to);
[[nodiscard]] bool is_not_negative(const Polynomial& p, const ExactRational& from,
                                   const ExactRational& to);
/// Whether p is positive from 0 on, itself excluded, up to a time.
[[nodiscard]] bool is_positive_after_zero(Polynomial p, const ExactRational& until);

}  // namespace trisect::detail::certified
