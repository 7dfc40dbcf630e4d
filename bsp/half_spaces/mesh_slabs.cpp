// SPDX-License-Identifier: Apache-2.0
//
// A corner lies above so many planes; a facet in the slabs from its lowest corner to its highest
// one. Where these are one slab it is a facet of that slab, else it crosses the planes between
// them. A crossing belongs to the slabs on both sides of its plane.

#include <trisect/bsp/half_spaces/mesh_slabs.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/half_spaces/cutting_plane.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Facets between two looks at the stop scope, and the least that is worth a thread.
constexpr std::size_t many_facets_of_slabs = 1 << 14;

class SlabCut {
public:
    SlabCut(std::span<const MeshSlab> slabs, const EvaluateSettings& options)
        : slabs_(slabs),
          source_(*slabs[0].solids[0]->root().node->polygons().whole_source()),
          options_(options),
          memory_(options.max_memory) {
        for (std::size_t k = 0; k + 1 < slabs.size(); ++k)
            planes_.emplace_back(plane_of_half_space(*slabs[k].solids[1]), source_.box());
    }

    void run() {
        const LatticeMesh& mesh = source_.mesh();
        const auto of_corners = memory_.hold(mesh.points.size() * sizeof(std::uint32_t));
        below_.resize(mesh.points.size());
        const ParallelParts of_points(mesh.points.size(), options_.threads, many_facets_of_slabs);
        std::vector<std::vector<std::uint8_t>> touched(of_points.count());
        of_points.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            touched[part].resize(planes_.size());
            for (std::size_t i = begin; i < end; ++i)
                below_[i] = planes_below(mesh.points[i], touched[part]);
        });
        is_touched_.resize(planes_.size());
        for (const auto& part : touched)
            for (std::size_t p = 0; p < part.size(); ++p)
                is_touched_[p] = static_cast<std::uint8_t>(is_touched_[p] | part[p]);
        const ParallelParts of_facets(mesh.triangles.size(), options_.threads,
                                      many_facets_of_slabs);
        parts_.resize(of_facets.count());
        of_facets.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            find_facets(parts_[part], begin, end);
        });
    }

    /// \pre run()
    [[nodiscard]] SlabValue slab(std::size_t number, EvaluateStats& stats) {
        const MeshSlab& slab = slabs_[number];
        auto crossings =
            *crossings_of(*slab.formula, slab.solids, CrossingOperands::WithHalfSpaces);
        std::size_t slot = 1;
        for (const std::size_t plane : {number, number - 1}) {
            if (plane >= planes_.size()) continue;
            if (is_touched_[plane] != 0) return {};
            add_pairs(crossings, plane, slot++);
        }
        if (crossings.pairs.empty()) return uncut_slab(number);
        stats.pairs_touching += crossings.pairs.size();
        stats.pairs_cutting += crossings.pairs.size();
        crossings.arrange();
        std::vector<UncrossedFacets> lists;
        for (std::size_t i = 0; i < slab.solids.size(); ++i)
            lists.push_back({slab.solids[i]->root().node->polygons().whole_source(),
                             crossings.operands[i].inside_above,
                             {}});
        lists[0].facets = uncrossed(number);
        stats.untouched_polygons += lists[0].facets.size();
        ++stats.half_space_cuts;
        memory_.keep(lists[0].facets.size() * sizeof(std::uint32_t) +
                     crossings.pairs.size() * sizeof(FacetCrossing));
        stats.memory = memory_.peak();
        SlabValue out;
        out.part = UndividedMeshes{
            std::move(lists), std::make_shared<const Crossings>(std::move(crossings)), nullptr};
        return out;
    }

