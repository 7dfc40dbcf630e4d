// SPDX-License-Identifier: Apache-2.0
//
// Planes that solids slide along have no margin, so candidates come from features: faces of a part
// of A or of B's triangles, products of their edges, and of an edge and the way that B goes. In
// doubles most of them are seen to be wrong; the checker judges the others. Far from each other any
// plane with a gap will do.
//
// A convex part and a triangle that keep out of each other have a candidate between them at every
// moment. Where no candidate serves the whole time the one that serves longest from the beginning
// says where to split it; with simple numbers such times are simple fractions.

#include <trisect/bsp/interference/certificate/find/clearance_finder.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

namespace trisect::detail {

using namespace proof;

namespace {

constexpr int most_clearance_levels = 120;
constexpr std::size_t few_triangles = 40;
constexpr double tolerance = 0x1p-30;  // of doubles, in front of exact tests

std::vector<double> coefficients(const certified::Polynomial& p) {
    std::vector<double> r;
    for (std::size_t i = 0; !p.is_zero() && i <= p.degree(); ++i)
        r.push_back(p.coefficient(i).to_double());
    return r;
}
double value(const std::vector<double>& p, double s) {
    double r = 0;
    for (std::size_t i = p.size(); i-- > 0;) r = r * s + p[i];
    return r;
}

struct PointExtent {
    Approximate lo{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Approximate hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    void add(const Approximate& x) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], x[k]);
            hi[k] = std::max(hi[k], x[k]);
        }
    }
    [[nodiscard]] double size() const { return length(minus(hi, lo)); }
    [[nodiscard]] Approximate middle() const {
        return {lo[0] + (hi[0] - lo[0]) / 2, lo[1] + (hi[1] - lo[1]) / 2,
                lo[2] + (hi[2] - lo[2]) / 2};
    }
};

PointExtent extent_of(const std::vector<Approximate>& points) {
    PointExtent r;
    for (const Approximate& x : points) r.add(x);
    return r;
}

// Directions that were there already, of either sense, are left out.
class Directions {
public:
    bool is_new(const Approximate& d) {
        const double size = length(d);
        if (!(size > 0) || !std::isfinite(size)) return false;
        std::array<long, 3> key{};
        for (std::size_t k = 0; k < 3; ++k) key[k] = std::lround(d[k] / size * 0x1p26);
        if (key < std::array<long, 3>{}) key = {-key[0], -key[1], -key[2]};
        return seen_.insert(key).second;
    }

private:
    std::set<std::array<long, 3>> seen_;
};

// Integers without a common factor, which keeps numbers short.
ExactPoint shortened(const ExactPoint& v) {
    const certified::IntegerPoint p(v);
    const mpz_class common = gcd(gcd(p.x[0], p.x[1]), p.x[2]);
    if (sgn(common) == 0) return v;
    ExactPoint r;
    for (std::size_t k = 0; k < 3; ++k) r[k] = from_gmp(mpq_class(mpz_class(p.x[k] / common)));
    return r;
}

}  // namespace

ExactRational simplest_fraction(double low, double high) {
    const double whole = std::floor(low);
    if (whole == low || whole + 1 <= high)
        return ExactRational::from_double(whole == low ? whole : whole + 1);
    return ExactRational::from_double(whole) +
           ExactRational(1) / simplest_fraction(1 / (high - whole), 1 / (low - whole));
}

// ---------------------------------------------------------------- doubles

ClearanceFinder::ApproximatePiece::ApproximatePiece(const certified::Piece& piece)
    : w(coefficients(piece.w)) {
    for (std::size_t i = 0; i < 3; ++i) {
        t[i] = coefficients(piece.t[i]);
        for (std::size_t j = 0; j < 3; ++j) m[i][j] = coefficients(piece.m[i][j]);
    }
}

ClearanceFinder::Map ClearanceFinder::ApproximatePiece::at(double s) const {
    Map r;
    const double weight = value(w, s);
    for (std::size_t i = 0; i < 3; ++i) {
        r.t[i] = value(t[i], s) / weight;
        for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = value(m[i][j], s) / weight;
    }
    return r;
}

