// SPDX-License-Identifier: Apache-2.0
//
// Where fine surfaces are flush each triangle meets a dozen others, nearly all in a corner or along
// a side, and to test all these pairs exactly takes most of the time of the query. Where the meshes
// fall together too, none of it is needed. Let triangle i of A have the corners of triangle j of B.
// Then whatever B has in common with i it has in common with j, and a boundary that does not touch
// itself meets its triangle j in common corners and sides only. So the contacts of i follow from
// the names of B's vertices, and likewise those of j from A's; only pairs of triangles without
// partner have to be looked for and compared.
//
// At a vertex all of whose triangles have partners the cones are equal and share area, which is all
// that they say. At other vertices of triangles with partners the pairs are listed by name, as many
// as a comparison of cones would be given by the tests.
//
// Vertices are put together by their positions in doubles, on a grid, and compared exactly.

#include <trisect/bsp/interference/relation/coincident_triangles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/kernel/pose/moved_predicates.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t no_partner = CoincidentTriangles::none;

std::uint32_t place_of_corner(const InterferenceModelData& m, const ModelTriangle& t,
                              std::size_t corner) {
    return m.place[t.vertex[corner].index].index;
}

// Vertices of a model by the cells of a grid, 2^20 along its longest side.
class VertexGrid {
public:
    VertexGrid(const InterferenceModelData& model, double error) : lo_(model.lo), error_(error) {
        double extent = 0;
        for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, model.hi[k] - model.lo[k]);
        cell_ = std::max(0x1p-20 * extent, 4 * error);
        for (std::uint32_t v = 0; v < model.positions.size(); ++v)
            if (model.place[v].index == v) cells_.emplace_back(key(cell_of(model.positions[v])), v);
        std::ranges::sort(cells_);
    }

    // visit(vertex) for all that may be within the error, and some others, until it returns true.
    template <class Visit>
    void for_near(const std::array<double, 3>& p, Visit&& visit) const {
        Cell from = cell_of({p[0] - error_, p[1] - error_, p[2] - error_});
        const Cell to = cell_of({p[0] + error_, p[1] + error_, p[2] + error_});
        for (std::size_t k = 0; k < 3; ++k) {
            if (to[k] < 0 || from[k] > most) return;
            from[k] = std::max<std::int64_t>(from[k], 0);
        }
        for (std::int64_t x = from[0]; x <= to[0]; ++x)
            for (std::int64_t y = from[1]; y <= to[1]; ++y)
                for (std::int64_t z = from[2]; z <= to[2]; ++z)
                    if (visit_cell(key({x, y, z}), visit)) return;
    }

private:
    using Cell = std::array<std::int64_t, 3>;
    // Rounding takes a point of the model by less than one cell beyond 2^20.
    static constexpr std::int64_t most = (std::int64_t{1} << 20) + 1;

    [[nodiscard]] Cell cell_of(const std::array<double, 3>& p) const {
        Cell c{};
        for (std::size_t k = 0; k < 3; ++k)
            c[k] = static_cast<std::int64_t>(std::clamp(std::floor((p[k] - lo_[k]) / cell_), -1.0,
                                                        static_cast<double>(most + 1)));
        return c;
    }
    [[nodiscard]] static std::uint64_t key(const Cell& c) {
        std::uint64_t r = 0;
        for (const std::int64_t i : c) r = r << 21U | static_cast<std::uint64_t>(i);
        return r;
    }
    template <class Visit>
    bool visit_cell(std::uint64_t cell, Visit& visit) const {
        for (auto at = std::ranges::lower_bound(cells_, std::pair(cell, std::uint32_t{0}));
             at != cells_.end() && at->first == cell; ++at)
            if (visit(at->second)) return true;
        return false;
    }

    std::array<double, 3> lo_;
    double error_;
    double cell_ = 1;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> cells_;
};

// For each node of a tree whether some triangle below it is not left out.
template <class IsLeftOut>
std::vector<bool> nodes_with_others(const ObbTree& tree, const IsLeftOut& is_left_out) {
    std::vector<bool> has(tree.nodes.size(), false);
    // Nodes come after those above them.
    for (std::size_t n = tree.nodes.size(); n-- > 0;)
        for (std::uint32_t k = 0; k < 4 && !has[n]; ++k) {
            const ObbChild child = tree.nodes[n].child[k];
            if (!child.is_leaf()) {
                has[n] = has[child.node()];
                continue;
            }
            for (std::uint32_t i = 0; i < child.count() && !has[n]; ++i)
                has[n] = !is_left_out(tree.order[child.first() + i]);
        }
    return has;
}

