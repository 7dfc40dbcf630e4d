// SPDX-License-Identifier: Apache-2.0
//
// Point location: one descent to a cell. In a mixed one the point's sides of the planes there
// decide in single precision, where these are sure: points above all planes, or below all, are in a
// convex region without polygons, and so are points on the same sides as a corner of the cell; what
// such a region is, is known. Otherwise the segment to a corner is traced across the polygons whose
// planes separate the two. Where a sign is not sure the polygon is asked exactly whether the point
// is on it; those that contain it are noted.
//
// What kind of boundary point it is, the normals of the noted polygons tell: in one plane a face,
// planes through one line an edge, else a vertex. Near the point the boundary is a cone over these
// polygons, so this is a property of the set.

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <trisect/bsp/detail/index_core.h>
#include <trisect/bsp/detail/index_counters.h>
#include <trisect/bsp/detail/index_sheets.h>
#include <trisect/bsp/detail/index_signs.h>
#include <trisect/bsp/detail/index_windings.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

// A sign that a leaf's planes or doubles did not tell.
constexpr int unsure = 2;

int sure_sign(float v) {
    return v > LeafPlanes::unsure ? 1 : (v < -LeafPlanes::unsure ? -1 : unsure);
}

// The place of a point in a cell's coordinates; false when it is not known well enough.
bool find_place(const IndexTree::Cell& cell, const IndexGrid::Position& at,
                std::array<float, 3>& place) {
    const double scale = 1 / static_cast<double>(std::uint32_t{1} << cell.shift);
    bool fits = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto low = static_cast<double>(at.fine[k] >> cell.shift << cell.shift);
        const double v = (at.at[k] - low) * scale;
        fits = fits && v > -0.25 && v < 1.25;
        place[k] = static_cast<float>(v);
    }
    return fits;
}

// A point's sides of the planes of a leaf.
struct LeafSides {
    std::array<float, 3> place{};
    PlaneSides of;  // of up to LeafSheets::polygons
    std::uint64_t all = 0;

    // Planes that may contain the point.
    [[nodiscard]] std::uint64_t open() const { return all & ~(of.above | of.below); }
    [[nodiscard]] bool are_mixed() const { return of.above != 0 && of.below != 0; }
};

// False when the planes do not help: there are none, or the point is not near or not known well
// enough.
bool find_sides(const IndexTree& tree, const IndexTree::Cell& cell, const IndexGrid::Position& at,
                LeafSides& sides) {
    const IndexLeaf& leaf = tree.leaf(cell.leaf);
    if (!leaf.has_planes() || !find_place(cell, at, sides.place)) return false;
    predicate_counters().filtered += leaf.count;
    if (leaf.count > LeafSheets::polygons) return true;
    sides.of = sides_of(tree.planes(leaf), leaf.count, sides.place);
    sides.all = (std::uint64_t{1} << leaf.count) - 1;
    return true;
}

// 1 inside, 0 outside, -1 when the sides do not tell.
int decided_by_sides(const IndexBase& index, const IndexTree::Cell& cell,
                     const IndexGrid::Position& at, const LeafSides& sides) {
    const IndexLeaf& leaf = index.tree.leaf(cell.leaf);
    if (leaf.count > LeafSheets::polygons) return -1;
    const std::uint8_t common = sides.of.above == sides.all   ? leaf.above
                                : sides.of.below == sides.all ? leaf.below
                                                              : IndexLeaf::unknown;
    if (common != IndexLeaf::unknown) {
        ++index_counters().side;
        return common;
    }
    const LeafSheets sheets = sheets_of(index, cell, at);
    const std::uint64_t inside = sides.of.below & sheets.inside_below;
    if (((sides.of.above & sheets.outside_above) | inside) != 0) {
        ++index_counters().sheet;
        return inside != 0 ? 1 : 0;
    }
    // Points on the same sides of all planes are in one convex region without polygons.
    if (sides.open() != 0) return -1;
    const auto known = remembered(leaf, sides.of.above);
    if (!known) return -1;
    ++index_counters().region;
    return *known ? 1 : 0;
}

