// SPDX-License-Identifier: Apache-2.0
//
// 1. Corners of equal value get one name.
// 2. Around each corner that both meshes have, the edges that both have are looked at: an exact
//    sign for each two facets, one of either mesh, which have such an edge in common. They meet in
//    it alone unless they cover a part of one plane. Facets of a mesh that have a corner in common
//    which the other mesh has not, or an edge, are on one side of the other mesh: the other mesh
//    does not reach there, or they would meet one of its facets. So they fall into patches, which
//    end at common edges, and the order of the half-planes around such an edge says on which side a
//    patch is.
// 3. Patches of both that cover a part of one plane have to cover the same part. They do if their
//    borders are equal, edge for edge: the triangles of an embedded mesh do not overlap, so a
//    border determines what of the plane they cover.
// 4. Facets that have one corner in common, and others, must have nothing else in common. The
//    former are compared around the corner, in doubles; a search by boxes finds the latter. Facets
//    around such a part of a plane are not compared with those in it.

#include <trisect/bsp/two_meshes/conforming/conforming_meshes.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/bsp/two_meshes/conforming/beside_covering.h>
#include <trisect/bsp/two_meshes/conforming/common_corner.h>
#include <trisect/bsp/two_meshes/conforming/corner_fans.h>
#include <trisect/bsp/two_meshes/conforming/covering_patches.h>
#include <trisect/bsp/two_meshes/conforming/edge_order.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

namespace {

using Triple = CornerNames::Triple;

// Around corners that are tips of cones pairs are many; other ways cost less then.
constexpr std::uint64_t most_pairs_of_a_facet = 512;

// Of two facets, one of either mesh.
class PairContacts {
public:
    PairContacts(const CornerNames& names, const Patches& patches, const BesideCovering& beside)
        : names_(names), patches_(patches), beside_(beside) {}

    /// Whether they have nothing in common but corners and edges of both, or cover one part of a
    /// plane together with others.
    [[nodiscard]] bool is_conforming(std::uint32_t a, std::uint32_t b) const {
        if (patches_.root(a) == patches_.root(b) || beside_.meets_properly(a, b)) return true;
        std::array<LatticePoint, 6> points;
        IndexedTriangle first{0, 1, 2};
        IndexedTriangle second{3, 4, 5};
        for (std::uint32_t i = 0; i < 3; ++i) points[i] = names_.point(names_.corners(a)[i]);
        for (std::uint32_t k = 0; k < 3; ++k) {
            points[3 + k] = names_.point(names_.corners(b)[k]);
            for (std::uint32_t i = 0; i < 3; ++i)
                if (names_.corners(a)[i] == names_.corners(b)[k]) second[k] = i;
        }
        return find_contact(points, first, second).kind == ContactKind::None;
    }

private:
    const CornerNames& names_;
    const Patches& patches_;
    const BesideCovering& beside_;
};

// The items of both meshes that use an edge, and the order of their half-planes.
class CommonEdge {
public:
    using Uses = std::array<std::span<const CommonCorner::Use>, 2>;

    CommonEdge(const CornerNames& names, Patches& patches) : names_(names), patches_(patches) {}

    /// False where a mesh does not close around it, or has many facets there.
    [[nodiscard]] bool look_at(std::uint32_t from, const Uses& uses) {
        from_ = &names_.point(from);
        to_ = &names_.point(uses[0][0].other);
        for (std::size_t mesh = 0; mesh < 2; ++mesh)
            if (!list(mesh, uses[mesh])) return false;
        const Vector3 along = minus(to_->doubles(), from_->doubles());
        for (std::size_t i = 0; i < counts_[0]; ++i) {
            const Minors minors(along, halves_[0][i].apex_from);
            for (std::size_t k = 0; k < counts_[1]; ++k) turns_[i][k] = compare(i, k, minors);
        }
        for (std::size_t mesh = 0; mesh < 2; ++mesh) find_sides(mesh);
        return true;
    }

private:
    static constexpr std::size_t most = 8;

