// SPDX-License-Identifier: Apache-2.0
//
// In a balanced tree of neighbours each level would look at all facets, and copy half of them,
// though only those beside the boundary between two halves can meet anything. A facet in a clear
// box can not. Nor is a point out of the clear box, and beyond the box of what is not settled,
// within the solid: a ray from there along an axis goes by both boxes.

#include <trisect/bsp/many_meshes/outlines/settled_parts.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include <trisect/kernel/support/touched_room.h>

namespace trisect::detail {

namespace {

// Of a position in lattice units: more than what lies between, rounded.
constexpr double clear_margin = 4;

// So many facets, and such a part of all, are worth a step.
constexpr std::size_t least_settled = 256;
constexpr std::size_t least_part = 8;

// A copy of facets of a solid, with those vertices that they have.
class PartCopy {
public:
    // For those facets that will be added, and those that will be kept.
    PartCopy(const OutlineStore& store, const OutlineStore::Solid& solid,
             std::span<const std::uint32_t> added, std::span<const std::uint32_t> kept)
        : solid_(store.view(solid)),
          first_vertex_(static_cast<std::uint32_t>(solid.vertices)),
          first_line_(static_cast<std::uint32_t>(solid.lines)),
          numbers_(solid_.vertices.size() - solid.vertices, none),
          part_(std::make_unique<SettledPart>()) {
        // There are many parts: what they do not use would be a good part of all memory.
        std::size_t vertices = 0;
        part_->facets.reserve(added.size());
        part_->boxes.reserve(added.size());
        part_->edges.reserve(count_edges(added, vertices));
        part_->lines.reserve(count_lines(added));
        PoolVector<std::uint32_t> cut;
        for (const std::uint32_t f : kept)
            if (!solid_.facets[f].whole) cut.push_back(f);
        part_->kept.reserve(cut.size());
        part_->kept_whole.reserve(kept.size() - cut.size());
        part_->kept_edges.reserve(count_edges(cut, vertices));
        part_->vertices.reserve(vertices);
    }
    void add(std::size_t place) {
        const OutlinedSolid::Facet& f = solid_.facets[place];
        const auto first = static_cast<std::uint32_t>(part_->edges.size());
        for (const OutlinedSolid::Edge& e : solid_.edges_of(f))
            part_->edges.push_back({number(e.from), number(e.to), origin(e)});
        part_->facets.push_back({f.number, f.slot, first, f.count, f.whole});
        part_->boxes.push_back(solid_.boxes[place]);
        part_->box.add(solid_.boxes[place]);
    }
    // As assembly takes it.
    void keep(std::size_t place, const ManyMeshes& meshes) {
        const OutlinedSolid::Facet& f = solid_.facets[place];
        part_->box.add(solid_.boxes[place]);
        if (f.whole) {
            part_->kept_whole.push_back({f.number, f.slot});
            return;
        }
        const auto first = static_cast<std::uint32_t>(part_->kept_edges.size());
        for (const OutlinedSolid::Edge& e : solid_.edges_of(f))
            part_->kept_edges.push_back(for_assembly(e, f, meshes));
        part_->kept.push_back({f.number, first, f.count});
    }
    // One that goes.
    void drop(std::size_t place) { part_->box.add(solid_.boxes[place]); }
    // Those of a facet that was added are shared if they were there before so many.
    void share(std::size_t place, std::size_t vertices) {
        for (const OutlinedSolid::Edge& e : solid_.edges_of(solid_.facets[place]))
            if (OutlineVertex* const v = vertex(e.from); v < &part_->vertices[0] + vertices)
                v->is_shared = true;
    }
    [[nodiscard]] SettledPart& part() { return *part_; }
    // Of a vertex of the solid, if the part has it; else null.
    [[nodiscard]] OutlineVertex* vertex(std::uint32_t v) {
        const std::uint32_t number = numbers_[v - first_vertex_];
        return number >= wanted ? nullptr : &part_->vertices[number];
    }
    [[nodiscard]] std::unique_ptr<SettledPart> take() { return std::move(part_); }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    static constexpr std::uint32_t wanted = none - 1;  // it has no number yet
    [[nodiscard]] OutlinedFacets::Edge for_assembly(const OutlinedSolid::Edge& e,
                                                    const OutlinedSolid::Facet& f,
                                                    const ManyMeshes& meshes) {
        OutlinedFacets::Edge out = solid_.for_assembly(meshes, e, f.number, f.slot);
        out.from = number(e.from);
        out.to = number(e.to);
        return out;
    }
    [[nodiscard]] EdgeOrigin origin(const OutlinedSolid::Edge& e) {
        if (!e.origin.has_line()) return e.origin;
        std::uint32_t& line = lines_[e.origin.line() - first_line_];
        if (line == wanted) {
            line = static_cast<std::uint32_t>(part_->lines.size());
            part_->lines.push_back(solid_.lines[e.origin.line()]);
        }
        return EdgeOrigin::of_line(line);
    }
    [[nodiscard]] std::size_t count_lines(std::span<const std::uint32_t> places) {
        if (!places.empty()) lines_.assign(solid_.lines.size() - first_line_, none);
        std::size_t lines = 0;
        for (const std::uint32_t f : places)
            for (const OutlinedSolid::Edge& e : solid_.edges_of(solid_.facets[f]))
                if (e.origin.has_line() &&
                    std::exchange(lines_[e.origin.line() - first_line_], wanted) == none)
                    ++lines;
        return lines;
    }
    // Counts vertices that are wanted for the first time, too.
    [[nodiscard]] std::size_t count_edges(std::span<const std::uint32_t> places,
                                          std::size_t& vertices) {
        std::size_t edges = 0;
        for (const std::uint32_t f : places) {
            edges += solid_.facets[f].count;
            for (const OutlinedSolid::Edge& e : solid_.edges_of(solid_.facets[f]))
                if (std::exchange(numbers_[e.from - first_vertex_], wanted) == none) ++vertices;
        }
        return edges;
    }
    [[nodiscard]] std::uint32_t number(std::uint32_t vertex) {
        std::uint32_t& number = numbers_[vertex - first_vertex_];
        if (number == wanted) {
            number = static_cast<std::uint32_t>(part_->vertices.size());
            part_->vertices.push_back(solid_.vertices[vertex]);
        }
        return number;
    }

