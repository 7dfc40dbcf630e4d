// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/certified_time.h>

namespace trisect::detail::certified {

std::string RootTime::wrong() const {
    if (!(lower_ < upper_) || polynomial_.is_zero()) return "there is no bracket";
    if (lower_.sign() < 0 || ExactRational(1) < lower_) return "the bracket is elsewhere";
    if (roots_between(polynomial_, lower_, upper_) != 1) return "the bracket holds no single root";
    // Not after the end of the piece.
    if (ExactRational(1) < upper_ && polynomial_.sign_at(1) != 0 &&
        roots_between(polynomial_, lower_, 1) != 1)
        return "the contact is after the end";
    return {};
}

bool RootTime::is_root_of(const Polynomial& p) const {
    if (p.is_zero()) return true;
    const Polynomial common = common_divisor(polynomial_, p);
    return common.degree() > 0 && roots_between(common, lower_, upper_) == 1;
}

int RootTime::sign_of(const Polynomial& p) const {
    if (is_root_of(p)) return 0;
    ExactRational low = lower_;
    ExactRational high = upper_;
    const int above_low = polynomial_.sign_at(low);
    for (int i = 0; i < 2000; ++i) {
        if (const auto n = roots_between(p, low, high); n && *n == 0) return p.sign_at(low);
        const ExactRational middle = (low + high) / ExactRational(2);
        const int s = polynomial_.sign_at(middle);
        if (s == 0) return p.sign_at(middle);
        (s == above_low ? low : high) = middle;
    }
    return 2;
}

bool RootTime::is_positive_before(const Polynomial& p, const ExactRational& from) const {
    if (p.is_zero() || p.sign_at(from) <= 0) return false;
    if (p.degree() == 0) return true;
    // A root right at the end of the bracket is none before the contact.
    if (p.sign_at(upper_) == 0)
        return roots_between(p, from, lower_) == 0 && p.sign_at(lower_) > 0 && is_root_of(p);
    const std::optional<int> n = roots_between(p, from, upper_);
    return n == 0 || (n == 1 && is_root_of(p));
}

bool is_positive(const Polynomial& p, const ExactRational& from, const ExactRational& to) {
    return !p.is_zero() && p.sign_at(from) > 0 && p.sign_at(to) > 0 &&
           (p.degree() == 0 || roots_between(p, from, to) == 0);
}

}  // namespace trisect::detail::certified