Approximate ClearanceFinder::Map::direction(const Approximate& v) const {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
Approximate ClearanceFinder::Map::point(const Approximate& x) const {
    const Approximate v = direction(x);
    return {v[0] + t[0], v[1] + t[1], v[2] + t[2]};
}

ClearanceFinder::Corners ClearanceFinder::corners_of(const Range& r) const {
    Corners c;
    for (const certified::IntegerPoint& p : r.part->points())
        c.of_a.push_back(approximate(p.rational()));
    c.b = b_.corners(r.b0, r.b1);
    for (const std::uint32_t v : c.b) c.of_b.push_back(b_.near[v]);
    c.size_a = extent_of(c.of_a).size();
    c.size_b = extent_of(c.of_b).size();
    return c;
}

// Farther than half of what is larger.
bool ClearanceFinder::moves_far(const Corners& c, const std::vector<Moment>& when) {
    double way = 0;
    for (const Approximate& x : {c.of_b.front(), c.of_b.back()})
        way = std::max(way, length(minus(when.back().to_a.point(x), when.front().to_a.point(x))));
    return way > 0.5 * std::max(c.size_a, c.size_b);
}

// ---------------------------------------------------------------- the tree

ClearanceFinder::ClearanceFinder(certified::Clearance& clearance, const ProofBody& b,
                                 std::size_t limit)
    : clearance_(clearance),
      b_(b),
      approximate_a_(clearance.to_a()),
      approximate_b_(clearance.to_b()),
      limit_(limit) {}

std::optional<std::vector<ClearanceNode>> ClearanceFinder::find(
    std::shared_ptr<const certified::Part> whole) {
    nodes_.clear();
    failure_.clear();
    if (!add({std::move(whole), 0, b_.triangles.size(), ExactRational(), clearance_.end()}, 0))
        return std::nullopt;
    return std::move(nodes_);
}

bool ClearanceFinder::add(const Range& r, int depth) {
    if (nodes_.size() >= limit_ || depth > most_clearance_levels) {
        failure_ =
            nodes_.size() >= limit_
                ? "the limit of nodes"
                : "planes between a part and a triangle change at times that are no fractions";
        return false;
    }
    const std::size_t node = nodes_.size();
    nodes_.emplace_back();
    if (r.part->points().empty()) return true;
    const Corners c = corners_of(r);
    const double from = r.from.to_double();
    const double to = r.to.to_double();
    std::vector<Moment> when;
    for (int i = 0; i <= 4; ++i) when.push_back(at(from + (to - from) * i / 4));
    if (auto plane = plane_with_a_gap(r, c, when)) {
        nodes_[node].plane = std::move(*plane);
        return true;
    }
    ClearanceNode how;
    const auto halve_time = [&] {
        how.kind = ClearanceNode::Kind::SplitTime;
        how.time = ExactRational::from_double(from + (to - from) / 2);
        return r.from < how.time && how.time < r.to;
    };
    if (moves_far(c, when) && halve_time()) return split(node, r, how, depth);
    std::vector<Candidate> all = candidates(r, c);
    const bool single = r.b1 - r.b0 == 1;
    const auto tries = [&](std::vector<Candidate>& these) {
        for (Candidate& candidate : these) {
            if (!std::ranges::all_of(
                    when, [&](const Moment& m) { return is_plausible(candidate, c, m); }))
                continue;
            complete(candidate, r, c);
            if (!clearance_.are_apart(r, c.b, candidate.plane)) continue;
            nodes_[node].plane = std::move(candidate.plane);
            return true;
        }
        return false;
    };
    if (tries(all)) return true;
    if (!single && (c.size_b >= c.size_a || r.part->triangles().size() <= few_triangles)) {
        how.kind = ClearanceNode::Kind::SplitB;
        return split(node, r, how, depth);
    }
    if (auto cut = plane_to_divide(r, c)) {
        how.kind = ClearanceNode::Kind::SplitA;
        how.cut = std::move(*cut);
        return split(node, r, how, depth);
    }
    if (!single) {
        how.kind = ClearanceNode::Kind::SplitB;
        return split(node, r, how, depth);
    }
    std::vector<Candidate> sliding;
    add_sliding(r, c, sliding);
    if (tries(sliding)) return true;
    all.insert(all.end(), sliding.begin(), sliding.end());
    how.kind = ClearanceNode::Kind::SplitTime;
    if (auto time = time_to_split(r, c, all))
        how.time = std::move(*time);
    else if (!halve_time()) {
        failure_ = "no plane keeps a part and a triangle apart";
        return false;
    }
    return split(node, r, how, depth);
}

bool ClearanceFinder::split(std::size_t at, const Range& r, const ClearanceNode& node, int depth) {
    nodes_[at] = node;
    Range first;
    Range second;
    if (!r.divide(node, first, second).empty()) return false;
    if (!add(first, depth + 1)) return false;
    nodes_[at].other = static_cast<std::uint32_t>(nodes_.size());
    return add(second, depth + 1);
}

// ---------------------------------------------------------------- planes

std::optional<SupportingPlane> ClearanceFinder::plane_with_a_gap(const Range& r, const Corners& c,
                                                                 const std::vector<Moment>& when) {
    std::vector<Approximate> moved;
    for (const Moment& m : when)
        for (const Approximate& x : c.of_b) moved.push_back(m.to_a.point(x));
    const Approximate from = extent_of(c.of_a).middle();
    const Approximate to = extent_of(moved).middle();
    for (const Approximate& d :
         {minus(to, from), Approximate{1, 0, 0}, Approximate{0, 1, 0}, Approximate{0, 0, 1},
          Approximate{-1, 0, 0}, Approximate{0, -1, 0}, Approximate{0, 0, -1}}) {
        double highest = -HUGE_VAL;
        double lowest = HUGE_VAL;
        for (const Approximate& x : c.of_a) highest = std::max(highest, dot(d, x));
        for (const Approximate& x : moved) lowest = std::min(lowest, dot(d, x));
        if (!(lowest - highest > tolerance * length(d) * (c.size_a + c.size_b))) continue;
        SupportingPlane plane;
        plane.plane = {exact(d), -ExactRational::from_double(highest + (lowest - highest) / 2)};
        if (clearance_.are_apart(r, c.b, plane)) return plane;
    }
    return std::nullopt;
}

std::vector<ClearanceFinder::Candidate> ClearanceFinder::candidates(const Range& r,
                                                                    const Corners& c) const {
    using Kind = SupportingPlane::Kind;
    std::vector<Candidate> all;
    if (r.part->triangles().size() > 2 * few_triangles || r.b1 - r.b0 > 2 * few_triangles)
        return all;
    const auto& points = r.part->points();
    const auto add = [&all](Kind kind, const ExactPoint& normal) {
        for (const ExactPoint& n : {normal, opposite(normal)}) {
            Candidate& x = all.emplace_back();
            x.plane.kind = kind;
            x.plane.plane.normal = n;
            x.normal = approximate(n);
        }
    };
    Directions faces_a;
    for (const auto& t : r.part->triangles())
        if (faces_a.is_new(
                cross(minus(c.of_a[t[1]], c.of_a[t[0]]), minus(c.of_a[t[2]], c.of_a[t[0]]))))
            add(Kind::OfA,
                shortened(cross(minus(points[t[1]].rational(), points[t[0]].rational()),
                                minus(points[t[2]].rational(), points[t[0]].rational()))));
    Directions faces_b;
    for (std::size_t i = r.b0; i < r.b1; ++i) {
        const auto& v = b_.triangles[i].vertex;
        const ExactPoint n = cross(minus(b_.points[v[1].index], b_.points[v[0].index]),
                                   minus(b_.points[v[2].index], b_.points[v[0].index]));
        if (faces_b.is_new(approximate(n))) add(Kind::OfB, shortened(n));
    }
    if (r.b1 - r.b0 > 1) return all;
    const auto& v = b_.triangles[r.b0].vertex;
    Directions edges_a;
    for (const auto& t : r.part->triangles())
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = t[i];
            const std::uint32_t q = t[(i + 1) % 3];
            if (!edges_a.is_new(minus(c.of_a[q], c.of_a[p]))) continue;
            const ExactPoint u = shortened(minus(points[q].rational(), points[p].rational()));
            for (std::size_t j = 0; j < 3; ++j) {
                const ExactPoint w =
                    shortened(minus(b_.points[v[(j + 1) % 3].index], b_.points[v[j].index]));
                for (const ExactPoint& along : {u, opposite(u)}) {
                    Candidate& x = all.emplace_back();
                    x.plane.kind = Kind::Edges;
                    x.plane.along_a = along;
                    x.plane.along_b = w;
                    x.along_a = approximate(along);
                    x.along_b = approximate(w);
                }
            }
        }
    return all;
}