    OutlinedSolid solid_;
    std::uint32_t first_vertex_;
    std::uint32_t first_line_;
    PoolVector<std::uint32_t> numbers_;  // by vertex of the solid
    PoolVector<std::uint32_t> lines_;    // numbers of these, by line of the solid
    std::unique_ptr<SettledPart> part_;
};

// Facets that do not go with the part move to the front.
void leave_out(OutlineStore& store, OutlineStore::Solid& solid,
               std::span<const std::uint8_t> settles, PartCopy& part) {
    solid.box = OutlineBox::none();
    std::size_t left = solid.facets;
    for (std::size_t f = 0; f < settles.size(); ++f) {
        const OutlinedSolid::Facet facet = store.facets()[solid.facets + f];
        if (settles[f] != 0) {
            solid.unused_edges += facet.count;
            continue;
        }
        for (std::uint32_t e = facet.first; e < facet.first + facet.count; ++e) {
            const std::uint32_t v = store.edge(e).from;
            if (OutlineVertex* const settled = part.vertex(v); settled != nullptr)
                settled->is_shared = store.vertices()[v].is_shared = true;
        }
        solid.box.add(store.boxes()[solid.facets + f]);
        store.facets()[left] = facet;
        store.boxes()[left] = store.boxes()[solid.facets + f];
        ++left;
    }
    store.facets().resize(left);
    store.boxes().resize(left);
}

using Settles = PoolVector<std::uint8_t>;  // by facet, whether it does

// By facet that settles.
PoolVector<OutlineSide> sides_of(const OutlinedSolid& all, const Settles& settles,
                                 const Settling& how) {
    PoolVector<OutlineSide> out(settles.size(), OutlineSide::Unknown);
    if (how.sides == nullptr) return out;
    for (std::size_t f = 0; f < settles.size(); ++f)
        if (settles[f] != 0) out[f] = how.sides->side_of(all.boxes[f]);
    return out;
}

void settle_those(OutlineStore& store, OutlineStore::Solid& solid, const Settles& settles,
                  const Settling& how) {
    const OutlinedSolid all = store.view(solid);
    const PoolVector<OutlineSide> sides = sides_of(all, settles, how);
    // Those that are not beside the boundary first.
    PoolVector<std::uint32_t> added;
    PoolVector<std::uint32_t> kept;
    PoolVector<std::uint32_t>& open = how.for_assembly == nullptr ? added : kept;
    for (std::uint32_t f = 0; f < settles.size(); ++f)
        if (settles[f] != 0 && sides[f] == OutlineSide::Open) open.push_back(f);
    const std::size_t far = added.size();
    for (std::uint32_t f = 0; f < settles.size(); ++f)
        if (settles[f] != 0 && sides[f] == OutlineSide::Unknown) added.push_back(f);
    PartCopy part(store, solid, added, kept);
    for (const std::uint32_t f : kept) part.keep(f, *how.for_assembly);
    const auto near = std::span(added).subspan(far);
    for (const std::uint32_t f : std::span(added).first(far)) part.add(f);
    const std::size_t vertices = part.part().vertices.size();
    for (const std::uint32_t f : near) part.add(f);
    if (how.sides != nullptr)
        for (const std::uint32_t f : near) part.share(f, vertices);
    for (std::size_t f = 0; f < settles.size(); ++f)
        if (settles[f] != 0 && sides[f] == OutlineSide::Closed) part.drop(f);
    part.part().far = far;
    leave_out(store, solid, settles, part);
    store.add_settled(part.take());
}

}  // namespace

Key128 name_of(const OutlineVertex& v) {
    const auto kind = static_cast<std::uint64_t>(v.kind);
    const auto which = static_cast<std::uint64_t>(v.which);
    return {std::uint64_t{v.facets[0]} << 32U | v.facets[1],
            std::uint64_t{v.facets[2]} << 32U | which << 8U | kind};
}

ClearBox::ClearBox() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    lo_.fill(-infinity);
    hi_.fill(infinity);
}

