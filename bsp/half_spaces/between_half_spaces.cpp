// SPDX-License-Identifier: Apache-2.0
//
// A plane cuts a facet where its corners are on both sides, so all that has to be known are the
// sides of the mesh's corners. Every facet is then one of three: cut, on the wrong side of a plane,
// or a facet of the result. The polygons in the planes are outlined by the crossings
// (traced_facets.h), whose ends are on edges of the mesh.
//
// Planes that meet within the mesh would cut each other as well; they are left to the tree, as is a
// plane through a corner.

#include <trisect/bsp/half_spaces/between_half_spaces.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/half_spaces/cutting_pair.h>
#include <trisect/bsp/half_spaces/cutting_plane.h>
#include <trisect/bsp/half_spaces/parallel_planes.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Facets between two looks at the stop scope, and the least that is worth a thread.
constexpr std::size_t many_facets = 1 << 14;

const Source& cut_source_of(const SolidState& state) {
    return *state.root().node->polygons().whole_source();
}

// The slot of the only mesh; nothing where there are more.
std::optional<std::size_t> slot_of_mesh(const SolidStates& solids) {
    std::optional<std::size_t> mesh;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        if (cut_source_of(*solids[i]).is_half_space()) continue;
        if (mesh) return std::nullopt;
        mesh = i;
    }
    return mesh;
}

// A plane of which the result is on one side.
struct PlaneOfSlot {
    CuttingPlane plane;
    std::size_t slot = 0;
    bool keeps_below = true;
};

// On which planes' wrong sides a corner is, a bit for each of at most two; the next bit: it is on a
// plane.
using Sides = std::uint8_t;
constexpr Sides on_a_plane = 4;

class MeshCut {
public:
    MeshCut(const SolidStates& solids, std::size_t mesh, std::span<const PlaneOfSlot> planes,
            const EvaluateSettings& options, Crossings& crossings, EvaluateStats& stats)
        : source_(cut_source_of(*solids[mesh])),
          mesh_slot_(mesh),
          planes_(planes),
          pair_(sides_of(planes)),
          options_(options),
          memory_(options.max_memory),
          crossings_(crossings),
          stats_(stats) {}

    /// The facets that pass through; nothing where a corner is on a plane.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> run() {
        // Both loops in one go: to wake another thread takes a tenth of a millisecond, in which one
        // thread looks at some 30,000 facets.
        const bool few = source_.mesh().triangles.size() < 16 * many_facets;
        return on_threads(few ? 1 : options_.threads, [&](std::uint32_t n) { return run_on(n); });
    }
    [[nodiscard]] std::uint64_t memory() const { return memory_.peak(); }

private:
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> run_on(std::uint32_t threads) {
        const LatticeMesh& mesh = source_.mesh();
        const auto of_sides = memory_.hold(mesh.points.size() * sizeof(Sides));
        sides_.resize(mesh.points.size());
        const ParallelParts of_points(mesh.points.size(), threads, many_facets);
        std::vector<Sides> met(of_points.count());
        of_points.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            met[part] = find_sides(begin, end);
        });
        if (std::ranges::any_of(met, [](Sides s) { return (s & on_a_plane) != 0; }))
            return std::nullopt;
        const ParallelParts of_facets(mesh.triangles.size(), threads, many_facets);
        parts_.resize(of_facets.count());
        of_facets.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            find_facets(parts_[part], begin, end);
        });
        return join();
    }

    // What some of the facets are, in their order.
    struct Part {
        std::vector<std::uint32_t> uncrossed;
        PoolVector<FacetCrossing> pairs;
    };

    static std::vector<CuttingPair::Side> sides_of(std::span<const PlaneOfSlot> planes) {
        std::vector<CuttingPair::Side> out;
        for (const PlaneOfSlot& p : planes) out.push_back({&p.plane, p.keeps_below});
        return out;
    }

    // Of the corners [begin, end); returns all bits that are set in any.
    Sides find_sides(std::size_t begin, std::size_t end) {
        const CuttingPair pair = pair_;
        const LatticePoint* const points = source_.mesh().points.data();
        Sides* const sides = sides_.data();
        unsigned met = 0;
        for (std::size_t i = begin; i < end; ++i) {
            unsigned at = pair.wrong_sides(points[i]);
            if (at == CuttingPair::in_doubt) [[unlikely]]
                at = sides_at(points[i]);
            sides[i] = static_cast<Sides>(at);
            met |= at;
        }
        return static_cast<Sides>(met);
    }

    [[nodiscard]] Sides sides_at(const LatticePoint& p) const {
        unsigned sides = 0;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const int s = planes_[i].plane.side(p);
            if (s == 0) return on_a_plane;
            if ((s < 0) != planes_[i].keeps_below) sides |= 1U << i;
        }
        return static_cast<Sides>(sides);
    }

    void find_facets(Part& part, std::size_t begin, std::size_t end) const {
        for (std::size_t first = begin; first < end; first += many_facets) {
            check_flags(options_.scope);
            find_some_facets(part, first, std::min(end, first + many_facets));
        }
    }

    // Most are on the wrong side as a whole, where planes are close to each other.
    void find_some_facets(Part& part, std::size_t begin, std::size_t end) const {
        const auto* const triangles = source_.mesh().triangles.data();
        const Sides* const sides = sides_.data();
        for (std::size_t f = begin; f < end; ++f) {
            const auto& t = triangles[f];
            const unsigned a = sides[t[0]];
            const unsigned b = sides[t[1]];
            const unsigned c = sides[t[2]];
            if ((a & b & c) != 0) continue;
            const auto facet = static_cast<std::uint32_t>(f);
            const unsigned crossed = a | b | c;
            if (crossed == 0) {
                part.uncrossed.push_back(facet);
                continue;
            }
            for (std::size_t i = 0; i < planes_.size(); ++i)
                if ((crossed >> i & 1U) != 0) part.pairs.push_back(crossing(facet, i));
        }
    }

    // Seen from above the facet, the plane's lower side is to the left of the product of the
    // normals if the facet comes first, so the segment begins on the edge that goes up.
    [[nodiscard]] FacetCrossing crossing(std::uint32_t facet, std::size_t number) const {
        const PlaneOfSlot& plane = planes_[number];
        const bool is_second = plane.slot < mesh_slot_;
        FacetCrossing out;
        out.facets[is_second ? 1 : 0] = crossings_.number_of(mesh_slot_, facet);
        out.facets[is_second ? 0 : 1] = crossings_.number_of(plane.slot, 0);
        for (int edge = 0; edge < 3; ++edge) {
            const bool from = is_above(facet, edge, number);
            const bool to = is_above(facet, edge == 2 ? 0 : edge + 1, number);
            if (from == to) continue;
            FacetCrossing::End& end = out.ends[to == is_second ? 1 : 0];
            end = {pierced_by(plane.plane, source_, facet, edge), is_second,
                   static_cast<std::int8_t>(edge)};
        }
        return out;
    }

    [[nodiscard]] bool is_above(std::uint32_t facet, int corner, std::size_t number) const {
        const bool is_wrong = (sides_[source_.corner_index(facet, corner)] >> number & 1U) != 0;
        return is_wrong == planes_[number].keeps_below;
    }

    // The lists of all parts.
    std::vector<std::uint32_t> join() {
        std::size_t facets = 0;
        std::size_t pairs = 0;
        for (const Part& part : parts_) {
            facets += part.uncrossed.size();
            pairs += part.pairs.size();
        }
        memory_.keep(facets * sizeof(std::uint32_t) + pairs * sizeof(FacetCrossing));
        stats_.untouched_polygons += facets;
        stats_.pairs_touching += pairs;
        stats_.pairs_cutting += pairs;
        crossings_.pairs.reserve(pairs);
        std::vector<std::uint32_t> uncrossed = std::move(parts_[0].uncrossed);
        uncrossed.reserve(facets);
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Part& part = parts_[i];
            crossings_.pairs.insert(crossings_.pairs.end(), part.pairs.begin(), part.pairs.end());
            if (i > 0)
                uncrossed.insert(uncrossed.end(), part.uncrossed.begin(), part.uncrossed.end());
        }
        return uncrossed;
    }

    const Source& source_;
    std::size_t mesh_slot_;
    std::span<const PlaneOfSlot> planes_;
    CuttingPair pair_;
    const EvaluateSettings& options_;
    MemoryBudget memory_;
    Crossings& crossings_;
    EvaluateStats& stats_;
    std::vector<Sides> sides_;  // by corner
    std::vector<Part> parts_;
};

