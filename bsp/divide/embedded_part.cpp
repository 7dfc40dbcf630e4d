// SPDX-License-Identifier: Apache-2.0
//
// Of all facets that do not meet others 0 is above and 1 below, or they bound nothing. So winding
// numbers between what is left are 0 and 1, and so is whether the reference point is inside.

#include <trisect/bsp/divide/embedded_part.h>

#include <algorithm>
#include <new>
#include <span>

namespace trisect::detail {

namespace {

void leave_out_hidden(CellOperand& o, std::span<const FacetKind> kinds, StackArena& arena) {
    const auto is_plain = [&](const PackedBox& e) { return kinds[e.id] == FacetKind::Plain; };
    const std::span<const PackedBox> list = o.list();
    if (std::ranges::all_of(list, is_plain)) return;
    auto* const kept = arena.take<PackedBox>(list.size());
    std::uint32_t count = 0;
    for (const PackedBox& e : list)
        if (is_plain(e)) ::new (kept + count++) PackedBox(e);
    o.entries = kept;
    o.count = count;
}

bool are_all_plain(const PolygonList& leaf, std::span<const FacetKind> kinds) {
    const auto is_plain = [&](std::uint32_t f) { return kinds[f] == FacetKind::Plain; };
    return leaf.has_all_facets()
               ? std::ranges::all_of(kinds, [](FacetKind k) { return k == FacetKind::Plain; })
               : std::ranges::all_of(leaf.facets(), is_plain);
}

}  // namespace

bool take_as_embedded(CellOperand& o, StackArena& arena) {
    if (o.embedded || o.complemented || !(o.is_list || o.node->is_leaf())) return false;
    const PolygonList& polygons = o.node->polygons();
    const Source* source = polygons.whole_source();
    if (source == nullptr || source->kinds().empty() || polygons.flipped()) return false;
    const std::span<const FacetKind> kinds = source->kinds();
    if (o.is_list) {
        if (std::ranges::any_of(
                o.list(), [&](const PackedBox& e) { return kinds[e.id] == FacetKind::Meets; }))
            return false;
        leave_out_hidden(o, kinds, arena);
    } else if (!are_all_plain(polygons, kinds) || o.node->winding() < 0 || o.node->winding() > 1) {
        return false;  // what shares the node reads its winding number as that of an embedded one
    }
    o.embedded = true;
    o.winding = o.winding > 0 ? 1 : 0;
    return true;
}

}  // namespace trisect::detail
