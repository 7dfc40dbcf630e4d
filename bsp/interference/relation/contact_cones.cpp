// SPDX-License-Identifier: Apache-2.0
//
// Near a common point c each boundary is a cone, and the cone is known by the curves that it cuts
// out of a small sphere around c: arcs of great circles, one per triangle's corner (a triangle that
// contains c in a side or inside gives two or four). So the question "which parts of A's boundary
// are in B, outside or on it" becomes the same question one dimension lower, for two figures of
// arcs on a sphere; and, around a direction where the figures meet, once more lower, for two sets
// of half-planes around a line, where it is a question of cyclic order.
//
//   on the sphere   Two arcs cross transversally: so do two faces, everything is decided. Else the
//                   figures meet in directions that are ends of arcs (an arc's end on the other's
//                   arc or end). Every piece of a figure ends in one of these, or belongs to a
//                   component that meets the other figure nowhere.
//   at a direction  Each arc that ends there or passes through is one or two half-planes around it.
//                   A half-plane of A coincides with one of B (the boundaries share area), or lies
//                   between two of B's, and the nearest one decides by its orientation whether
//                   that is inside B.
//   components      Of one that meets nothing, one direction is located: a path on the sphere to
//                   the middle of some arc of B crosses other arcs of B an even or odd number of
//                   times, and then arrives from above or below. Where the path meets ends of arcs,
//                   it is pushed aside by an infinitely small amount, always to the same side.
//
// Directions are integer vectors in the lattice of their solid; all signs are dot products with
// pulled-back plane normals or determinants of three directions. No point is sampled, nothing is
// perturbed that counts. Sampling would fail exactly here: IfcOpenShell#4594 is the story of
// witnesses that all lie on coplanar faces.

#include <trisect/bsp/interference/relation/contact_cones.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/pose/moved_predicates.h>

namespace trisect::detail {

namespace {

const RelativePose& identity() {
    static const RelativePose pose;
    return pose;
}

struct Arc {
    std::uint32_t from = 0;   // direction
    std::uint32_t to = 0;     // direction, less than half a turn away, counter-clockwise
    std::uint32_t plane = 0;  // outward
};

// Where a direction is on an arc.
enum class On : std::uint8_t { Not, From, To, Inside };

// The figure that one solid's cone cuts out of the sphere.
class Figure {
public:
    Figure(std::span<const ConePart> parts, const RelativePose& from_other,
           const RelativePose& to_other)
        : from_other_(from_other), to_other_(to_other) {
        directions_.reserve(4 * parts.size());
        planes_.reserve(parts.size());
        for (const ConePart& part : parts) add(part);
        moved_.resize(directions_.size());
        component_.resize(directions_.size());
        std::iota(component_.begin(), component_.end(), 0U);
        for (const Arc& arc : arcs_) component_[root(arc.from)] = root(arc.to);
        own_signs_.assign(planes_.size() * directions_.size(), unknown);
        for (const Arc& arc : arcs_) {
            own_sign(arc.plane, arc.from) = 0;
            own_sign(arc.plane, arc.to) = 0;
        }
    }

    [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }
    [[nodiscard]] std::uint32_t direction_count() const {
        return static_cast<std::uint32_t>(directions_.size());
    }
    [[nodiscard]] const Direction& direction(std::uint32_t d) const { return directions_[d]; }
    [[nodiscard]] const Plane& plane(std::uint32_t p) const { return *planes_[p].plane; }
    [[nodiscard]] const PulledPlane& pulled(std::uint32_t p) const { return planes_[p].pulled; }
    [[nodiscard]] const RelativePose& to_other() const { return to_other_; }

