// SPDX-License-Identifier: Apache-2.0
//
// Pairs of facets whose boxes meet: all with all four at once where they are few or of two
// operands, else by a sweep. How two facets are related is in filtered_pair_relation.cpp.

#include <trisect/bsp/leaf/doubles/filtered_pairs.h>

#include <algorithm>
#include <bit>
#include <limits>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

// Of the boxes of a row. Without a call, which std::popcount is on the oldest processors.
constexpr std::array<std::uint8_t, 16> count_of{0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

// So many are listed before they are compared.
constexpr std::size_t many_leaf_pairs = 4096;

}  // namespace

// All facets of two operands. They are few, and four boxes are compared at once: to compare those
// of one operand with all of the other takes less than to sort them. Facets of the first operand
// come first.
bool FilteredPairs::relate_two(FilteredFacets& facets, EvaluateStats& stats) {
    const std::size_t n = as_index(facets.size());
    has_all_boxes_ = true;
    has_planes_ = false;
    boxes_.clear();
    for (LeafIndex i = 0; i < facets.size(); ++i)
        boxes_.add(facets[i].lo, facets[i].hi, facets[i].operand);
    const auto reach_of = [&](LeafIndex operand) {
        const FilteredFacets::Reach& r = facets.reach(as_index(operand));
        return BoxRows::probe(r.lo, r.hi, operand);
    };
    const std::array reaches{reach_of(0), reach_of(1)};
    is_candidate_.resize(4 * boxes_.row_count());
    rows_of_first_.clear();
    for (std::size_t row = 0; row < boxes_.row_count(); ++row) {
        const unsigned firsts = boxes_.meeting(row, reaches[1]);
        const unsigned candidates = firsts | boxes_.meeting(row, reaches[0]);
        for (std::size_t i = 0; i < 4; ++i)
            is_candidate_[4 * row + i] = static_cast<std::uint8_t>(candidates >> i & 1U);
        if (firsts != 0) rows_of_first_.push_back(row);
    }
    for (std::size_t i = as_index(facets.first_of(1)); i < n; ++i) {
        if (is_candidate_[i] == 0) continue;
        check_budget(*facets.problem().options, stats);
        const BoxRows::Probe probe = boxes_.probe(i);
        for (const std::size_t row : rows_of_first_)
            for (unsigned met = boxes_.meeting(row, probe); met != 0; met &= met - 1) {
                const std::size_t j = 4 * row + static_cast<std::size_t>(std::countr_zero(met));
                if (!compare(facets, static_cast<LeafIndex>(j), static_cast<LeafIndex>(i), stats))
                    return false;
            }
    }
    return true;
}

// Facets that may meet one of another operand. Those of small leaves are compared all with all, as
// they are: rows of one operand after the other, four neighbours in each, are mostly kept or left
// out as one.
void FilteredPairs::list_candidates(FilteredFacets& facets, LeafIndex few) {
    const std::size_t n = facets.operand_count();
    candidates_.clear();
    boxes_.clear();
    has_all_boxes_ = facets.size() <= few;
    has_planes_ = facets.fragment_count() == 0;
    // With many operands the boxes of the others overlap nearly everything.
    const bool all = has_all_boxes_ || n > 8;
    for (LeafIndex i = 0; i < facets.size(); ++i) {
        const FilteredFacet& f = facets[i];
        bool candidate = all;
        for (std::size_t o = 0; o < n && !candidate; ++o)
            candidate = o != as_index(f.operand) && f.meets(facets.reach(o).lo, facets.reach(o).hi);
        if (candidate) candidates_.push_back({0, i});
    }
    if (has_all_boxes_) {
        for (LeafIndex i = 0; i < facets.size(); ++i)
            boxes_.add(facets[i].lo, facets[i].hi, facets[i].operand);
        boxes_.add_hulls();
    } else {
        sort_candidates(facets);
    }
    if (!has_planes_) return;
    planes_.start(facets.extent());
    for (const Candidate& c : candidates_)
        planes_.add(facets[c.item].corners, facets.plane(c.item));
}