    struct HalfPlane {
        std::uint32_t item;
        std::uint32_t apex;
        bool forward;
        bool is_covered;
        Vector3 apex_from;  // the edge's first end
    };
    // Of two vectors whose components are differences of doubles.
    struct Minors {
        Vector3 value;
        Vector3 terms;

        Minors(const Vector3& a, const Vector3& b) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t u = k == 2 ? 0 : k + 1;
                const std::size_t v = k == 0 ? 2 : k - 1;
                const double over = a[u] * b[v];
                const double under = a[v] * b[u];
                value[k] = over - under;
                terms[k] = std::fabs(over) + std::fabs(under);
            }
        }
        // Of the determinant with another one; 0 where doubles do not decide.
        [[nodiscard]] int sign_with(const Vector3& c) const {
            const double det = (value[0] * c[0] + value[1] * c[1]) + value[2] * c[2];
            const double size = (terms[0] * std::fabs(c[0]) + terms[1] * std::fabs(c[1])) +
                                terms[2] * std::fabs(c[2]);
            return certain_sign(det, determinant_rounding * size);
        }
    };

    [[nodiscard]] bool list(std::size_t mesh, std::span<const CommonCorner::Use> uses) {
        if (uses.size() > most) return false;
        int balance = 0;
        const Vector3 origin = from_->doubles();
        counts_[mesh] = uses.size();
        HalfPlane* out = halves_[mesh].data();
        for (const CommonCorner::Use& use : uses) {
            *out++ = {use.item, use.apex, use.forward, false,
                      minus(names_.point(use.apex).doubles(), origin)};
            balance += use.forward ? 1 : -1;
        }
        return balance == 0;
    }
    // The turn from one to the other, 1 for counter-clockwise seen against the edge.
    [[nodiscard]] int exact_turn_of(std::uint32_t a, std::uint32_t b) const {
        return orientation(*to_, names_.point(a), names_.point(b), *from_);
    }
    [[nodiscard]] int compare(std::size_t i, std::size_t k, const Minors& minors) {
        HalfPlane& a = halves_[0][i];
        HalfPlane& b = halves_[1][k];
        const bool are_equal = a.apex == b.apex;
        if (!are_equal) {
            if (const int sign = minors.sign_with(b.apex_from); sign != 0) return sign;
            if (const int sign = exact_turn_of(a.apex, b.apex); sign != 0) return sign;
        }
        if (are_equal ||
            are_on_one_side(*from_, *to_, names_.point(a.apex), names_.point(b.apex))) {
            a.is_covered = b.is_covered = true;
            patches_.join_covering(a.item, b.item);
        }
        return 0;
    }
    // From a mesh's half-plane to one of the other mesh.
    [[nodiscard]] int known_turn(std::size_t mesh, std::size_t i, std::size_t other) const {
        return mesh == 0 ? turns_[i][other] : -turns_[other][i];
    }

    // Turning counter-clockwise the next facet of the other mesh is come to from below if it runs
    // along the edge, else from above.
    void find_sides(std::size_t mesh) {
        const auto& others = halves_[1 - mesh];
        for (std::size_t i = 0; i < counts_[mesh]; ++i) {
            const HalfPlane& h = halves_[mesh][i];
            if (h.is_covered || patches_.side(h.item) != FacetRelation::Unknown) continue;
            std::size_t next = 0;
            for (std::size_t k = 1; k < counts_[1 - mesh]; ++k)
                if (comes_between(known_turn(mesh, i, k), known_turn(mesh, i, next),
                                  exact_turn_of(others[k].apex, others[next].apex)))
                    next = k;
            patches_.set_side(h.item,
                              others[next].forward ? FacetRelation::Below : FacetRelation::Above);
        }
    }

    const CornerNames& names_;
    Patches& patches_;
    const LatticePoint* from_ = nullptr;
    const LatticePoint* to_ = nullptr;
    std::array<std::array<HalfPlane, most>, 2> halves_{};
    std::array<std::size_t, 2> counts_{};
    std::array<std::array<int, most>, most> turns_{};  // from the first mesh's to the second's
};

