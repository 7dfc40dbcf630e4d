// SPDX-License-Identifier: Apache-2.0
//
// A binary partition of space (Fuchs, Kedem and Naylor 1980) used as a proof. Open cells and the
// planes between them fill space, so what holds for open sets in every cell holds everywhere. Where
// many pieces are left, axis-perpendicular planes separate them; few are separated by the planes of
// pieces, each of which takes its own piece out of both sides. That ends, because every piece lies
// in one of finitely many planes; planes that split little and keep A's pieces from B's come first.
//
// Every cell has a point: a cell is divided by a plane that has points of the cell on both sides,
// and a point of each side is made of the cell's point and of the middle of a piece, which is in
// the open cell too.

#include <trisect/bsp/interference/certificate/find/cell_proof.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/brep/number/gmp_conversion.h>

namespace trisect::detail {

namespace {

constexpr std::size_t few_pieces = 12;
constexpr std::size_t most_candidates = 24;
constexpr int most_cell_levels = 2000;

GmpVector middle_of(const ConvexPolygon& p) {
    GmpVector sum;
    for (const GmpVector& v : p)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += v[k];
    for (mpq_class& c : sum) c /= static_cast<unsigned long>(p.size());
    return sum;
}

struct GmpPlane {
    GmpVector normal;
    mpq_class offset;

    [[nodiscard]] int sign_at(const GmpVector& p) const {
        return sgn(mpq_class(dot(normal, p) + offset));
    }
};

// Without common factors: numbers stay short.
GmpPlane plane_of(const ConvexPolygon& p) {
    GmpVector n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    std::vector<mpq_class> values(n.begin(), n.end());
    mpz_class denominator;
    const std::vector<mpz_class> c = common_numerators(values, denominator);
    mpz_class common = gcd(gcd(c[0], c[1]), c[2]);
    for (std::size_t k = 0; k < 3; ++k) n[k] = mpz_class(c[k] / common);
    return {n, -dot(n, p[0])};
}

// -1 or 1: on one side; 0: in the plane; 2: on both sides.
int side_of(const ConvexPolygon& p, const GmpPlane& plane) {
    bool below = false;
    bool above = false;
    for (const GmpVector& v : p) {
        const int s = plane.sign_at(v);
        below = below || s < 0;
        above = above || s > 0;
    }
    return below ? (above ? 2 : -1) : (above ? 1 : 0);
}

ConvexPolygon clipped(const ConvexPolygon& p, const GmpPlane& plane, int side) {
    ConvexPolygon r;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const GmpVector& u = p[i];
        const GmpVector& v = p[(i + 1) % p.size()];
        const mpq_class du = dot(plane.normal, u) + plane.offset;
        const mpq_class dv = dot(plane.normal, v) + plane.offset;
        if (sgn(du) * side >= 0) r.push_back(u);
        if (sgn(du) * sgn(dv) >= 0) continue;
        const mpq_class t = du / (du - dv);
        GmpVector x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = u[k] + t * (v[k] - u[k]);
        r.push_back(std::move(x));
    }
    return r;
}

std::vector<ConvexPolygon> part(const std::vector<ConvexPolygon>& polygons, const GmpPlane& plane,
                                int side) {
    std::vector<ConvexPolygon> r;
    for (const ConvexPolygon& p : polygons) {
        const int s = side_of(p, plane);
        if (s == side)
            r.push_back(p);
        else if (s == 2)
            r.push_back(clipped(p, plane, side));
    }
    return r;
}

struct PolygonExtent {
    std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    std::array<double, 3> hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    explicit PolygonExtent(const std::vector<ConvexPolygon>& polygons) {
        for (const ConvexPolygon& p : polygons)
            for (const GmpVector& v : p)
                for (std::size_t k = 0; k < 3; ++k) {
                    lo[k] = std::min(lo[k], v[k].get_d());
                    hi[k] = std::max(hi[k], v[k].get_d());
                }
    }
};

GmpPlane across(std::size_t axis, double at) {
    GmpPlane r;
    r.normal[axis] = 1;
    r.offset = -mpq_class(at);
    return r;
}

// The double with the fewest digits near the middle of an interval.
double short_between(double low, double high) {
    const double unit = std::ldexp(1., std::ilogb(high - low) - 2);
    const double r = std::round((low + high) / 2 / unit) * unit;
    return low < r && r < high ? r : (low + high) / 2;
}

// Through a gap between the two boxes, or the middle of what they have in common. It may fail to
// part anything.
std::optional<GmpPlane> plane_across_an_axis(const std::vector<ConvexPolygon>& a,
                                             const std::vector<ConvexPolygon>& b) {
    const PolygonExtent ea(a);
    const PolygonExtent eb(b);
    std::size_t axis = 0;
    double longest = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = std::max(ea.lo[k], eb.lo[k]);
        const double high = std::min(ea.hi[k], eb.hi[k]);
        if (high < low) return across(k, short_between(high, low));
        if (high - low > longest) {
            longest = high - low;
            axis = k;
        }
    }
    if (!(longest > 0)) return std::nullopt;
    return across(axis, short_between(std::max(ea.lo[axis], eb.lo[axis]),
                                      std::min(ea.hi[axis], eb.hi[axis])));
}

