// SPDX-License-Identifier: Apache-2.0
//
// Finding certificates. Whatever is found here need not be right, it is what check_certificate
// accepts or not; so this part may guess. Planes are tried in doubles and taken when their margin
// is far above rounding, else in fractions; points are tried where contacts say that they must be.

#include <trisect/bsp/interference_certificate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/detail/gmp_conversion.h>
#include <trisect/bsp/detail/cell_proof.h>
#include <trisect/bsp/detail/exact_place.h>
#include <trisect/bsp/detail/from_world.h>
#include <trisect/bsp/detail/interference_model_data.h>
#include <trisect/bsp/detail/meeting_pairs.h>
#include <trisect/bsp/detail/proof_body.h>

namespace trisect {

using detail::ExactPlace;
using detail::FromWorld;
using detail::InterferenceModelData;
using detail::MeetingPair;
using detail::PosedModels;
using detail::ProofBody;

namespace {

using Vector = RationalPoint;
using Approximate = std::array<double, 3>;

ExactRational dot(const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
Vector cross(const Vector& u, const Vector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Vector minus(const Vector& u, const Vector& v) { return {u[0] - v[0], u[1] - v[1], u[2] - v[2]}; }
double dot(const Approximate& u, const Approximate& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
Vector exact(const Approximate& v) {
    return {ExactRational::from_double(v[0]), ExactRational::from_double(v[1]),
            ExactRational::from_double(v[2])};
}

// A plane with `below` strictly on its lower side and `above` on the upper one; or weakly, when
// that is enough.
std::optional<SeparatingPlane> plane_along(const Vector& direction,
                                           std::span<const std::uint32_t> below, const ProofBody& a,
                                           std::span<const std::uint32_t> above, const ProofBody& b,
                                           bool strict) {
    std::optional<ExactRational> highest;
    std::optional<ExactRational> lowest;
    for (const std::uint32_t v : below) {
        ExactRational x = dot(direction, a.points[v]);
        if (!highest || *highest < x) highest = std::move(x);
    }
    for (const std::uint32_t v : above) {
        ExactRational x = dot(direction, b.points[v]);
        if (!lowest || x < *lowest) lowest = std::move(x);
    }
    if (strict ? !(*highest < *lowest) : *lowest < *highest) return std::nullopt;
    return SeparatingPlane{direction, -((*highest + *lowest) / ExactRational(2))};
}

// The directions of separating planes of two triangles or convex sets are among these.
std::vector<Vector> directions_of(const ProofBody& a, const CertifiedTriangle& s,
                                  const ProofBody& b, const CertifiedTriangle& t) {
    const auto sides = [](const ProofBody& p, const CertifiedTriangle& x) {
        std::array<Vector, 3> e;
        for (std::size_t i = 0; i < 3; ++i)
            e[i] = minus(p.points[x.vertex[(i + 1) % 3].index], p.points[x.vertex[i].index]);
        return e;
    };
    const auto u = sides(a, s);
    const auto v = sides(b, t);
    const Vector n = cross(u[0], u[1]);
    const Vector m = cross(v[0], v[1]);
    std::vector<Vector> out{n, m};
    for (const Vector& e : u)
        for (const Vector& f : v) out.push_back(cross(e, f));
    for (const Vector& e : u) out.push_back(cross(e, n));
    for (const Vector& f : v) out.push_back(cross(f, m));
    std::erase_if(out, [](const Vector& d) { return dot(d, d).sign() == 0; });
    return out;
}

Vector opposite(const Vector& v) { return {-v[0], -v[1], -v[2]}; }

class TreeBuilder {
public:
    TreeBuilder(const ProofBody& a, const ProofBody& b) : a_(a), b_(b) {}

    // Nothing when some triangles meet.
    std::optional<std::vector<ApartNode>> build() {
        if (!add(0, a_.triangles.size(), 0, b_.triangles.size())) return std::nullopt;
        return std::move(nodes_);
    }

private:
    bool add(std::size_t a0, std::size_t a1, std::size_t b0, std::size_t b1) {
        const auto below = a_.corners(a0, a1);
        const auto above = b_.corners(b0, b1);
        const std::size_t at = nodes_.size();
        nodes_.emplace_back();
        const bool single = a1 - a0 == 1 && b1 - b0 == 1;
        if (auto plane = single ? exact_plane(a0, b0, below, above) : quick_plane(below, above)) {
            nodes_[at].plane = std::move(*plane);
            return true;
        }
        if (single) return false;
        const bool of_a = a1 - a0 >= b1 - b0;
        const std::size_t ma = (a0 + a1) / 2;
        const std::size_t mb = (b0 + b1) / 2;
        nodes_[at].kind = of_a ? ApartNode::Kind::SplitA : ApartNode::Kind::SplitB;
        if (!add(a0, of_a ? ma : a1, b0, of_a ? b1 : mb)) return false;
        nodes_[at].other = static_cast<std::uint32_t>(nodes_.size());
        return add(of_a ? ma : a0, a1, of_a ? b0 : mb, b1);
    }
    std::optional<SeparatingPlane> exact_plane(std::size_t i, std::size_t j,
                                               std::span<const std::uint32_t> below,
                                               std::span<const std::uint32_t> above) const {
        for (const Vector& d : directions_of(a_, a_.triangles[i], b_, b_.triangles[j]))
            for (const Vector& v : {d, opposite(d)})
                if (auto plane = plane_along(v, below, a_, above, b_, true)) return plane;
        return std::nullopt;
    }
    // Axes and the line between the middles, when the gap is far above rounding.
    std::optional<SeparatingPlane> quick_plane(std::span<const std::uint32_t> below,
                                               std::span<const std::uint32_t> above) const {
        const auto middle = [](const ProofBody& p, std::span<const std::uint32_t> corners) {
            Approximate sum{};
            for (const std::uint32_t v : corners)
                for (std::size_t k = 0; k < 3; ++k) sum[k] += p.near[v][k];
            for (double& x : sum) x /= static_cast<double>(corners.size());
            return sum;
        };
        const Approximate from = middle(a_, below);
        const Approximate to = middle(b_, above);
        const std::array<Approximate, 7> directions{
            Approximate{to[0] - from[0], to[1] - from[1], to[2] - from[2]},
            Approximate{1, 0, 0},
            Approximate{0, 1, 0},
            Approximate{0, 0, 1},
            Approximate{-1, 0, 0},
            Approximate{0, -1, 0},
            Approximate{0, 0, -1}};
        for (const Approximate& d : directions) {
            double highest = -std::numeric_limits<double>::infinity();
            double lowest = std::numeric_limits<double>::infinity();
            double size = 0;
            const auto measure = [&](const Approximate& p) {
                for (std::size_t k = 0; k < 3; ++k) size = std::max(size, std::abs(d[k] * p[k]));
                return dot(d, p);
            };
            for (const std::uint32_t v : below) highest = std::max(highest, measure(a_.near[v]));
            for (const std::uint32_t v : above) lowest = std::min(lowest, measure(b_.near[v]));
            if (lowest - highest > 0x1p-40 * size)
                return SeparatingPlane{
                    exact(d), -ExactRational::from_double(highest + (lowest - highest) / 2)};
        }
        return std::nullopt;
    }

    const ProofBody& a_;
    const ProofBody& b_;
    std::vector<ApartNode> nodes_;
};

// Looks for points strictly inside and outside.
class PointFinder {
public:
    PointFinder(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                const Pose& pose_a, InterferenceCertificate& certificate)
        : models_(models), pairs_(pairs), pose_a_(pose_a), certificate_(certificate) {}

    void run() {
        for (const MeetingPair& pair : pairs_) {
            if (is_done()) return;
            if (pair.contact.crossing) try_beside_crossing(pair);
        }
        for (const MeetingPair& pair : pairs_) {
            if (is_done()) return;
            for (const auto& p : pair.contact.corners())
                if (!p.a.is_interior() || !p.b.is_interior())
                    try_around(place_of(models_, pair, p), pair);
        }
        try_anywhere();
    }

private:
    [[nodiscard]] bool is_done() const {
        const Relation r = certificate_.relation;
        return certificate_.in_both && (certificate_.only_in_a || r == Relation::Inside) &&
               (certificate_.only_in_b || r == Relation::Contains);
    }
    // A point in A's lattice: notes what it shows.
    void look_at(const ExactPlace& p) {
        const Location in_a = locate(models_.a, p);
        if (in_a != Location::Inside && in_a != Location::Outside) return;
        const bool inside_a = in_a == Location::Inside;
        if (inside_a ? certificate_.in_both && certificate_.only_in_a
                     : certificate_.only_in_b.has_value())
            return;
        const Location in_b = locate(models_.b, moved(p, models_.poses.to_b));
        if (in_b != Location::Inside && in_b != Location::Outside) return;
        const bool inside_b = in_b == Location::Inside;
        if (!inside_a && !inside_b) return;
        auto& slot = inside_a ? (inside_b ? certificate_.in_both : certificate_.only_in_a)
                              : certificate_.only_in_b;
        if (!slot) slot = in_world(p, models_.a.brep.lattice(), pose_a_);
    }
    static Location locate(const InterferenceModelData& model, const ExactPlace& p) {
        std::array<ExactRational, 3> x = p.c;
        for (ExactRational& c : x) c = c.scaled(model.brep.lattice().exponent);
        return model.index().locate(x).location;
    }
    static ExactPlace shifted(const ExactPlace& p, const Vector& by, const ExactRational& factor) {
        ExactPlace r;
        for (std::size_t k = 0; k < 3; ++k) r.c[k] = p.c[k] + factor * by[k];
        return r;
    }
    // The number of the size of v, as a power of two.
    static int magnitude(const Vector& v) {
        double m = 0;
        for (const ExactRational& x : v) m = std::max(m, std::abs(x.to_double()));
        return m == 0 ? 0 : std::ilogb(m);
    }

    static Vector of_size_one(Vector v) {
        const int size = magnitude(v);
        for (ExactRational& x : v) x = x.scaled(-size);
        return v;
    }

    // Beside the middle of the segment in which two faces cross, in the quadrants between them.
    void try_beside_crossing(const MeetingPair& pair) {
        const auto& c = pair.contact;
        const ExactPlace p = place_of(models_, pair, c.points[0]);
        const ExactPlace q = place_of(models_, pair, c.points[1]);
        const Vector along = minus(q.c, p.c);
        const ExactPlace middle = shifted(p, along, ExactRational(1) / ExactRational(2));
        // Of one size, or the point would be much nearer to one of the faces.
        const Vector n =
            of_size_one(normal(models_.a.brep.plane(models_.a.triangles[pair.a].face)));
        const Vector m =
            of_size_one(normal_of_b(models_.b.brep.plane(models_.b.triangles[pair.b].face)));
        // d = x n + y m with d·n = s n·n and d·m = t m·m, by Cramer's rule without the division.
        const ExactRational nn = dot(n, n);
        const ExactRational nm = dot(n, m);
        const ExactRational mm = dot(m, m);
        for (const auto& [s, t] : {std::pair{-1, -1}, std::pair{-1, 1}, std::pair{1, -1}}) {
            const ExactRational x = ExactRational(s) * nn * mm - ExactRational(t) * mm * nm;
            const ExactRational y = ExactRational(t) * mm * nn - ExactRational(s) * nn * nm;
            Vector d;
            for (std::size_t k = 0; k < 3; ++k) d[k] = x * n[k] + y * m[k];
            const int start = magnitude(along) - magnitude(d);
            for (int k = 0; k < 12; ++k)
                look_at(shifted(middle, d, ExactRational(1).scaled(start - 3 * k)));
        }
    }
    static Vector normal(const Plane& plane) {
        return {ExactRational(WideInt<2>(plane.normal(0))),
                ExactRational(WideInt<2>(plane.normal(1))),
                ExactRational(WideInt<2>(plane.normal(2)))};
    }
    // Seen in A's lattice: the transposed map from A to B.
    [[nodiscard]] Vector normal_of_b(const Plane& plane) const {
        const ExactPlace origin = moved(ExactPlace{}, models_.poses.to_b);
        const Vector n = normal(plane);
        Vector r;
        for (std::size_t k = 0; k < 3; ++k) {
            ExactPlace unit;
            unit.c[k] = ExactRational(1);
            r[k] = dot(n, minus(moved(unit, models_.poses.to_b).c, origin.c));
        }
        return r;
    }
    // Around a point of contact, in directions of no special meaning.
    void try_around(const ExactPlace& p, const MeetingPair& pair) {
        double size = 0;
        const auto& t = models_.a.triangles[pair.a];
        for (std::size_t k = 0; k < 3; ++k)
            size = std::max(size, std::abs(models_.a.position(t.vertex[0])[k] -
                                           models_.a.position(t.vertex[1])[k]));
        const int start = size > 0 ? std::ilogb(size) - 8 : 0;
        for (int k = 0; k < 24 && !is_done(); ++k) {
            Vector d;
            for (ExactRational& x : d)
                x = ExactRational(static_cast<std::int64_t>(random_() % 129) - 64);
            for (const int down : {0, 6, 14})
                look_at(shifted(p, d, ExactRational(1).scaled(start - down)));
        }
    }
    void try_anywhere() {
        for (int k = 0; k < 1500 && !is_done(); ++k) {
            ExactPlace p;
            const bool of_a = k % 2 == 0;
            const InterferenceModelData& m = of_a ? models_.a : models_.b;
            for (std::size_t i = 0; i < 3; ++i) {
                const double u = static_cast<double>(random_() % 4095 + 1) / 4096;
                p.c[i] = ExactRational::from_double(m.lo[i] + u * (m.hi[i] - m.lo[i]));
            }
            look_at(of_a ? p : moved(p, models_.poses.to_a));
        }
    }

    const PosedModels& models_;
    const std::vector<MeetingPair>& pairs_;
    const Pose& pose_a_;
    InterferenceCertificate& certificate_;
    std::mt19937 random_{1};
};

// A plane that no interior reaches beyond: those of faces in contact, and between edges.
std::optional<SeparatingPlane> touching_plane(const ProofBody& a, const ProofBody& b,
                                              const PosedModels& models,
                                              const std::vector<MeetingPair>& pairs) {
    std::vector<std::uint32_t> below(a.points.size());
    std::vector<std::uint32_t> above(b.points.size());
    std::iota(below.begin(), below.end(), 0U);
    std::iota(above.begin(), above.end(), 0U);
    std::size_t tried = 0;
    for (const MeetingPair& pair : pairs) {
        if (++tried > 64) break;
        const auto& s = models.a.triangles[pair.a];
        const auto& t = models.b.triangles[pair.b];
        for (const Vector& d : directions_of(a, {s.face, s.vertex}, b, {t.face, t.vertex}))
            for (const Vector& v : {d, opposite(d)})
                if (auto plane = plane_along(v, below, a, above, b, false)) return plane;
    }
    return std::nullopt;
}

std::vector<detail::ConvexPolygon> polygons_of(const ProofBody& placed) {
    std::vector<detail::ConvexPolygon> r;
    for (const CertifiedTriangle& t : placed.triangles) {
        detail::ConvexPolygon& p = r.emplace_back();
        for (const VertexId v : t.vertex) {
            const Vector& x = placed.points[v.index];
            p.push_back({detail::to_gmp(x[0]), detail::to_gmp(x[1]), detail::to_gmp(x[2])});
        }
    }
    return r;
}

// What follows from a partition of space.
class Cells {
public:
    Cells(const InterferenceModelData& a, const Pose& pose_a, const InterferenceModelData& b,
          const Pose& pose_b)
        : a_(a, pose_a), b_(b, pose_b), in_a_(a, pose_a), in_b_(b, pose_b) {}

    void prove(InterferenceCertificate& c) {
        detail::CellGoal goal;
        goal.a_outside_is_enough = c.relation != Relation::Contains;
        goal.a_inside_is_enough = c.relation == Relation::Contains;
        goal.b_outside_is_enough = c.relation != Relation::Inside;
        goal.b_inside_is_enough = c.relation == Relation::Inside;
        auto cells = proof(goal, {}).run(polygons_of(a_), polygons_of(b_));
        if (!cells) return;
        c.cells = std::move(*cells);
        c.triangles_a = std::move(a_.triangles);
        c.triangles_b = std::move(b_.triangles);
    }
    // Points inside and outside, where nothing else has found them.
    void find_points(InterferenceCertificate& c) {
        const auto note = [&c](const RationalPoint& p, bool in_a, bool in_b) {
            if (in_a && in_b && !c.in_both) c.in_both = p;
            if (in_a && !in_b && !c.only_in_a) c.only_in_a = p;
            if (!in_a && in_b && !c.only_in_b) c.only_in_b = p;
            const Relation r = c.relation;
            return (c.in_both || r != Relation::Overlapping) &&
                   (c.only_in_a || r == Relation::Inside) &&
                   (c.only_in_b || r == Relation::Contains);
        };
        (void)proof({}, note).run(polygons_of(a_), polygons_of(b_));
    }

private:
    detail::CellProof proof(const detail::CellGoal& goal, detail::CellProof::Visit visit) {
        return {[this](const Vector& p) { return in_a_.is_inside(p); },
                [this](const Vector& p) { return in_b_.is_inside(p); }, goal, std::move(visit)};
    }

    ProofBody a_;
    ProofBody b_;
    FromWorld in_a_;
    FromWorld in_b_;
};

// Points that are still missing, and the proof that one solid is within the other.
template <class MakeCells>
void complete(InterferenceCertificate& c, MakeCells&& cells) {
    if (c.is_complete) return;
    const auto has_points = [&c] {
        return (c.in_both || c.relation != Relation::Overlapping) &&
               (c.only_in_a || c.relation == Relation::Inside) &&
               (c.only_in_b || c.relation == Relation::Contains);
    };
    if (!has_points()) cells().find_points(c);
    if (c.relation != Relation::Overlapping) cells().prove(c);
    c.is_complete = has_points() && (c.relation == Relation::Overlapping || !c.cells.empty());
}

}  // namespace

InterferenceCertificate certify(const InterferenceModel& a, const Pose& pose_a,
                                const InterferenceModel& b, const Pose& pose_b) {
    InterferenceCertificate c;
    c.relation = interfere(a, pose_a, b, pose_b).relation;
    if (a.is_empty() || b.is_empty()) {
        c.is_complete = true;
        return c;
    }
    const PosedModels models{a.data(), b.data(),
                             detail::PosedPair(pose_a, a.lattice(), pose_b, b.lattice())};
    detail::BoundaryFlags flags;
    const std::vector<MeetingPair> pairs = meeting_pairs(models, true, flags);
    const auto note_common_point = [&] {
        for (const MeetingPair& pair : pairs)
            for (const auto& p : pair.contact.corners())
                if (!c.on_both && (!p.a.is_interior() || !p.b.is_interior()))
                    c.on_both = in_world(place_of(models, pair, p), a.lattice(), pose_a);
    };
    if (pairs.empty()) {
        ProofBody pa(a.data(), pose_a);
        ProofBody pb(b.data(), pose_b);
        if (auto tree = TreeBuilder(pa, pb).build()) {
            c.apart = std::move(*tree);
            c.triangles_a = std::move(pa.triangles);
            c.triangles_b = std::move(pb.triangles);
            c.is_complete = c.relation != Relation::Overlapping;
        }
    }
    switch (c.relation) {
        case Relation::Disjoint:
            break;
        case Relation::Touching: {
            note_common_point();
            c.plane = touching_plane(ProofBody(a.data(), pose_a), ProofBody(b.data(), pose_b),
                                     models, pairs);
            if (!c.plane) Cells(a.data(), pose_a, b.data(), pose_b).prove(c);
            c.is_complete = c.on_both && (c.plane || !c.cells.empty());
            break;
        }
        case Relation::Equal:
            note_common_point();
            c.is_complete = true;
            break;
        case Relation::Overlapping:
        case Relation::Inside:
        case Relation::Contains:
            PointFinder(models, pairs, pose_a, c).run();
            complete(c, [&] { return Cells(a.data(), pose_a, b.data(), pose_b); });
            break;
    }
    return c;
}

}  // namespace trisect