// All edges from one corner, those that the other end has not been looked at for.
class EdgesOfCorner {
public:
    EdgesOfCorner(const CornerNames& names, Patches& patches)
        : patches_(patches), edge_(names, patches) {}

    [[nodiscard]] bool look_at(const CommonCorner& corner) {
        CommonEdge::Uses left{corner.uses(0), corner.uses(1)};
        while (!left[0].empty() || !left[1].empty()) {
            std::uint32_t other = ~std::uint32_t{0};
            for (const auto& l : left)
                if (!l.empty()) other = std::min(other, l[0].other);
            CommonEdge::Uses uses;
            for (std::size_t mesh = 0; mesh < 2; ++mesh) {
                std::size_t n = 0;
                while (n < left[mesh].size() && left[mesh][n].other == other) ++n;
                uses[mesh] = left[mesh].first(n);
                left[mesh] = left[mesh].subspan(n);
            }
            if (uses[0].empty() || uses[1].empty()) {
                for (const auto& u : uses)
                    for (std::size_t i = 1; i < u.size(); ++i) patches_.join(u[0].item, u[i].item);
            } else if (!edge_.look_at(corner.name(), uses)) {
                return false;
            }
        }
        return true;
    }

private:
    Patches& patches_;
    CommonEdge edge_;
};

class ConformingSearch {
public:
    ConformingSearch(const std::array<const LatticeMesh*, 2>& meshes,
                     const std::array<std::span<const std::uint32_t>, 2>& facets,
                     std::uint32_t threads)
        : meshes_(meshes), facets_(facets), threads_(threads), names_(meshes, facets, arena_) {}

    [[nodiscard]] std::optional<ConformingMeshes> run(const PairsSearch& search) {
        if (names_.common_count() == 0 || names_.item_count() >= CornerFans::most_items)
            return std::nullopt;
        patches_.emplace(names_.item_count(), arena_);
        join_own_corners();
        if (!look_around_corners() || !patches_->is_consistent()) return std::nullopt;
        patches_->flatten();
        if (!look_at_covering()) return std::nullopt;
        const BesideCovering beside(names_, *patches_);
        const PairContacts contacts(names_, *patches_, beside);
        if (!are_conforming(contacts) || !search(check_of(contacts), lists_to_compare(beside)))
            return std::nullopt;
        return result();
    }

private:
    // Facets around a corner that the other mesh has not.
    void join_own_corners() {
        constexpr std::uint32_t none = ~std::uint32_t{0};
        if (names_.common_count() == names_.count()) return;
        std::vector<std::uint32_t> first(names_.count(), none);
        for (std::uint32_t item = 0; item < names_.item_count(); ++item)
            for (const std::uint32_t v : names_.corners(item)) {
                if (names_.is_common(v)) continue;
                if (first[v] == none) first[v] = item;
                patches_->join(item, first[v]);
            }
    }

    [[nodiscard]] bool look_around_corners() {
        const CornerFans fans(names_, arena_);
        const std::uint64_t most = most_pairs_of_a_facet * names_.item_count();
        std::uint64_t pairs = 0;
        CommonCorner corner(names_);
        EdgesOfCorner edges(names_, *patches_);
        for (std::uint32_t name = 0; name < names_.count(); ++name) {
            if (!names_.is_common(name)) continue;
            corner.set(name, fans);
            check_stop(corner.pair_count());
            pairs += corner.pair_count();
            if (pairs > most || !edges.look_at(corner)) return false;
            corner.add_open_pairs(open_);
        }
        return true;
    }

    [[nodiscard]] bool look_at_covering() {
        auto covering = find_covering(names_, *patches_);
        if (!covering) return false;
        covering_ = *std::move(covering);
        return true;
    }

