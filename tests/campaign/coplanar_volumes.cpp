// SPDX-License-Identifier: Apache-2.0
//
// Volumes of booleans of coplanar families whose corners are moved by one ulp, against CGAL's Nef
// polyhedra in rationals, on the same doubles.
//
// A family has a few decimal numbers for each axis, of one magnitude or several. Its boxes, prisms
// and tetrahedra have their corners there, so their faces lie in common planes, axis-parallel or
// not; the second of a pair may also be the first one with other diagonals, or share a face with
// it. Then corners are moved by one ulp, in three pairs of four: one corner along an axis or along
// all, one of each, or all corners of one plane. Faces that were coplanar cross at angles of 2^-50.
// The volumes of the operands, the union, the intersection and both differences have to be the same
// fractions, and an intersection without volume has to be empty.
//
//     coplanar_volumes [--seed S] [--pairs N] [--only I]
//
// Prints the pairs that differ; exits with 1 when there are any.

#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/interop/cgal.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>

namespace {

using trisect::ExactRational;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;

using Number = CGAL::Gmpq;
using Kernel = CGAL::Cartesian<Number>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

// Oracle -----------------------------------------------------------------------------------------

// The cross products of a facet's edges around the origin: twice its vector area.
Kernel::Vector_3 vector_area(const Nef::Halffacet_const_handle& face) {
    Kernel::Vector_3 sum(0, 0, 0);
    for (auto cycle = face->facet_cycles_begin(); cycle != face->facet_cycles_end(); ++cycle) {
        if (!cycle.is_shalfedge()) continue;  // an isolated vertex in the face
        Nef::SHalfedge_around_facet_const_circulator step(Nef::SHalfedge_const_handle{cycle});
        const auto first = step;
        do {
            const auto& p = step->source()->center_vertex()->point();
            const auto& q = step->next()->source()->center_vertex()->point();
            sum = sum + CGAL::cross_product(p - CGAL::ORIGIN, q - CGAL::ORIGIN);
        } while (++step != first);
    }
    return sum;
}

// Of the cones over all facets between a volume in the set and one outside of it.
Number volume_of(const Nef& nef) {
    Number sum = 0;
    for (auto face = nef.halffacets_begin(); face != nef.halffacets_end(); ++face) {
        if (face->incident_volume()->mark() || !face->twin()->incident_volume()->mark()) continue;
        // The plane points into the volume, so outwards.
        const Kernel::Vector_3 area = vector_area(face);
        const Nef::SHalfedge_const_handle first(face->facet_cycles_begin());
        const auto height = (first->source()->center_vertex()->point() - CGAL::ORIGIN) * area;
        const bool outwards = area * face->plane().orthogonal_vector() > 0;
        sum += outwards ? height : -height;
    }
    return sum / 6;
}

ExactRational exact(const Number& value) {
    std::ostringstream text;
    text << value;
    return ExactRational::from_string(text.str());
}

// Six times that of a mesh of triangles.
Number six_volumes(const PolygonMesh& mesh) {
    Number sum = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::array<Kernel::Vector_3, 3> v;
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3d& p = mesh.points[mesh.face(f)[i]];
            v[i] = Kernel::Vector_3(Number(p[0]), Number(p[1]), Number(p[2]));
        }
        sum += CGAL::cross_product(v[0], v[1]) * v[2];
    }
    return sum;
}

// Families ---------------------------------------------------------------------------------------

struct Body {
    std::vector<Point3d> corners;
    std::vector<std::vector<std::uint32_t>> faces;
};

enum class Move { None, OneAxis, AllAxes, BothBodies, Plane };

class Family {
public:
    explicit Family(std::uint64_t seed) : random_(seed) {
        const double size = std::pow(10.0, real(-6, 6));
        const bool mixed = chance(2);
        for (auto& axis : values_)
            while (axis.size() < 5) {
                const double s = mixed ? size * std::pow(10.0, real(-8, 0)) : size;
                const double v = decimal(s * real(-1, 1), s);
                if (std::ranges::find(axis, v) == axis.end()) axis.push_back(v);
            }
        // What a zero is moved by: its own ulp is finer than a lattice.
        step_at_zero_ = std::ldexp(1.0, std::ilogb(size) - 60);
    }

    [[nodiscard]] std::size_t below(std::size_t n) { return random_() % n; }
    [[nodiscard]] bool chance(unsigned of) { return random_() % of == 0; }

    [[nodiscard]] Body body() {
        switch (below(3)) {
            case 0:
                return box();
            case 1:
                return prism();
            default:
                return tetrahedron();
        }
    }

