// SPDX-License-Identifier: Apache-2.0

#include "query_oracle.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "reference/vector.h"

namespace brute {

using reference::cross;
using reference::dot;
using reference::subtracted;
using trisect::FaceSource;
using trisect::Location;

namespace {

Rational value(const Polygon& g, const Point3& p) {
    return Rational(g.normal[0]) * p[0] + Rational(g.normal[1]) * p[1] +
           Rational(g.normal[2]) * p[2] + Rational(g.offset);
}
Rational slope(const Polygon& g, const Point3& d) {
    return Rational(g.normal[0]) * d[0] + Rational(g.normal[1]) * d[1] +
           Rational(g.normal[2]) * d[2];
}
Point3 normal(const Polygon& g) {
    return {Rational(g.normal[0]), Rational(g.normal[1]), Rational(g.normal[2])};
}

// On which side of edge i a point of the plane is: positive inside.
Rational edge_value(const Polygon& g, std::size_t i, const Point3& p) {
    const Point3& a = g.corners[i];
    const Point3& b = g.corners[(i + 1) % g.corners.size()];
    return dot(cross(subtracted(b, a), subtracted(p, a)), normal(g));
}

bool contains(const Polygon& g, const Point3& p) {
    for (std::size_t k = 0; k < 3; ++k)
        if (p[k] < Rational(g.lo[k]) || p[k] > Rational(g.hi[k])) return false;
    if (value(g, p) != 0) return false;
    for (std::size_t i = 0; i < g.corners.size(); ++i)
        if (edge_value(g, i, p) < 0) return false;
    return true;
}

// Gaussian elimination would do; three normals need less.
bool independent(const std::vector<const Polygon*>& chosen, const Polygon& g) {
    if (chosen.empty()) return true;
    const Point3 a = normal(*chosen[0]);
    if (chosen.size() == 1) {
        const Point3 c = cross(a, normal(g));
        return c[0] != 0 || c[1] != 0 || c[2] != 0;
    }
    if (chosen.size() == 2) return dot(cross(a, normal(*chosen[1])), normal(g)) != 0;
    return false;
}

double below(const Rational& v) { return std::nextafter(v.get_d(), -HUGE_VAL); }
double above(const Rational& v) { return std::nextafter(v.get_d(), HUGE_VAL); }

Rational squared_distance_to(const Polygon& g, const Point3& p) {
    const Point3 n = normal(g);
    const Rational h = value(g, p) / dot(n, n);
    const Point3 foot{p[0] - h * n[0], p[1] - h * n[1], p[2] - h * n[2]};
    bool in = true;
    for (std::size_t i = 0; i < g.corners.size(); ++i) in = in && edge_value(g, i, foot) >= 0;
    if (in) return h * h * dot(n, n);
    std::optional<Rational> best;
    for (std::size_t i = 0; i < g.corners.size(); ++i) {
        const Point3& a = g.corners[i];
        const Point3 e = subtracted(g.corners[(i + 1) % g.corners.size()], a);
        Rational t = dot(subtracted(p, a), e) / dot(e, e);
        t = std::clamp(t, Rational(0), Rational(1));
        const Point3 q = subtracted(p, {a[0] + t * e[0], a[1] + t * e[1], a[2] + t * e[2]});
        const Rational d = dot(q, q);
        if (!best || d < *best) best = d;
    }
    return *best;
}

// A line against a box, in doubles and on the safe side: half-spaces that the line does not enter,
// and the line seen along each axis. Only what surely misses is left out.
class LineFilter {
public:
    LineFilter(const Point3& o, const Point3& d) {
        for (std::size_t k = 0; k < 3; ++k) {
            o_[k] = o[k].get_d();
            d_[k] = d[k].get_d();
        }
    }
    [[nodiscard]] bool may_meet(const Polygon& g) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const double slack =
                1e-12 * (std::fabs(o_[k]) + std::fabs(g.lo[k]) + std::fabs(g.hi[k]));
            if (d_[k] >= 0 && g.hi[k] < o_[k] - slack) return false;
            if (d_[k] <= 0 && g.lo[k] > o_[k] + slack) return false;
            const std::size_t j = (k + 1) % 3;
            double lo = 0;
            double hi = 0;
            double terms = 0;
            const auto add = [&](double f, double from, double to, double origin) {
                const double a = f * (from - origin);
                const double b = f * (to - origin);
                lo += std::min(a, b);
                hi += std::max(a, b);
                terms += std::fabs(f) * (std::fabs(from) + std::fabs(to) + std::fabs(origin));
            };
            add(d_[j], g.lo[k], g.hi[k], o_[k]);
            add(-d_[k], g.lo[j], g.hi[j], o_[j]);
            if (lo > 1e-12 * terms || hi < -1e-12 * terms) return false;
        }
        return true;
    }

private:
    std::array<double, 3> o_{};
    std::array<double, 3> d_{};
};

}  // namespace