private:
    // What some of the facets are, in their order.
    struct Part {
        std::vector<std::vector<std::uint32_t>> uncrossed;  // by slab
        std::vector<PoolVector<FacetCrossing>> pairs;       // by plane
    };

    // Between planes that cut nothing.
    [[nodiscard]] SlabValue uncut_slab(std::size_t number) const {
        std::size_t facets = 0;
        for (const Part& part : parts_) facets += part.uncrossed[number].size();
        SlabValue out;
        out.is_none = facets == 0;
        out.is_all = facets == source_.mesh().triangles.size();
        return out;
    }

    // A corner on a plane counts as above it, and spoils the slabs beside it.
    [[nodiscard]] std::uint32_t planes_below(const LatticePoint& p,
                                             std::vector<std::uint8_t>& touched) const {
        std::size_t first = 0;
        std::size_t last = planes_.size();
        while (first < last) {
            const std::size_t middle = first + (last - first) / 2;
            const int side = planes_[middle].side(p);
            if (side == 0) touched[middle] = 1;
            if (side < 0) {
                last = middle;
            } else {
                first = middle + 1;
            }
        }
        return static_cast<std::uint32_t>(first);
    }

    void find_facets(Part& part, std::size_t begin, std::size_t end) const {
        part.uncrossed.resize(slabs_.size());
        part.pairs.resize(planes_.size());
        const auto& triangles = source_.mesh().triangles;
        for (std::size_t f = begin; f < end; ++f) {
            if (f % many_facets_of_slabs == 0) check_flags(options_.scope);
            const auto& t = triangles[f];
            const auto [low, high] = std::minmax({below_[t[0]], below_[t[1]], below_[t[2]]});
            const auto facet = static_cast<std::uint32_t>(f);
            if (low == high) {
                part.uncrossed[low].push_back(facet);
                continue;
            }
            for (std::size_t p = low; p < high; ++p)
                if (is_touched_[p] == 0) part.pairs[p].push_back(crossing(facet, p));
        }
    }

    // Seen from above the facet, the plane's lower side is to the left of the product of the
    // normals, so the segment begins on the edge that goes up.
    [[nodiscard]] FacetCrossing crossing(std::uint32_t facet, std::size_t plane) const {
        FacetCrossing out;
        out.facets[0] = facet;
        for (int edge = 0; edge < 3; ++edge) {
            const bool from = is_above(facet, edge, plane);
            const bool to = is_above(facet, edge == 2 ? 0 : edge + 1, plane);
            if (from == to) continue;
            out.ends[to ? 0 : 1] = {pierced_by(planes_[plane], source_, facet, edge), false,
                                    static_cast<std::int8_t>(edge)};
        }
        return out;
    }

    [[nodiscard]] bool is_above(std::uint32_t facet, int corner, std::size_t plane) const {
        return below_[source_.corner_index(facet, corner)] > plane;
    }

    void add_pairs(Crossings& crossings, std::size_t plane, std::size_t slot) const {
        for (const Part& part : parts_) {
            const std::size_t first = crossings.pairs.size();
            crossings.pairs.insert(crossings.pairs.end(), part.pairs[plane].begin(),
                                   part.pairs[plane].end());
            for (std::size_t i = first; i < crossings.pairs.size(); ++i)
                crossings.pairs[i].facets[1] = crossings.number_of(slot, 0);
        }
    }

    // No other slab has them.
    [[nodiscard]] std::vector<std::uint32_t> uncrossed(std::size_t slab) {
        std::vector<std::uint32_t> out = std::move(parts_[0].uncrossed[slab]);
        std::size_t size = 0;
        for (const Part& part : parts_) size += part.uncrossed[slab].size();
        out.reserve(out.size() + size);
        for (std::size_t i = 1; i < parts_.size(); ++i)
            out.insert(out.end(), parts_[i].uncrossed[slab].begin(),
                       parts_[i].uncrossed[slab].end());
        return out;
    }

    std::span<const MeshSlab> slabs_;
    const Source& source_;
    const EvaluateSettings& options_;
    MemoryBudget memory_;
    std::vector<CuttingPlane> planes_;
    std::vector<std::uint32_t> below_;      // planes, by corner
    std::vector<std::uint8_t> is_touched_;  // by plane: it goes through a corner
    std::vector<Part> parts_;
};

}  // namespace

Plane plane_of_half_space(const SolidState& state) {
    return state.root().node->polygons().whole_source()->support(0);
}

std::vector<SlabValue> evaluate_slabs(std::span<const MeshSlab> slabs,
                                      const EvaluateSettings& options, EvaluateStats& stats) {
    SlabCut cut(slabs, options);
    cut.run();
    std::vector<SlabValue> out;
    for (std::size_t i = 0; i < slabs.size(); ++i) out.push_back(cut.slab(i, stats));
    return out;
}

}  // namespace trisect::detail