// How bad it is to divide by a plane.
long cost_of(const GmpPlane& plane, const std::vector<ConvexPolygon>& a,
             const std::vector<ConvexPolygon>& b) {
    // [below, above] of each.
    std::array<long, 2> na{};
    std::array<long, 2> nb{};
    long splits = 0;
    const auto count = [&](const std::vector<ConvexPolygon>& polygons, std::array<long, 2>& n) {
        for (const ConvexPolygon& p : polygons) {
            const int s = side_of(p, plane);
            splits += s == 2 ? 1 : 0;
            n[0] += s == -1 || s == 2 ? 1 : 0;
            n[1] += s == 1 || s == 2 ? 1 : 0;
        }
    };
    count(a, na);
    count(b, nb);
    // Pairs that are still together on some side.
    return 4 * (na[0] * nb[0] + na[1] * nb[1]) + splits;
}

GmpPlane best_plane(const std::vector<ConvexPolygon>& a, const std::vector<ConvexPolygon>& b) {
    GmpPlane best = plane_of(a.front());
    long least = std::numeric_limits<long>::max();
    for (const auto* polygons : {&a, &b})
        for (std::size_t i = 0; i < std::min(polygons->size(), most_candidates); ++i) {
            const GmpPlane plane = plane_of((*polygons)[i]);
            const long cost = cost_of(plane, a, b);
            if (cost >= least) continue;
            least = cost;
            best = plane;
        }
    return best;
}

// Whether dividing by it leaves less on both sides.
bool parts(const GmpPlane& plane, const std::vector<ConvexPolygon>& a,
           const std::vector<ConvexPolygon>& b) {
    bool below = false;
    bool above = false;
    for (const auto* polygons : {&a, &b})
        for (const ConvexPolygon& p : *polygons) {
            const int s = side_of(p, plane);
            below = below || s == -1;
            above = above || s == 1;
        }
    return below && above;
}

}  // namespace

std::optional<std::vector<CertifiedCell>> CellProof::run(Polygons a, Polygons b) {
    cells_.clear();
    path_.clear();
    // Any point that is on no boundary will do; it is replaced on first use.
    const GmpVector point = a.empty() ? GmpVector{} : middle_of(a.front());
    if (divide(a, b, point, 0) != Progress::Done) return std::nullopt;
    return std::move(cells_);
}

