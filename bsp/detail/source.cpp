// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/source.h>

#include <cstdlib>
#include <string>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

std::uint64_t next_serial() {
    static std::atomic<std::uint64_t> serial{0};
    return ++serial;
}

}  // namespace

std::shared_ptr<const Source> Source::share(Source* source) {
    source->serial_ = next_serial();
    source->retain();
    return {source, [](const Source* s) { s->release(); }};
}

std::shared_ptr<const Source> Source::make(LatticeMesh mesh) {
    auto* s = new Source;
    auto shared = share(s);
    s->mesh_ = std::move(mesh);
    for (const LatticePoint& p : s->mesh_.points) s->box_.add(p);
    return shared;
}

std::shared_ptr<const Source> Source::half_space(const Plane& plane, Lattice lattice) {
    auto* s = new Source;
    auto shared = share(s);
    s->half_space_ = true;
    s->plane_ = plane;
    s->mesh_.lattice = lattice;
    s->box_.lo.fill(-coordinate_limit);
    s->box_.hi.fill(coordinate_limit);
    return shared;
}

Plane Source::support(std::uint32_t facet) const {
    if (half_space_) return plane_;
    return Plane::through(corner(facet, 0), corner(facet, 1), corner(facet, 2));
}

// The normal of the plane along axis k is (b - a) × e_k, and the third corner c is at
// ((b - a) × e_k) · (c - a) = -n_k, n being the support's normal: below when n_k > 0.
Plane Source::edge_plane(std::uint32_t facet, int i, const Plane& support) const {
    const int k = support.dominant_axis();
    const LatticePoint& a = corner(facet, i);
    const LatticePoint& b = corner(facet, (i + 1) % 3);
    return support.normal(k) > 0 ? Plane::along_axis(a, b, k) : Plane::along_axis(b, a, k);
}

std::shared_ptr<const Source> Source::numbered(std::shared_ptr<const Source> source,
                                               std::uint64_t serial) {
    const_cast<Source&>(*source).serial_ = serial;  // nobody else has seen it yet
    return source;
}

std::shared_ptr<const Source> Source::refined(int exponent) const {
    const int shift = mesh_.lattice.exponent - exponent;
    TRISECT_EXPECTS(shift >= 0, "a source can only move to a finer lattice");
    if (half_space_) {
        if (shift > 48)
            throw LimitError("a half-space of unit 2^" + std::to_string(mesh_.lattice.exponent) +
                             " cannot move to the lattice of unit 2^" + std::to_string(exponent));
        const Plane p(plane_.normal(0), plane_.normal(1), plane_.normal(2),
                      plane_.offset().shifted_left(shift));
        return numbered(half_space(p, Lattice{exponent}), serial_);
    }
    LatticeMesh fine = mesh_;
    fine.lattice.exponent = exponent;
    for (LatticePoint& p : fine.points) {
        for (const std::int64_t c : {p.x, p.y, p.z}) {
            if (shift >= coordinate_bits || std::abs(c) >= (coordinate_limit >> shift))
                throw LimitError(
                    "operands of units 2^" + std::to_string(mesh_.lattice.exponent) + " and 2^" +
                    std::to_string(exponent) +
                    " have no common lattice: their sizes differ too much; coordinate " +
                    std::to_string(c) + " of the coarser one would not fit");
        }
        p = {p.x << shift, p.y << shift, p.z << shift};
    }
    return numbered(make(std::move(fine)), serial_);
}

}  // namespace trisect::detail