// Planes along an edge and the way that B goes, which rest in A: a corner that passes over an edge.
void ClearanceFinder::add_sliding(const Range& r, const Corners& c,
                                  std::vector<Candidate>& all) const {
    const certified::Piece& to_a = clearance_.to_a();
    const auto place = [&to_a](const ExactPoint& x, const ExactRational& s) {
        ExactPoint y;
        const ExactRational w = to_a.w.value_at(s);
        const certified::PolynomialVector p = to_a.point(x);
        for (std::size_t k = 0; k < 3; ++k) y[k] = p[k].value_at(s) / w;
        return y;
    };
    std::array<ExactPoint, 3> at_first;
    std::array<ExactPoint, 3> at_last;
    for (std::size_t i = 0; i < 3; ++i) {
        const ExactPoint& x = b_.points[b_.triangles[r.b0].vertex[i].index];
        at_first[i] = place(x, r.from);
        at_last[i] = place(x, r.to);
    }
    std::vector<ExactPoint> along;
    Directions edges;
    const auto& points = r.part->points();
    for (const auto& t : r.part->triangles())
        for (std::size_t i = 0; i < 3; ++i)
            if (edges.is_new(minus(c.of_a[t[(i + 1) % 3]], c.of_a[t[i]])))
                along.push_back(minus(points[t[(i + 1) % 3]].rational(), points[t[i]].rational()));
    for (std::size_t i = 0; i < 3; ++i) along.push_back(minus(at_first[(i + 1) % 3], at_first[i]));
    Directions normals;
    for (std::size_t i = 0; i < 3; ++i) {
        const ExactPoint way = minus(at_last[i], at_first[i]);
        for (const ExactPoint& u : along) {
            const ExactPoint n = cross(u, way);
            if (!normals.is_new(approximate(n))) continue;
            const ExactPoint s = shortened(n);
            for (const ExactPoint& m : {s, opposite(s)}) {
                Candidate& x = all.emplace_back();
                x.plane.plane.normal = m;
                x.normal = approximate(m);
            }
        }
    }
}