bool ClearBox::is_all() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k)
        if (lo_[k] != -infinity || hi_[k] != infinity) return false;
    return true;
}

bool ClearBox::has(const OutlineBox& box) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (!(lo_[k] < box.lo[k] && box.hi[k] < hi_[k])) return false;
    return true;
}

// Any one plane across an axis that has all of `those` on one side serves; the one that leaves most
// of the own box is taken.
ClearBox ClearBox::without(std::span<const Box> boxes, std::span<const std::uint32_t> those,
                           std::span<const std::uint32_t> own) const {
    Box mine;
    Box begins;  // where boxes begin, from the first to the last
    Box ends;
    const auto add = [](Box& box, const std::array<std::int64_t, 3>& at) {
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = std::min(box.lo[k], at[k]);
            box.hi[k] = std::max(box.hi[k], at[k]);
        }
    };
    for (const std::uint32_t s : own) mine.add(boxes[s]);
    for (const std::uint32_t s : those) {
        add(begins, boxes[s].lo);
        add(ends, boxes[s].hi);
    }
    ClearBox out = *this;
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const auto low = static_cast<double>(mine.lo[k]);
        const auto high = static_cast<double>(mine.hi[k]);
        const double length = high - low + 1;
        const double below = static_cast<double>(begins.lo[k]) - clear_margin;
        const double above = static_cast<double>(ends.hi[k]) + clear_margin;
        for (const bool is_below : {true, false}) {
            const double left = (is_below ? below - low : high - above) / length;
            if (left <= best) continue;
            best = left;
            out = *this;
            if (is_below)
                out.hi_[k] = std::min(out.hi_[k], below);
            else
                out.lo_[k] = std::max(out.lo_[k], above);
        }
    }
    return out;
}