    // A direction in the other solid's lattice.
    [[nodiscard]] const IntVector& moved(std::uint32_t d) {
        std::optional<IntVector>& m = moved_[d];
        if (!m) {
            m.emplace();
            for (std::size_t i = 0; i < 3; ++i)
                (*m)[i] = dot(to_other_.row(i), directions_[d].exact());
        }
        return *m;
    }
    // Side of an own direction, or of an own sum of two.
    [[nodiscard]] int side(std::uint32_t p, std::uint32_t d) {
        int& sign = own_sign(p, d);
        if (sign == unknown) sign = planes_[p].own.along(directions_[d]);
        return sign;
    }
    [[nodiscard]] int side(std::uint32_t p, const Direction& d) const {
        return planes_[p].own.along(d);
    }
    [[nodiscard]] int side_of_other(std::uint32_t p, const Direction& d) const {
        return planes_[p].pulled.along(d);
    }
    // A vector in this lattice, known to be in the arc's plane: where is it on the arc?
    [[nodiscard]] On place_on(const Arc& arc, const IntVector& v) const {
        const Plane& n = plane(arc.plane);
        const int axis = n.dominant_axis();
        const int up = n.normal(axis) > 0 ? 1 : -1;
        const auto k = static_cast<std::size_t>(axis);
        const int after = up * cross(directions_[arc.from].exact(), v, k).sign();
        const int before = up * cross(v, directions_[arc.to].exact(), k).sign();
        if (after > 0 && before > 0) return On::Inside;
        if (after == 0 && before > 0) return On::From;
        if (after > 0 && before == 0) return On::To;
        return On::Not;
    }
    [[nodiscard]] std::uint32_t root(std::uint32_t d) {
        while (component_[d] != d) {
            component_[d] = component_[component_[d]];
            d = component_[d];
        }
        return d;
    }

private:
    static constexpr int unknown = 2;

    struct Support {
        const Plane* plane;
        PulledPlane pulled;  // seen by the other solid
        PulledPlane own;
    };

    int& own_sign(std::uint32_t p, std::uint32_t d) {
        return own_signs_[p * directions_.size() + d];
    }

    void add(const ConePart& part) {
        const auto& corner = part.triangle.corner;
        const auto& place = part.place;
        const std::uint32_t p = plane_number(part.triangle.plane);
        const auto after = [](std::size_t i) { return i == 2 ? std::size_t{0} : i + 1; };
        if (part.at.is_corner()) {
            const std::size_t i = part.at.index();
            const std::size_t j = after(i);
            const std::size_t k = after(j);
            arcs_.push_back({towards(place[j], *corner[i], *corner[j]),
                             towards(place[k], *corner[i], *corner[k]), p});
        } else if (part.at.is_side()) {
            const std::size_t i = part.at.index();
            const std::size_t j = after(i);
            const std::uint32_t forward = towards(place[j], *corner[i], *corner[j]);
            const std::uint32_t back = towards(place[i], *corner[j], *corner[i]);
            const std::uint32_t inward = own_direction({*corner[i], *corner[after(j)]});
            arcs_.push_back({forward, inward, p});
            arcs_.push_back({inward, back, p});
        } else {
            const Direction u(*corner[0], *corner[1]);
            const Direction v(*corner[0], *corner[2]);
            const std::array<std::uint32_t, 4> d{own_direction(u), own_direction(v),
                                                 own_direction(-u), own_direction(-v)};
            for (std::size_t i = 0; i < 4; ++i) arcs_.push_back({d[i], d[(i + 1) % 4], p});
        }
    }
    // Directions to the same place are the same one.
    std::uint32_t towards(std::uint32_t target, const Point& from, const Point& to) {
        for (std::uint32_t d = 0; d < targets_.size(); ++d)
            if (targets_[d] == target) return d;
        directions_.emplace_back(from, to);
        targets_.push_back(target);
        return direction_count() - 1;
    }
    std::uint32_t own_direction(const Direction& v) {
        directions_.push_back(v);
        targets_.push_back(no_target);
        return direction_count() - 1;
    }
    std::uint32_t plane_number(const Plane* plane) {
        for (std::uint32_t p = 0; p < planes_.size(); ++p)
            if (planes_[p].plane == plane) return p;
        planes_.push_back(
            {plane, PulledPlane(*plane, from_other_), PulledPlane(*plane, identity())});
        return static_cast<std::uint32_t>(planes_.size()) - 1;
    }