    // The first one again, or one of its faces and a corner elsewhere, or a body of its own.
    [[nodiscard]] Body beside(const Body& first) {
        if (chance(6)) return first;
        if (!chance(3)) return body();
        const auto& face = first.faces[below(first.faces.size())];
        return over(
            {first.corners[face[0]], first.corners[face[1]], first.corners[face[2]], corner()});
    }

    void move(Body& a, Body& b, Move how) {
        const auto any = [this](Body& body) -> Point3d& {
            return body.corners[below(body.corners.size())];
        };
        const std::size_t axis = below(3);
        switch (how) {
            case Move::None:
                break;
            case Move::BothBodies:
                nudge(any(a)[axis], chance(2));
                [[fallthrough]];
            case Move::OneAxis: {
                nudge(any(b)[below(3)], chance(2));
                break;
            }
            case Move::AllAxes: {
                for (double& c : any(b)) nudge(c, chance(2));
                break;
            }
            case Move::Plane: {
                const double at = any(b)[axis];
                const bool up = chance(2);
                for (Point3d& p : b.corners)
                    if (p[axis] == at) nudge(p[axis], up);
                break;
            }
        }
    }

    // With diagonals at random, and outward faces.
    [[nodiscard]] PolygonMesh triangulated(const Body& body) {
        PolygonMesh mesh;
        mesh.points = body.corners;
        for (auto face : body.faces) {
            std::ranges::rotate(face, face.begin() + static_cast<std::ptrdiff_t>(below(2)));
            for (std::size_t i = 2; i < face.size(); ++i)
                mesh.add_triangle(face[0], face[i - 1], face[i]);
        }
        if (six_volumes(mesh) < 0)
            for (std::size_t f = 0; f < mesh.face_count(); ++f)
                std::swap(mesh.corners[3 * f], mesh.corners[3 * f + 1]);
        return mesh;
    }

private:
    double real(double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random_);
    }
    // The double of a decimal text with two to five digits of what a family is made of.
    double decimal(double v, double size) {
        const int digits = 2 + static_cast<int>(below(4));
        const int places = std::max(0, digits - static_cast<int>(std::ceil(std::log10(size))));
        std::array<char, 400> text{};
        std::snprintf(text.data(), text.size(), "%.*f", places, v);
        return std::strtod(text.data(), nullptr);
    }
    void nudge(double& c, bool up) const {
        const double to =
            up ? std::numeric_limits<double>::max() : std::numeric_limits<double>::lowest();
        c = c != 0 ? std::nextafter(c, to) : (up ? step_at_zero_ : -step_at_zero_);
    }
    double value(std::size_t axis) { return values_[axis][below(5)]; }
    Point3d corner() { return {value(0), value(1), value(2)}; }
    std::pair<double, double> two_values(std::size_t axis) {
        const std::size_t i = below(5);
        return {values_[axis][i], values_[axis][(i + 1 + below(4)) % 5]};
    }

    Body box() {
        std::array<std::pair<double, double>, 3> of{two_values(0), two_values(1), two_values(2)};
        Body out;
        for (unsigned i = 0; i < 8; ++i) {
            Point3d& p = out.corners.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = (i >> k & 1U) != 0 ? of[k].second : of[k].first;
        }
        out.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        return out;
    }
    // Over a triangle whose corners are on the grid.
    Body prism() {
        const std::size_t axis = below(3);
        const auto ends = two_values(axis);
        Body out;
        for (int i = 0; i < 3; ++i) out.corners.push_back(corner());
        for (std::size_t i = 0; i < 3; ++i) {
            out.corners[i][axis] = ends.first;
            Point3d top = out.corners[i];
            top[axis] = ends.second;
            out.corners.push_back(top);
        }
        out.faces = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
        return out;
    }
    static Body over(const std::array<Point3d, 4>& corners) {
        return {{corners.begin(), corners.end()}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    }
    Body tetrahedron() { return over({corner(), corner(), corner(), corner()}); }

    std::mt19937_64 random_;
    std::array<std::vector<double>, 3> values_;
    double step_at_zero_ = 0;
};

// Comparison -------------------------------------------------------------------------------------

struct Counts {
    std::size_t drawn = 0, pairs = 0, volumes = 0, fractions = 0, crossing = 0, different = 0;
    std::array<std::size_t, 5> moves{};
};

// A mesh that bounds a solid, does not meet itself and keeps its doubles.
bool is_fit(const PolygonMesh& mesh, Counts& counts) {
    if (six_volumes(mesh) <= 0) return false;
    const trisect::ImportedMesh imported = trisect::import_mesh(mesh);
    const auto& report = imported.report;
    if (report.degenerate_faces_dropped != 0 || report.t_edges != 0 || report.welded_points != 0 ||
        !report.lattice.lossless || !trisect::is_embedded(imported.mesh))
        return false;
    counts.fractions +=
        std::ranges::all_of(imported.mesh.points, [](const auto& p) { return p.is_whole(); }) ? 0U
                                                                                              : 1U;
    return true;
}

