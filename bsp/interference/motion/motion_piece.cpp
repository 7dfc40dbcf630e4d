// SPDX-License-Identifier: Apache-2.0
//
// With the point map x' = (M x + t) / w and C the matrix of cofactors of M, for which
// C u × ... (M u) × (M v) = C (u × v) holds,
//
//   plane  n·x + d  ->  w (C n)·x' + det(M) d - (C n)·t        (a multiple: det(M) (n·x + d))
//   line   (u, x×u) ->  direction w M u, moment C (x×u) + t × (M u)   (both times w^2)
//
// For a rotation M = w R the cofactors are w M, so every entry of these maps is divisible by a
// power of w; in general by whatever the greatest common divisor finds. Common factors have no root
// in the interval: they divide the weight or the determinant, which have none. So roots are kept.

#include <trisect/bsp/interference/motion/motion_piece.h>

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

using Entries = std::vector<IntegerPolynomial*>;

void append(Entries& entries, PolynomialVector& v) {
    for (IntegerPolynomial& p : v) entries.push_back(&p);
}
void append(Entries& entries, PolynomialMatrix& m) {
    for (PolynomialVector& row : m) append(entries, row);
}

// Divides by the common divisor, including that of the numbers. Signs are kept.
void divide_by_common(const Entries& entries) {
    IntegerPolynomial common;
    mpz_class content;
    for (const IntegerPolynomial* p : entries) {
        if (p->is_zero()) continue;
        if (common.degree() != 0) common = gcd(common, *p);
        for (const mpz_class& c : p->coefficients())
            mpz_gcd(content.get_mpz_t(), content.get_mpz_t(), c.get_mpz_t());
    }
    if (common.is_zero()) return;
    for (IntegerPolynomial* p : entries) {
        if (p->is_zero()) continue;
        std::vector<mpz_class> c = p->coefficients();
        for (mpz_class& v : c) mpz_divexact(v.get_mpz_t(), v.get_mpz_t(), content.get_mpz_t());
        *p = IntegerPolynomial(std::move(c));
        if (common.degree() > 0) *p = exact_quotient(*p, common);
    }
}

// Columns of the matrix of t × (m u).
PolynomialMatrix cross_matrix(const PolynomialVector& t, const PolynomialMatrix& m) {
    PolynomialMatrix r;
    for (std::size_t j = 0; j < 3; ++j) {
        const PolynomialVector column = cross(t, {m[0][j], m[1][j], m[2][j]});
        for (std::size_t i = 0; i < 3; ++i) r[i][j] = column[i];
    }
    return r;
}

mpz_class two_to_the(int exponent) { return mpz_class(1) << static_cast<unsigned>(exponent); }

// p(from + (to - from) u) times the n-th power of a number that is the same for all polynomials.
IntegerPolynomial on_part(const IntegerPolynomial& p, int n, const mpq_class& from,
                          const mpq_class& to) {
    const mpq_class span = to - from;
    std::vector<mpq_class> r;  // Horner's scheme
    for (int i = p.degree(); i >= 0; --i) {
        r.emplace_back(0);
        for (std::size_t k = r.size() - 1; k > 0; --k) r[k] = r[k] * from + r[k - 1] * span;
        r[0] = r[0] * from + p[i];
    }
    const mpz_class unit = from.get_den() * to.get_den();
    mpz_class scale = 1;
    for (int i = 0; i < n; ++i) scale *= unit;
    std::vector<mpz_class> c;
    for (const mpq_class& v : r) c.push_back(mpq_class(v * scale).get_num());
    return IntegerPolynomial(std::move(c));
}

}  // namespace

PolynomialMatrix operator*(const PolynomialMatrix& a, const PolynomialMatrix& b) {
    PolynomialMatrix r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    return r;
}

PolynomialVector operator*(const PolynomialMatrix& a, const PolynomialVector& b) {
    return {dot(a[0], b), dot(a[1], b), dot(a[2], b)};
}

PolynomialVector operator*(const PolynomialVector& a, const IntegerPolynomial& b) {
    return {a[0] * b, a[1] * b, a[2] * b};
}

PolynomialMatrix operator*(const PolynomialMatrix& a, const IntegerPolynomial& b) {
    return {a[0] * b, a[1] * b, a[2] * b};
}

PolynomialVector operator+(const PolynomialVector& a, const PolynomialVector& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

PolynomialMatrix transposed(const PolynomialMatrix& a) {
    PolynomialMatrix r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) r[i][j] = a[j][i];
    return r;
}

