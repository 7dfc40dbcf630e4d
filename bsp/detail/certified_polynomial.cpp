// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/certified_polynomial.h>

#include <trisect/brep/detail/gmp_conversion.h>
#include <trisect/bsp/detail/motion_piece.h>

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

// Where all coefficients of Bernstein's are positive, so is the polynomial: b(k) is the sum of
// (k choose j) / (n choose j) c(j). Sturm's theorem decides the others.
bool is_positive_on_unit(const Polynomial& p) {
    if (p.is_zero()) return false;
    const std::size_t n = p.degree();
    bool all = true;
    for (std::size_t k = 0; all && k <= n; ++k) {
        ExactRational sum;
        ExactRational factor(1);
        for (std::size_t j = 0; j <= k; ++j) {
            sum += factor * p.coefficient(j);
            if (j < k)
                factor *= ExactRational(static_cast<std::int64_t>(k - j)) /
                          ExactRational(static_cast<std::int64_t>(n - j));
        }
        all = sum.sign() > 0;
    }
    return all || (p.sign_at(0) > 0 && roots_between(p, 0, 1) == 0);
}

namespace {

Polynomial converted(const IntegerPolynomial& p) {
    std::vector<ExactRational> c;
    for (const mpz_class& v : p.coefficients()) c.push_back(from_gmp(mpq_class(v)));
    return Polynomial(std::move(c));
}

}  // namespace

Piece piece_of(const Motion& motion, std::size_t i) {
    const MotionPiece& p = motion.piece(std::min(i, motion.piece_count() - 1));
    Piece r;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j) r.m[k][j] = converted(p.matrix[k][j]);
        r.t[k] = converted(p.shift[k]);
    }
    r.w = converted(p.weight);
    return r;
}

}  // namespace trisect::detail::certified