// A point in a mixed cell.
class InLeaf {
public:
    InLeaf(const IndexBase& index, const IndexTree::Cell& cell, const IndexGrid::Position& at,
           const IndexPoint& p, std::vector<PolygonId>& on)
        : index_(index),
          polygons_(index.polygons),
          tree_(index.tree),
          cell_(cell),
          at_(at),
          leaf_(index.tree.leaf(cell.leaf)),
          p_(p),
          on_(on) {}

    // Whether the point is inside; of no meaning when polygons that contain it were noted. `sides`:
    // where the leaf's planes are good for the point and there are few enough.
    [[nodiscard]] bool is_inside(const LeafSides* sides) {
        if (sides == nullptr) return trace_to_reference();
        place_ = sides->place;
        if (leaf_.count > LeafSheets::polygons) return to_corner_of_many();
        if (const std::uint64_t open = sides->open(); open != 0)
            return !note_if_on(open) && to_corner();
        const bool inside = to_corner();
        remember(leaf_, sides->of.above, inside);
        return inside;
    }

private:
    [[nodiscard]] bool to_corner_of_many() {
        const std::size_t before = on_.size();
        const LeafPlanes planes = tree_.planes(leaf_);
        for (std::uint32_t i = 0; i < leaf_.count; ++i)
            if (sure_sign(planes.at(i, place_)) == unsure) note_polygon_if_on(i);
        if (on_.size() == before) return to_corner();
        ++index_counters().on;
        return false;
    }

    // For a point on no polygon. The corner that fewest planes separate from the point: where none
    // does, it knows the answer; otherwise those that do are asked exactly.
    [[nodiscard]] bool to_corner() {
        const LeafPlanes planes = tree_.planes(leaf_);
        Int4 low{};  // planes on whose sure side a corner is with the point, negative
        Int4 high{};
        for (std::uint32_t i = 0; i < leaf_.count; ++i) {
            const int sign = sure_sign(planes.at(i, place_));
            if (sign == unsure) continue;
            const auto [v, w] = at_corners(planes, i);
            const auto s = static_cast<float>(sign);
            constexpr float e = LeafPlanes::unsure;
            low += v * s > Float4{e, e, e, e};
            high += w * s > Float4{e, e, e, e};
        }
        unsigned best = 8;
        int most = -1;
        for (unsigned c = 0; c < 8; ++c) {
            const int together = -(c < 4 ? low[c] : high[c - 4]);
            if ((leaf_.known >> c & 1U) == 0 || together <= most) continue;
            most = together;
            best = c;
        }
        if (best == 8) return trace_to_reference();
        int winding = leaf_.inside >> best & 1;
        if (most == static_cast<int>(leaf_.count)) {
            ++index_counters().corner;
            return winding > 0;
        }
        ++index_counters().traced;
        const Reference reference(corner(best));
        for (std::uint32_t i = 0; i < leaf_.count; ++i) {
            const int sign = sure_sign(planes.at(i, place_));
            const auto [v, w] = at_corners(planes, i);
            if (sign != unsure && sign == sure_sign(best < 4 ? v[best] : w[best - 4])) continue;
            winding += passed(tree_.listed(leaf_)[i], reference);
        }
        return winding > 0;
    }

    [[nodiscard]] static std::array<Float4, 2> at_corners(const LeafPlanes& planes,
                                                          std::uint32_t i) {
        const float* f = planes.first + i;
        const float a = f[0];
        const float b = f[planes.stride];
        const float d = f[3 * planes.stride];
        const Float4 v{d, d + a, d + b, d + a + b};
        return {v, v + f[2 * planes.stride]};
    }