PolynomialMatrix cofactors(const PolynomialMatrix& m) {
    return {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
}

IntegerPolynomial determinant(const PolynomialMatrix& m) { return dot(cross(m[0], m[1]), m[2]); }

MotionPiece MotionPiece::still() {
    MotionPiece r;
    for (std::size_t i = 0; i < 3; ++i) r.matrix[i][i] = mpz_class(1);
    r.weight = mpz_class(1);
    return r;
}

void MotionPiece::reduce() {
    Entries entries{&weight};
    append(entries, matrix);
    append(entries, shift);
    divide_by_common(entries);
    if (weight.sign_at(0) > 0) return;
    for (IntegerPolynomial* p : entries) *p *= -1;
}

int MotionPiece::degree() const {
    int d = weight.degree();
    for (std::size_t i = 0; i < 3; ++i) {
        d = std::max(d, shift[i].degree());
        for (std::size_t j = 0; j < 3; ++j) d = std::max(d, matrix[i][j].degree());
    }
    return d;
}

MotionPiece operator*(const MotionPiece& a, const MotionPiece& b) {
    MotionPiece r;
    r.matrix = a.matrix * b.matrix;
    r.shift = a.matrix * b.shift + a.shift * b.weight;
    r.weight = a.weight * b.weight;
    r.reduce();
    return r;
}

MotionPiece inverse(const MotionPiece& a) {
    MotionPiece r;
    const PolynomialMatrix adjugate = transposed(cofactors(a.matrix));
    r.matrix = adjugate * a.weight;
    r.shift = adjugate * (PolynomialVector{} - a.shift);
    r.weight = determinant(a.matrix);
    r.reduce();
    return r;
}

MotionPiece part_of(const MotionPiece& piece, const mpq_class& from, const mpq_class& to) {
    const int n = piece.degree();
    MotionPiece r;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j)
            r.matrix[k][j] = on_part(piece.matrix[k][j], n, from, to);
        r.shift[k] = on_part(piece.shift[k], n, from, to);
    }
    r.weight = on_part(piece.weight, n, from, to);
    r.reduce();
    return r;
}

MotionPiece rotation_by(const std::array<IntegerPolynomial, 4>& q) {
    const auto& [a, b, c, d] = q;
    const mpz_class two = 2;
    MotionPiece r;
    r.matrix = {PolynomialVector{a * a + b * b - c * c - d * d, (b * c - a * d) * two,
                                 (b * d + a * c) * two},
                PolynomialVector{(b * c + a * d) * two, a * a - b * b + c * c - d * d,
                                 (c * d - a * b) * two},
                PolynomialVector{(b * d - a * c) * two, (c * d + a * b) * two,
                                 a * a - b * b - c * c + d * d}};
    r.weight = a * a + b * b + c * c + d * d;
    return r;
}

MotionPiece relative_points(const MotionPiece& a, Lattice lattice_a, const MotionPiece& b,
                            Lattice lattice_b) {
    MotionPiece point = inverse(a) * b;
    // From user's units to lattice units: x' = (M 2^eb x + t) / (w 2^ea).
    const int least = std::min({lattice_a.exponent, lattice_b.exponent, 0});
    const auto scaled = [&](int exponent) { return two_to_the(exponent - least); };
    point.matrix = point.matrix * IntegerPolynomial(scaled(lattice_b.exponent));
    point.shift = point.shift * IntegerPolynomial(scaled(0));
    point.weight *= scaled(lattice_a.exponent);
    point.reduce();
    return point;
}

RelativeMotion::RelativeMotion(const MotionPiece& a, Lattice lattice_a, const MotionPiece& b,
                               Lattice lattice_b) {
    point = relative_points(a, lattice_a, b, lattice_b);
    const PolynomialMatrix cofactor = cofactors(point.matrix);
    plane_normal = cofactor * point.weight;
    plane_shift = transposed(cofactor) * point.shift;
    plane_offset = determinant(point.matrix);
    Entries plane_entries{&plane_offset};
    append(plane_entries, plane_normal);
    append(plane_entries, plane_shift);
    divide_by_common(plane_entries);
    if (plane_offset.sign_at(0) < 0)
        for (IntegerPolynomial* p : plane_entries) *p *= -1;

    line_direction = point.matrix * point.weight;
    line_moment = cofactor;
    line_lever = cross_matrix(point.shift, point.matrix);
    Entries line_entries;
    append(line_entries, line_direction);
    append(line_entries, line_moment);
    append(line_entries, line_lever);
    divide_by_common(line_entries);
}

}  // namespace trisect::detail
