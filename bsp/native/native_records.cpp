// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/native/native_records.h>

#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <trisect/kernel/number/dyadic.h>

namespace trisect::detail {

namespace {

using Section = NativeSection;
using Part = SourceRecord::Part;

// Of triangles, planes and points a source has no more.
constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();

// Winding numbers are counted in 32 bits.
constexpr std::int32_t most_winding = 1 << 30;

bool is_permutation_of_axes(const std::array<std::uint8_t, 3>& axes) {
    unsigned seen = 0;
    for (const std::uint8_t a : axes) seen |= a < 3 ? 1U << a : 8U;
    return seen == 7;
}

bool is_source_possible(const SourceRecord& s) {
    const bool has_mesh = s.points.count != 0 && s.triangles.count != 0 && s.planes.count == 0;
    const bool has_planes = s.points.count == 0 && s.triangles.count == 0 && s.planes.count != 0;
    return (s.has_planes ? has_planes : has_mesh) && is_permutation_of_axes(s.axes) &&
           (s.faces.count == 0 || s.faces.count == s.triangles.count) && s.points.count < most &&
           s.facets() < most && s.names.count < most;
}

bool is_box(const Box& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (b.lo[k] > b.hi[k] || b.lo[k] < -coordinate_limit || b.hi[k] > coordinate_limit)
            return false;
    return true;
}

std::uint8_t bit_of(const NativeView& view, Section section, std::uint64_t record,
                    std::uint8_t value) {
    if (value > 1) view.fail(section, record, "a byte that is neither 0 nor 1");
    return value;
}

}  // namespace

std::vector<SourceRecord> source_records(const NativeView& view) {
    const NativeHeader& header = view.header();
    const std::uint64_t n = header.count(Section::Sources);
    std::vector<SourceRecord> out;
    out.reserve(n);
    SourceRecord sum;
    NativeCursor from(view.records(Section::Sources, 0, n));
    for (std::uint64_t i = 0; i < n; ++i) {
        SourceRecord s;
        s.has_planes = bit_of(view, Section::Sources, i, from.next<std::uint8_t>()) != 0;
        s.same_serial = bit_of(view, Section::Sources, i, from.next<std::uint8_t>()) != 0;
        for (std::uint8_t& a : s.axes) a = from.next<std::uint8_t>();
        from.skip(3);
        s.operand = from.next<std::uint32_t>();
        from.skip(4);
        const auto take = [&](Part& part, Part& all, Section section) {
            part.first = all.count;
            part.count = from.next<std::uint64_t>();
            if (part.count > header.count(section) - all.count)
                view.fail(Section::Sources, i, "a source with more than the file has");
            all.count += part.count;
        };
        take(s.points, sum.points, Section::Points);
        take(s.triangles, sum.triangles, Section::Triangles);
        take(s.faces, sum.faces, Section::Faces);
        take(s.planes, sum.planes, Section::Planes);
        take(s.names, sum.names, Section::Names);
        s.box = from.next_box();
        if (!is_source_possible(s) || (s.has_planes && !is_box(s.box)))
            view.fail(Section::Sources, i, "an impossible source");
        if (s.same_serial &&
            (i == 0 || out.back().has_planes != s.has_planes || out.back().facets() != s.facets()))
            view.fail(Section::Sources, i, "a source that does not go with the one before it");
        out.push_back(s);
    }
    if (sum.points.count != header.count(Section::Points) ||
        sum.triangles.count != header.count(Section::Triangles) ||
        sum.faces.count != header.count(Section::Faces) ||
        sum.planes.count != header.count(Section::Planes) ||
        sum.names.count != header.count(Section::Names))
        view.fail(native_place::counts, "the file has more than its sources have");
    return out;
}

NodeRecord node_record(const NativeView& view, std::uint64_t number) {
    NativeCursor from(view.records(Section::Nodes, number, 1));
    NodeRecord n;
    n.axis = from.next<std::uint8_t>();
    n.flags = from.next<std::uint8_t>();
    from.skip(2);
    n.winding = from.next<std::int32_t>();
    n.above = from.next<std::uint64_t>();
    n.position = from.next<std::int64_t>();
    n.leaf = from.next<std::uint64_t>();
    const unsigned allowed =
        n.is_leaf() ? NativeNodeFlag::mixed
                    : NativeNodeFlag::below_complemented | NativeNodeFlag::above_complemented;
    if (n.axis > native_leaf_axis || (n.flags & ~allowed) != 0 || n.winding < -most_winding ||
        n.winding > most_winding)
        view.fail(Section::Nodes, number, "an impossible node");
    if (!n.is_leaf() && !may_be_splitter(n.position))
        view.fail(Section::Nodes, number, "a splitting plane that is not at a third of a unit");
    return n;
}

CellRecord cell_record(const NativeView& view, std::uint64_t number) {
    NativeCursor from(view.records(Section::Cells, number, 1));
    CellRecord c;
    for (std::int64_t& x : c.reference.c) x = from.next<std::int64_t>();
    const auto kind = from.next<std::uint32_t>();
    const auto flipped = from.next<std::uint32_t>();
    c.source = from.next<std::uint32_t>();
    from.skip(4);
    c.first = from.next<std::uint64_t>();
    c.count = from.next<std::uint64_t>();
    c.contained = from.next<std::uint64_t>();
    if (kind > static_cast<std::uint32_t>(NativeList::Polygons) || flipped > 1)
        view.fail(Section::Cells, number, "an impossible cell");
    c.kind = static_cast<NativeList>(kind);
    c.flipped = flipped != 0;
    const NativeHeader& header = view.header();
    const bool has_source = c.kind == NativeList::AllFacets || c.kind == NativeList::WholeFacets;
    const std::uint64_t there = c.kind == NativeList::WholeFacets ? header.count(Section::Facets)
                                : c.kind == NativeList::Polygons  ? header.count(Section::Polygons)
                                                                  : 0;
    const bool in_section = has_source && c.kind == NativeList::AllFacets
                                ? c.first == 0
                                : c.first <= there && c.count <= there - c.first;
    if ((c.count == 0) != (c.kind == NativeList::None) || !in_section ||
        (has_source ? c.source >= header.count(Section::Sources) : c.source != 0) ||
        c.contained > (has_source ? c.count : 0) ||
        (c.kind == NativeList::AllFacets && (c.flipped || c.contained != c.count)) ||
        (!has_source && c.flipped))
        view.fail(Section::Cells, number, "a cell with an impossible list");
    return c;
}

PolygonRecord polygon_record(const NativeView& view, std::uint64_t number,
                             std::span<const SourceRecord> sources) {
    NativeCursor from(view.records(Section::Polygons, number, 1));
    PolygonRecord p;
    p.source = from.next<std::uint32_t>();
    p.facet = from.next<std::uint32_t>();
    p.fragment = from.next<std::uint32_t>();
    const auto flags = from.next<std::uint32_t>();
    if (flags > 3 || p.source >= sources.size() || p.facet >= sources[p.source].facets() ||
        p.fragment > view.header().count(Section::Fragments))
        view.fail(Section::Polygons, number, "an impossible polygon");
    // Only the plane of a half-space is a facet as a whole.
    const SourceRecord& s = sources[p.source];
    if (p.fragment == 0 && s.has_planes && !s.is_half_space())
        view.fail(Section::Polygons, number, "a plane as a facet");
    p.flipped = (flags & 1U) != 0;
    p.touched = (flags & 2U) != 0;
    return p;
}

FragmentRecord fragment_record(const NativeView& view, std::uint64_t number) {
    NativeCursor from(view.records(Section::Fragments, number, 1));
    FragmentRecord f;
    f.box = from.next_box();
    f.first = from.next<std::uint64_t>();
    f.count = from.next<std::uint32_t>();
    const std::uint64_t there = view.header().count(Section::Edges);
    if (f.count < 3 || f.first > there || f.count > there - f.first)
        view.fail(Section::Fragments, number, "an impossible part of a facet");
    return f;
}

LatticePoint point_record(const NativeView& view, std::uint64_t number) {
    NativeCursor from(view.records(Section::Points, number, 1));
    const auto coordinate = [&] {
        const auto v = from.next<double>();
        if (!(std::fabs(v) < static_cast<double>(coordinate_limit)) ||
            (v == 0 && std::signbit(v)) || fraction_bits(Coordinate(v)) > fraction_limit)
            view.fail(Section::Points, number, "a point with an impossible coordinate");
        return Coordinate(v);
    };
    const Coordinate x = coordinate();
    const Coordinate y = coordinate();
    return {x, y, coordinate()};
}

std::array<std::uint32_t, 3> triangle_record(const NativeView& view, const SourceRecord& source,
                                             std::uint64_t number) {
    const std::uint64_t record = source.triangles.first + number;
    NativeCursor from(view.records(Section::Triangles, record, 1));
    std::array<std::uint32_t, 3> t{};
    for (std::uint32_t& c : t) {
        c = from.next<std::uint32_t>();
        if (c >= source.points.count)
            view.fail(Section::Triangles, record, "a triangle with a corner that is no point");
    }
    return t;
}

}  // namespace trisect::detail