    [[nodiscard]] bool are_conforming(const PairContacts& contacts) const {
        std::atomic<bool> are_all{true};
        constexpr std::size_t least = 4096;
        ParallelParts(open_.size(), threads_, least)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end && are_all.load(std::memory_order_relaxed); ++i)
                    if (!contacts.is_conforming(open_[i][0], open_[i][1])) are_all = false;
            });
        return are_all;
    }

    // Facets of both that are covered need no comparison: each mesh has them in its own boundary,
    // where they meet others in corners and edges. Nor do those beside them.
    [[nodiscard]] std::vector<FacetLists> lists_to_compare(const BesideCovering& beside) const {
        std::array<FacetLists, 2> lists;  // by mesh: own ones, covered ones
        FacetLists unclear;               // of the own ones
        for (std::uint32_t item = 0; item < names_.item_count(); ++item) {
            const std::size_t mesh = names_.mesh_of(item);
            const std::uint32_t facet = names_.facet(item);
            const bool is_covered = patches_->is_covered(item);
            lists[mesh][is_covered ? 1 : 0].push_back(facet);
            if (!is_covered && !beside.is_clear(item)) unclear[mesh].push_back(facet);
        }
        return {{lists[0][0], lists[1][0]}, {unclear[0], lists[1][1]}, {lists[0][1], unclear[1]}};
    }

    // Items of facets.
    [[nodiscard]] const std::uint32_t* items_of(std::size_t mesh) {
        auto* const out = arena_.take<std::uint32_t>(meshes_[mesh]->triangles.size());
        std::uint32_t item = names_.first_item(mesh);
        for (const std::uint32_t f : facets_[mesh]) out[f] = item++;
        return out;
    }

    [[nodiscard]] PairsCheck check_of(const PairContacts& contacts) {
        const std::uint32_t* const of_first = items_of(0);
        const std::uint32_t* const of_second = items_of(1);
        return [=, this](std::span<const PackedBox> first, std::span<const PackedBox> second) {
            constexpr std::size_t most = 64;
            for (; !second.empty(); second = second.subspan(std::min(most, second.size()))) {
                const auto part = second.first(std::min(most, second.size()));
                std::array<Triple, most> corners;
                for (std::size_t k = 0; k < part.size(); ++k)
                    corners[k] = names_.corners(of_second[part[k].id]);
                for (const PackedBox& a : first) {
                    const PackedReach reach(a);
                    const std::uint32_t item = of_first[a.id];
                    const Triple s = names_.corners(item);
                    for (std::size_t k = 0; k < part.size(); ++k)
                        if (reach.meets(part[k]) && !have_common(s, corners[k]) &&
                            !contacts.is_conforming(item, of_second[part[k].id]))
                            return false;
                }
            }
            return true;
        };
    }

    // Without a branch: whether they have is as good as random.
    [[nodiscard]] static bool have_common(const Triple& s, const Triple& t) {
        const int a = int{s[0] == t[0]} | int{s[0] == t[1]} | int{s[0] == t[2]};
        const int b = int{s[1] == t[0]} | int{s[1] == t[1]} | int{s[1] == t[2]};
        const int c = int{s[2] == t[0]} | int{s[2] == t[1]} | int{s[2] == t[2]};
        return (a | b | c) != 0;
    }

    [[nodiscard]] std::optional<ConformingMeshes> result() {
        ConformingMeshes out;
        for (std::size_t mesh = 0; mesh < 2; ++mesh) {
            auto& relations = out.meshes[mesh].relations;
            const std::uint32_t first = names_.first_item(mesh);
            relations.resize(facets_[mesh].size());
            for (std::size_t i = 0; i < relations.size(); ++i) {
                const auto item = static_cast<std::uint32_t>(first + i);
                relations[i] =
                    patches_->is_covered(item) ? FacetRelation::Same : patches_->side(item);
                out.are_some_unknown =
                    out.are_some_unknown || relations[i] == FacetRelation::Unknown;
            }
        }
        for (const std::uint32_t item : covering_.opposite) {
            const std::size_t mesh = names_.mesh_of(item);
            out.meshes[mesh].relations[item - names_.first_item(mesh)] = FacetRelation::Opposite;
        }
        for (std::size_t mesh = 0; mesh < 2; ++mesh)
            if (out.are_some_unknown || facets_[mesh].size() < meshes_[mesh]->triangles.size())
                list_common(mesh, out.meshes[mesh]);
        if (out.are_some_unknown && !choose_corners(out)) return std::nullopt;
        out.equal_corners = equal_corners();
        return out;
    }

    void list_common(std::size_t mesh, ConformingMeshes::Mesh& out) const {
        out.is_common.resize(meshes_[mesh]->points.size());
        for_each_corner(mesh, [&](std::uint32_t corner, std::uint32_t name) {
            if (names_.is_common(name)) out.is_common[corner] = true;
        });
    }

    // One for each patch. False where it has none.
    [[nodiscard]] bool choose_corners(ConformingMeshes& out) const {
        constexpr std::uint32_t none = ~std::uint32_t{0};
        std::vector<std::uint32_t> of_root(names_.item_count(), none);
        for (std::uint32_t item = 0; item < names_.item_count(); ++item) {
            const auto& t = meshes_[names_.mesh_of(item)]->triangles[names_.facet(item)];
            for (std::size_t k = 0; k < 3; ++k)
                if (!names_.is_common(names_.corners(item)[k]))
                    of_root[patches_->root(item)] = t[k];
        }
        for (std::size_t mesh = 0; mesh < 2; ++mesh) {
            auto& m = out.meshes[mesh];
            m.corners.resize(m.relations.size());
            for (std::size_t i = 0; i < m.corners.size(); ++i) {
                const auto item = static_cast<std::uint32_t>(names_.first_item(mesh) + i);
                m.corners[i] = of_root[patches_->root(item)];
                if (m.relations[i] == FacetRelation::Unknown && m.corners[i] == none) return false;
            }
        }
        return true;
    }

    template <class Visit>
    void for_each_corner(std::size_t mesh, const Visit& visit) const {
        for (std::uint32_t item = names_.first_item(mesh); item < names_.first_item(mesh + 1);
             ++item) {
            const auto& t = meshes_[mesh]->triangles[names_.facet(item)];
            for (std::size_t k = 0; k < 3; ++k) visit(t[k], names_.corners(item)[k]);
        }
    }

    [[nodiscard]] std::shared_ptr<const EqualCorners> equal_corners() const {
        auto out = std::make_shared<EqualCorners>();
        for (const std::uint8_t mesh : {std::uint8_t{0}, std::uint8_t{1}}) {
            std::vector<bool> is_listed(meshes_[mesh]->points.size());
            for_each_corner(mesh, [&](std::uint32_t corner, std::uint32_t name) {
                if (!names_.is_common(name) || is_listed[corner]) return;
                is_listed[corner] = true;
                const std::uint32_t first = names_.first_corner(name);
                if (mesh == 1 || first != corner) out->pairs.push_back({corner, first, mesh});
            });
        }
        return out;
    }

    StackArena arena_;
    std::array<const LatticeMesh*, 2> meshes_;
    std::array<std::span<const std::uint32_t>, 2> facets_;
    std::uint32_t threads_;
    CornerNames names_;
    std::optional<Patches> patches_;
    CoveringPatches covering_;
    std::vector<CommonCorner::Pair> open_;  // with one corner in common
};

}  // namespace

std::optional<ConformingMeshes> find_conforming(
    const std::array<const LatticeMesh*, 2>& meshes,
    const std::array<std::span<const std::uint32_t>, 2>& facets, const PairsSearch& search,
    std::uint32_t threads) {
    if (!may_have_common_corners(meshes, facets)) return std::nullopt;
    return ConformingSearch(meshes, facets, threads).run(search);
}

}  // namespace trisect::detail