// What doubles say of a moment.
bool ClearanceFinder::is_plausible(const Candidate& x, const Corners& c, const Moment& when) {
    using Kind = SupportingPlane::Kind;
    double highest = -HUGE_VAL;  // of A
    double lowest = HUGE_VAL;    // of B
    Approximate n = x.normal;
    if (x.plane.kind == Kind::OfB) {
        for (const Approximate& y : c.of_b) lowest = std::min(lowest, dot(n, y));
        for (const Approximate& y : c.of_a) highest = std::max(highest, dot(n, when.to_b.point(y)));
    } else {
        if (x.plane.kind == Kind::Edges) n = cross(x.along_a, when.to_a.direction(x.along_b));
        for (const Approximate& y : c.of_a) highest = std::max(highest, dot(n, y));
        for (const Approximate& y : c.of_b) lowest = std::min(lowest, dot(n, when.to_a.point(y)));
    }
    const double size = length(n);
    return size > 0 && lowest - highest >= -tolerance * size * (c.size_a + c.size_b);
}

// The offset, as tight as possible, in fractions; or a point of A that is highest all the time.
void ClearanceFinder::complete(Candidate& x, const Range& r, const Corners& c) const {
    using Kind = SupportingPlane::Kind;
    const auto& points = r.part->points();
    const ExactPoint& n = x.plane.plane.normal;
    if (x.plane.kind == Kind::OfA) {
        ExactRational highest = dot(n, points.front().rational());
        for (const certified::IntegerPoint& p : points)
            highest = std::max(highest, dot(n, p.rational()));
        x.plane.plane.offset = -highest;
    } else if (x.plane.kind == Kind::OfB) {
        ExactRational lowest = dot(n, b_.points[c.b.front()]);
        for (const std::uint32_t v : c.b) lowest = std::min(lowest, dot(n, b_.points[v]));
        x.plane.plane.offset = -lowest;
    } else {
        const double from = r.from.to_double();
        const Moment middle = at(from + (r.to.to_double() - from) / 2);
        const Approximate m = cross(x.along_a, middle.to_a.direction(x.along_b));
        std::size_t best = 0;
        for (std::size_t i = 0; i < c.of_a.size(); ++i)
            if (dot(m, c.of_a[i]) > dot(m, c.of_a[best])) best = i;
        x.plane.through = points[best].rational();
    }
}

