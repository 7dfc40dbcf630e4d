// SPDX-License-Identifier: Apache-2.0

#include "interference_oracle.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

#include "engines/engines.h"
#include "fraction_models.h"
#include "pose_oracle.h"
#include "reference/triangle_contact.h"

namespace brute {

using oracle::RationalMap;
using reference::Operand;
using reference::Point3;
using reference::Random;
using reference::Rational;
using trisect::BoundaryEntity;
using trisect::Brep;
using trisect::Contact;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Relation;

Body Body::of(Operand operand) { return {{std::move(operand)}, reference::Expression::leaf(0)}; }

trisect::Solid Body::solid() const {
    std::vector<trisect::Solid> solids;
    solids.reserve(operands.size());
    for (const Operand& o : operands) solids.push_back(engines::solid(o));
    if (solids.size() == 1) return solids.front();  // not resolved: models do that
    return trisect::evaluate(engines::formula(formula, solids));
}

// Contacts -----------------------------------------------------------------------------------

namespace {

struct PosedBrep {
    const Brep& brep;
    std::vector<Point3> points;  // of the vertices, in the world

    PosedBrep(const Brep& b, const Pose& pose) : brep(b) {
        const RationalMap map = oracle::composed(
            oracle::map_of(pose), oracle::scaling(oracle::power_of_two(b.lattice().exponent)));
        for (const auto& p : b.points()) points.push_back(map(oracle::rational(p)));
    }
    [[nodiscard]] const Point3& at(trisect::VertexId v) const { return points[v.index]; }
};

template <class Id>
Id smallest_copy(const Brep& brep, Id id) {
    const auto copies = brep.copies(id);
    return copies.empty() ? id : *std::min_element(copies.begin(), copies.end());
}

// The part of a face that a point in it is on: a vertex, an edge, or the face itself.
BoundaryEntity entity_at(const PosedBrep& posed, trisect::FaceId face, const Point3& p) {
    const Brep& brep = posed.brep;
    for (const auto h : brep.halfedges(face))
        if (posed.at(brep.origin(h)) == p) return smallest_copy(brep, brep.origin(h));
    for (const auto h : brep.halfedges(face)) {
        const Point3 u = reference::subtracted(posed.at(brep.target(h)), posed.at(brep.origin(h)));
        const Point3 v = reference::subtracted(p, posed.at(brep.origin(h)));
        if (reference::cross(u, v) != Point3{}) continue;
        const Rational along = reference::dot(u, v);
        if (along > 0 && along < reference::dot(u, u)) return smallest_copy(brep, brep.edge(h));
    }
    return face;
}

Point3 middle(const std::vector<Point3>& points) {
    Point3 sum{};
    for (const Point3& p : points)
        for (std::size_t i = 0; i < 3; ++i) sum[i] += p[i];
    for (Rational& x : sum) x /= static_cast<unsigned long>(points.size());
    return sum;
}

// Bounding boxes in rationals, so that not everything is intersected with everything.
struct Bounds {
    Point3 lo;
    Point3 hi;
    explicit Bounds(const reference::Triangle3& t) : lo(t[0]), hi(t[0]) {
        for (const Point3& p : t)
            for (std::size_t i = 0; i < 3; ++i) {
                if (p[i] < lo[i]) lo[i] = p[i];
                if (p[i] > hi[i]) hi[i] = p[i];
            }
    }
    [[nodiscard]] bool meets(const Bounds& o) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (lo[i] > o.hi[i] || o.lo[i] > hi[i]) return false;
        return true;
    }
};

struct PosedTriangles {
    std::vector<reference::Triangle3> triangles;
    std::vector<trisect::FaceId> faces;
    std::vector<Bounds> bounds;

    PosedTriangles(const InterferenceModel& model, const PosedBrep& posed) {
        for (const auto& t : trisect::detail::data_of(model).triangles) {
            triangles.push_back(
                {posed.at(t.vertex[0]), posed.at(t.vertex[1]), posed.at(t.vertex[2])});
            faces.push_back(t.face);
            bounds.emplace_back(triangles.back());
        }
    }
};

// The outward normal as the image of what is below stays below: orientation times mirror.
Point3 outward(const reference::Triangle3& t, const Pose& pose) {
    Point3 n =
        reference::cross(reference::subtracted(t[1], t[0]), reference::subtracted(t[2], t[0]));
    if (pose.is_mirror())
        for (Rational& v : n) v = -v;
    return n;
}

}  // namespace