void Boundary::add(std::vector<Point3> corners, FaceSource name) {
    Polygon g;
    // Collinear corners are left out; they would make edges without direction of their own.
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point3& a = corners[(i + corners.size() - 1) % corners.size()];
        const Point3& b = corners[i];
        const Point3& c = corners[(i + 1) % corners.size()];
        const Point3 n = cross(subtracted(b, a), subtracted(c, b));
        if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
        g.corners.push_back(b);
    }
    if (g.corners.size() < 3) return;
    const Point3 n =
        cross(subtracted(g.corners[1], g.corners[0]), subtracted(g.corners[2], g.corners[1]));
    const Rational d = -dot(n, g.corners[0]);
    Integer common = d.get_den();
    for (const Rational& x : n) mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), x.get_den_mpz_t());
    for (std::size_t k = 0; k < 3; ++k) g.normal[k] = Rational(n[k] * common).get_num();
    g.offset = Rational(d * common).get_num();
    g.name = name;
    g.lo.fill(HUGE_VAL);
    g.hi.fill(-HUGE_VAL);
    for (const Point3& c : g.corners)
        for (std::size_t k = 0; k < 3; ++k) {
            g.lo[k] = std::min(g.lo[k], below(c[k]));
            g.hi[k] = std::max(g.hi[k], above(c[k]));
        }
    polygons_.push_back(std::move(g));
}

Boundary Boundary::of_mesh(const trisect::LatticeMesh& mesh, std::uint32_t operand) {
    Boundary b;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        std::vector<Point3> corners;
        for (const std::uint32_t v : mesh.triangles[i]) {
            corners.push_back(point(mesh.points[v].doubles()));
        }
        b.add(std::move(corners), {operand, mesh.face_of(i)});
    }
    return b;
}

Boundary Boundary::of_triangles(const trisect::PolygonMesh& mesh, std::uint32_t operand) {
    Boundary b;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::vector<Point3> corners;
        for (const std::uint32_t v : mesh.face(f)) corners.push_back(point(mesh.points[v]));
        b.add(std::move(corners), {operand, static_cast<std::uint32_t>(f)});
    }
    return b;
}

Boundary Boundary::of_result(const reference::Result& result) {
    Boundary b;
    b.unbounded_ = result.unbounded;
    for (const reference::ConvexCell& c : result.cells) b.add(c.vertices, {});
    return b;
}

Answer Boundary::answer_on(std::vector<const Polygon*> on) const {
    std::stable_sort(on.begin(), on.end(),
                     [](const Polygon* a, const Polygon* b) { return a->name < b->name; });
    std::vector<const Polygon*> chosen;
    Answer answer;
    for (const Polygon* g : on)
        if (chosen.size() < 3 && independent(chosen, *g)) {
            chosen.push_back(g);
            answer.faces.push_back(g->name);
        }
    answer.location = chosen.size() == 1   ? Location::OnFace
                      : chosen.size() == 2 ? Location::OnEdge
                                           : Location::OnVertex;
    return answer;
}

Answer Boundary::locate(const Point3& p) const {
    std::vector<const Polygon*> on;
    const double x = p[0].get_d();
    const double y = p[1].get_d();
    for (const Polygon& g : polygons_) {
        if (x < std::nextafter(g.lo[0], -HUGE_VAL) || x > std::nextafter(g.hi[0], HUGE_VAL))
            continue;
        if (y < std::nextafter(g.lo[1], -HUGE_VAL) || y > std::nextafter(g.hi[1], HUGE_VAL))
            continue;
        if (contains(g, p)) on.push_back(&g);
    }
    if (!on.empty()) return answer_on(std::move(on));
    Answer answer;
    answer.location = is_inside(p) ? Location::Inside : Location::Outside;
    return answer;
}