    // The polygons whose planes are not surely off the point, exactly.
    [[nodiscard]] bool note_if_on(std::uint64_t open) {
        const std::size_t before = on_.size();
        for (; open != 0; open &= open - 1)
            note_polygon_if_on(static_cast<std::uint32_t>(std::countr_zero(open)));
        if (on_.size() == before) return false;
        ++index_counters().on;
        return true;
    }
    void note_polygon_if_on(std::uint32_t i) {
        const PolygonId id = tree_.listed(leaf_)[i];
        if (is_on(polygons_, id, p_)) on_.push_back(id);
    }

    [[nodiscard]] FinePoint corner(unsigned c) const {
        FinePoint p;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = (at_.fine[k] >> cell_.shift) + (c >> k & 1U);
            p.c[k] = fine_position(cell_.grid->wall(k, i << cell_.shift));
        }
        return p;
    }

    [[nodiscard]] int passed(PolygonId id, const Reference& reference) {
        const Passing s = passing(polygons_, id, p_, reference);
        if (s == Passing::On) {
            on_.push_back(id);
            return 0;
        }
        return polygons_.is_flipped(id) ? -static_cast<int>(s) : static_cast<int>(s);
    }

    [[nodiscard]] bool trace_to_reference() {
        const std::size_t before = on_.size();
        int winding = leaf_.winding;
        const Reference reference(tree_.reference(cell_, at_));
        for (const PolygonId id : tree_.listed(leaf_)) winding += passed(id, reference);
        ++(on_.size() == before ? index_counters().traced : index_counters().on);
        return winding > 0;
    }

    const IndexBase& index_;
    const IndexPolygons& polygons_;
    const IndexTree& tree_;
    const IndexTree::Cell& cell_;
    const IndexGrid::Position& at_;
    const IndexLeaf& leaf_;
    const IndexPoint& p_;
    std::vector<PolygonId>& on_;
    std::array<float, 3> place_{};
};

// Whether a point is known well enough for the planes of a cell.
bool is_precise(const IndexTree::Cell& cell, const IndexPoint& p) {
    if (p.is_doubles()) return true;
    if (cell.grid == nullptr) return false;
    const auto& s = cell.grid->scale;
    return p.error() * std::max({s[0], s[1], s[2]}) < 0x1p-22;
}

bool is_beyond(const IndexTree& tree, const IndexPoint& p) {
    if (!tree.is_bounded()) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (p[k] - p.error() > tree.hi()[k] || p[k] + p.error() < tree.lo()[k]) return true;
    return false;
}

bool are_parallel(const Plane& a, const Plane& b) {
    for (int k = 0; k < 3; ++k)
        if (sign_of_cross(a, b, k) != 0) return false;
    return true;
}

}  // namespace

Location locate_polygons(const IndexBase& index, const IndexPoint& point,
                         std::vector<PolygonId>& on) {
    on.clear();
    const IndexTree& tree = index.tree;
    if (is_beyond(tree, point)) {
        ++index_counters().empty;
        return tree.is_inside_beyond() ? Location::Inside : Location::Outside;
    }
    bool inside = false;
    bool several = false;
    tree.for_leaves_at(point, [&](const IndexTree::Cell& cell, const IndexGrid::Position& at) {
        if (!cell.is_mixed()) {
            ++index_counters().empty;
            inside = cell.is_inside();
            return;
        }
        const std::size_t before = on.size();
        LeafSides sides;
        const bool helps = is_precise(cell, point) && find_sides(tree, cell, at, sides);
        const int quick = helps ? decided_by_sides(index, cell, at, sides) : -1;
        const bool found =
            quick >= 0 ? quick != 0
                       : InLeaf(index, cell, at, point, on).is_inside(helps ? &sides : nullptr);
        if (on.empty()) inside = found;
        several = several || (before != 0 && on.size() != before);
    });
    if (on.empty()) return inside ? Location::Inside : Location::Outside;
    if (several) {
        std::sort(on.begin(), on.end());
        on.erase(std::unique(on.begin(), on.end()), on.end());
    }
    return Location::OnFace;
}

