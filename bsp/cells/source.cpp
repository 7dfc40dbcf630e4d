// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/source.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/serial_scope.h>

namespace trisect::detail {

namespace {

std::atomic<std::uint64_t> last_serial{0};

std::uint64_t next_serial() {
    const std::uint64_t in_scope = SerialScope::take();
    return in_scope != 0 ? in_scope : ++last_serial;
}

struct Extent {
    Box box;
    bool whole = true;
};

// Positions are in the order of coordinates. Doubles below 2^52 are whole where adding it and
// subtracting it again changes nothing, all others are.
Extent extent_of(std::span<const LatticePoint> points) {
    Extent out;
    if (points.empty()) return out;
    std::array<double, 3> lo = points[0].doubles();
    std::array<double, 3> hi = lo;
    bool whole = true;
    for (const LatticePoint& p : points) {
        const std::array<double, 3> c = p.doubles();
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = c[k] < lo[k] ? c[k] : lo[k];
            hi[k] = c[k] > hi[k] ? c[k] : hi[k];
            const double size = std::fabs(c[k]);
            whole &= (size + 0x1p52 - 0x1p52 == size) | (size >= 0x1p52);
        }
    }
    out.box.add(LatticePoint{Coordinate(lo[0]), Coordinate(lo[1]), Coordinate(lo[2])});
    out.box.add(LatticePoint{Coordinate(hi[0]), Coordinate(hi[1]), Coordinate(hi[2])});
    out.whole = whole;
    return out;
}

// Of coordinates times 2^shift, rounded outwards.
Box box_on_lattice(const Box& box, int shift) {
    Box out;
    for (std::size_t k = 0; k < 3; ++k) {
        if (shift >= 0) {
            out.lo[k] = box.lo[k] * (std::int64_t{1} << shift);
            out.hi[k] = box.hi[k] * (std::int64_t{1} << shift);
        } else {
            const int by = std::min(-shift, 62);
            out.lo[k] = box.lo[k] >> by;
            out.hi[k] = -(-box.hi[k] >> by);
        }
    }
    return out;
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
    std::vector<int> bits(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        const auto some = points.subspan(begin, end - begin);
        const Extent extent = extent_of(some);
        boxes[part] = extent.box;
        if (extent.whole) return;
        for (const LatticePoint& p : some)
            bits[part] = std::max(bits[part], trisect::detail::fraction_bits(p));
    });
    for (const Box& b : boxes) s->box_.add(b);
    s->fraction_bits_ = *std::ranges::max_element(bits);
    s->whole_ = s->fraction_bits_ == 0;
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
    made.kinds_ = kinds_;
    made.axes_ = axes_;
    return source;
}

std::shared_ptr<const Source> Source::named(std::shared_ptr<const Source> source,
                                            std::vector<FaceSource> names) {
    auto& made = const_cast<Source&>(*source);
    made.names_ = std::make_shared<const std::vector<FaceSource>>(std::move(names));
    return source;
}

std::shared_ptr<const Source> Source::of_kinds(std::shared_ptr<const Source> source,
                                               std::vector<FacetKind> kinds) {
    auto& made = const_cast<Source&>(*source);
    made.kinds_ = std::make_shared<const std::vector<FacetKind>>(std::move(kinds));
    return source;
}

std::shared_ptr<const Source> Source::stored(std::shared_ptr<const Source> source, Stored stored) {
    auto& made = const_cast<Source&>(*source);
    made.operand_ = stored.operand;
    made.axes_ = stored.axes;
    if (stored.of_same_serial != nullptr) made.serial_ = stored.of_same_serial->serial_;
    return stored.names.empty() ? source : named(source, std::move(stored.names));
}

void Source::reserve_serials(std::uint64_t largest) {
    if (largest >= std::uint64_t{1} << 31) return;
    std::uint64_t last = last_serial.load();
    while (last < largest && !last_serial.compare_exchange_weak(last, largest)) {
    }
}

std::uint64_t Source::take_serials(std::uint64_t count) { return last_serial.fetch_add(count) + 1; }

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

int Source::last_bit() const {
    if (!whole_) return -fraction_bits_;
    std::uint64_t bits = 0;
    for (const LatticePoint& p : mesh_.points)
        for (const Coordinate c : {p.x, p.y, p.z})
            bits |= static_cast<std::uint64_t>(c.to_integer());
    return std::countr_zero(bits);
}

void Source::refuse_lattice(int exponent, const std::string& why) const {
    throw LimitError("operands of units 2^" + std::to_string(mesh_.lattice.exponent) + " and 2^" +
                     std::to_string(exponent) + " have no common lattice: " + why);
}

std::shared_ptr<const Source> Source::on_lattice(int exponent) const {
    if (is_half_space()) return planes_on_lattice(exponent);
    const int shift = mesh_.lattice.exponent - exponent;
    if (fraction_bits_ - shift > fraction_limit && -last_bit() - shift > fraction_limit)
        refuse_lattice(exponent, "their sizes differ too much for the digits of the finer one");
    const double factor = std::ldexp(1, shift);
    LatticeMesh moved = mesh_;
    moved.lattice.exponent = exponent;
    for (LatticePoint& p : moved.points) {
        const auto scaled = [&](Coordinate c) {
            const double there = c.to_double() * factor;
            if (std::fabs(there) >= static_cast<double>(coordinate_limit))
                refuse_lattice(exponent, "their sizes differ too much; coordinate " +
                                             std::to_string(c.to_double()) +
                                             " of the coarser one would not fit");
            return Coordinate(there);
        };
        p = {scaled(p.x), scaled(p.y), scaled(p.z)};
    }
    auto out = renamed_as_this(make(std::move(moved)));
    const_cast<Source&>(*out).serial_ = serial_;
    return out;
}

// n · x + d with x = X 2^k: the normal or the offset takes up the power of two.
std::shared_ptr<const Source> Source::half_space_on(int exponent) const {
    constexpr int normal_bits = 327;  // see plane.h
    constexpr int offset_bits = 380;
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

// n · x + d with x = X 2^k: the normal or the offset is multiplied.
std::shared_ptr<const Source> Source::planes_on_lattice(int exponent) const {
    const int shift = mesh_.lattice.exponent - exponent;
    constexpr int most_bits = 327;  // of a normal, and less than of an offset
    std::vector<Plane> moved;
    moved.reserve(planes_.size());
    for (const Plane& p : planes_) {
        const auto times = [&](const Plane::Coefficient& c, int bits) {
            if (bits == 0 || c.is_zero()) return c;
            if (c.bit_length() + bits > most_bits || shift > coordinate_bits)
                refuse_lattice(exponent, "a plane would have too long coefficients");
            return c.shifted_left(bits);
        };
        const int to_normal = std::max(-shift, 0);
        moved.emplace_back(times(p.normal(0), to_normal), times(p.normal(1), to_normal),
                           times(p.normal(2), to_normal), times(p.offset(), std::max(shift, 0)));
    }
    Box box = box_;
    if (!is_unbounded()) box = box_on_lattice(box_, shift);
    auto out = renamed_as_this(planes(std::move(moved), Lattice{exponent}, box));
    const_cast<Source&>(*out).serial_ = serial_;
    return out;
}

}  // namespace trisect::detail
