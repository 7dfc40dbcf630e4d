// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/native/native_fragments.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

using Section = NativeSection;

// Boxes of fragments are rounded outwards and may end beyond the last coordinate.
constexpr std::int64_t most_of_box = coordinate_limit * 2;

bool is_box_of(const Box& box, const Approximation& at) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double c = at.c[k];
        if (box.lo[k] > box.hi[k] || box.lo[k] < -most_of_box || box.hi[k] > most_of_box ||
            c < static_cast<double>(box.lo[k]) - 1 - at.error ||
            c > static_cast<double>(box.hi[k]) + 1 + at.error)
            return false;
    }
    return true;
}

// Of one point, both within their errors, which are rounded up.
bool may_be_equal(const Approximation& a, const Approximation& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double size = std::max(std::fabs(a.c[k]), std::fabs(b.c[k]));
        if (!(std::fabs(a.c[k] - b.c[k]) <= a.error + b.error + 0x1p-50 * size)) return false;
    }
    return true;
}

}  // namespace

NativeFragments::NativeFragments(const NativeView& view,
                                 std::span<const std::shared_ptr<const Source>> sources,
                                 std::uint32_t threads)
    : view_(view), sources_(sources) {
    const std::uint64_t n = view.header().count(Section::Fragments);
    fragments_.resize(n);
    facet_of_ = std::make_unique<std::atomic<std::uint64_t>[]>(n);
    std::uint64_t next = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
        const FragmentRecord f = fragment_record(view, i);
        if (f.first != next) view.fail(Section::Fragments, i, "edges out of order");
        next += f.count;
    }
    if (next != view.header().count(Section::Edges))
        view.fail(native_place::counts, "the file has more edges than its fragments have");
    const ParallelParts parts(n, threads);
    try {
        parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Fragment* const made = read(i);
                made->retain();
                fragments_[i] = made;
            }
        });
    } catch (...) {
        release_all();
        throw;
    }
}

NativeFragments::~NativeFragments() { release_all(); }

void NativeFragments::release_all() {
    for (const Fragment* f : fragments_)
        if (f != nullptr) f->release();
}

EdgeName NativeFragments::edge(std::uint64_t number, Approximation& begin) const {
    NativeCursor from(view_.records(Section::Edges, number, 1));
    const auto owner = from.next<std::int64_t>();
    const auto facet = from.next<std::uint32_t>();
    const auto kind = from.next<std::uint8_t>();
    const auto above = from.next<std::uint8_t>();
    from.skip(2);
    for (double& c : begin.c) c = from.next<double>();
    begin.error = from.next<double>();
    const bool is_finite =
        std::ranges::all_of(begin.c, [](double c) { return std::isfinite(c); }) && begin.error >= 0;
    if (kind > PlaneName::SplittingPlane || above > 1 || !is_finite)
        view_.fail(Section::Edges, number, "an impossible edge");
    if (kind == PlaneName::SplittingPlane) {
        if (facet > 2 || !may_be_splitter(owner) || owner > universe_limit ||
            owner < -universe_limit)
            view_.fail(Section::Edges, number, "an edge in an impossible splitting plane");
        return {PlaneName::splitter(static_cast<int>(facet), owner), above != 0};
    }
    if (owner < 0 || static_cast<std::uint64_t>(owner) >= sources_.size())
        view_.fail(Section::Edges, number, "an edge of a source that is not there");
    const Source* const source = sources_[static_cast<std::size_t>(owner)].get();
    if (facet >= source->facet_count() || (source->is_half_space() && kind != PlaneName::Support))
        view_.fail(Section::Edges, number, "an edge of a facet that is not there");
    PlaneName name = PlaneName::support(source, facet);
    name.kind = kind;
    return {name, above != 0};
}

const Fragment* NativeFragments::read(std::uint64_t number) const {
    const FragmentRecord f = fragment_record(view_, number);
    std::vector<EdgeName> edges(f.count);
    std::vector<Approximation> vertices(f.count);
    for (std::uint32_t i = 0; i < f.count; ++i) {
        edges[i] = edge(f.first + i, vertices[i]);
        if (!is_box_of(f.box, vertices[i]))
            view_.fail(Section::Fragments, number, "a part of a facet that is not in its box");
    }
    return Fragment::make(edges, vertices, f.box);
}

const Fragment* NativeFragments::at(std::uint32_t number, std::uint32_t source,
                                    std::uint32_t facet) const {
    const std::uint64_t key = ((std::uint64_t{source} << 32) | facet) + 1;
    if (facet_of_[number].load(std::memory_order_relaxed) != key) {
        check(number, sources_[source]->support(facet));
        facet_of_[number].store(key, std::memory_order_relaxed);
    }
    return fragments_[number];
}

void NativeFragments::check(std::uint32_t number, const Plane& support) const {
    const Fragment& f = *fragments_[number];
    const std::size_t n = f.edges().size();
    Plane before = f.edges()[n - 1].plane.plane();
    for (std::size_t i = 0; i < n; ++i) {
        const Plane here = f.edges()[i].plane.plane();
        if (!meet_in_a_point(support, before, here) ||
            !may_be_equal(approximate(support, before, here), f.vertices()[i]))
            view_.fail(Section::Fragments, number,
                       "a corner that is not where the planes of its edges meet");
        before = here;
    }
}

}  // namespace trisect::detail