// A walk down two trees without some of the triangles.
class WalkOfOthers {
public:
    WalkOfOthers(const PosedModels& models, const CoincidentTriangles& coincident)
        : a_(models.a),
          b_(models.b),
          coincident_(coincident),
          map_(approximate_map(models.poses.to_a)),
          pose_(a_.boxes, b_.boxes, map_),
          error_(a_.position_error + map_.error_below(b_.largest, b_.position_error)),
          others_a_(nodes_with_others(
              a_.boxes, [&](std::uint32_t t) { return coincident.partner_of_a(t) != no_partner; })),
          others_b_(nodes_with_others(b_.boxes, [&](std::uint32_t t) {
              return coincident.partner_of_b(t) != no_partner;
          })) {}

    void run(MeetingCollector& visit) {
        if (!others_a_[0] || !others_b_[0] || pose_.is_apart()) return;
        stack_.push_back({});
        while (!stack_.empty()) {
            const ObbWalk::Pair pair = stack_.back();
            stack_.pop_back();
            const ObbChild ca = a_.boxes.child(pair.a);
            const ObbChild cb = b_.boxes.child(pair.b);
            if (ca.is_leaf() && cb.is_leaf()) {
                if (compare_leaves(ca, cb, visit)) return;
            } else if (ca.is_leaf() || (!cb.is_leaf() && pose_.scale() * size(b_.boxes, pair.b) >
                                                             size(a_.boxes, pair.a))) {
                open(cb, pose_.overlaps(a_.boxes.box(pair.a), b_.boxes.nodes[cb.node()]), b_.boxes,
                     others_b_, [&](ObbId lane) {
                         stack_.push_back({pair.a, lane});
                     });
            } else {
                open(ca, pose_.overlaps(a_.boxes.nodes[ca.node()], b_.boxes.box(pair.b)), a_.boxes,
                     others_a_, [&](ObbId lane) {
                         stack_.push_back({lane, pair.b});
                     });
            }
        }
    }

private:
    static float size(const ObbTree& t, ObbId id) {
        const ObbNode& n = t.nodes[id.node()];
        return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
    }
    template <class Push>
    static void open(ObbChild node, unsigned hits, const ObbTree& tree,
                     const std::vector<bool>& others, const Push& push) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            if ((hits >> k & 1U) == 0) continue;
            const ObbId lane = ObbId::of(node.node(), k);
            const ObbChild child = tree.child(lane);
            if (child.is_leaf() || others[child.node()]) push(lane);
        }
    }
    bool compare_leaves(ObbChild ca, ObbChild cb, MeetingCollector& visit) const {
        for (std::uint32_t j = cb.first(); j < cb.first() + cb.count(); ++j) {
            if (coincident_.partner_of_b(b_.boxes.order[j]) != no_partner) continue;
            TriangleCorners q;
            for (std::size_t k = 0; k < 3; ++k) q[k] = map_(b_.positions[b_.boxes.corners[j][k]]);
            for (std::uint32_t i = ca.first(); i < ca.first() + ca.count(); ++i) {
                if (coincident_.partner_of_a(a_.boxes.order[i]) != no_partner) continue;
                TriangleCorners p;
                for (std::size_t k = 0; k < 3; ++k) p[k] = a_.positions[a_.boxes.corners[i][k]];
                const PairVerdict verdict = compare_triangles(p, q, error_);
                if (verdict != PairVerdict::Apart &&
                    visit(a_.boxes.order[i], b_.boxes.order[j], verdict))
                    return true;
            }
        }
        return false;
    }

    const InterferenceModelData& a_;
    const InterferenceModelData& b_;
    const CoincidentTriangles& coincident_;
    ApproximateMap map_;
    ObbPose pose_;
    double error_;
    std::vector<bool> others_a_;
    std::vector<bool> others_b_;
    ObbWalk::Stack stack_;
};

}  // namespace

CoincidentTriangles::CoincidentTriangles(const PosedModels& models)
    : models_(&models),
      partner_of_a_(models.a.triangles.size(), no_partner),
      partner_of_b_(models.b.triangles.size(), no_partner) {
    match_vertices();
    match_triangles();
    mark_partial_vertices();
}