void settle(OutlineStore& store, OutlineStore::Solid& solid, const ClearBox& clear,
            const Settling& how) {
    const OutlinedSolid all = store.view(solid);
    Settles settles(all.facets.size());
    std::size_t facets = 0;
    for (std::size_t f = 0; f < settles.size(); ++f) {
        if (!clear.has(all.boxes[f])) continue;
        settles[f] = 1;
        ++facets;
    }
    if (facets < std::max(least_settled, settles.size() / least_part)) return;
    settle_those(store, solid, settles, how);
    store.tidy(solid);
}

void settle_rest(OutlineStore& store, OutlineStore::Solid& solid, const Settling& how) {
    settle_those(store, solid, Settles(store.view(solid).facets.size(), 1), how);
    store.tidy(solid);
}

void JoinedParts::reserve(std::size_t facets, std::size_t edges, std::size_t vertices,
                          std::size_t lines, std::uint32_t threads) {
    // With room for what is cut next.
    const auto reserve_more = [threads](auto& items, std::size_t more) {
        if (items.size() + more > items.capacity()) items.reserve(items.size() + more + more / 4);
        reserve_touched(items, more, threads);
    };
    reserve_more(store_.facets(), facets);
    reserve_more(store_.boxes(), facets);
    reserve_more(store_.edges(), edges);
    reserve_more(store_.vertices(), vertices);
    reserve_more(store_.lines(), lines);
}

void JoinedParts::begin(const SettledPart& part) {
    numbers_.assign(part.vertices.size(), none);
    lines_.assign(part.lines.size(), none);
}

void JoinedParts::add(const SettledPart& part, std::size_t place) {
    const OutlinedSolid::Facet& f = part.facets[place];
    PoolVector<OutlinedSolid::Edge>& edges = store_.edges();
    const auto first = static_cast<std::uint32_t>(edges.size());
    for (std::uint32_t i = f.first; i < f.first + f.count; ++i) {
        const OutlinedSolid::Edge& e = part.edges[i];
        edges.push_back({number(part, e.from), number(part, e.to), origin(part, e.origin)});
    }
    store_.facets().push_back({f.number, f.slot, first, f.count, f.whole});
    store_.boxes().push_back(part.boxes[place]);
    solid_.box.add(part.boxes[place]);
}

EdgeOrigin JoinedParts::origin(const SettledPart& part, const EdgeOrigin& origin) {
    if (!origin.has_line()) return origin;
    std::uint32_t& number = lines_[origin.line()];
    if (number == none) {
        number = static_cast<std::uint32_t>(store_.lines().size());
        store_.lines().push_back(part.lines[origin.line()]);
    }
    return EdgeOrigin::of_line(number);
}

std::uint32_t JoinedParts::number(const SettledPart& part, std::uint32_t vertex) {
    std::uint32_t& number = numbers_[vertex];
    if (number != none) return number;
    const OutlineVertex& v = part.vertices[vertex];
    PoolVector<OutlineVertex>& vertices = store_.vertices();
    number = static_cast<std::uint32_t>(vertices.size());
    if (v.is_shared)
        number = static_cast<std::uint32_t>(
            shared_.insert(name_of(v), static_cast<std::int32_t>(number)).first);
    if (number == vertices.size()) vertices.push_back(v);
    return number;
}

void join_settled(OutlineStore& store, OutlineStore::Solid& solid) {
    if (store.settled(solid).empty()) return;
    SettledParts parts = store.take_out(solid);
    std::size_t facets = 0;
    std::size_t edges = 0;
    std::size_t vertices = 0;
    std::size_t lines = 0;
    for (const auto& p : parts) {
        facets += p->facets.size();
        edges += p->edges.size();
        vertices += p->vertices.size();
        lines += p->lines.size();
    }
    JoinedParts joined(store);
    joined.reserve(facets, edges, vertices, lines, 1);
    for (auto& p : parts) {
        joined.begin(*p);
        for (std::size_t f = 0; f < p->facets.size(); ++f) joined.add(*p, f);
        p.reset();
    }
    const bool open_far_out = solid.open_far_out;
    solid = joined.solid();
    solid.open_far_out = open_far_out;
}

}  // namespace trisect::detail