namespace {

// Points of a solid whose index is one grid. Of those in mixed cells every step is done for 32 of
// them before the next one, and asks for the memory that the next one needs.
class Batch {
public:
    static constexpr std::size_t together = 32;

    Batch(const IndexBase& index, std::span<const std::array<double, 3>> points,
          const FoundPoint& found)
        : index_(index),
          tree_(index.tree),
          grid_(tree_.grid(tree_.node(0))),
          points_(points),
          found_(found) {}

    // Points from begin on: those in cells without polygons are found at once, in their own order;
    // the others are left in mixed(), with their leaves.
    void find_empty(std::uint32_t begin, std::uint32_t end) {
        mixed_.clear();
        Descent& d = all_[0];
        for (std::uint32_t i = begin; i < end; ++i) {
            descend(d, i);
            if (d.state == State::Known) {
                finish(d);
            } else {
                mixed_.emplace_back(d.state == State::Mixed ? d.cell.leaf : 0, i);
            }
        }
    }

    // The others by leaf, so that neighbours come after each other.
    void find_mixed() {
        const std::vector<std::uint32_t> order = mixed_in_order();
        for (std::size_t i = 0; i < order.size(); i += together)
            locate(std::span(order).subspan(i, std::min(together, order.size() - i)));
    }

private:
    // A counting sort by the leading bits of the leaf.
    [[nodiscard]] std::vector<std::uint32_t> mixed_in_order() const {
        std::vector<std::uint32_t> order(mixed_.size());
        std::uint32_t last = 0;
        for (const auto& [leaf, i] : mixed_) last = std::max(last, leaf);
        const int width = std::bit_width(last);
        const auto shift = static_cast<unsigned>(std::max(width - 14, 0));
        std::vector<std::uint32_t> begin((std::size_t{last} >> shift) + 2, 0);
        for (const auto& [leaf, i] : mixed_) ++begin[(leaf >> shift) + 1];
        for (std::size_t b = 1; b < begin.size(); ++b) begin[b] += begin[b - 1];
        for (const auto& [leaf, i] : mixed_) order[begin[leaf >> shift]++] = i;
        return order;
    }

    void locate(std::span<const std::uint32_t> order) {
        count_ = order.size();
        for (std::size_t i = 0; i < count_; ++i) descend(all_[i], order[i]);
        for_mixed([&](Descent& d) { tree_.prefetch(tree_.leaf(d.cell.leaf)); });
        for_mixed([&](Descent& d) {
            d.helps = find_sides(tree_, d.cell, d.at, d.sides);
            d.wanted = d.helps && d.sides.are_mixed() && has_unknown_sheets(tree_.leaf(d.cell.leaf))
                           ? d.sides.all
                           : 0;
        });
        fetch_corners();
        for_mixed([&](Descent& d) { decide(d); });
        fetch_corners();
        for (std::size_t i = 0; i < count_; ++i) finish(all_[i]);
    }

    enum class State : std::uint8_t { Known, Mixed, Open, Alone };
    struct Descent {
        std::uint32_t number = 0;
        State state = State::Known;
        bool inside = false;
        bool helps = false;
        std::uint64_t wanted = 0;  // polygons whose corners will be looked at
        IndexGrid::Position at;
        IndexTree::Cell cell;
        LeafSides sides;
    };

