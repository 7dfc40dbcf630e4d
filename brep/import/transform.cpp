// SPDX-License-Identifier: Apache-2.0
//
// A coordinate of an affine map is a sum of three products and a translation. In plain doubles a
// map that only permutes axes and adds an integer would already be exact; a rotation of a large
// part would lose the last bits to cancellation between the terms, and then flat faces become less
// flat than the rounding to the lattice alone would make them. So products are split without error
// by a fused multiply-add and sums carry their error along [Ogita, Rump, Oishi 2005, algorithm
// Dot2].

#include <trisect/brep/transform.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>

#include <trisect/brep/import/weld_points.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/plane.h>

namespace trisect {

namespace {

// The value is head + tail; head alone is the rounded value.
struct Sum {
    double head = 0;
    double tail = 0;

    void add(double v) {
        const double s = head + v;
        const double b = s - head;
        tail += (head - (s - b)) + (v - b);
        head = s;
    }
    void add_product(double a, double b) {
        const double p = a * b;
        tail += std::fma(a, b, -p);
        add(p);
    }
};

Sum dot(const std::array<double, 4>& row, const Point3d& p, double translation) {
    Sum s;
    for (std::size_t i = 0; i < 3; ++i) s.add_product(row[i], p[i]);
    s.add(translation);
    return s;
}

// Each of the six products of three entries is split into four doubles without error (barring
// underflow), and the 24 are added by distilling them: sweeps of error-free sums until the last
// term outweighs all others. The sign is that of the last term.
int determinant_sign(const AffineMap& m) {
    std::array<double, 24> terms{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (const int sign : {1, -1}) {
            const std::size_t j = (i + (sign > 0 ? 1 : 2)) % 3;
            const std::size_t k = (i + (sign > 0 ? 2 : 1)) % 3;
            const double a = sign * m.rows[0][i];
            const double p = m.rows[1][j] * m.rows[2][k];
            const double e = std::fma(m.rows[1][j], m.rows[2][k], -p);
            for (const double f : {p, e}) {
                terms[n++] = a * f;
                terms[n++] = std::fma(a, f, -(a * f));
            }
        }
    }
    for (int sweep = 0; sweep < 64; ++sweep) {
        for (std::size_t i = 1; i < n; ++i) {
            const double s = terms[i - 1] + terms[i];
            const double b = s - terms[i - 1];
            terms[i - 1] = (terms[i - 1] - (s - b)) + (terms[i] - b);
            terms[i] = s;
        }
        double rest = 0;
        for (std::size_t i = 0; i + 1 < n; ++i) rest += std::fabs(terms[i]);
        if (rest == 0 || std::fabs(terms[n - 1]) > 2 * rest) break;
    }
    return terms[n - 1] > 0 ? 1 : (terms[n - 1] < 0 ? -1 : 0);
}

void require_regular(const AffineMap& m) {
    for (const auto& row : m.rows)
        for (const double v : row)
            if (!std::isfinite(v)) throw UsageError("a transform has an entry that is not finite");
    if (m.orientation() == 0) throw UsageError("a transform is singular: it flattens the solid");
}

void reverse_faces(PolygonMesh& m) {
    for (std::size_t f = 0; f < m.face_count(); ++f)
        std::reverse(m.corners.begin() + m.face_begin[f], m.corners.begin() + m.face_begin[f + 1]);
}

void reverse_triangles(LatticeMesh& m) {
    for (auto& t : m.triangles) std::swap(t[1], t[2]);
}

void require_on_lattice(const LatticePoint& p) {
    for (int i = 0; i < 3; ++i)
        if (std::fabs(p[i].to_double()) >= static_cast<double>(coordinate_limit))
            throw LimitError("a transformed coordinate leaves the lattice");
}

// \throw LimitError when the sum is no coordinate.
Coordinate exact_sum(Coordinate a, Coordinate b) {
    const double sum = a.to_double() + b.to_double();
    const double rest =
        (a.to_double() - (sum - b.to_double())) + (b.to_double() - (sum - (sum - b.to_double())));
    if (rest != 0 || std::fabs(sum) >= static_cast<double>(coordinate_limit))
        throw LimitError(rest != 0 ? "a translated coordinate is not a double"
                                   : "a translation leaves the lattice");
    return Coordinate(sum);
}

int floor_divide(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

// The nearest multiple of the unit to t units, ties to even in the head.
std::int64_t round_to_lattice(const Sum& s, double& move) {
    if (!(std::fabs(s.head) < static_cast<double>(coordinate_limit)))
        throw LimitError("a transformed coordinate leaves the lattice");
    double r = std::nearbyint(s.head);
    const double rest = (s.head - r) + s.tail;  // exact difference up to one rounding
    if (rest > 0.5) r += 1;
    if (rest < -0.5) r -= 1;
    move = std::fabs((s.head - r) + s.tail);
    return static_cast<std::int64_t>(r);
}

// The nearest double with no more than fraction_limit bits behind the point.
double round_to_fraction(const Sum& s, double& move) {
    if (!(std::fabs(s.head) < static_cast<double>(coordinate_limit)))
        throw LimitError("a transformed coordinate leaves the lattice");
    const double fine = std::ldexp(s.head + s.tail, fraction_limit);
    const double r = std::ldexp(std::nearbyint(fine), -fraction_limit);
    move = std::fabs((s.head - r) + s.tail);
    return r;
}

using Normal = std::array<double, 3>;

template <class P>
Normal normal_of(const P& a, const P& b, const P& c) {
    Normal u{}, v{};
    for (std::size_t i = 0; i < 3; ++i) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
    }
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

// Renames welded points and leaves out triangles that became flat.
void clean_up(LatticeMesh& m) {
    auto welded = detail::weld_points(m.points);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> faces;
    for (std::uint32_t i = 0; i < m.triangles.size(); ++i) {
        const auto& t = m.triangles[i];
        if (are_collinear(m.points[t[0]], m.points[t[1]], m.points[t[2]])) continue;
        triangles.push_back({welded.id[t[0]], welded.id[t[1]], welded.id[t[2]]});
        faces.push_back(m.face_of(i));
    }
    if (!m.face_of_triangle.empty() || triangles.size() != m.triangles.size())
        m.face_of_triangle = std::move(faces);
    m.triangles = std::move(triangles);
    m.points = std::move(welded.points);
}

}  // namespace

AffineMap AffineMap::translation(const Point3d& by) {
    AffineMap m;
    for (std::size_t i = 0; i < 3; ++i) m.rows[i][3] = by[i];
    return m;
}

AffineMap AffineMap::scaling(const Point3d& factors) {
    AffineMap m;
    for (std::size_t i = 0; i < 3; ++i) m.rows[i][i] = factors[i];
    return m;
}

AffineMap AffineMap::mirror(int axis) {
    AffineMap m;
    m.rows[static_cast<std::size_t>(axis)][static_cast<std::size_t>(axis)] = -1;
    return m;
}

AffineMap AffineMap::rotation(const Point3d& axis, double degrees) {
    const double largest = std::max({std::fabs(axis[0]), std::fabs(axis[1]), std::fabs(axis[2])});
    if (!std::isfinite(degrees) || !std::isfinite(axis[0] + axis[1] + axis[2]) || largest == 0)
        throw UsageError("a rotation needs a finite angle and an axis that is not zero");
    Point3d k{axis[0] / largest, axis[1] / largest, axis[2] / largest};
    const double length = std::sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
    for (double& v : k) v /= length;                        // a coordinate axis stays exactly one
    const double reduced = std::remainder(degrees, 360.0);  // exact
    double c = std::cos(reduced * std::numbers::pi / 180);
    double s = std::sin(reduced * std::numbers::pi / 180);
    if (std::remainder(reduced, 90.0) == 0) {
        c = std::round(c);
        s = std::round(s);
    }
    AffineMap m;
    for (std::size_t i = 0; i < 3; ++i) {  // Rodrigues: c I + s [k]× + (1 - c) k kᵀ
        for (std::size_t j = 0; j < 3; ++j) {
            double v = k[i] * k[j] * (1 - c);
            if (i == j) v += c;
            if (j == (i + 1) % 3) v -= s * k[(i + 2) % 3];
            if (j == (i + 2) % 3) v += s * k[(i + 1) % 3];
            m.rows[i][j] = v;
        }
    }
    return m;
}

int AffineMap::orientation() const { return determinant_sign(*this); }

Point3d AffineMap::apply(const Point3d& p) const {
    Point3d out{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Sum s = dot(rows[i], p, rows[i][3]);
        out[i] = s.head + s.tail;
    }
    return out;
}

AffineMap compose(const AffineMap& second, const AffineMap& first) {
    AffineMap m;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            Sum s;
            for (std::size_t k = 0; k < 3; ++k) s.add_product(second.rows[i][k], first.rows[k][j]);
            if (j == 3) s.add(second.rows[i][3]);
            m.rows[i][j] = s.head + s.tail;
        }
    }
    return m;
}