void CoincidentTriangles::match_vertices() {
    const InterferenceModelData& a = models_->a;
    const InterferenceModelData& b = models_->b;
    vertex_of_b_.assign(a.positions.size(), no_partner);
    vertex_of_a_.assign(b.positions.size(), no_partner);
    const ApproximateMap to_a = approximate_map(models_->poses.to_a);
    const double error = a.position_error + to_a.error_below(b.largest, b.position_error);
    const VertexGrid grid(a, error);
    for (std::uint32_t w = 0; w < b.positions.size(); ++w) {
        if (b.place[w].index != w) continue;
        const MovedPoint moved(b.brep.point(VertexId(w)), models_->poses.to_a);
        grid.for_near(to_a(b.positions[w]), [&](std::uint32_t v) {
            if (!moved.is_at(a.brep.point(VertexId(v)))) return false;
            vertex_of_b_[v] = w;
            vertex_of_a_[w] = v;
            return true;
        });
    }
}

std::span<const std::uint32_t> CoincidentTriangles::triangles_of_b_at(std::uint32_t vertex) const {
    return std::span(at_vertex_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
}

std::uint32_t CoincidentTriangles::partner_of_corner(const ModelTriangle& of_a,
                                                     std::size_t corner) const {
    return vertex_of_b_[place_of_corner(models_->a, of_a, corner)];
}

// 3 when the triangle has no corner there.
std::size_t CoincidentTriangles::corner_of_b_at(std::uint32_t triangle,
                                                std::uint32_t vertex) const {
    std::size_t k = 0;
    while (k < 3 && place_of_corner(models_->b, models_->b.triangles[triangle], k) != vertex) ++k;
    return k;
}

void CoincidentTriangles::match_triangles() {
    const InterferenceModelData& a = models_->a;
    const InterferenceModelData& b = models_->b;
    begin_.assign(b.positions.size() + 1, 0);
    for (const ModelTriangle& t : b.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++begin_[place_of_corner(b, t, k) + 1];
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) begin_[v + 1] += begin_[v];
    at_vertex_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t j = 0; j < b.triangles.size(); ++j)
        for (std::size_t k = 0; k < 3; ++k)
            at_vertex_[next[place_of_corner(b, b.triangles[j], k)]++] = j;

    for (std::uint32_t i = 0; i < a.triangles.size(); ++i) {
        const std::array<std::uint32_t, 3> corner{partner_of_corner(a.triangles[i], 0),
                                                  partner_of_corner(a.triangles[i], 1),
                                                  partner_of_corner(a.triangles[i], 2)};
        if (std::ranges::find(corner, no_partner) != corner.end()) continue;
        for (const std::uint32_t j : triangles_of_b_at(corner[0]))
            if (corner_of_b_at(j, corner[1]) < 3 && corner_of_b_at(j, corner[2]) < 3) {
                partner_of_a_[i] = j;
                partner_of_b_[j] = i;
            }
    }
}

void CoincidentTriangles::mark_partial_vertices() {
    const InterferenceModelData& a = models_->a;
    const InterferenceModelData& b = models_->b;
    partial_.assign(a.positions.size(), false);
    for (std::uint32_t i = 0; i < a.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3 && partner_of_a_[i] == no_partner; ++k)
            partial_[place_of_corner(a, a.triangles[i], k)] = true;
    for (std::uint32_t j = 0; j < b.triangles.size(); ++j)
        for (std::size_t k = 0; k < 3 && partner_of_b_[j] == no_partner; ++k)
            if (const auto v = vertex_of_a_[place_of_corner(b, b.triangles[j], k)]; v != no_partner)
                partial_[v] = true;
}

bool CoincidentTriangles::is_partial(const ModelTriangle& of_a, std::size_t corner) const {
    return partial_[place_of_corner(models_->a, of_a, corner)];
}