    void descend(Descent& d, std::uint32_t number) const {
        d.number = number;
        d.wanted = 0;
        d.state = State::Alone;
        std::array<double, 3> p{};
        if (!IndexPoint::to_lattice(points_[number], index_.solid.lattice(), p)) return;
        d.state = State::Known;
        for (std::size_t k = 0; k < 3; ++k)
            if (p[k] > tree_.hi()[k] || p[k] < tree_.lo()[k]) {
                ++index_counters().empty;
                d.inside = tree_.is_inside_beyond();
                return;
            }
        if (!grid_.find_position(p, d.at)) {
            d.state = State::Alone;
            return;
        }
        d.cell = tree_.cell_at(grid_, d.at);
        d.inside = d.cell.is_inside();
        if (d.cell.is_mixed()) {
            d.state = State::Mixed;
            __builtin_prefetch(&tree_.leaf(d.cell.leaf));
        } else {
            ++index_counters().empty;
        }
    }
    void decide(Descent& d) const {
        const int quick = d.helps ? decided_by_sides(index_, d.cell, d.at, d.sides) : -1;
        d.state = quick >= 0 ? State::Known : State::Open;
        d.inside = quick > 0;
        // Those that may contain the point, or all for a trace.
        const std::uint64_t open = d.sides.open();
        d.wanted = quick >= 0 || !d.helps ? 0 : (open != 0 ? open : d.sides.all);
    }
    void finish(const Descent& d) {
        on_.clear();
        if (d.state == State::Known) {
            found_(d.number, d.inside ? Location::Inside : Location::Outside, nullptr, on_);
            return;
        }
        const IndexPoint p = IndexPoint::from_user(points_[d.number], index_.solid.lattice());
        Location l = Location::Outside;
        if (d.state == State::Alone) {
            l = locate_polygons(index_, p, on_);
        } else {
            const bool inside =
                InLeaf(index_, d.cell, d.at, p, on_).is_inside(d.helps ? &d.sides : nullptr);
            l = !on_.empty() ? Location::OnFace : (inside ? Location::Inside : Location::Outside);
        }
        found_(d.number, l, &p, on_);
    }

    template <class Work>
    void for_mixed(const Work& work) {
        for (std::size_t i = 0; i < count_; ++i)
            if (all_[i].state == State::Mixed) work(all_[i]);
    }
    template <class Work>
    void for_wanted(const Work& work) const {
        for (std::size_t i = 0; i < count_; ++i) {
            const Descent& d = all_[i];
            if (d.state == State::Alone || d.wanted == 0) continue;
            const auto listed = tree_.listed(tree_.leaf(d.cell.leaf));
            for (std::uint64_t left = d.wanted; left != 0; left &= left - 1)
                work(listed[static_cast<std::size_t>(std::countr_zero(left))]);
        }
    }
    void fetch_corners() const {
        const Source* source = index_.polygons.only_source();
        if (source == nullptr) return;
        for_wanted([&](PolygonId id) { __builtin_prefetch(&source->mesh().triangles[id]); });
        for_wanted([&](PolygonId id) {
            for (int i = 0; i < 3; ++i) __builtin_prefetch(&source->corner(id, i));
        });
    }

    const IndexBase& index_;
    const IndexTree& tree_;
    const IndexGrid& grid_;
    std::span<const std::array<double, 3>> points_;
    const FoundPoint& found_;
    std::array<Descent, together> all_;
    std::size_t count_ = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> mixed_;  // leaf, point
    std::vector<PolygonId> on_;
};

}  // namespace

void locate_batch(const IndexBase& index, std::span<const std::array<double, 3>> points,
                  std::size_t begin, std::size_t end, const FoundPoint& found) {
    if (points.size() >= 0xffffffffU) throw LimitError("more than 2^32 points at once");
    const auto first = static_cast<std::uint32_t>(begin);
    const auto last = static_cast<std::uint32_t>(end);
    if (index.tree.node(0).is_grid() && index.tree.is_bounded()) {
        Batch batch(index, points, found);
        batch.find_empty(first, last);
        batch.find_mixed();
        return;
    }
    std::vector<PolygonId> on;
    for (std::uint32_t i = first; i < last; ++i) {
        const IndexPoint p = IndexPoint::from_user(points[i], index.solid.lattice());
        const Location l = locate_polygons(index, p, on);
        found(i, l, &p, on);
    }
}

namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& u, const Vector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
double largest(const Vector& v) {
    return std::max(std::max(std::fabs(v[0]), std::fabs(v[1])), std::fabs(v[2]));
}

