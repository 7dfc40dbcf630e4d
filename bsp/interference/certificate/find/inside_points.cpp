// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/find/inside_points.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>

#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::detail {

namespace {

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
        return model.model.index().locate(x).location;
    }
    static ExactPlace shifted(const ExactPlace& p, const ExactPoint& by,
                              const ExactRational& factor) {
        ExactPlace r;
        for (std::size_t k = 0; k < 3; ++k) r.c[k] = p.c[k] + factor * by[k];
        return r;
    }
    // The number of the size of v, as a power of two.
    static int magnitude(const ExactPoint& v) {
        double m = 0;
        for (const ExactRational& x : v) m = std::max(m, std::abs(x.to_double()));
        return m == 0 ? 0 : std::ilogb(m);
    }

    static ExactPoint of_size_one(ExactPoint v) {
        const int size = magnitude(v);
        for (ExactRational& x : v) x = x.scaled(-size);
        return v;
    }

    // Beside the middle of the segment in which two faces cross, in the quadrants between them.
    void try_beside_crossing(const MeetingPair& pair) {
        const auto& c = pair.contact;
        const ExactPlace p = place_of(models_, pair, c.points[0]);
        const ExactPlace q = place_of(models_, pair, c.points[1]);
        const ExactPoint along = minus(q.c, p.c);
        const ExactPlace middle = shifted(p, along, ExactRational(1) / ExactRational(2));
        // Of one size, or the point would be much nearer to one of the faces.
        const ExactPoint n =
            of_size_one(normal(models_.a.brep.plane(models_.a.triangles[pair.a].face)));
        const ExactPoint m =
            of_size_one(normal_of_b(models_.b.brep.plane(models_.b.triangles[pair.b].face)));
        // d = x n + y m with d·n = s n·n and d·m = t m·m, by Cramer's rule without the division.
        const ExactRational nn = dot(n, n);
        const ExactRational nm = dot(n, m);
        const ExactRational mm = dot(m, m);
        for (const auto& [s, t] : {std::pair{-1, -1}, std::pair{-1, 1}, std::pair{1, -1}}) {
            const ExactRational x = ExactRational(s) * nn * mm - ExactRational(t) * mm * nm;
            const ExactRational y = ExactRational(t) * mm * nn - ExactRational(s) * nn * nm;
            ExactPoint d;
            for (std::size_t k = 0; k < 3; ++k) d[k] = x * n[k] + y * m[k];
            const int start = magnitude(along) - magnitude(d);
            for (int k = 0; k < 12; ++k)
                look_at(shifted(middle, d, ExactRational(1).scaled(start - 3 * k)));
        }
    }
    static ExactPoint normal(const Plane& plane) {
        return {ExactRational(plane.normal(0)), ExactRational(plane.normal(1)),
                ExactRational(plane.normal(2))};
    }
    // Seen in A's lattice: the transposed map from A to B.
    [[nodiscard]] ExactPoint normal_of_b(const Plane& plane) const {
        const ExactPlace origin = moved(ExactPlace{}, models_.poses.to_b);
        const ExactPoint n = normal(plane);
        ExactPoint r;
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
            ExactPoint d;
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

}  // namespace

void find_inside_points(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                        const Pose& pose_a, InterferenceCertificate& certificate) {
    PointFinder(models, pairs, pose_a, certificate).run();
}

}  // namespace trisect::detail
