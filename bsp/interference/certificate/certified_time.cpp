// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/certified_time.h>

#include <cstdint>
#include <optional>

namespace trisect::detail::certified {

namespace {

// Zero where p has a root of odd multiplicity, that is where it changes its sign, and nowhere else.
// The common divisor of p and its derivative has all roots of p, one time less each.
Polynomial sign_changes_of(const Polynomial& p) {
    if (p.degree() == 0) return ExactRational(1);
    const Polynomial repeated = common_divisor(p, p.derivative());
    return quotient(quotient(p, repeated), sign_changes_of(repeated));
}

// Without a root at a point, if it has a single one there.
Polynomial without_root_at(const Polynomial& p, const ExactRational& at) {
    if (p.sign_at(at) != 0) return p;
    return quotient(p, Polynomial(std::vector<ExactRational>{-at, ExactRational(1)}));
}

// The sign of p at some point of an open interval that is no root. \pre p is not zero
int sign_within(const Polynomial& p, const ExactRational& from, const ExactRational& to) {
    const auto parts = static_cast<std::int64_t>(p.degree() + 2);
    for (std::int64_t i = 1; i < parts; ++i) {
        const ExactRational at = from + (to - from) * ExactRational(i) / ExactRational(parts);
        if (const int s = p.sign_at(at); s != 0) return s;
    }
    return 0;
}

}  // namespace

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
    for (int i = 0; i < 2000; ++i) {
        if (roots_between(p, low, high) == 0) return p.sign_at(low);
        const ExactRational middle = (low + high) / ExactRational(2);
        if (polynomial_.sign_at(middle) == 0) return p.sign_at(middle);
        // By counts: signs are the same on both sides of a double root.
        (roots_between(polynomial_, low, middle) == 1 ? high : low) = middle;
    }
    return 2;
}

bool RootTime::is_positive_before(const Polynomial& p, const ExactRational& from) const {
    if (p.is_zero() || p.sign_at(from) <= 0) return false;
    // A root right at the end of the bracket is none before the contact.
    Polynomial rest = p;
    const Polynomial to_end(std::vector<ExactRational>{upper_, ExactRational(-1)});
    while (rest.sign_at(upper_) == 0) rest = quotient(std::move(rest), to_end);
    const std::optional<int> n = roots_between(rest, from, upper_);
    return n == 0 || (n == 1 && is_root_of(rest));
}

bool RootTime::is_not_negative_before(const Polynomial& p, const ExactRational& from) const {
    if (p.is_zero()) return true;
    if (!(from < lower_) || sign_within(p, from, lower_) <= 0) return false;
    const Polynomial changes = without_root_at(sign_changes_of(p), from);
    if (changes.degree() == 0) return true;
    const std::optional<int> n = roots_between(changes, from, upper_);
    return n == 0 || (n == 1 && is_root_of(changes));
}

bool RootTime::is_positive_after(const Polynomial& p, const ExactRational& until) const {
    if (p.is_zero() || !(upper_ <= until)) return false;
    if (p.sign_at(upper_) <= 0 || p.sign_at(until) <= 0) return false;
    if (p.degree() == 0) return true;
    const std::optional<int> n = roots_between(p, lower_, until);
    return n == 0 || (n == 1 && is_root_of(p));
}

bool is_not_negative(const Polynomial& p, const ExactRational& from, const ExactRational& to) {
    if (p.is_zero()) return true;
    if (!(from < to) || sign_within(p, from, to) <= 0) return false;
    const Polynomial changes = without_root_at(without_root_at(sign_changes_of(p), from), to);
    return changes.degree() == 0 || roots_between(changes, from, to) == 0;
}

bool is_positive_after_zero(Polynomial p, const ExactRational& until) {
    if (p.is_zero()) return false;
    const Polynomial time(std::vector<ExactRational>{0, 1});
    while (p.sign_at(0) == 0) p = quotient(std::move(p), time);
    return is_positive(p, 0, until);
}

bool is_positive(const Polynomial& p, const ExactRational& from, const ExactRational& to) {
    return !p.is_zero() && p.sign_at(from) > 0 && p.sign_at(to) > 0 &&
           (p.degree() == 0 || roots_between(p, from, to) == 0);
}

}  // namespace trisect::detail::certified