// A triangle's normal, its largest component 1, in doubles: within 2^-40, or not known.
bool find_normal(const IndexPolygons& polygons, PolygonId id, Vector& n) {
    if (!polygons.is_triangle(id)) return false;
    std::array<Vector, 3> c{};
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& p = polygons.corner(id, i);
        c[static_cast<std::size_t>(i)] = {static_cast<double>(p.x), static_cast<double>(p.y),
                                          static_cast<double>(p.z)};
    }
    const Vector u{c[1][0] - c[0][0], c[1][1] - c[0][1], c[1][2] - c[0][2]};
    const Vector v{c[2][0] - c[0][0], c[2][1] - c[0][1], c[2][2] - c[0][2]};
    n = cross(u, v);
    // Each component is within 2^-50 of the product of the largest ones of u and v.
    const double size = largest(n);
    if (!(0x1p-50 * largest(u) * largest(v) < 0x1p-42 * size)) return false;
    for (double& x : n) x /= size;
    return true;
}

// The rank of the normals where doubles tell that it is 3, or 2 for two polygons; else 0.
int sure_rank(const IndexPolygons& polygons, const std::vector<PolygonId>& on) {
    if (on.size() < 2) return static_cast<int>(on.size());
    Vector first{};
    if (!find_normal(polygons, on[0], first)) return 0;
    Vector both{};
    bool turned = false;
    for (std::size_t i = 1; i < on.size(); ++i) {
        Vector n{};
        if (!find_normal(polygons, on[i], n)) return 0;
        if (turned) {
            // Within 2^-35: three components of at most 2 that are within 2^-38.
            if (std::fabs(both[0] * n[0] + both[1] * n[1] + both[2] * n[2]) > 0x1p-30) return 3;
            continue;
        }
        both = cross(first, n);
        turned = largest(both) > 0x1p-30;
    }
    return turned && on.size() == 2 ? 2 : 0;
}

}  // namespace

Location location_on(const IndexPolygons& polygons, std::vector<PolygonId>& on) {
    switch (sure_rank(polygons, on)) {
        case 1:
            return Location::OnFace;
        case 2:
            return Location::OnEdge;
        case 3:
            return Location::OnVertex;
        default:
            return place_on(polygons, on).location;
    }
}

Place place_on(const IndexPolygons& polygons, std::vector<PolygonId>& on) {
    if (on.size() > 1)
        std::sort(on.begin(), on.end(),
                  [&](PolygonId a, PolygonId b) { return polygons.name(a) < polygons.name(b); });
    Place place;
    std::array<Plane, 3> planes;
    std::size_t rank = 0;
    for (const PolygonId id : on) {
        if (rank == 3) break;
        const Plane p = polygons.support(id);
        if (rank == 1 && are_parallel(planes[0], p)) continue;
        if (rank == 2 && sign_of_det(planes[0], planes[1], p) == 0) continue;
        planes[rank] = p;
        place.faces[rank] = polygons.face_source(id);
        ++rank;
    }
    place.face_count = static_cast<std::uint8_t>(rank);
    place.location = rank == 1   ? Location::OnFace
                     : rank == 2 ? Location::OnEdge
                                 : Location::OnVertex;
    return place;
}

Place place_on(const IndexPolygons& polygons, std::vector<PolygonId>& on, const IndexPoint& point) {
    Place place = place_on(polygons, on);
    if (place.location != Location::OnVertex || !point.is_doubles()) return place;
    for (const PolygonId id : on) {
        const Source& s = polygons.source(id);
        if (s.is_half_space()) continue;
        for (int i = 0; i < 3; ++i) {
            const LatticePoint& c = s.corner(polygons.facet(id), i);
            if (static_cast<double>(c.x) != point[0] || static_cast<double>(c.y) != point[1] ||
                static_cast<double>(c.z) != point[2])
                continue;
            const CornerSource name{static_cast<std::uint32_t>(s.serial()),
                                    s.corner_index(polygons.facet(id), i)};
            if (!place.corner.is_valid() || name < place.corner) place.corner = name;
        }
    }
    return place;
}

}  // namespace trisect::detail