    static constexpr std::uint32_t no_target = 0xffffffffU;

    const RelativePose& from_other_;
    const RelativePose& to_other_;
    std::vector<Arc> arcs_;
    std::vector<Direction> directions_;
    std::vector<std::uint32_t> targets_;
    std::vector<std::optional<IntVector>> moved_;
    std::vector<Support> planes_;
    std::vector<std::uint32_t> component_;
    std::vector<int> own_signs_;
};

// A half-plane around a direction z. Geometrically z × towards is `turn` times the outward normal
// of its plane: with turn = 1 the solid is on its clockwise side.
struct HalfPlane {
    bool of_a = false;
    std::uint32_t plane = 0;
    std::uint32_t towards = 0;
    int turn = 1;
};

class Comparison {
public:
    Comparison(std::span<const ConePart> a, std::span<const ConePart> b, const PosedPair& poses,
               bool thorough)
        : a_(a, poses.to_a, poses.to_b),
          b_(b, poses.to_b, poses.to_a),
          turn_b_(poses.to_a.is_mirror() ? -1 : 1),
          thorough_(thorough),
          b_to_planes_of_a_(signs_of(a_, b_)),
          a_to_planes_of_b_(signs_of(b_, a_)) {}

    BoundaryFlags run() {
        flags_.meet = true;
        if (arcs_cross()) {
            flags_.set_crossing();
            return flags_;
        }
        met_a_.resize(a_.direction_count(), false);
        met_b_.resize(b_.direction_count(), false);
        compare_at_directions(a_, b_, true);
        compare_at_directions(b_, a_, false);
        locate_components(a_, b_, true);
        locate_components(b_, a_, false);
        return flags_;
    }

private:
    using Signs = std::vector<int>;

    // Of the other figure's directions to the planes of a figure.
    static Signs signs_of(const Figure& planes, const Figure& directions) {
        std::uint32_t count = 0;
        for (const Arc& arc : planes.arcs()) count = std::max(count, arc.plane + 1);
        Signs signs;
        signs.reserve(count * directions.direction_count());
        for (std::uint32_t p = 0; p < count; ++p)
            for (std::uint32_t d = 0; d < directions.direction_count(); ++d)
                signs.push_back(planes.side_of_other(p, directions.direction(d)));
        return signs;
    }
    // Of direction d of the other solid to plane p of A (or of B).
    [[nodiscard]] int sign(bool plane_of_a, std::uint32_t p, std::uint32_t d) const {
        return plane_of_a ? b_to_planes_of_a_[p * b_.direction_count() + d]
                          : a_to_planes_of_b_[p * a_.direction_count() + d];
    }

    // Two arcs cross if the ends of each are strictly on both sides of the other's plane, and the
    // crossing is not on the far side of the sphere: det(u, v, x) and det(x, y, u) differ in sign.
    [[nodiscard]] bool arcs_cross() {
        for (const Arc& s : a_.arcs())
            for (const Arc& t : b_.arcs()) {
                const int x = sign(true, s.plane, t.from);
                const int u = sign(false, t.plane, s.from);
                if (x * sign(true, s.plane, t.to) < 0 && u * sign(false, t.plane, s.to) < 0 &&
                    x == -turn_b_ * u && !(thorough_ && has_direction_at(s, t)))
                    return true;
            }
        return false;
    }
    // Whether some direction is where two arcs cross. There another part of the same boundary
    // begins, so that the crossing alone decides nothing.
    [[nodiscard]] bool has_direction_at(const Arc& s, const Arc& t) {
        for (std::uint32_t z = 0; z < a_.direction_count(); ++z)
            if (sign(false, t.plane, z) == 0 && a_.side(s.plane, z) == 0 &&
                a_.place_on(s, a_.direction(z).exact()) == On::Inside &&
                b_.place_on(t, a_.moved(z)) == On::Inside)
                return true;
        for (std::uint32_t z = 0; z < b_.direction_count(); ++z)
            if (sign(true, s.plane, z) == 0 && b_.side(t.plane, z) == 0 &&
                b_.place_on(t, b_.direction(z).exact()) == On::Inside &&
                a_.place_on(s, b_.moved(z)) == On::Inside)
                return true;
        return false;
    }

