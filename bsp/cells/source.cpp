// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/source.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/number/vector3.h>
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
    source->operand_ = static_cast<std::uint32_t>(source->serial_);
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
    std::vector<std::uint8_t> whole(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        Box box;
        bool all = true;
        for (const LatticePoint& p : points.subspan(begin, end - begin)) {
            box.add(p);
            all = all && p.is_whole();
        }
        boxes[part] = box;
        whole[part] = all ? 1 : 0;
    });
    for (const Box& b : boxes) s->box_.add(b);
    s->whole_ = std::ranges::all_of(whole, [](std::uint8_t all) { return all != 0; });
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
    s->whole_ = std::ranges::all_of(s->planes_, [](const Plane& p) { return p.tier() <= 1; });
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
    const int k = edge_axis(support);
    const LatticePoint& a = corner(facet, i);
    const LatticePoint& b = corner(facet, (i + 1) % 3);
    return support.normal(k) > 0 ? Plane::along_axis(a, b, k) : Plane::along_axis(b, a, k);
}

int Source::edge_axis(const Plane& support) const {
    return support.largest_normal(axes_[0], axes_[1], axes_[2]);
}

// The source is not shared yet.
std::shared_ptr<const Source> Source::renamed_as_this(std::shared_ptr<const Source> source) const {
    auto& made = const_cast<Source&>(*source);
    made.operand_ = operand_;
    made.names_ = names_;
    made.axes_ = axes_;
    return source;
}

std::shared_ptr<const Source> Source::named(std::shared_ptr<const Source> source,
                                            std::vector<FaceSource> names) {
    auto& made = const_cast<Source&>(*source);
    made.names_ = std::make_shared<const std::vector<FaceSource>>(std::move(names));
    return source;
}

std::shared_ptr<const Source> Source::moved(const LatticeMove& move) const {
    std::shared_ptr<const Source> out;
    if (is_half_space()) {
        std::vector<Plane> planes;
        planes.reserve(planes_.size());
        for (const Plane& p : planes_) planes.push_back(move.applied(p));
        out = Source::planes(std::move(planes), mesh_.lattice,
                             is_unbounded() ? box_ : move.applied(box_));
    } else {
        LatticeMesh mesh = mesh_;
        for (LatticePoint& p : mesh.points) p = move.applied(p);
        if (move.is_mirror())
            for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
        out = make(std::move(mesh));
    }
    out = renamed_as_this(std::move(out));
    for (std::size_t i = 0; i < 3; ++i)
        const_cast<Source&>(*out).axes_[i] =
            static_cast<std::uint8_t>(move.image_of_axis(axes_[i]));
    return out;
}

std::shared_ptr<const Source> Source::refined(int exponent) const {
    const int shift = mesh_.lattice.exponent - exponent;
    TRISECT_EXPECTS(shift >= 0, "a source can only move to a finer lattice");
    if (is_half_space()) return refined_planes(exponent, shift);
    LatticeMesh fine = mesh_;
    fine.lattice.exponent = exponent;
    for (LatticePoint& p : fine.points) {
        for (const std::int64_t c : to_integers(p)) {
            if (shift >= coordinate_bits || std::abs(c) >= (coordinate_limit >> shift))
                throw LimitError(
                    "operands of units 2^" + std::to_string(mesh_.lattice.exponent) + " and 2^" +
                    std::to_string(exponent) +
                    " have no common lattice: their sizes differ too much; coordinate " +
                    std::to_string(c) + " of the coarser one would not fit");
        }
        const auto moved = [factor = std::ldexp(1, shift)](Coordinate c) {
            return Coordinate(c.to_double() * factor);
        };
        p = {moved(p.x), moved(p.y), moved(p.z)};
    }
    auto out = renamed_as_this(make(std::move(fine)));
    const_cast<Source&>(*out).serial_ = serial_;
    return out;
}

// n · x + d with x = X 2^k: the normal or the offset takes up the power of two.
std::shared_ptr<const Source> Source::half_space_on(int exponent) const {
    constexpr int normal_bits = 109;  // see plane.h
    constexpr int offset_bits = 162;
    const Plane& p = planes_[0];
    const int power = exponent - mesh_.lattice.exponent;
    std::array<BoundedInt, 4> n{p.normal(0), p.normal(1), p.normal(2), p.offset()};
    const auto shift_of = [&](std::size_t i) {
        return (i < 3) == (power > 0) ? std::abs(power) : 0;
    };
    int common = std::numeric_limits<int>::max();  // power of two
    for (std::size_t i = 0; i < 4; ++i)
        if (!n[i].is_zero()) common = std::min(common, n[i].trailing_zeros() + shift_of(i));
    for (std::size_t i = 0; i < 4; ++i) {
        if (n[i].is_zero()) continue;
        const int by = shift_of(i) - common;
        if (n[i].bit_length() + by > (i < 3 ? normal_bits : offset_bits))
            throw LimitError("a half-space of unit 2^" + std::to_string(mesh_.lattice.exponent) +
                             " cannot move to the lattice of unit 2^" + std::to_string(exponent));
        n[i] = by >= 0 ? n[i].shifted_left(by) : n[i].shifted_right(-by);
    }
    auto out = renamed_as_this(half_space(
        Plane(n[0].to_wide<6>(), n[1].to_wide<6>(), n[2].to_wide<6>(), n[3].to_wide<6>()),
        Lattice{exponent}));
    const_cast<Source&>(*out).serial_ = serial_;
    return out;
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
    auto out = renamed_as_this(planes(std::move(fine), Lattice{exponent}, box));
    const_cast<Source&>(*out).serial_ = serial_;
    return out;
}

}  // namespace trisect::detail