// With the corners of the one in the order of the other's.
MeetingPair CoincidentTriangles::coincident_pair(std::uint32_t i) const {
    const std::uint32_t j = partner_of_a_[i];
    MeetingPair pair{i, j, {}};
    std::array<std::size_t, 3> corner{};
    for (std::size_t k = 0; k < 3; ++k) {
        corner[k] = corner_of_b_at(j, partner_of_corner(models_->a.triangles[i], k));
        pair.contact.points[k] = {Feature::corner(k), Feature::corner(corner[k])};
    }
    pair.contact.count = 3;
    pair.contact.coplanar = true;
    // Corners run counter-clockwise about the outward normal; of a mirror image clockwise.
    const bool same_order = corner[1] == (corner[0] + 1) % 3;
    pair.contact.opposite = same_order == models_->poses.to_a.is_mirror();
    return pair;
}

void CoincidentTriangles::add_flags(BoundaryFlags& flags) const {
    for (std::uint32_t i = 0; i < partner_of_a_.size(); ++i) {
        if (partner_of_a_[i] == no_partner) continue;
        flags.meet = true;
        (coincident_pair(i).contact.opposite ? flags.opposite : flags.same) = true;
        if (flags.same && flags.opposite) return;
    }
}

// Pairs of a triangle of A with those of B at one of its corners; those with two such corners only
// once. Corners that are not partial are left out: their cones are equal.
void CoincidentTriangles::add_pairs_at(std::uint32_t i, std::size_t corner,
                                       std::vector<MeetingPair>& pairs) const {
    const ModelTriangle& t = models_->a.triangles[i];
    const std::uint32_t vertex = partner_of_corner(t, corner);
    if (vertex == no_partner) return;
    for (const std::uint32_t j : triangles_of_b_at(vertex)) {
        if (j == partner_of_a_[i] ||
            (partner_of_a_[i] == no_partner && partner_of_b_[j] == no_partner))
            continue;
        MeetingPair pair{i, j, {}};
        bool is_first = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t w = partner_of_corner(t, k);
            if (w == no_partner || !is_partial(t, k)) continue;
            const std::size_t of_b = corner_of_b_at(j, w);
            if (of_b == 3) continue;
            is_first = is_first && k >= corner;
            pair.contact.points[pair.contact.count++] = {Feature::corner(k), Feature::corner(of_b)};
        }
        if (is_first) pairs.push_back(pair);
    }
}

void CoincidentTriangles::add_pairs(std::vector<MeetingPair>& pairs) const {
    const InterferenceModelData& a = models_->a;
    const InterferenceModelData& b = models_->b;
    std::vector<bool> known_a(a.shell_vertex.size(), false);
    std::vector<bool> known_b(b.shell_vertex.size(), false);
    for (std::uint32_t i = 0; i < a.triangles.size(); ++i) {
        const ModelTriangle& t = a.triangles[i];
        bool is_needed = false;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!is_partial(t, k)) continue;
            add_pairs_at(i, k, pairs);
            is_needed = true;
        }
        if (partner_of_a_[i] == no_partner) continue;
        const std::uint32_t shell_a = a.shell_of(t).index;
        const std::uint32_t shell_b = b.shell_of(b.triangles[partner_of_a_[i]]).index;
        if (!is_needed && known_a[shell_a] && known_b[shell_b]) continue;
        known_a[shell_a] = known_b[shell_b] = true;
        pairs.push_back(coincident_pair(i));
    }
}

void CoincidentTriangles::for_other_candidates(MeetingCollector& visit) const {
    WalkOfOthers(*models_, *this).run(visit);
}

bool may_coincide(const InterferenceModelData& a, const InterferenceModelData& b,
                  const ApproximateMap& to_a, std::span<const CandidatePair> pairs) {
    const double error = a.position_error + to_a.error_below(b.largest, b.position_error);
    const auto is_at = [&](const ModelTriangle& i, std::size_t k, const ModelTriangle& j) {
        const auto& p = a.position(i.vertex[k]);
        return std::ranges::any_of(j.vertex, [&](VertexId v) {
            const std::array<double, 3> q = to_a(b.position(v));
            return std::abs(p[0] - q[0]) <= 2 * error && std::abs(p[1] - q[1]) <= 2 * error &&
                   std::abs(p[2] - q[2]) <= 2 * error;
        });
    };
    return std::ranges::any_of(pairs, [&](const CandidatePair& pair) {
        const ModelTriangle& i = a.triangles[pair.a];
        const ModelTriangle& j = b.triangles[pair.b];
        return is_at(i, 0, j) && is_at(i, 1, j) && is_at(i, 2, j);
    });
}

}  // namespace trisect::detail