// Crossings with the ray from p in direction +x, p moved by infinitely small steps: first e^2 in y
// then e in z, so no corner and no edge is ever met.
bool Boundary::is_inside(const Point3& p) const {
    int winding = unbounded_ ? 1 : 0;
    const std::array<double, 3> d{p[0].get_d(), p[1].get_d(), p[2].get_d()};
    for (const Polygon& g : polygons_) {
        if (d[0] > std::nextafter(g.hi[0], HUGE_VAL) || d[1] < g.lo[1] || d[1] > g.hi[1] ||
            d[2] < g.lo[2] || d[2] > g.hi[2])
            continue;
        int turns = 0;
        for (std::size_t i = 0; i < g.corners.size(); ++i) {
            const Point3& a = g.corners[i];
            const Point3& b = g.corners[(i + 1) % g.corners.size()];
            const bool a_below = a[2] <= p[2];
            const bool b_below = b[2] <= p[2];
            if (a_below == b_below) continue;
            const Rational turn = (b[1] - a[1]) * (p[2] - a[2]) - (b[2] - a[2]) * (p[1] - a[1]);
            // The moved point is a little further in y.
            const bool left = a_below ? turn > 0 : turn < 0;
            if (left) turns += a_below ? 1 : -1;
        }
        if (turns == 0) continue;
        // Which side of the plane is p on? The ray leaves through planes that face it.
        const int side = sgn(value(g, p));
        const int facing = sgn(g.normal[0]);
        if (side * facing < 0) winding += facing;
    }
    return winding > 0;
}

std::vector<Hit> Boundary::hits(const Point3& o, const Point3& d, bool segment) const {
    struct Part {
        const Polygon* polygon;
        Rational enter;
        Rational leave;
    };
    std::vector<Part> parts;
    std::set<Rational> ends;
    const auto at = [&](const Rational& t) -> Point3 {
        return {o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]};
    };
    const LineFilter filter(o, d);
    for (const Polygon& g : polygons_) {
        if (!filter.may_meet(g)) continue;
        const Rational s = slope(g, d);
        const Rational v = value(g, o);
        Part part{&g, 0, 0};
        if (s != 0) {
            part.enter = part.leave = -v / s;
            if (part.enter < 0 || (segment && part.enter > 1)) continue;
            if (!contains(g, at(part.enter))) continue;
        } else {
            if (v != 0) continue;
            bool bounded = segment;
            if (segment) part.leave = 1;
            bool meets = true;
            for (std::size_t i = 0; i < g.corners.size() && meets; ++i) {
                const Rational e0 = edge_value(g, i, o);
                const Rational e1 = edge_value(g, i, at(1)) - e0;
                if (e1 == 0) {
                    meets = e0 >= 0;
                } else if (const Rational t = -e0 / e1; e1 > 0) {
                    part.enter = std::max(part.enter, t);
                } else if (!bounded || t < part.leave) {
                    part.leave = t;
                    bounded = true;
                }
            }
            if (!meets || part.enter > part.leave) continue;
        }
        ends.insert(part.enter);
        ends.insert(part.leave);
        parts.push_back(part);
    }
    const auto covering = [&](const Rational& t) {
        std::vector<const Polygon*> on;
        for (const Part& p : parts)
            if (p.enter <= t && t <= p.leave) on.push_back(p.polygon);
        return on;
    };
    struct Piece {
        Hit hit;
        std::vector<const Polygon*> on;
    };
    std::vector<Piece> pieces;
    for (auto it = ends.begin(); it != ends.end(); ++it) {
        auto on = covering(*it);
        pieces.push_back({{*it, *it, false, answer_on(on)}, on});
        const auto next = std::next(it);
        if (next == ends.end()) break;
        on = covering((*it + *next) / 2);
        if (!on.empty()) pieces.push_back({{*it, *next, true, answer_on(on)}, on});
    }
    std::vector<Hit> out;
    for (std::size_t i = 0; i < pieces.size();) {
        Hit hit = pieces[i].hit;
        std::set<const Polygon*> on(pieces[i].on.begin(), pieces[i].on.end());
        std::size_t end = i + 1;
        while (end < pieces.size() && hit.answer.location != Location::OnVertex &&
               pieces[end].hit.answer.location == hit.answer.location &&
               pieces[end].hit.enter == pieces[end - 1].hit.leave) {
            hit.leave = pieces[end].hit.leave;
            hit.is_interval = true;
            on.insert(pieces[end].on.begin(), pieces[end].on.end());
            ++end;
        }
        hit.answer = answer_on({on.begin(), on.end()});
        out.push_back(hit);
        i = end;
    }
    return out;
}

