// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/traced/facet_tracing.h>

#include <algorithm>
#include <array>
#include <utility>

namespace trisect::detail {

namespace {

template <class T>
void append(PoolVector<T>& to, std::span<const T> from) {
    to.insert(to.end(), from.begin(), from.end());
}

std::array<const LatticePoint*, 3> corners_of(const Source& source, std::uint32_t facet) {
    return {&source.corner(facet, 0), &source.corner(facet, 1), &source.corner(facet, 2)};
}

void set_ends(const FacetCrossing& c, std::uint32_t side, const Source& source, std::uint32_t facet,
              OutlineSegment& segment) {
    // Within the facet, to the left of the product of the normals, is what lies below the other
    // facet for the first one, and above it for the second one.
    const bool along = segment.open_below == (side == 0);
    for (std::size_t k = 0; k < 2; ++k) {
        const FacetCrossing::End& end = c.ends[along ? k : 1 - k];
        segment.at[k] = &end.at;
        const bool is_own = end.of_second == (side == 1);
        segment.edge[k] = static_cast<std::int8_t>(is_own ? end.edge : -1);
        if (is_own) continue;
        const std::uint64_t v = source.corner_index(facet, end.edge);
        const std::uint64_t w = source.corner_index(facet, end.edge == 2 ? 0 : end.edge + 1);
        segment.through[k] = std::min(v, w) << 32 | std::max(v, w);
    }
}

}  // namespace

void TracedFacets::add(const TracedFacet& facet) {
    entries_.push_back({facet.number, facet.is_special,
                        static_cast<std::uint32_t>(facet.segments.size()),
                        static_cast<std::uint32_t>(facet.edges.size()),
                        static_cast<std::uint32_t>(facet.meetings.size())});
    append(segments_, facet.segments);
    append(edges_, facet.edges);
    append(meetings_, facet.meetings);
}

namespace {

// Of pairs in the order of their first facets the first with this one or a later one.
std::size_t first_pair_of(const Crossings& crossings, std::uint32_t number) {
    const auto& pairs = crossings.pairs;
    const auto first_facet = [](const FacetCrossing& c) { return c.facets[0]; };
    return static_cast<std::size_t>(std::ranges::lower_bound(pairs, number, {}, first_facet) -
                                    pairs.begin());
}

// The same in the order of their second facets.
std::size_t second_pair_of(const Crossings& crossings, std::uint32_t number) {
    const auto& by_second = crossings.by_second;
    const auto second_facet = [&](std::uint32_t i) { return crossings.pairs[i].facets[1]; };
    return static_cast<std::size_t>(std::ranges::lower_bound(by_second, number, {}, second_facet) -
                                    by_second.begin());
}

}  // namespace

std::size_t FacetTracing::segments_before(const Crossings& crossings, std::uint32_t number) {
    return first_pair_of(crossings, number) + second_pair_of(crossings, number);
}

void FacetTracing::start_at(std::size_t shown) {
    first_ = second_ = uncertain_ = 0;
    if (shown == 0 || shown == crossings_.shown.size()) return;
    const std::uint32_t number = crossings_.shown[shown];
    first_ = first_pair_of(crossings_, number);
    second_ = second_pair_of(crossings_, number);
    uncertain_ = static_cast<std::size_t>(std::ranges::lower_bound(crossings_.uncertain, number) -
                                          crossings_.uncertain.begin());
}

void FacetTracing::list_sides(std::uint32_t number) {
    const auto& pairs = crossings_.pairs;
    const auto& by_second = crossings_.by_second;
    while (first_ < pairs.size() && pairs[first_].facets[0] < number) ++first_;
    while (second_ < pairs.size() && pairs[by_second[second_]].facets[1] < number) ++second_;
    listed_.clear();
    for (; first_ < pairs.size() && pairs[first_].facets[0] == number; ++first_)
        listed_.push_back({static_cast<std::uint32_t>(first_), 0});
    for (; second_ < pairs.size() && pairs[by_second[second_]].facets[1] == number; ++second_)
        listed_.push_back({by_second[second_], 1});
}

bool FacetTracing::traces(std::uint32_t number) {
    list_sides(number);
    const auto& uncertain = crossings_.uncertain;
    while (uncertain_ < uncertain.size() && uncertain[uncertain_] < number) ++uncertain_;
    if (uncertain_ < uncertain.size() && uncertain[uncertain_] == number) return false;
    const std::size_t operand = operand_of_(number);
    const Crossings::Operand& o = crossings_.operands[operand];
    const FacetMarks* const marks = marks_[operand];
    const std::uint32_t facet = number - o.first;
    if (marks == nullptr || !marks->takes_part(facet, o.inside_above) ||
        (marks->is_worked(facet, !o.inside_above) && !crossings_.has_other_sides))
        return false;
    special_ = std::ranges::binary_search(crossings_.special, number) ? number : none;
    if (!list_segments() || !trace(*marks->source(), facet)) return false;
    for (std::uint32_t i = 0; i < listed_.size(); ++i) {
        listed_[i].open_below = segments_[i].open_below;
        listed_[i].next = outline_.next(i);
    }
    return true;
}

// Of a half-space the facet is the whole plane.
bool FacetTracing::trace(const Source& source, std::uint32_t facet) {
    return source.is_half_space() ? outline_.trace_section(source.support(facet), segments_)
                                  : outline_.trace(corners_of(source, facet), segments_,
                                                   special_ != none ? this : nullptr);
}

// False when nothing is left of an operand that crosses the facet. Those that come first in pairs
// are in the order of their numbers, and so are those that come second; the facet's own operand is
// between them, so each operand comes once.
bool FacetTracing::list_segments() {
    segments_.resize(listed_.size());
    std::size_t n = 0;
    std::uint32_t cutters = 0;
    std::uint32_t begin = 0;  // of the facets of the last one
    std::uint32_t end = 0;
    const Crossings::Operand* operand = nullptr;
    const Source* source = nullptr;
    for (const TracedSegment& s : listed_) {
        const FacetCrossing& c = crossings_.pairs[s.pair];
        const std::uint32_t number = c.facets[1 - s.side];
        if (number < begin || number >= end) {
            const std::size_t i = operand_of_(number);
            if (marks_[i] == nullptr) return false;
            operand = &crossings_.operands[i];
            source = marks_[i]->source();
            begin = operand->first;
            end = begin + source->facet_count();
            ++cutters;
        }
        OutlineSegment& segment = segments_[n++];
        segment.cutter = cutters - 1;
        segment.open_below = operand->is_open_below();
        set_ends(c, s.side, *source, number - begin, segment);
    }
    return true;
}

int FacetTracing::order_on(std::size_t edge, std::uint32_t a, std::uint32_t b) const {
    const std::size_t operand = crossings_.operand_of(special_);
    const Source& own = *marks_[operand]->source();
    const std::uint32_t facet = special_ - crossings_.operands[operand].first;
    const auto start = static_cast<int>(edge);
    return order_along_shifted(own.corner(facet, start), own.corner(facet, (start + 1) % 3),
                               operand == 1, cutter_corners(a), cutter_corners(b),
                               crossings_.shift);
}

Crossings::Corner FacetTracing::first_corner() const {
    const auto at = std::ranges::lower_bound(crossings_.shown, special_);
    return crossings_.first_corners[static_cast<std::size_t>(at - crossings_.shown.begin())];
}

FacetCorners FacetTracing::cutter_corners(std::uint32_t segment) const {
    const TracedSegment& s = listed_[segment];
    const std::uint32_t number = crossings_.pairs[s.pair].facets[1 - s.side];
    const std::size_t operand = crossings_.operand_of(number);
    return corners_of(*marks_[operand]->source(), number - crossings_.operands[operand].first);
}

}  // namespace trisect::detail
