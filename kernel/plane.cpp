// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/plane.h>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/int128.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect {

using detail::difference;
using detail::magnitude;
using detail::to_integers;

namespace {

// The largest limits for which 256 bits suffice (see predicates.cpp).
constexpr Int128 narrow_normal_limit = Int128{1} << 56;
constexpr int narrow_offset_bits = 83;

// Differences of coordinates have 54 bits and their products 108: Int128 is wide enough.
std::array<Int128, 3> normal_through(const LatticePoint& a, const LatticePoint& b,
                                     const LatticePoint& c) {
    const auto u = difference(b, a);
    const auto v = difference(c, a);
    return {Int128{u[1]} * v[2] - Int128{u[2]} * v[1], Int128{u[2]} * v[0] - Int128{u[0]} * v[2],
            Int128{u[0]} * v[1] - Int128{u[1]} * v[0]};
}

Plane::Offset offset_through(const std::array<Int128, 3>& n, const LatticePoint& a) {
    using W2 = WideInt<2>;
    const auto x = to_integers(a);
    Plane::Offset d = multiply<3>(W2(n[0]), WideInt<1>(x[0]));
    d += multiply<3>(W2(n[1]), WideInt<1>(x[1]));
    d += multiply<3>(W2(n[2]), WideInt<1>(x[2]));
    return -d;
}

}  // namespace

Plane::Plane(Int128 nx, Int128 ny, Int128 nz, const Offset& d) : n_{nx, ny, nz}, d_(d) {
    for (std::size_t i = 0; i < 3; ++i) {
        fn_[i] = static_cast<double>(n_[i]);
        narrow_ = narrow_ && magnitude(n_[i]) < narrow_normal_limit;
    }
    fd_ = d_.to_double();
    narrow_ = narrow_ && d_.bit_length() <= narrow_offset_bits;
    TRISECT_AUDIT_CHECK(d_.bit_length() <= 163, "plane offset exceeds its bound");
}

Plane Plane::through(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    const auto n = normal_through(a, b, c);
    TRISECT_EXPECTS(n[0] != 0 || n[1] != 0 || n[2] != 0, "plane through collinear points");
    return {n[0], n[1], n[2], offset_through(n, a)};
}

// (b - a) × e_axis has two components of 54 bits, so that the offset fits into 128 bits.
Plane Plane::along_axis(const LatticePoint& a, const LatticePoint& b, int axis) {
    const int j = (axis + 1) % 3;
    const int l = (axis + 2) % 3;
    const std::int64_t nj = difference(b[l], a[l]);
    const std::int64_t nl = difference(a[j], b[j]);
    TRISECT_EXPECTS(nj != 0 || nl != 0, "edge parallel to the axis of its plane");
    Plane p;
    const auto set = [&](int i, std::int64_t v) {
        p.n_[static_cast<std::size_t>(i)] = v;
        p.fn_[static_cast<std::size_t>(i)] = static_cast<double>(v);
    };
    set(j, nj);
    set(l, nl);
    p.d_ = Offset(-(Int128{nj} * a[j].to_integer() + Int128{nl} * a[l].to_integer()));
    p.fd_ = p.d_.to_double();
    p.narrow_ = p.d_.bit_length() <= narrow_offset_bits;
    return p;
}

Plane Plane::axis_aligned(int axis, std::int64_t scale, std::int64_t position) {
    std::array<Int128, 3> n{};
    n[static_cast<std::size_t>(axis)] = scale;
    return {n[0], n[1], n[2], -Offset(position)};
}

Plane Plane::flipped() const { return {-n_[0], -n_[1], -n_[2], -d_}; }

int Plane::dominant_axis() const {
    int best = 0;
    for (int i = 1; i < 3; ++i)
        if (magnitude(normal(i)) > magnitude(normal(best))) best = i;
    return best;
}

bool are_collinear(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    const auto n = normal_through(a, b, c);
    return n[0] == 0 && n[1] == 0 && n[2] == 0;
}

}  // namespace trisect