// Along the axis on which the fewest boxes overlap: where their lengths sum up to the smallest part
// of the whole extent.
void FilteredPairs::sort_candidates(const FilteredFacets& facets) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vector3 lengths{};
    Vector3 low{infinity, infinity, infinity};
    Vector3 high{-infinity, -infinity, -infinity};
    for (const Candidate& c : candidates_) {
        const FilteredFacet& f = facets[c.item];
        for (std::size_t k = 0; k < 3; ++k) {
            lengths[k] += f.hi[k] - f.lo[k];
            low[k] = std::min(low[k], f.lo[k]);
            high[k] = std::max(high[k], f.hi[k]);
        }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (lengths[k] * (high[axis] - low[axis] + 1) < lengths[axis] * (high[k] - low[k] + 1))
            axis = k;
    for (Candidate& c : candidates_) c.lo = facets[c.item].lo[axis];
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
        return a.lo != b.lo ? a.lo < b.lo : a.item < b.item;
    });
    const auto turned = [&](const Vector3& v) {
        return Vector3{v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3]};
    };
    for (const Candidate& c : candidates_) {
        const FilteredFacet& f = facets[c.item];
        boxes_.add(turned(f.lo), turned(f.hi), f.operand);
    }
}

// Which boxes of a row are marked, and which row is the next one that has some.
void FilteredPairs::mark_rows(std::span<const std::uint8_t> marks) {
    const std::size_t rows = boxes_.row_count();
    marked_.assign(rows, 0);
    next_marked_.assign(rows + 1, rows);
    for (std::size_t i = 0; i < candidates_.size(); ++i)
        if (marks[as_index(candidates_[i].item)] != 0)
            marked_[i / 4] = static_cast<std::uint8_t>(marked_[i / 4] | 1U << i % 4);
    for (std::size_t row = rows; row-- > 0;)
        next_marked_[row] = marked_[row] != 0 ? row : next_marked_[row + 1];
}

// Rows from the candidate `i` on of which boxes meet that of the candidate: the number of the row
// and four bits for its boxes, of those that come behind it, and are marked if it is not.
std::span<const std::uint64_t> FilteredPairs::find_rows(std::size_t i, bool all) {
    const BoxRows::Probe probe = boxes_.probe(i);
    const std::size_t first = (i + 1) / 4;
    std::uint64_t* const begin = rows_.data();
    std::uint64_t* end = begin;
    if (has_all_boxes_) {
        static_cast<void>(boxes_.visit_meeting(first, probe, [&](std::size_t row, unsigned met) {
            *end++ = row << 4 | met;
            return true;
        }));
    } else {
        const auto next = [&](std::size_t row) {
            return all || row >= boxes_.row_count() ? row : next_marked_[row];
        };
        for (std::size_t row = next(first);
             row < boxes_.row_count() && boxes_.first_low(row) <= probe.hi[0][0];
             row = next(row + 1))
            if (const unsigned met = boxes_.meeting(row, probe); met != 0) *end++ = row << 4 | met;
    }
    if (end != begin && *begin >> 4 == first) *begin &= ~std::uint64_t{15} | 15U << (i + 1) % 4;
    if (!all)
        for (std::uint64_t* r = begin; r != end; ++r) *r &= ~std::uint64_t{15} | marked_[*r >> 4];
    return {begin, end};
}