std::vector<Contact> contacts(const InterferenceModel& a, const Pose& pose_a,
                              const InterferenceModel& b, const Pose& pose_b) {
    const PosedBrep pa(a.brep(), pose_a);
    const PosedBrep pb(b.brep(), pose_b);
    const PosedTriangles ta(a, pa);
    const PosedTriangles tb(b, pb);
    std::map<std::pair<BoundaryEntity, BoundaryEntity>, std::pair<std::uint8_t, bool>> found;
    for (std::size_t i = 0; i < ta.triangles.size(); ++i)
        for (std::size_t j = 0; j < tb.triangles.size(); ++j) {
            if (!ta.bounds[i].meets(tb.bounds[j])) continue;
            std::vector<Point3> corners;
            for (const auto& [point, parts] : reference::contact(ta.triangles[i], tb.triangles[j]))
                corners.push_back(point);
            const auto note = [&](const Point3& p, std::uint8_t dimension, bool opposite) {
                auto& entry = found[{entity_at(pa, ta.faces[i], p), entity_at(pb, tb.faces[j], p)}];
                if (dimension >= entry.first) entry = {dimension, opposite};
            };
            for (const Point3& p : corners) note(p, 0, false);
            for (std::size_t k = 0; k < corners.size(); ++k)
                for (std::size_t l = k + 1; l < corners.size(); ++l)
                    note(middle({corners[k], corners[l]}), 1, false);
            if (corners.size() > 2)
                note(middle(corners), 2,
                     reference::dot(outward(ta.triangles[i], pose_a),
                                    outward(tb.triangles[j], pose_b)) < 0);
        }
    std::vector<Contact> all;
    for (const auto& [entities, kind] : found)
        all.push_back({entities.first, entities.second, kind.first, kind.second});
    return all;
}

// Regions ------------------------------------------------------------------------------------

