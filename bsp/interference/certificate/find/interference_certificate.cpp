// SPDX-License-Identifier: Apache-2.0
//
// Finding certificates. Whatever is found here need not be right, it is what check_certificate
// accepts or not; so this part may guess. Planes are tried in doubles and taken when their margin
// is far above rounding, else in fractions; points are tried where contacts say that they must be.

#include <trisect/bsp/interference/interference_certificate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/interference/certificate/find/cell_proof.h>
#include <trisect/bsp/interference/certificate/find/from_world.h>
#include <trisect/bsp/interference/certificate/find/inside_points.h>
#include <trisect/bsp/interference/certificate/find/proof_body.h>
#include <trisect/bsp/interference/certificate/find/proof_tree.h>
#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>

namespace trisect {

using detail::FromWorld;
using detail::InterferenceModelData;
using detail::MeetingPair;
using detail::PosedModels;
using detail::ProofBody;

namespace {

using detail::cross;
using detail::dot;
using detail::minus;
using detail::proof::Approximate;
using detail::proof::exact;
using detail::proof::opposite;

// A plane with `below` strictly on its lower side and `above` on the upper one; or weakly, when
// that is enough.
std::optional<SeparatingPlane> plane_along(const ExactPoint& direction,
                                           std::span<const std::uint32_t> below, const ProofBody& a,
                                           std::span<const std::uint32_t> above, const ProofBody& b,
                                           bool strict) {
    const ExactRational highest = highest_along(direction, below, a);
    const ExactRational lowest = lowest_along(direction, above, b);
    if (strict ? !(highest < lowest) : lowest < highest) return std::nullopt;
    return SeparatingPlane{direction, -((highest + lowest) / ExactRational(2))};
}

// The directions of separating planes of two triangles or convex sets are among these.
std::vector<ExactPoint> directions_of(const ProofBody& a, const CertifiedTriangle& s,
                                      const ProofBody& b, const CertifiedTriangle& t) {
    const auto sides = [](const ProofBody& p, const CertifiedTriangle& x) {
        std::array<ExactPoint, 3> e;
        for (std::size_t i = 0; i < 3; ++i)
            e[i] = minus(p.points[x.vertex[(i + 1) % 3].index], p.points[x.vertex[i].index]);
        return e;
    };
    const auto u = sides(a, s);
    const auto v = sides(b, t);
    const ExactPoint n = cross(u[0], u[1]);
    const ExactPoint m = cross(v[0], v[1]);
    std::vector<ExactPoint> out{n, m};
    for (const ExactPoint& e : u)
        for (const ExactPoint& f : v) out.push_back(cross(e, f));
    for (const ExactPoint& e : u) out.push_back(cross(e, n));
    for (const ExactPoint& f : v) out.push_back(cross(f, m));
    std::erase_if(out, [](const ExactPoint& d) { return dot(d, d).sign() == 0; });
    return out;
}

// Planes with the triangles of ranges strictly on both sides.
class Separation {
public:
    Separation(const ProofBody& a, const ProofBody& b) : a_(a), b_(b) {}

    // Nothing when some triangles meet.
    std::optional<std::vector<ApartNode>> tree() {
        return detail::ProofTree<ApartNode, detail::NoTime, Separation>(*this, {}).build(
            {0, a_.triangles.size(), 0, b_.triangles.size(), {}, {}});
    }
    bool separate(const detail::ProofRange<>& r, ApartNode& node) const {
        const auto below = a_.corners(r.a0, r.a1);
        const auto above = b_.corners(r.b0, r.b1);
        auto plane =
            r.is_single() ? exact_plane(r.a0, r.b0, below, above) : quick_plane(below, above);
        if (plane) node.plane = std::move(*plane);
        return plane.has_value();
    }

private:
    std::optional<SeparatingPlane> exact_plane(std::size_t i, std::size_t j,
                                               std::span<const std::uint32_t> below,
                                               std::span<const std::uint32_t> above) const {
        for (const ExactPoint& d : directions_of(a_, a_.triangles[i], b_, b_.triangles[j]))
            for (const ExactPoint& v : {d, opposite(d)})
                if (auto plane = plane_along(v, below, a_, above, b_, true)) return plane;
        return std::nullopt;
    }
    // Axes and the line between the middles, when the gap is far above rounding.
    std::optional<SeparatingPlane> quick_plane(std::span<const std::uint32_t> below,
                                               std::span<const std::uint32_t> above) const {
        for (const Approximate& d :
             detail::proof_directions(minus(b_.middle(above), a_.middle(below)))) {
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
        for (const ExactPoint& d : directions_of(a, {s.face, s.vertex}, b, {t.face, t.vertex}))
            for (const ExactPoint& v : {d, opposite(d)})
                if (auto plane = plane_along(v, below, a, above, b, false)) return plane;
    }
    return std::nullopt;
}

std::vector<detail::ConvexPolygon> polygons_of(const ProofBody& placed) {
    std::vector<detail::ConvexPolygon> r;
    for (const CertifiedTriangle& t : placed.triangles) {
        detail::ConvexPolygon& p = r.emplace_back();
        for (const VertexId v : t.vertex) {
            const ExactPoint& x = placed.points[v.index];
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
        const auto note = [&c](const ExactPoint& p, bool in_a, bool in_b) {
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
        return {[this](const ExactPoint& p) { return in_a_.is_inside(p); },
                [this](const ExactPoint& p) { return in_b_.is_inside(p); }, goal, std::move(visit)};
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

InterferenceCertificate certify_relation(const InterferenceModel& a, const Pose& pose_a,
                                         const InterferenceModel& b, const Pose& pose_b) {
    InterferenceCertificate c;
    c.relation = interfere(a, pose_a, b, pose_b).relation;
    if (a.is_empty() || b.is_empty()) {
        c.is_complete = true;
        return c;
    }
    const PosedModels models{detail::data_of(a), detail::data_of(b),
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
        ProofBody pa(detail::data_of(a), pose_a);
        ProofBody pb(detail::data_of(b), pose_b);
        if (auto tree = Separation(pa, pb).tree()) {
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
            c.plane = touching_plane(ProofBody(detail::data_of(a), pose_a),
                                     ProofBody(detail::data_of(b), pose_b), models, pairs);
            if (!c.plane) Cells(detail::data_of(a), pose_a, detail::data_of(b), pose_b).prove(c);
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
            detail::find_inside_points(models, pairs, pose_a, c);
            complete(c,
                     [&] { return Cells(detail::data_of(a), pose_a, detail::data_of(b), pose_b); });
            break;
    }
    return c;
}

}  // namespace trisect