std::optional<CertifiedCell::Kind> CellProof::verdict(const Polygons& a, const Polygons& b,
                                                      const GmpVector& point) {
    const ExactPoint p = rational(point);
    if (visit_) {
        if (!a.empty() || !b.empty()) return std::nullopt;
        stopped_ = visit_(p, in_a_(p), in_b_(p));
        return CertifiedCell::Kind::WithoutA;
    }
    if (a.empty() && (in_a_(p) ? goal_.a_inside_is_enough : goal_.a_outside_is_enough))
        return CertifiedCell::Kind::WithoutA;
    if (b.empty() && (in_b_(p) ? goal_.b_inside_is_enough : goal_.b_outside_is_enough))
        return CertifiedCell::Kind::WithoutB;
    return std::nullopt;
}

CellProof::Progress CellProof::divide(const Polygons& a, const Polygons& b, const GmpVector& point,
                                      int depth) {
    if (cells_.size() >= goal_.limit || depth > most_cell_levels) return Progress::Failed;
    const std::size_t at = cells_.size();
    cells_.emplace_back();
    if (a.empty() || b.empty()) {
        if (const auto kind = verdict(a, b, point)) {
            cells_[at].kind = *kind;
            cells_[at].point = rational(point);
            return stopped_ ? Progress::Stopped : Progress::Done;
        }
        // One boundary alone, or none: only a search for points goes on.
        if (!visit_ || (a.empty() && b.empty())) return Progress::Failed;
    }
    GmpPlane plane;
    const std::optional<GmpPlane> axis =
        a.size() + b.size() > few_pieces && !a.empty() && !b.empty() ? plane_across_an_axis(a, b)
                                                                     : std::nullopt;
    if (axis && parts(*axis, a, b))
        plane = *axis;
    else
        plane = a.empty()   ? plane_of(b.front())
                : b.empty() ? plane_of(a.front())
                            : best_plane(a, b);
    cells_[at].kind = CertifiedCell::Kind::Split;
    cells_[at].plane = {rational(plane.normal), from_gmp(plane.offset)};
    path_.push_back({plane.normal, plane.offset, 0});
    for (const int side : {-1, 1}) {
        if (side == 1) cells_[at].other = static_cast<std::uint32_t>(cells_.size());
        path_.back().side = 0;  // the point may be on either side of the new plane
        const GmpVector p = point_beside(path_.back(), a, b, point, side);
        path_.back().side = side;
        const Progress progress = divide(part(a, plane, side), part(b, plane, side), p, depth + 1);
        if (progress != Progress::Done) return progress;
    }
    path_.pop_back();
    return Progress::Done;
}

bool CellProof::is_within(const GmpVector& p) const {
    return std::ranges::all_of(path_, [&p](const Bound& b) {
        return b.side == 0 || sgn(mpq_class(dot(b.normal, p) + b.offset)) == b.side;
    });
}

GmpVector CellProof::point_beside(const Bound& cut, const Polygons& a, const Polygons& b,
                                  const GmpVector& point, int side) const {
    const auto sign_at = [&cut](const GmpVector& p) {
        return sgn(mpq_class(dot(cut.normal, p) + cut.offset));
    };
    // The middle of a piece is no good itself where the piece is the boundary of a later query: it
    // is moved towards the cell's point. So is the point itself when it is in the plane.
    const auto near = [&](const GmpVector& from, const GmpVector& direction) {
        mpq_class step = 1;
        for (;;) {
            step /= 4;
            GmpVector p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = from[k] + step * direction[k];
            if (sign_at(p) == side && is_within(p)) return p;
        }
    };
    if (sign_at(point) == side) return point;
    for (const auto* polygons : {&a, &b})
        for (const ConvexPolygon& polygon : *polygons) {
            const GmpVector m = middle_of(polygon);
            if (sign_at(m) == side) return m;
            if (sign_at(m) == 0 && sign_at(point) == -side) return near(m, minus(m, point));
        }
    GmpVector away = cut.normal;
    if (side < 0)
        for (mpq_class& c : away) c = -c;
    return near(point, away);
}

}  // namespace trisect::detail