PolygonMesh transformed(PolygonMesh mesh, const AffineMap& map) {
    require_regular(map);
    for (Point3d& p : mesh.points) p = map.apply(p);
    if (map.orientation() < 0) reverse_faces(mesh);
    return mesh;
}

LatticeMesh translated(const LatticeMesh& mesh, const LatticePoint& by) {
    LatticeMesh out = mesh;
    for (LatticePoint& p : out.points)
        p = {exact_sum(p.x, by.x), exact_sum(p.y, by.y), exact_sum(p.z, by.z)};
    return out;
}

LatticeMesh rotated_by_quarter_turns(const LatticeMesh& mesh, int axis, int quarter_turns) {
    LatticeMesh out = mesh;
    const int turns = ((quarter_turns % 4) + 4) % 4;
    for (LatticePoint& p : out.points) {
        for (int i = 0; i < turns; ++i) {
            if (axis == 0) p = {p.x, -p.z, p.y};
            if (axis == 1) p = {p.z, p.y, -p.x};
            if (axis == 2) p = {-p.y, p.x, p.z};
        }
    }
    return out;
}

LatticeMesh mirrored(const LatticeMesh& mesh, int axis) {
    LatticeMesh out = mesh;
    for (LatticePoint& p : out.points) {
        Coordinate& c = axis == 0 ? p.x : (axis == 1 ? p.y : p.z);
        c = -c;
    }
    reverse_triangles(out);
    return out;
}