// The half-spaces that bound the result; nothing where this is not as simple.
std::optional<std::vector<PlaneOfSlot>> cutting_planes(const SolidStates& solids, std::size_t mesh,
                                                       const Crossings& crossings) {
    std::vector<PlaneSide> sides;
    std::vector<std::size_t> slots;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        if (i == mesh) continue;
        sides.push_back(
            {cut_source_of(*solids[i]).support(0), crossings.operands[i].is_open_below()});
        slots.push_back(i);
    }
    const auto tight = tight_sides(sides);
    if (!tight) return std::nullopt;
    std::vector<PlaneOfSlot> out;
    for (const std::size_t i : *tight)
        out.push_back({CuttingPlane(sides[i].plane, cut_source_of(*solids[mesh]).box()), slots[i],
                       sides[i].below});
    return out;
}

}  // namespace

bool is_mesh_with_half_spaces(const Residual::Ref& formula, const SolidStates& solids,
                              const EvaluateSettings& options) {
    if (solids.size() < 2 || options.budget != nullptr) return false;
    const auto crossings = crossings_of(*formula, solids, CrossingOperands::WithHalfSpaces);
    if (!crossings) return false;
    const auto mesh = slot_of_mesh(solids);
    if (!mesh) return false;
    const CellRef& root = solids[*mesh]->root();
    // What is far away is not open to the planes: they end within the mesh.
    return lies_outside(root.node->reference(), cut_source_of(*solids[*mesh]).box()) &&
           complemented_winding(root.node->winding(), root.complemented) !=
               crossings->operands[*mesh].open;
}

std::optional<SolidForm> evaluate_between_half_spaces(const Residual::Ref& formula,
                                                      const SolidStates& solids,
                                                      const EvaluateSettings& options,
                                                      EvaluateStats& stats,
                                                      std::shared_ptr<const LazyTree> tree) {
    auto crossings = crossings_of(*formula, solids, CrossingOperands::WithHalfSpaces);
    const std::size_t mesh = *slot_of_mesh(solids);
    const auto planes = cutting_planes(solids, mesh, *crossings);
    if (!planes) return std::nullopt;
    EvaluateStats made;
    MeshCut cut(solids, mesh, *planes, options, *crossings, made);
    auto uncrossed = cut.run();
    if (!uncrossed || crossings->pairs.empty()) return std::nullopt;
    crossings->arrange();
    made.half_space_cuts = 1;
    made.memory = cut.memory();
    stats = made;
    std::vector<UncrossedFacets> lists;
    for (std::size_t i = 0; i < solids.size(); ++i)
        lists.push_back({&cut_source_of(*solids[i]), crossings->operands[i].inside_above, {}});
    lists[mesh].facets = *std::move(uncrossed);
    return UndividedMeshes{std::move(lists),
                           std::make_shared<const Crossings>(*std::move(crossings)),
                           std::move(tree)};
}

}  // namespace trisect::detail
