// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/source.h>

#include <cstdlib>
#include <string>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/parallel_parts.h>

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

std::shared_ptr<const Source> Source::make(LatticeMesh mesh, std::uint32_t threads) {
    auto* s = new Source;
    auto shared = share(s);
    s->mesh_ = std::move(mesh);
    const std::span<const LatticePoint> points = s->mesh_.points;
    const ParallelParts parts(points.size(), threads, std::size_t{1} << 16);
    std::vector<Box> boxes(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        Box box;
        for (const LatticePoint& p : points.subspan(begin, end - begin)) box.add(p);
        boxes[part] = box;
    });
    for (const Box& b : boxes) s->box_.add(b);
    return shared;
}

std::shared_ptr<const Source> Source::half_space(const Plane& plane, Lattice lattice) {
    Box everywhere;
    everywhere.lo.fill(-coordinate_limit);
    everywhere.hi.fill(coordinate_limit);
    return planes({plane}, lattice, everywhere);
}

std::shared_ptr<const Source> Source::planes(std::vector<Plane> planes, Lattice lattice,
                                             const Box& box) {
    TRISECT_EXPECTS(!planes.empty(), "a source of planes has some");
    auto* s = new Source;
    auto shared = share(s);
    s->planes_ = std::move(planes);
    s->mesh_.lattice = lattice;
    s->box_ = box;
    return shared;
}

Plane Source::support(std::uint32_t facet) const {
    if (is_half_space()) return planes_[facet];
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
    const_cast<Source&>(*source).serial_ = serial;  // it is not shared yet
    return source;
}

std::shared_ptr<const Source> Source::refined(int exponent) const {
    const int shift = mesh_.lattice.exponent - exponent;
    TRISECT_EXPECTS(shift >= 0, "a source can only move to a finer lattice");
    if (is_half_space()) return refined_planes(exponent, shift);
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

std::shared_ptr<const Source> Source::refined_planes(int exponent, int shift) const {
    if (shift > 48)
        throw LimitError((facet_count() == 1 ? "a half-space of unit 2^" : "planes of unit 2^") +
                         std::to_string(mesh_.lattice.exponent) +
                         " cannot move to the lattice of unit 2^" + std::to_string(exponent));
    std::vector<Plane> fine;
    fine.reserve(planes_.size());
    for (const Plane& p : planes_)
        fine.emplace_back(p.normal(0), p.normal(1), p.normal(2), p.offset().shifted_left(shift));
    Box box = box_;
    if (!is_unbounded())
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] *= std::int64_t{1} << shift;
            box.hi[k] *= std::int64_t{1} << shift;
        }
    return numbered(planes(std::move(fine), Lattice{exponent}, box), serial_);
}

}  // namespace trisect::detail
