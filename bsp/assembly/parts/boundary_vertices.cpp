// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/boundary_vertices.h>

#include <algorithm>

#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

std::uint64_t hash_of(const LatticePoint& p) {
    return mix64(p.x.bits() * 0x9e3779b97f4a7c15ULL ^
                 mix64(p.y.bits() * 0xc2b2ae3d27d4eb4fULL ^ p.z.bits()));
}

}  // namespace

BoundaryVertices::BoundaryVertices(const BoundaryParts& parts)
    : parts_(parts), of_point_(parts.bench.point_count(), none) {
    std::size_t corners = 0;
    for (const FacetMarks& marks : parts.sources) {
        const std::size_t n = marks.source()->mesh().points.size();
        of_corner_.emplace_back(n, none);
        corners += n;
    }
    corners = std::min<std::size_t>(corners, 3 * parts.stats.whole_facets);
    vertices_.reserve(corners + parts.bench.point_count());
    std::size_t want = 64;
    while (want < 2 * corners) want *= 2;
    slots_.assign(want, none);
}

std::size_t BoundaryVertices::slot_of(const LatticePoint& p) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = static_cast<std::size_t>(hash_of(p)) & mask;
    while (slots_[i] != none && vertices_[slots_[i]].corner != p) i = (i + 1) & mask;
    return i;
}

void BoundaryVertices::rehash(std::size_t size) {
    PoolVector<Index> old(size, none);
    old.swap(slots_);
    for (const Index v : old)
        if (v != none) slots_[slot_of(vertices_[v].corner)] = v;
}

BoundaryVertices::Index BoundaryVertices::find_or_add(const LatticePoint& p) {
    if (2 * (used_ + 1) > slots_.size()) rehash(2 * slots_.size());
    Index& slot = slots_[slot_of(p)];
    if (slot != none) return slot;
    ++used_;
    slot = static_cast<Index>(vertices_.size());
    vertices_.push_back({-1, p});
    return slot;
}

BoundaryVertices::Index BoundaryVertices::of_point(PointId p) {
    if (as_index(p) >= of_point_.size()) of_point_.resize(parts_.bench.point_count(), none);
    Index& at = of_point_[as_index(p)];
    if (at != none) return at;
    if (parts_.bench.is_corner(p)) {
        at = find_or_add(parts_.bench.lattice(p));
    } else {
        at = static_cast<Index>(vertices_.size());
        vertices_.emplace_back();
    }
    vertices_[at].point = p;
    return at;
}

BoundaryVertices::Index BoundaryVertices::of_corner(std::size_t table, std::uint32_t vertex) {
    Index& at = of_corner_[table][vertex];
    if (at == none) at = find_or_add(parts_.sources[table].source()->mesh().points[vertex]);
    return at;
}

}  // namespace trisect::detail