namespace {

Point3 added(const Point3& a, const Point3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

// Twice the vector area of a closed polygon.
Point3 vector_area(const std::vector<Point3>& loop) {
    Point3 sum{};
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum = added(sum, reference::cross(loop[i], loop[(i + 1) % loop.size()]));
    return sum;
}

Rational rational(const trisect::ExactRational& v) { return Rational(v.to_string()); }

bool is_on_segment(const Point3& p, const Point3& from, const Point3& to) {
    const Point3 u = reference::subtracted(to, from);
    const Point3 v = reference::subtracted(p, from);
    if (reference::cross(u, v) != Point3{}) return false;
    const Rational along = reference::dot(u, v);
    return along >= 0 && along <= reference::dot(u, u);
}

using Loops = std::vector<std::vector<Point3>>;

Loops loops_of(const trisect::ContactRegion& region) {
    Loops loops;
    for (const auto& loop : region.loops) {
        loops.emplace_back();
        for (const auto& p : loop)
            loops.back().push_back(
                {rational(p.exact[0]), rational(p.exact[1]), rational(p.exact[2])});
    }
    return loops;
}

// Whether a region contains a point: on its outline, or within an area.
bool covers(const Loops& loops, const Point3& normal, const Point3& p) {
    for (const auto& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            if (is_on_segment(p, loop[i], loop[(i + 1) % loop.size()])) return true;
    if (loops.front().size() < 3 ||
        reference::dot(normal, reference::subtracted(p, loops.front()[0])) != 0)
        return false;
    // Even or odd, in the plane of two coordinates.
    std::size_t k = 0;
    while (normal[k] == 0) ++k;
    const std::size_t x = (k + 1) % 3;
    const std::size_t y = (k + 2) % 3;
    bool inside = false;
    for (const auto& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point3& u = loop[i];
            const Point3& v = loop[(i + 1) % loop.size()];
            if ((u[y] > p[y]) == (v[y] > p[y])) continue;
            const Rational at = u[x] + (p[y] - u[y]) * (v[x] - u[x]) / (v[y] - u[y]);
            if (p[x] < at) inside = !inside;
        }
    return inside;
}

}  // namespace

std::string wrong_regions(const InterferenceModel& a, const Pose& pose_a,
                          const InterferenceModel& b, const Pose& pose_b,
                          const trisect::InterferenceResult& result) {
    const PosedBrep pa(a.brep(), pose_a);
    const PosedBrep pb(b.brep(), pose_b);
    const PosedTriangles ta(a, pa);
    const PosedTriangles tb(b, pb);
    std::vector<Point3> points;  // that must be covered
    std::map<std::pair<BoundaryEntity, BoundaryEntity>, Point3> areas;
    for (std::size_t i = 0; i < ta.triangles.size(); ++i)
        for (std::size_t j = 0; j < tb.triangles.size(); ++j) {
            if (!ta.bounds[i].meets(tb.bounds[j])) continue;
            std::vector<Point3> corners;
            for (const auto& [point, parts] : reference::contact(ta.triangles[i], tb.triangles[j]))
                corners.push_back(point);
            if (corners.empty()) continue;
            points.insert(points.end(), corners.begin(), corners.end());
            points.push_back(middle(corners));
            if (corners.size() < 3) continue;
            const Point3 n = outward(ta.triangles[i], pose_a);
            std::sort(corners.begin() + 1, corners.end(), [&](const Point3& p, const Point3& q) {
                return reference::dot(n, reference::cross(reference::subtracted(p, corners[0]),
                                                          reference::subtracted(q, corners[0]))) >
                       0;
            });
            Point3& area = areas[{ta.faces[i], tb.faces[j]}];
            area = added(area, vector_area(corners));
        }
    std::vector<std::pair<Loops, Point3>> regions;
    for (const auto& r : result.regions) {
        regions.emplace_back(loops_of(r), Point3{});
        const bool known = std::ranges::any_of(result.contacts, [&](const Contact& c) {
            return c.a == r.a && c.b == r.b && c.dimension == r.dimension &&
                   c.opposite == r.opposite;
        });
        if (!known) return "a region that is no contact\n";
        const Loops& loops = regions.back().first;
        if (r.dimension < 2) {
            if (loops.size() != 1 || loops[0].size() != r.dimension + 1U)
                return "a segment or point of the wrong form\n";
            continue;
        }
        Point3 area{};
        for (const auto& loop : loops) area = added(area, vector_area(loop));
        if (pose_a.is_mirror())
            for (Rational& v : area) v = -v;
        const auto expected = areas.find({r.a, r.b});
        if (expected == areas.end() || expected->second != area) return "a wrong area\n";
        regions.back().second = area;
        areas.erase(expected);
    }
    if (!areas.empty()) return "an area is missing\n";
    for (const Point3& p : points)
        if (std::ranges::none_of(regions,
                                 [&](const auto& r) { return covers(r.first, r.second, p); }))
            return "a common point is in no region\n";
    return {};
}

// Relations ----------------------------------------------------------------------------------

namespace {

using MovedOperand = std::vector<reference::Triangle3>;

MovedOperand moved(const Operand& operand, const Pose& pose) {
    const RationalMap map = oracle::map_of(pose);
    MovedOperand out;
    for (const auto& t : operand) {
        reference::Triangle3 m{map(reference::to_point(t[0])), map(reference::to_point(t[1])),
                               map(reference::to_point(t[2]))};
        if (pose.is_mirror()) std::swap(m[1], m[2]);
        out.push_back(m);
    }
    return out;
}

// All on one grid of integers, if they fit.
std::optional<std::vector<Operand>> on_grid(const std::vector<MovedOperand>& operands) {
    reference::Integer unit = 1;
    for (const auto& operand : operands)
        for (const auto& t : operand)
            for (const Point3& p : t)
                for (const Rational& x : p) unit = lcm(unit, x.get_den());
    std::vector<Operand> out;
    for (const auto& operand : operands) {
        Operand o;
        for (const auto& t : operand) {
            reference::Triangle g;
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t i = 0; i < 3; ++i) {
                    const Rational x = t[k][i] * unit;
                    if (mpz_sizeinbase(x.get_num().get_mpz_t(), 2) > 62) return std::nullopt;
                    g[k][i] = x.get_num().get_si();
                }
            o.push_back(g);
        }
        out.push_back(std::move(o));
    }
    return out;
}

}  // namespace

std::optional<Relation> relation(const Scene& scene, bool boundaries_meet) {
    std::vector<MovedOperand> moved_operands;
    for (const Operand& o : scene.a.operands) moved_operands.push_back(moved(o, scene.pose_a));
    for (const Operand& o : scene.b.operands) moved_operands.push_back(moved(o, scene.pose_b));
    const auto operands = on_grid(moved_operands);
    if (!operands) return std::nullopt;
    const std::size_t split = scene.a.operands.size();
    const auto in_a = reference::make_indicator(scene.a.formula);
    const auto in_b = reference::make_indicator(scene.b.formula);
    const auto is_empty = [&](const std::function<bool(bool, bool)>& rule) {
        return reference::evaluate(*operands,
                                   [&](const std::vector<int>& windings) {
                                       const auto middle =
                                           windings.begin() + static_cast<std::ptrdiff_t>(split);
                                       return rule(in_a({windings.begin(), middle}),
                                                   in_b({middle, windings.end()}));
                                   })
            .cells.empty();
    };
    if (is_empty([](bool a, bool b) { return a && b; }))
        return boundaries_meet ? Relation::Touching : Relation::Disjoint;
    const bool a_within = is_empty([](bool a, bool b) { return a && !b; });
    const bool b_within = is_empty([](bool a, bool b) { return b && !a; });
    if (a_within) return b_within ? Relation::Equal : Relation::Inside;
    return b_within ? Relation::Contains : Relation::Overlapping;
}

// Scenes -------------------------------------------------------------------------------------

namespace {

using Kind = reference::Expression::Kind;

Operand small_box(Random& random) {
    const auto low = [&] { return random.between(0, 6); };
    const reference::LatticePoint lo{low(), low(), low()};
    const auto size = [&] { return random.between(1, 5); };
    return reference::box(lo, {lo[0] + size(), lo[1] + size(), lo[2] + size()});
}

Body two(Operand x, Operand y, Kind kind) {
    return {{std::move(x), std::move(y)}, reference::pair_expression(kind)};
}

// A block and something that touches it with a corner in a face, an edge in a face, or crosswise
// edge on edge: places that no vertex of the block knows of.
Body self_touching(Random& random) {
    const Operand block = reference::box({0, 0, 0}, {4, 4, 4});
    const auto jitter = [&] { return random.between(1, 3); };
    Operand other;
    switch (random.below(3)) {
        case 0:
            other =
                reference::pyramid({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 7, {jitter(), jitter(), 4});
            break;
        case 1:
            other =
                reference::tetrahedron({1, jitter(), 4}, {3, jitter(), 4}, {1, 4, 7}, {3, 0, 7});
            break;
        default:
            other = reference::tetrahedron({2, -2, 5}, {2, 6, 3}, {0, 2, 8}, {5, 2, 8});
    }
    return two(block, other, Kind::Union);
}

Body random_body(Random& random) {
    switch (random.below(7)) {
        case 6:
            return self_touching(random);
        case 0:
            return Body::of(small_box(random));
        case 1:
            return Body::of(reference::random_embedded_solid(random));
        case 2:
            return Body::of(reference::random_operand(random));
        case 3:
            return two(small_box(random), small_box(random), Kind::Difference);
        case 4:
            return two(small_box(random), small_box(random), Kind::Union);
        default: {
            auto family = reference::random_family(random, 2);
            constexpr std::array<Kind, 3> kinds{Kind::Union, Kind::Intersection, Kind::Difference};
            return {std::move(family), reference::pair_expression(kinds[random.below(3)])};
        }
    }
}

// Pairs that belong together: what one boolean leaves and what it takes, a cavity and its filling.
void make_related(Random& random, Scene& scene) {
    const auto box = [](std::int64_t lo, std::int64_t hi) {
        return reference::box({lo, lo, lo}, {hi, hi, hi});
    };
    switch (random.below(6)) {
        case 0:
            scene.b = scene.a;
            return;
        case 1: {  // A - B next to A * B
            auto family = reference::random_family(random, 2);
            scene.a = {family, reference::pair_expression(Kind::Difference)};
            scene.b = {family, reference::pair_expression(Kind::Intersection)};
            return;
        }
        case 2:  // a cavity, and something in it
            scene.a = two(box(0, 7), box(1, 6), Kind::Difference);
            scene.b = random.chance(1, 2) ? Body::of(box(1, 6)) : Body::of(box(2, 5));
            return;
        case 3: {  // shells in shells
            scene.a = {{box(0, 9), box(1, 8), box(2, 7)},
                       reference::Expression::node(
                           Kind::Union, {reference::Expression::node(
                                             Kind::Difference, {reference::Expression::leaf(0),
                                                                reference::Expression::leaf(1)}),
                                         reference::Expression::leaf(2)})};
            const std::int64_t lo = random.between(0, 4);
            scene.b = Body::of(box(lo, 9 - lo));
            return;
        }
        case 4: {  // A and A with something taken away or added
            scene.b = {scene.a.operands, scene.a.formula};
            scene.b.operands.push_back(small_box(random));
            scene.b.formula = reference::Expression::node(
                random.chance(1, 2) ? Kind::Difference : Kind::Union,
                {scene.a.formula, reference::Expression::leaf(scene.b.operands.size() - 1)});
            return;
        }
        default: {  // blocks side by side
            const std::int64_t x = random.between(1, 5);
            scene.a = Body::of(reference::box({0, 0, 0}, {x, random.between(1, 4), 4}));
            scene.b = Body::of(reference::box({x, random.between(-2, 4), random.between(-2, 2)},
                                              {x + 2, random.between(5, 6), random.between(3, 6)}));
        }
    }
}

Pose random_pose(Random& random) {
    const auto whole = [&](std::int64_t size) {
        return static_cast<double>(random.between(-size, size));
    };
    const std::array<double, 3> t{whole(4), whole(4), whole(4)};
    const auto component = [&] { return random.between(-2, 2); };
    switch (random.below(8)) {
        case 0:
        case 1:
            return Pose();
        case 2:
        case 3:
            return Pose::from_translation(t);
        case 4:
            return Pose::from_quaternion(
                {1, random.between(0, 1), random.between(0, 1), random.between(0, 1)}, t);
        case 5: {
            std::array<std::int64_t, 4> q{component(), component(), component(), component()};
            if (q == std::array<std::int64_t, 4>{}) q[0] = 1;
            return Pose::from_quaternion(q, t);
        }
        case 6:  // a mirror
            return Pose::from_doubles({-1, 0, 0, whole(8), 0, 1, 0, t[1], 0, 0, 1, t[2]});
        default: {  // doubles with all their bits
            for (;;) {
                std::array<double, 12> rows{};
                for (std::size_t i = 0; i < 12; ++i)
                    rows[i] = std::ldexp(static_cast<double>(random.between(
                                             -(std::int64_t{1} << 52), std::int64_t{1} << 52)),
                                         i % 4 == 3 ? -50 : -52);
                try {
                    return Pose::from_doubles(rows);
                } catch (const trisect::UsageError&) {
                }
            }
        }
    }
}

}  // namespace

Scene random_scene(Random& random) {
    Scene scene{random_body(random), random_body(random), Pose(), Pose()};
    if (random.chance(1, 3)) make_related(random, scene);
    if (random.chance(2, 3)) scene.pose_b = random_pose(random);
    if (random.chance(1, 4)) {  // both under one pose
        const Pose frame = random_pose(random);
        scene.pose_a = frame;
        scene.pose_b = frame * scene.pose_b;
    } else if (random.chance(1, 8)) {
        scene.pose_a = random_pose(random);
    }
    if (random.chance(1, 2)) {
        std::swap(scene.a, scene.b);
        std::swap(scene.pose_a, scene.pose_b);
    }
    return scene;
}

namespace {

void print(std::ostream& out, const std::vector<Contact>& contacts) {
    for (const Contact& c : contacts)
        out << ' ' << "vef"[static_cast<int>(c.a.kind())] << c.a.index() << '-'
            << "vef"[static_cast<int>(c.b.kind())] << c.b.index() << ':'
            << static_cast<int>(c.dimension) << (c.opposite ? "o" : "");
}

Relation turned_over(Relation r) {
    if (r == Relation::Inside) return Relation::Contains;
    if (r == Relation::Contains) return Relation::Inside;
    return r;
}

}  // namespace

std::string difference(const Scene& scene, Relation* expected) {
    const InterferenceModel a(scene.a.solid());
    const InterferenceModel b(scene.b.solid());
    const auto found =
        interfere(a, scene.pose_a, b, scene.pose_b, {.contacts = true, .regions = true});
    const auto contacts_found = contacts(a, scene.pose_a, b, scene.pose_b);
    std::ostringstream out;
    if (found.contacts != contacts_found) {
        out << "contacts:";
        print(out, found.contacts);
        out << "\nbrute force:";
        print(out, contacts_found);
        out << '\n';
    }
    out << wrong_regions(a, scene.pose_a, b, scene.pose_b, found);
    std::optional<Relation> right;
    if (a.is_empty() || b.is_empty())
        right = Relation::Disjoint;
    else
        right = relation(scene, !contacts_found.empty());
    if (right && found.relation != *right)
        out << "relation: " << to_string(found.relation) << ", brute force: " << to_string(*right)
            << '\n';
    const Relation short_way = interfere(a, scene.pose_a, b, scene.pose_b).relation;
    if (short_way != found.relation)
        out << "relation without contacts: " << to_string(short_way) << '\n';
    const Relation other_way = interfere(b, scene.pose_b, a, scene.pose_a).relation;
    if (other_way != turned_over(found.relation))
        out << "relation of B to A: " << to_string(other_way) << ", of A to B "
            << to_string(found.relation) << '\n';
    if (expected != nullptr) *expected = right.value_or(found.relation);
    return out.str();
}

namespace {

bool same_regions(const trisect::InterferenceResult& a, const trisect::InterferenceResult& b) {
    return std::ranges::equal(a.regions, b.regions, [](const auto& x, const auto& y) {
        return x.a == y.a && x.b == y.b && x.dimension == y.dimension && x.opposite == y.opposite &&
               loops_of(x) == loops_of(y);
    });
}

}  // namespace

std::string difference_on_coarser_lattices(const Scene& scene, const std::array<int, 2>& bits) {
    const InterferenceModel a(scene.a.solid());
    const InterferenceModel b(scene.b.solid());
    const InterferenceModel fa = trisect::test::with_fractions(a, bits[0]);
    const InterferenceModel fb = trisect::test::with_fractions(b, bits[1]);
    const trisect::InterferenceOptions all{.contacts = true, .regions = true};
    const auto expected = interfere(a, scene.pose_a, b, scene.pose_b, all);
    const auto found = interfere(fa, scene.pose_a, fb, scene.pose_b, all);
    std::ostringstream out;
    if (found.relation != expected.relation)
        out << "relation: " << to_string(found.relation) << ", before "
            << to_string(expected.relation) << '\n';
    if (found.contacts != expected.contacts) out << "other contacts\n";
    if (!same_regions(found, expected)) out << "other regions\n";
    if (interfere(fa, scene.pose_a, fb, scene.pose_b).relation != expected.relation)
        out << "another relation without contacts\n";
    if (interfere(fb, scene.pose_b, fa, scene.pose_a).relation != turned_over(expected.relation))
        out << "another relation of B to A\n";
    std::string what = out.str();
    if (!what.empty())
        what +=
            "in units of 2^" + std::to_string(bits[0]) + " and 2^" + std::to_string(bits[1]) + '\n';
    return what;
}

}  // namespace brute