std::optional<Rational> Boundary::squared_distance(const Point3& p) const {
    std::optional<Rational> best;
    for (const Polygon& g : polygons_) {
        const Rational d = squared_distance_to(g, p);
        if (!best || d < *best) best = d;
    }
    return best;
}

Point3 point(const std::array<double, 3>& p) {
    return {Rational(p[0]), Rational(p[1]), Rational(p[2])};
}

Rational rational(const trisect::ExactRational& v) { return Rational(v.to_string()); }

std::string to_string(const Answer& a) {
    std::string s = trisect::to_string(a.location);
    for (const FaceSource& f : a.faces)
        s += " " + std::to_string(f.operand) + ":" + std::to_string(f.face);
    return s;
}

std::string to_string(const trisect::Place& p) {
    Answer a{p.location, {p.faces.begin(), p.faces.begin() + p.face_count}};
    return to_string(a);
}

bool agrees(const trisect::Place& place, const Answer& answer, bool named) {
    if (place.location != answer.location) return false;
    return !named || std::equal(place.faces.begin(), place.faces.begin() + place.face_count,
                                answer.faces.begin(), answer.faces.end());
}

PointMaker::PointMaker(const trisect::LatticeMesh& mesh, std::uint64_t seed)
    : mesh_(mesh), random_(seed) {
    lo_.fill(HUGE_VAL);
    hi_.fill(-HUGE_VAL);
    for (const trisect::LatticePoint& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k] = std::min(lo_[k], p[static_cast<int>(k)].to_double());
            hi_[k] = std::max(hi_[k], p[static_cast<int>(k)].to_double());
        }
}

const std::array<std::uint32_t, 3>& PointMaker::triangle() {
    return mesh_.triangles[random_.below(mesh_.triangles.size())];
}

std::array<double, 3> PointMaker::combined(const std::array<int, 3>& eighths) {
    const auto& t = triangle();
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            p[k] += eighths[i] * 0.125 * mesh_.points[t[i]][static_cast<int>(k)].to_double();
    return p;
}

std::array<double, 3> PointMaker::uniform() {
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = lo_[k] + (hi_[k] - lo_[k]) * (static_cast<double>(random_.next() >> 11) * 0x1p-53);
    return p;
}

std::array<double, 3> PointMaker::grid() {
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto lo = static_cast<std::int64_t>(lo_[k]);
        const auto hi = static_cast<std::int64_t>(hi_[k]);
        p[k] = static_cast<double>(random_.between(4 * lo - 4, 4 * hi + 4)) * 0.25;
    }
    return p;
}

std::array<double, 3> PointMaker::corner() { return combined({8, 0, 0}); }

std::array<double, 3> PointMaker::on_edge() {
    const int i = static_cast<int>(random_.between(1, 7));
    return combined({i, 8 - i, 0});
}

std::array<double, 3> PointMaker::on_face() {
    const int i = static_cast<int>(random_.between(1, 6));
    const int j = static_cast<int>(random_.between(1, 7 - i));
    return combined({i, j, 8 - i - j});
}

std::array<double, 3> PointMaker::on_plane() {
    const int i = static_cast<int>(random_.between(-16, 24));
    const int j = static_cast<int>(random_.between(-16, 24));
    return combined({i, j, 8 - i - j});
}

std::array<double, 3> PointMaker::any() {
    switch (random_.below(9)) {
        case 0:
            return corner();
        case 1:
            return on_edge();
        case 2:
            return on_face();
        case 3:
            return on_plane();
        case 4:
        case 5:
        case 6:
            return grid();
        default:
            return uniform();
    }
}

}  // namespace brute
