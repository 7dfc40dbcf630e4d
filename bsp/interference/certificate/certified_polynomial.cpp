// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/certified_polynomial.h>

namespace trisect::detail::certified {

Polynomial common_divisor(Polynomial a, Polynomial b) {
    while (!b.is_zero()) {
        Polynomial r = remainder(std::move(a), b);
        a = std::exchange(b, std::move(r));
    }
    return a;
}

std::optional<int> roots_between(const Polynomial& p, const ExactRational& from,
                                 const ExactRational& to) {
    if (p.sign_at(from) == 0 || p.sign_at(to) == 0) return std::nullopt;
    int lost = 0;
    Polynomial a = p;
    Polynomial b = p.derivative();
    int at_from = a.sign_at(from);
    int at_to = a.sign_at(to);
    while (!b.is_zero()) {
        const int from_next = b.sign_at(from);
        const int to_next = b.sign_at(to);
        if (from_next != 0) {
            lost += from_next != at_from ? 1 : 0;
            at_from = from_next;
        }
        if (to_next != 0) {
            lost -= to_next != at_to ? 1 : 0;
            at_to = to_next;
        }
        Polynomial r = -remainder(std::move(a), b);
        a = std::exchange(b, std::move(r));
    }
    return lost;
}

// With p(from + (to - from) u) = sum of c(j) u^j, coefficient k is the sum of
// (k choose j) / (n choose j) c(j).
std::vector<ExactRational> bernstein_coefficients(const Polynomial& p, std::size_t degree,
                                                  const ExactRational& from,
                                                  const ExactRational& to) {
    const Polynomial time(std::vector<ExactRational>{from, to - from});
    Polynomial q;
    for (std::size_t j = p.is_zero() ? 0 : p.degree() + 1; j-- > 0;)
        q = q * time + Polynomial(p.coefficient(j));
    const std::size_t terms = q.is_zero() ? 0 : q.degree() + 1;
    std::vector<ExactRational> r(degree + 1);
    for (std::size_t k = 0; k <= degree; ++k) {
        ExactRational factor(1);
        for (std::size_t j = 0; j <= k && j < terms; ++j) {
            r[k] += factor * q.coefficient(j);
            if (j < k)
                factor *= ExactRational(static_cast<std::int64_t>(k - j)) /
                          ExactRational(static_cast<std::int64_t>(degree - j));
        }
    }
    return r;
}

bool is_positive_on_unit(const Polynomial& p) {
    if (p.is_zero()) return false;
    const auto controls = bernstein_coefficients(p, p.degree(), 0, 1);
    return std::ranges::all_of(controls, [](const ExactRational& c) { return c.sign() > 0; }) ||
           (p.sign_at(0) > 0 && roots_between(p, 0, 1) == 0);
}

}  // namespace trisect::detail::certified