bool FilteredPairs::sweep(FilteredFacets& facets, std::span<const std::uint8_t> marks,
                          EvaluateStats& stats) {
    // With marks most rows are left out, and sorting pays sooner.
    list_candidates(facets, marks.empty() ? 840 : 512);
    pairs_.clear();
    rows_.resize(boxes_.row_count());
    if (!marks.empty()) mark_rows(marks);
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        check_budget(*facets.problem().options, stats);
        const bool all = marks.empty() || (marked_[i / 4] >> i % 4 & 1U) != 0;
        const std::span<const std::uint64_t> rows = find_rows(i, all);
        if (rows.empty()) continue;
        FacetRows::Probe facet;
        if (has_planes_) facet = planes_.probe(i);
        std::uint64_t meeting = 0;
        for (const std::uint64_t r : rows) {
            const std::size_t row = r >> 4;
            auto met = static_cast<unsigned>(r & 15U);
            if (met == 0) continue;
            meeting += count_of[met];
            if (has_planes_) met &= ~planes_.parted(row, facet, met);
            for (; met != 0; met &= met - 1) {
                const std::size_t j = 4 * row + static_cast<std::size_t>(std::countr_zero(met));
                if (are_in_plane(candidates_[i].item, candidates_[j].item)) continue;
                if (has_planes_) {
                    pairs_.push_back(
                        {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
                } else if (!add_pair(facets, candidates_[i].item, candidates_[j].item) &&
                           !is_left_open(candidates_[i].item, candidates_[j].item)) {
                    return false;
                }
            }
        }
        stats.pairs_boxes += meeting;
        if (pairs_.size() >= many_leaf_pairs && !add_pairs(facets)) return false;
    }
    return add_pairs(facets);
}

// The pairs that were listed, four at once: single precision is enough for nearly all of them.
bool FilteredPairs::add_pairs(FilteredFacets& facets) {
    for (std::size_t first = 0; first < pairs_.size(); first += 4) {
        const std::size_t count = std::min<std::size_t>(4, pairs_.size() - first);
        std::array<FacetRows::Pair, 4> four;
        for (std::size_t i = 0; i < 4; ++i) four[i] = pairs_[first + (i < count ? i : 0)];
        const FacetRows::Relation relation = planes_.relate(four);
        for (unsigned i = 0; i < count; ++i) {
            if ((relation.apart >> i & 1U) != 0) continue;
            const LeafIndex s = candidates_[four[i][0]].item;
            const LeafIndex t = candidates_[four[i][1]].item;
            const bool crosses = (relation.crosses >> i & 1U) != 0;
            if (!(crosses ? add_crossing(facets, s, t, relation, i) : add_pair(facets, s, t)) &&
                !is_left_open(s, t))
                return false;
        }
    }
    pairs_.clear();
    return true;
}

bool FilteredPairs::relate(FilteredFacets& facets, std::span<const std::uint8_t> marks,
                           bool edges_apart, EvaluateStats& stats) {
    edges_apart_ = edges_apart;
    crossings_.clear();
    has_partner_.assign(as_index(facets.size()), 0);
    const bool two = facets.operand_count() == 2 && marks.empty();
    if (!(two ? relate_two(facets, stats) : sweep(facets, marks, stats))) return false;
    stats.pairs_touching += crossings_.size();
    stats.pairs_cutting += crossings_.size();
    list_contacts(facets.size());
    return true;
}

void FilteredPairs::add_to(Crossings& crossings, const FilteredFacets& facets) const {
    for (const FilteredCrossing& c : crossings_) {
        FacetCrossing& made = crossings.pairs.emplace_back();
        for (std::size_t k = 0; k < 2; ++k) {
            const FilteredFacet& f = facets[c.items[k]];
            const std::int32_t slot = facets.problem().operands[as_index(f.operand)].slot;
            made.facets[k] = crossings.number_of(static_cast<std::size_t>(slot), f.ref.facet);
            const FilteredEnd& end = c.ends[k];
            made.ends[k] = {facets.in_lattice(end.at), end.of_second, end.edge};
        }
    }
}

bool FilteredPairs::compare(FilteredFacets& facets, LeafIndex s, LeafIndex t,
                            EvaluateStats& stats) {
    if (are_in_plane(s, t) || !facets[s].meets(facets[t].lo, facets[t].hi)) return true;
    ++stats.pairs_boxes;
    has_partner_[as_index(s)] = has_partner_[as_index(t)] = 1;
    if (add_pair(facets, s, t)) [[likely]]
        return true;
    return is_left_open(s, t);
}

// Whether a pair that doubles do not decide may be one.
bool FilteredPairs::is_left_open(LeafIndex s, LeafIndex t) {
    if (doubtful_ == nullptr) return false;
    doubtful_->push_back({std::min(s, t), std::max(s, t)});
    return true;
}

// Counting sort by item: `first_contact_[i + 1]` runs from the start of item i to its end.
void FilteredPairs::list_contacts(LeafIndex count) {
    first_contact_.assign(as_index(count) + 1, 0);
    for (const FilteredCrossing& c : crossings_)
        for (const LeafIndex i : c.items) ++first_contact_[as_index(i) + 1];
    std::size_t before = 0;
    for (std::size_t i = 1; i < first_contact_.size(); ++i) {
        const std::size_t n = first_contact_[i];
        first_contact_[i] = before;
        before += n;
    }
    contacts_.resize(2 * crossings_.size());
    for (std::size_t c = 0; c < crossings_.size(); ++c) {
        const auto& items = crossings_[c].items;
        for (std::size_t i = 0; i < 2; ++i)
            contacts_[first_contact_[as_index(items[i]) + 1]++] = {
                items[1 - i], static_cast<std::int32_t>(c), i == 1};
    }
    for (std::size_t i = 0; i + 1 < first_contact_.size(); ++i) {
        if (first_contact_[i + 1] - first_contact_[i] < 2) continue;
        const auto at = [&](std::size_t k) {
            return contacts_.begin() + static_cast<std::ptrdiff_t>(first_contact_[k]);
        };
        std::sort(at(i), at(i + 1), [](const FilteredContact& a, const FilteredContact& b) {
            return a.other < b.other;
        });
    }
}

}  // namespace trisect::detail