    // At directions of `figure` that are on the other one. Marks the components (by their roots)
    // that meet there. A direction of both is compared once, as one of A.
    void compare_at_directions(Figure& figure, Figure& other, bool figure_is_a) {
        std::vector<bool>& met = figure_is_a ? met_a_ : met_b_;
        std::vector<bool>& other_met = figure_is_a ? met_b_ : met_a_;
        std::vector<HalfPlane> own;
        std::vector<HalfPlane> others;
        for (std::uint32_t z = 0; z < figure.direction_count(); ++z) {
            others.clear();
            bool known = false;
            for (const Arc& arc : other.arcs()) {
                if (sign(!figure_is_a, arc.plane, z) != 0) continue;
                const On on = other.place_on(arc, figure.moved(z));
                if (on == On::Not) continue;
                known = known || (!figure_is_a && on != On::Inside);
                add_half_planes(arc, on, !figure_is_a, others);
                other_met[other.root(arc.from)] = true;
            }
            if (others.empty()) continue;
            met[figure.root(z)] = true;
            if (known) continue;
            own.clear();
            for (const Arc& arc : figure.arcs()) {
                On on = arc.from == z ? On::From : (arc.to == z ? On::To : On::Not);
                if (on == On::Not && thorough_ && figure.side(arc.plane, z) == 0)
                    on = figure.place_on(arc, figure.direction(z).exact());
                if (on != On::Not) add_half_planes(arc, on, figure_is_a, own);
            }
            classify(own, others);
            classify(others, own);
        }
    }

    void add_half_planes(const Arc& arc, On on, bool of_a, std::vector<HalfPlane>& out) const {
        const int turn = of_a ? 1 : turn_b_;
        if (on != On::To) out.push_back({of_a, arc.plane, arc.to, turn});
        if (on != On::From) out.push_back({of_a, arc.plane, arc.from, -turn});
    }

    // Sign of det(z, towards of g, towards of h): whether h is less than half a turn
    // counter-clockwise of g.
    int turn_between(const HalfPlane& g, const HalfPlane& h) {
        if (g.of_a != h.of_a) return g.turn * sign(g.of_a, g.plane, h.towards);
        return g.turn * (g.of_a ? a_ : b_).side(g.plane, h.towards);
    }
    // Of half-planes in one plane: the same one, not the opposite one.
    bool coincide(const HalfPlane& g, const HalfPlane& h) const {
        const int sense = g.of_a == h.of_a ? own_sense(g, h) : mixed_sense(g, h);
        return g.turn * h.turn * sense > 0;
    }
    int own_sense(const HalfPlane& g, const HalfPlane& h) const {
        const Figure& f = g.of_a ? a_ : b_;
        return sign_of_dot(f.plane(g.plane), f.plane(h.plane));
    }
    int mixed_sense(const HalfPlane& g, const HalfPlane& h) const {
        const HalfPlane& of_a = g.of_a ? g : h;
        const HalfPlane& of_b = g.of_a ? h : g;
        return a_.pulled(of_a.plane).sense_of(b_.plane(of_b.plane));
    }