LatticeMesh scaled_by_power_of_two(const LatticeMesh& mesh, int power) {
    LatticeMesh out = mesh;
    const int eights = floor_divide(power, 8);
    const double factor = std::ldexp(1, power - 8 * eights);
    out.lattice.exponent += 8 * eights;
    for (LatticePoint& p : out.points) {
        p = {Coordinate(p.x.to_double() * factor), Coordinate(p.y.to_double() * factor),
             Coordinate(p.z.to_double() * factor)};  // exact: a power of two
        require_on_lattice(p);
    }
    return out;
}

LatticeMesh transformed(const LatticeMesh& mesh, const AffineMap& map, LatticeReport& report) {
    require_regular(map);
    LatticeMesh out = mesh;
    report.lattice = mesh.lattice;
    const auto is_whole = [](const LatticePoint& p) { return p.is_whole(); };
    const bool whole = std::ranges::all_of(mesh.points, is_whole);
    for (LatticePoint& p : out.points) {
        std::array<Coordinate, 3> c{};
        double largest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double t = std::ldexp(map.rows[i][3], -mesh.lattice.exponent);
            double move = 0;
            const Sum image = dot(map.rows[i], p.doubles(), t);
            c[i] = whole ? Coordinate(round_to_lattice(image, move))
                         : Coordinate(round_to_fraction(image, move));
            largest = std::max(largest, move);
        }
        p = {c[0], c[1], c[2]};
        require_on_lattice(p);
        if (largest > 0) ++report.moved;
        report.max_move = std::max(report.max_move, mesh.lattice.to_double(largest));
    }
    report.lossless = report.lossless && report.moved == 0;
    for (const auto& t : mesh.triangles) {
        std::array<Point3d, 3> before{}, after{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3d p = mesh.points[t[i]].doubles();
            for (std::size_t k = 0; k < 3; ++k) before[i][k] = dot(map.rows[k], p, 0).head;
            after[i] = out.points[t[i]].doubles();
        }
        const Normal n = normal_of(before[0], before[1], before[2]);
        const Normal m = normal_of(after[0], after[1], after[2]);
        if (n[0] * m[0] + n[1] * m[1] + n[2] * m[2] <= 0) ++report.flipped_faces;
    }
    if (map.orientation() < 0) reverse_triangles(out);
    clean_up(out);
    return out;
}

}  // namespace trisect