std::string difference(const PolygonMesh& a, const PolygonMesh& b, Counts& counts) {
    const Solid x = Solid::from_mesh(a);
    const Solid y = Solid::from_mesh(b);
    const Nef p(trisect::to_cgal_surface_mesh<Kernel::Point_3>(a));
    const Nef q(trisect::to_cgal_surface_mesh<Kernel::Point_3>(b));
    const Number volume_p = volume_of(p);
    const Number volume_q = volume_of(q);
    const Number both = volume_of(p * q);
    counts.crossing += both != 0 && both != volume_p && both != volume_q ? 1U : 0U;
    const Solid intersection = evaluate(x & y);
    std::string why;
    const auto check = [&](const char* what, const Solid& solid, const Number& expected) {
        ++counts.volumes;
        if (exact_volume(solid) != exact(expected)) why += std::string(" ") + what;
    };
    if (6 * volume_p != six_volumes(a) || 6 * volume_q != six_volumes(b)) why += " oracle";
    check("first", x, volume_p);
    check("second", y, volume_q);
    check("union", evaluate(x | y), volume_of(p + q));
    check("intersection", intersection, both);
    check("difference", evaluate(x - y), volume_of(p - q));
    check("difference turned over", evaluate(y - x), volume_of(q - p));
    if (intersection.is_empty() != (both == 0)) why += " emptiness";
    return why;
}

void print_mesh(const PolygonMesh& mesh) {
    std::printf("  points");
    for (const Point3d& p : mesh.points) std::printf(" %a,%a,%a", p[0], p[1], p[2]);
    std::printf("\n  corners");
    for (const std::uint32_t c : mesh.corners) std::printf(" %u", c);
    std::printf("\n");
}

void compare(std::uint64_t seed, std::uint64_t index, Counts& counts) {
    Family family(seed * 1'000'003 + index);
    ++counts.drawn;
    Body first = family.body();
    Body second = family.beside(first);
    constexpr std::array moves{Move::None,    Move::None,    Move::OneAxis,    Move::OneAxis,
                               Move::OneAxis, Move::AllAxes, Move::BothBodies, Move::Plane};
    const Move how = moves[family.below(moves.size())];
    family.move(first, second, how);
    const PolygonMesh a = family.triangulated(first);
    const PolygonMesh b = family.triangulated(second);
    if (!is_fit(a, counts) || !is_fit(b, counts)) return;
    ++counts.pairs;
    ++counts.moves[static_cast<std::size_t>(how)];
    std::string why;
    try {
        why = difference(a, b, counts);
    } catch (const std::exception& e) {
        why = e.what();
    }
    if (why.empty()) return;
    ++counts.different;
    std::printf("DIFFERENT pair %llu: %s\n", static_cast<unsigned long long>(index), why.c_str());
    print_mesh(a);
    print_mesh(b);
    std::fflush(stdout);
}

void print(const Counts& counts) {
    std::printf("| | |\n|---|---:|\n");
    std::printf("| pairs | %zu |\n", counts.pairs);
    std::printf("| drawn, but flat, not embedded or too wide | %zu |\n",
                counts.drawn - counts.pairs);
    constexpr std::array<const char*, 5> names{
        "no corner moved", "one corner by one ulp", "one corner by one ulp along all axes",
        "a corner of each by one ulp", "a plane of corners by one ulp"};
    for (std::size_t i = 0; i < names.size(); ++i)
        std::printf("| %s | %zu |\n", names[i], counts.moves[i]);
    std::printf("| operands with bits behind the point | %zu |\n", counts.fractions);
    std::printf("| pairs of which each has volume within and outside of the other | %zu |\n",
                counts.crossing);
    std::printf("| volumes compared as fractions | %zu |\n", counts.volumes);
    std::printf("| different | %zu |\n", counts.different);
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t seed = 1;
    std::uint64_t count = 1000;
    std::uint64_t only = ~std::uint64_t{0};
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        const auto value = std::strtoull(argv[i + 1], nullptr, 10);
        (name == "--seed" ? seed : name == "--only" ? only : count) = value;
    }
    Counts counts;
    if (only != ~std::uint64_t{0}) {
        compare(seed, only, counts);
    } else {
        for (std::uint64_t i = 0; counts.pairs < count && i < 10 * count; ++i)
            compare(seed, i, counts);
    }
    print(counts);
    return counts.different == 0 && counts.pairs != 0 ? 0 : 1;
}