    // Where the half-planes of one solid are with respect to the other one's.
    void classify(const std::vector<HalfPlane>& these, const std::vector<HalfPlane>& others) {
        for (const HalfPlane& h : these) {
            const HalfPlane* nearest = nullptr;
            int nearest_sector = 4;
            bool shared = false;
            for (const HalfPlane& o : others) {
                const int turn = turn_between(h, o);
                if (turn == 0 && coincide(h, o)) {
                    (solids_agree(h, o) ? flags_.same : flags_.opposite) = true;
                    shared = true;
                    break;
                }
                const int sector = 2 - turn;  // 1: within half a turn, 2: opposite, 3: beyond
                if (sector < nearest_sector ||
                    (sector == nearest_sector && turn_between(o, *nearest) > 0)) {
                    nearest = &o;
                    nearest_sector = sector;
                }
            }
            if (shared) continue;
            // What is before the nearest half-plane on the way counter-clockwise is inside if that
            // one has its solid on the clockwise side.
            set(h.of_a, is_solid_clockwise(*nearest));
        }
    }
    static bool is_solid_clockwise(const HalfPlane& h) { return h.turn > 0; }
    static bool solids_agree(const HalfPlane& g, const HalfPlane& h) { return g.turn == h.turn; }

    void set(bool of_a, bool inside) {
        if (of_a)
            (inside ? flags_.a_in : flags_.a_out) = true;
        else
            (inside ? flags_.b_in : flags_.b_out) = true;
    }

    void locate_components(Figure& figure, Figure& other, bool figure_is_a) {
        const std::vector<bool>& met = figure_is_a ? met_a_ : met_b_;
        for (std::uint32_t d = 0; d < figure.direction_count(); ++d)
            if (figure.root(d) == d && !met[d])
                set(figure_is_a, is_inside(figure, d, other, !figure_is_a));
    }

    // Whether a direction that is not on the other figure is inside the other solid.
    bool is_inside(Figure& figure, std::uint32_t d, Figure& other, bool other_is_a) {
        const IntVector& v = figure.moved(d);
        for (const int weight : {1, 2, 3, 5}) {
            for (std::uint32_t k = 0; k < other.arcs().size(); ++k) {
                const Arc& goal = other.arcs()[k];
                const int arrival = sign(other_is_a, goal.plane, d);
                if (arrival == 0) continue;
                const Direction m = Direction::between(other.direction(goal.from),
                                                       other.direction(goal.to), weight, 1);
                if (thorough_ && is_on_another(other, k, m)) continue;
                bool inside = arrival < 0;
                for (std::uint32_t j = 0; j < other.arcs().size(); ++j)
                    if (j != k && path_crosses(other, other.arcs()[j], d, v, m, other_is_a))
                        inside = !inside;
                return inside;
            }
        }
        contract_violated("a direction that could not be located", __FILE__, __LINE__);
    }
    static bool is_on_another(const Figure& figure, std::uint32_t k, const Direction& m) {
        for (std::uint32_t j = 0; j < figure.arcs().size(); ++j)
            if (j != k && figure.side(figure.arcs()[j].plane, m) == 0 &&
                figure.place_on(figure.arcs()[j], m.exact()) != On::Not)
                return true;
        return false;
    }
    // The path from direction d (v in the lattice of `other`) to m, pushed aside: ends of arcs on
    // its great circle count as above it.
    bool path_crosses(const Figure& other, const Arc& arc, std::uint32_t d, const IntVector& v,
                      const Direction& m, bool other_is_a) const {
        const int start = sign(other_is_a, arc.plane, d);
        if (start == 0 || start * other.side(arc.plane, m) >= 0) return false;
        const auto above = [&](std::uint32_t end) {
            return determinant(v, m.exact(), other.direction(end).exact()).sign() >= 0 ? 1 : -1;
        };
        const int from = above(arc.from);
        return from != above(arc.to) && from == -start;
    }

    Figure a_;
    Figure b_;
    int turn_b_;
    bool thorough_;
    Signs b_to_planes_of_a_;
    Signs a_to_planes_of_b_;
    std::vector<bool> met_a_;
    std::vector<bool> met_b_;
    BoundaryFlags flags_;
};

}  // namespace

BoundaryFlags compare_cones(std::span<const ConePart> a, std::span<const ConePart> b,
                            const PosedPair& poses, bool thorough) {
    return Comparison(a, b, poses, thorough).run();
}

}  // namespace trisect::detail