// ---------------------------------------------------------------- where to split

std::optional<ExactRational> ClearanceFinder::time_to_split(
    const Range& r, const Corners& c, const std::vector<Candidate>& all) const {
    const double from = r.from.to_double();
    const double to = r.to.to_double();
    double last = from;
    for (const Candidate& x : all) {
        const auto holds = [&](double s) { return is_plausible(x, c, at(s)); };
        if (!holds(from)) continue;
        double good = from;
        double bad = to;
        for (int i = 1; i <= 16; ++i) {
            const double s = from + (to - from) * i / 16;
            if (!holds(s)) {
                bad = s;
                break;
            }
            good = s;
        }
        for (int i = 0; i < 50 && good < bad; ++i) {
            const double s = good + (bad - good) / 2;
            if (s == good || s == bad) break;
            (holds(s) ? good : bad) = s;
        }
        last = std::max(last, good);
    }
    // Not where the range begins or ends, where nothing would be gained.
    if (!(last > from + 0x1p-30 * (to - from)) || !(last < to - 0x1p-30 * (to - from)))
        return std::nullopt;
    const double margin = std::min(0x1p-24, 0x1p-6 * (to - from));
    ExactRational time = simplest_fraction(last - margin, last + 0x1p-8 * margin);
    if (!(r.from < time) || !(time < r.to)) return std::nullopt;
    return time;
}

// A face's plane that divides few triangles; through the middle where there are many.
std::optional<SeparatingPlane> ClearanceFinder::plane_to_divide(const Range& r,
                                                                const Corners& c) const {
    const auto& triangles = r.part->triangles();
    const auto& points = r.part->points();
    if (triangles.size() > 2 * few_triangles) {
        const PointExtent e = extent_of(c.of_a);
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (e.hi[k] - e.lo[k] > e.hi[axis] - e.lo[axis]) axis = k;
        SeparatingPlane plane;
        plane.normal[axis] = ExactRational(1);
        const double unit = std::ldexp(1., std::ilogb(e.hi[axis] - e.lo[axis]) - 8);
        plane.offset = ExactRational::from_double(-std::round(e.middle()[axis] / unit) * unit);
        return plane;
    }
    long least = std::numeric_limits<long>::max();
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& t = triangles[i];
        const Approximate n =
            cross(minus(c.of_a[t[1]], c.of_a[t[0]]), minus(c.of_a[t[2]], c.of_a[t[0]]));
        const double size = length(n) * c.size_a * tolerance;
        if (!(size > 0)) continue;
        std::vector<int> side;
        for (const Approximate& x : c.of_a) {
            const double h = dot(n, minus(x, c.of_a[t[0]]));
            side.push_back(h > size ? 1 : h < -size ? -1 : 0);
        }
        if (std::ranges::find(side, 1) == side.end() || std::ranges::find(side, -1) == side.end())
            continue;
        long below = 0;
        long above = 0;
        for (const auto& u : triangles) {
            below += std::ranges::any_of(u, [&](std::uint32_t v) { return side[v] < 0; }) ? 1 : 0;
            above += std::ranges::any_of(u, [&](std::uint32_t v) { return side[v] > 0; }) ? 1 : 0;
        }
        const long cost = 2 * (below + above) + std::abs(below - above);
        if (cost >= least) continue;
        least = cost;
        best = i;
    }
    if (!best) return std::nullopt;
    const auto& t = triangles[*best];
    const ExactPoint p = points[t[0]].rational();
    const ExactPoint n =
        shortened(cross(minus(points[t[1]].rational(), p), minus(points[t[2]].rational(), p)));
    return SeparatingPlane{n, -dot(n, p)};
}

}  // namespace trisect::detail
