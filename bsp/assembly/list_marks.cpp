// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/list_marks.h>

#include <algorithm>

#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

void ListMarks::note(const PolygonList& polygons, const Cell& cell, bool complemented,
                     std::size_t table, FacetMarks& marks) {
    const bool flipped = polygons.flipped() != complemented;
    if (polygons.has_all_facets()) {
        for (std::uint32_t f = 0; f < polygons.size(); ++f) marks.set_present(f, flipped);
        return;
    }
    const auto add = [&](std::span<const std::uint32_t> facets, bool contained) {
        constexpr std::size_t most = 16384;
        for (std::size_t i = 0; i < facets.size(); i += most)
            parts_.push_back({facets.subspan(i, std::min(most, facets.size() - i)), contained,
                              &cell, table, flipped});
    };
    const std::span<const std::uint32_t> facets = polygons.facets();
    add(facets.first(polygons.contained()), true);
    add(facets.subspan(polygons.contained()), false);
}

// Without a branch: corners lie anywhere in memory, and a wrong guess would wait for each of them.
// So they are prefetched well before.
template <bool Shared, bool Whole>
void ListMarks::mark(const Part& list, FacetMarks& marks) {
    constexpr std::size_t ahead = 16;
    const Box inside = list.cell->lattice_box();
    const LatticeMesh& mesh = marks.source()->mesh();
    const auto facets = list.facets;
    for (std::size_t i = 0; i < facets.size(); ++i) {
        if (i + 2 * ahead < facets.size())
            __builtin_prefetch(&mesh.triangles[facets[i + 2 * ahead]]);
        if (i + ahead < facets.size())
            __builtin_prefetch(&mesh.points[mesh.triangles[facets[i + ahead]][0]]);
        const std::uint32_t f = facets[i];
        const LatticePoint& p = mesh.points[mesh.triangles[f][0]];
        const auto at = [&](int k) { return Whole ? p[k].to_integer() : position_of(p[k]); };
        const bool owned = (int{at(0) >= inside.lo[0]} & int{at(0) <= inside.hi[0]} &
                            int{at(1) >= inside.lo[1]} & int{at(1) <= inside.hi[1]} &
                            int{at(2) >= inside.lo[2]} & int{at(2) <= inside.hi[2]}) != 0;
        if constexpr (Shared) {
            marks.add_present_shared(f, list.flipped, owned);
        } else {
            marks.add_present(f, list.flipped, owned);
        }
    }
}

void ListMarks::mark(std::span<FacetMarks> tables, std::uint32_t threads) const {
    std::size_t facets = 0;
    for (const Part& list : parts_) facets += list.facets.size();
    constexpr std::size_t few = 65536;
    const ParallelParts parts(parts_.size(), facets < few ? 1 : threads, 1);
    parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (const Part& list : std::span(parts_).subspan(begin, end - begin)) {
            FacetMarks& marks = tables[list.table];
            if (list.contained) {
                for (const std::uint32_t f : list.facets) marks.set_present(f, list.flipped);
            } else if (!marks.source()->is_whole()) {
                mark<true, false>(list, marks);
            } else if (parts.count() == 1) {
                mark<false, true>(list, marks);
            } else {
                mark<true, true>(list, marks);
            }
        }
    });
}

}  // namespace trisect::detail
