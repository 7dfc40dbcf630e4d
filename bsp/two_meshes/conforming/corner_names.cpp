// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/conforming/corner_names.h>

#include <algorithm>
#include <bit>
#include <bitset>
#include <utility>
#include <vector>

namespace trisect::detail {

namespace {

std::uint64_t hash_of(const LatticePoint& p) {
    std::uint64_t h = p.x.bits() * 0x9e3779b97f4a7c15ULL;
    h = (h ^ h >> 32 ^ p.y.bits()) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ h >> 29 ^ p.z.bits()) * 0x94d049bb133111ebULL;
    return h ^ h >> 32;
}

// Some corners, and a bit for the hash of each.
class CornerSample {
public:
    static constexpr std::size_t few = 64;

    CornerSample(const LatticeMesh& mesh, std::span<const std::uint32_t> facets) {
        const std::size_t step = std::max(facets.size() / few, std::size_t{1});
        for (std::size_t i = 0; i < facets.size(); i += step)
            for (const std::uint32_t v : mesh.triangles[facets[i]]) {
                const std::uint64_t hash = hash_of(mesh.points[v]);
                bits_.set(bit_of(hash));
                corners_.emplace_back(hash, &mesh.points[v]);
            }
        std::ranges::sort(corners_, {}, &Corner::first);
    }
    [[nodiscard]] bool has(const LatticePoint& p) const {
        const std::uint64_t hash = hash_of(p);
        if (!bits_.test(bit_of(hash))) return false;
        for (auto c = std::ranges::lower_bound(corners_, hash, {}, &Corner::first);
             c != corners_.end() && c->first == hash; ++c)
            if (*c->second == p) return true;
        return false;
    }

private:
    using Corner = std::pair<std::uint64_t, const LatticePoint*>;
    static constexpr unsigned size_bits = 13;
    static std::size_t bit_of(std::uint64_t hash) {
        return static_cast<std::size_t>(hash >> (64 - size_bits));
    }
    std::bitset<std::size_t{1} << size_bits> bits_;
    std::vector<Corner> corners_;
};

}  // namespace

bool may_have_common_corners(const std::array<const LatticeMesh*, 2>& meshes,
                             const std::array<std::span<const std::uint32_t>, 2>& facets) {
    const CornerSample sample(*meshes[0], facets[0]);
    // Of many facets nearly each corner is the first one of some.
    const std::size_t looked_at = facets[1].size() > CornerSample::few ? 1 : 3;
    return std::ranges::any_of(facets[1], [&](std::uint32_t f) {
        const std::span corners = std::span(meshes[1]->triangles[f]).first(looked_at);
        return std::ranges::any_of(
            corners, [&](std::uint32_t v) { return sample.has(meshes[1]->points[v]); });
    });
}

CornerNames::CornerNames(const std::array<const LatticeMesh*, 2>& meshes,
                         const std::array<std::span<const std::uint32_t>, 2>& facets,
                         StackArena& arena)
    : meshes_(meshes),
      facets_(facets),
      items_{static_cast<std::uint32_t>(facets[0].size()),
             static_cast<std::uint32_t>(facets[0].size() + facets[1].size())},
      first_points_(static_cast<std::uint32_t>(meshes[0]->points.size())),
      arena_(arena),
      triples_(arena.take<Triple>(items_[1])),
      at_(arena.take<std::uint32_t>(most_names())),
      is_common_(arena.take<std::uint8_t>(most_names())) {
    rehash(std::bit_ceil(facets[0].size() + 16));
    for (std::size_t mesh = 0; mesh < 2; ++mesh) name_corners(mesh);
}

void CornerNames::name_corners(std::size_t mesh) {
    const LatticeMesh& m = *meshes_[mesh];
    auto* const names = arena_.take<std::uint32_t>(m.points.size());  // of corners that have one
    std::fill(names, names + m.points.size(), none);
    const std::uint32_t first = mesh == 0 ? 0 : first_points_;
    Triple* out = triples_ + first_item(mesh);
    for (const std::uint32_t f : facets_[mesh]) {
        const auto& t = m.triangles[f];
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& name = names[t[k]];
            if (name == none) name = name_of(first + t[k], m.points[t[k]], mesh == 1);
            (*out)[k] = name;
        }
        ++out;
    }
}

std::uint32_t CornerNames::name_of(std::uint32_t at, const LatticePoint& p, bool is_second) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = static_cast<std::size_t>(hash_of(p)) & mask;
    while (slots_[i].name != none && point_at(slots_[i].at) != p) i = (i + 1) & mask;
    if (const std::uint32_t name = slots_[i].name; name != none) {
        if (is_second && slots_[i].at < first_points_ && is_common_[name] == 0) {
            is_common_[name] = 1;
            ++common_count_;
        }
        return name;
    }
    const auto name = static_cast<std::uint32_t>(count_++);
    slots_[i] = {name, at};
    at_[name] = at;
    is_common_[name] = 0;
    if (2 * count_ > slots_.size()) rehash(2 * slots_.size());
    return name;
}

void CornerNames::rehash(std::size_t slots) {
    slots_ = {arena_.take<Slot>(slots), slots};
    std::ranges::fill(slots_, Slot{none, none});
    const std::size_t mask = slots - 1;
    for (std::uint32_t name = 0; name < count_; ++name) {
        std::size_t i = static_cast<std::size_t>(hash_of(point_at(at_[name]))) & mask;
        while (slots_[i].name != none) i = (i + 1) & mask;
        slots_[i] = {name, at_[name]};
    }
}

}  // namespace trisect::detail
