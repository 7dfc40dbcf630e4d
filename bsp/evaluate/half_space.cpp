// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/half_space.h>

#include <utility>
#include <variant>

namespace trisect::detail {

// The reference is some point that is not on the plane.
CellRef half_space_root(const Source& source) {
    const Plane plane = source.support(0);
    FinePoint p;
    int s = 0;
    for (std::int64_t k = 1; s == 0; ++k) {
        p.c = {2 * k, 6 * k * k, 10 * k * k * k};
        s = sign_of(side_of(HomogeneousPoint({p.c[0], p.c[1], p.c[2]}, splitting_scale), plane));
    }
    return {CellNode::fresh(source, p, s < 0 ? 1 : 0, false), false};
}

bool is_half_space(const SolidState& state) {
    const auto* const tree = std::get_if<CellTree>(&state.form);
    if (tree == nullptr) return false;
    const CellNode& root = *tree->root.node;
    if (!root.is_leaf() || root.deferred() != nullptr) return false;
    const PolygonList& polygons = root.polygons();
    return polygons.has_all_facets() && polygons.size() == 1 &&
           polygons.whole_source()->is_half_space() && polygons.whole_source()->is_unbounded();
}

std::shared_ptr<const SolidState> half_space_on(const SolidState& state, Lattice lattice) {
    auto out = std::make_shared<SolidState>(state);
    const auto source =
        state.root().node->polygons().whole_source()->half_space_on(lattice.exponent);
    out->lattice = lattice;
    CellRef root = half_space_root(*source);
    root.complemented = state.root().complemented;
    out->form = CellTree{std::move(root), {}, nullptr};
    return out;
}

}  // namespace trisect::detail
