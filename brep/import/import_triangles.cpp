// SPDX-License-Identifier: Apache-2.0
//
// Nearly all meshes are triangles whose sides cancel by name. For them import is a handful of
// linear passes: round, weld, look at every triangle once, match the sides. Whatever is found to be
// otherwise is left to the general path, which starts afresh, so that only one place words errors.
//
// The look at a triangle decides three things by one number, the z component N of its normal in
// doubles. With all coordinates within D of each other, u = 2^-53:
//
// - Area. Differences and products are rounded once each, so N is within 2^-49 D^2 of the true
//   component. Beyond that the triangle is not degenerate. Else are_collinear decides, exactly.
// - Orientation after rounding. A corner moves by at most half a unit, so each component of the
//   normal differs between before and after by at most m = 32 D + 32 + 2^-48 D^2 with all errors of
//   both computations (4 units for each of four differences of at most D, twice that for slack).
//   When |N| >= 9 m, the scalar product that is_flipped computes is at least half |N|^2 and
//   positive. Else is_flipped decides. Exponents are kept in a range where nothing overflows and
//   what underflows is far below m.
// - Volume. Six times the volume is the sum of N (a_z + b_z + c_z - 3 o_z) over all triangles, by
//   the divergence theorem for (0, 0, z), for any o. A term is below 6 D_x D_y D_z and has an
//   error of less than 16 u of that; adding n of them, in any order, costs n u of the sum of their
//   sizes. A sum beyond n (n + 16) 2^-52 times that bound has the right sign. Else volume_sign
//   decides, exactly.
//
// Nothing underflows: coordinates are multiples of 2^-73 units, products of two of 2^-146.
//
// Several threads take parts of the points and of the triangles. Welding and matching sides are one
// piece of work each, a fourth and a third of an import, and done at the same time: as long as no
// points are equal, which is the rule where points are shared, sides have the names that they have
// in the input.

#include <trisect/brep/import/import_triangles.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/import/import_findings.h>
#include <trisect/brep/import/own_lattice.h>
#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/brep/import/side_balance.h>
#include <trisect/brep/import/volume_sign.h>
#include <trisect/brep/import/weld_points.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/ready_memory.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

// How a range is divided: see ParallelParts.
struct Sharing {
    std::uint32_t threads;
    std::size_t least_part;

    [[nodiscard]] ParallelParts parts(std::size_t size) const {
        return {size, threads, least_part};
    }
};

// Whether face f begins at corner 3 f.
bool begins_by_threes(const PolygonMesh& mesh, const Sharing& sharing) {
    const std::vector<std::uint32_t>& begin = mesh.face_begin;
    if (begin.empty() || mesh.corners.size() != 3 * (begin.size() - 1)) return false;
    if (begin.size() > (std::size_t{1} << 30) || begin.back() != mesh.corners.size()) return false;
    std::atomic<bool> is_so{true};
    sharing.parts(begin.size() - 1).for_each([&](std::size_t, std::size_t first, std::size_t end) {
        std::uint32_t wrong = 0;
        for (std::size_t f = first; f < end; ++f)
            wrong |= begin[f] ^ static_cast<std::uint32_t>(3 * f);
        if (wrong != 0) is_so = false;
    });
    return is_so;
}

bool has_corners_in_range(const TriangleView& mesh, const Sharing& sharing) {
    const std::size_t n = mesh.points.size();
    if (mesh.triangles.size() >= (std::size_t{1} << 30) || n > 0xffffffffU) return false;
    std::atomic<bool> is_so{true};
    sharing.parts(mesh.triangles.size())
        .for_each([&](std::size_t, std::size_t first, std::size_t end) {
            std::uint32_t largest = 0;
            for (const Triangle& t : mesh.triangles.subspan(first, end - first))
                largest = std::max({largest, t[0], t[1], t[2]});
            if (first != end && largest >= n) is_so = false;
        });
    return is_so;
}

// The corners three by three, as they lie in memory.
TriangleView view_of(const PolygonMesh& mesh) {
    static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));
    return {mesh.points,
            {reinterpret_cast<const Triangle*>(mesh.corners.data()), mesh.face_count()}};
}

struct CoordinateBox {
    Point3d low;
    Point3d high;

    CoordinateBox() {
        low.fill(HUGE_VAL);
        high.fill(-HUGE_VAL);
    }
    void add(const Point3d& l, const Point3d& h) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], l[k]);
            high[k] = std::max(high[k], h[k]);
        }
    }
};

// How far the points extend along each axis.
Point3d extents(std::span<const LatticePoint> points, const Sharing& sharing) {
    const ParallelParts parts = sharing.parts(points.size());
    std::vector<CoordinateBox> ranges(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        CoordinateBox range;
        for (const LatticePoint& p : points.subspan(begin, end - begin)) {
            const Point3d c = p.doubles();
            range.add(c, c);
        }
        ranges[part] = range;
    });
    CoordinateBox all;
    for (const CoordinateBox& r : ranges) all.add(r.low, r.high);
    Point3d d{};
    if (points.empty()) return d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = all.high[k] - all.low[k];
    return d;
}

class TriangleImporter {
public:
    TriangleImporter(const TriangleView& mesh, const ImportOptions& options, Fractions fractions,
                     const Sharing& sharing)
        : input_(mesh), options_(options), fractions_(fractions), sharing_(sharing) {}

    std::optional<ImportedMesh> run() {
        check_stop(input_.points.size());
        points() = points_on_lattice(input_.points, options_.lattice, fractions_,
                                     out_.report.lattice, sharing_.threads);
        out_.mesh.lattice = out_.report.lattice.lattice;
        check_stop(input_.triangles.size());
        const SideBalance sides = connect();
        check_stop();
        end_step();
        if (!sides.cancel) return std::nullopt;
        out_.report.inside_out = is_inside_out();
        end_step();
        drop_degenerate();
        if (!sides.reach_all_points || out_.report.degenerate_faces_dropped != 0)
            drop_unused_points();
        return std::move(out_);
    }

private:
    std::vector<LatticePoint>& points() { return out_.mesh.points; }
    std::vector<Triangle>& triangles() { return out_.mesh.triangles; }

    // Welds, renames, looks at the triangles and at their sides.
    SideBalance connect() {
        weld();
        look_at_triangles();
        return balance_sides(points().size(), triangles(), sharing_.threads);
    }

    void weld() {
        // A closed surface has half as many points as triangles, give or take.
        names_ = weld_in_place(points(), input_.triangles.size() / 2 + input_.triangles.size() / 16,
                               sharing_.threads);
        out_.report.welded_points = input_.points.size() - points().size();
    }

    // What a part of the triangles adds to the result.
    struct Found {
        double sum = 0;  ///< six times the volume
        std::vector<std::uint32_t> degenerate;
        std::size_t flipped = 0;
    };

    void look_at_triangles() {
        resize_ready(triangles(), input_.triangles.size());
        set_bounds();
        const ParallelParts parts = sharing_.parts(triangles().size());
        std::vector<Found> found(parts.count());
        const auto look_at = [&](const auto& name) {
            parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
                look(begin, end, name, found[part]);
            });
        };
        if (names_.empty()) {
            look_at([](std::uint32_t c) { return c; });
        } else {
            look_at([name = names_.data()](std::uint32_t c) { return name[c]; });
        }
        for (const Found& f : found) {
            sum_ += f.sum;
            degenerate_.insert(degenerate_.end(), f.degenerate.begin(), f.degenerate.end());
            out_.report.lattice.flipped_faces += f.flipped;
        }
    }

    // Names the corners of some triangles and looks at them.
    template <class Name>
    void look(std::size_t begin, std::size_t end, const Name& name, Found& found) {
        const LatticePoint* const point = points().data();
        const double clear = clear_;
        const double z0 = points().empty() ? 0 : points()[0].z.to_double();
        const Triangle* corners = input_.triangles.data() + begin;
        Triangle* const triangle = triangles().data();
        double sum = 0;
        for (std::size_t f = begin; f < end; ++f, ++corners) {
            const std::uint32_t i = name((*corners)[0]);
            const std::uint32_t j = name((*corners)[1]);
            const std::uint32_t k = name((*corners)[2]);
            triangle[f] = {i, j, k};
            const Point3d a = point[i].doubles();
            const Point3d b = point[j].doubles();
            const Point3d c = point[k].doubles();
            const double n = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            sum += n * ((a[2] - z0) + (b[2] - z0) + (c[2] - z0));
            if (std::fabs(n) < clear) look_closely(static_cast<std::uint32_t>(f), found);
        }
        found.sum = sum;
    }

    void set_bounds() {
        const Point3d d = extents(points(), sharing_);
        const double n = static_cast<double>(triangles().size());
        const double largest = std::max({d[0], d[1], d[2]});
        const double squares = largest * largest;
        // A term is at most 6 d_x d_y d_z, and its thirteen roundings are less than 16 u of that;
        // the sum of n terms adds n of its own to each.
        sum_bound_ = n * (n + 16) * 0x1p-52 * 6 * d[0] * d[1] * d[2];
        degenerate_bound_ = 0x1p-49 * squares;
        flip_bound_ = 9 * (32 * largest + 32 + 0x1p-48 * squares);
        const bool in_range = std::abs(out_.mesh.lattice.exponent) <= 300;
        if (!in_range) flip_bound_ = HUGE_VAL;
        clear_ = out_.report.lattice.lossless ? degenerate_bound_ : flip_bound_;
        clear_ = std::max(clear_, 0x1p-200);  // a component of zero is never clear
    }

    // For triangles whose normal is small or has a small z component.
    [[gnu::noinline]] void look_closely(std::uint32_t f, Found& found) {
        const Triangle& t = triangles()[f];
        const LatticePoint& a = points()[t[0]];
        const Point3d u = minus(points()[t[1]].doubles(), a.doubles());
        const Point3d v = minus(points()[t[2]].doubles(), a.doubles());
        const double n =
            std::max({std::fabs(u[1] * v[2] - u[2] * v[1]), std::fabs(u[2] * v[0] - u[0] * v[2]),
                      std::fabs(u[0] * v[1] - u[1] * v[0])});
        if (n >= clear_) return;
        if (n <= degenerate_bound_ && are_collinear(a, points()[t[1]], points()[t[2]]))
            found.degenerate.push_back(f);
        if (!out_.report.lattice.lossless && n < flip_bound_ && rounding_flips(f)) ++found.flipped;
    }

    [[nodiscard]] bool rounding_flips(std::uint32_t f) const {
        return is_flipped(
            std::span<const std::uint32_t>(input_.triangles[f]),
            [&](std::uint32_t c) { return input_.points[c]; },
            [&](std::uint32_t c) {
                return out_.mesh.points[names_.empty() ? c : names_[c]].doubles();
            });
    }

    bool is_inside_out() const {
        if (std::fabs(sum_) > sum_bound_) return sum_ < 0;
        return volume_sign(out_.mesh.points, out_.mesh.triangles) < 0;
    }

    void drop_degenerate() {
        if (degenerate_.empty()) return;
        out_.report.degenerate_faces_dropped = degenerate_.size();
        add_face_defects(out_.report.defects, DefectKind::DegenerateFace, degenerate_,
                         degenerate_face_text, [&](std::uint32_t f) {
                             return to_user(points()[triangles()[f][0]], out_.mesh.lattice);
                         });
        std::vector<std::uint32_t>& face = out_.mesh.face_of_triangle;
        face.reserve(triangles().size() - degenerate_.size());
        auto dropped = degenerate_.begin();
        for (std::uint32_t f = 0; f < triangles().size(); ++f) {
            if (dropped != degenerate_.end() && *dropped == f) {
                ++dropped;
                continue;
            }
            triangles()[face.size()] = triangles()[f];
            face.push_back(f);
        }
        triangles().resize(face.size());
        out_.report.t_edges = count_net_edges(points().size(), triangles());
    }

    void drop_unused_points() {
        std::vector<std::uint8_t> used(points().size());
        for (const Triangle& t : triangles())
            for (const std::uint32_t v : t) used[v] = 1;
        std::vector<std::uint32_t> name(points().size());
        std::uint32_t n = 0;
        for (std::size_t i = 0; i < name.size(); ++i) {
            if (used[i] == 0) continue;
            points()[n] = points()[i];
            name[i] = n++;
        }
        points().resize(n);
        for (Triangle& t : triangles()) t = {name[t[0]], name[t[1]], name[t[2]]};
    }

    TriangleView input_;
    const ImportOptions& options_;
    Fractions fractions_;
    Sharing sharing_;
    ImportedMesh out_;
    std::vector<std::uint32_t> names_;  ///< of the input's points; empty: their indices
    std::vector<std::uint32_t> degenerate_;
    double sum_ = 0;  ///< six times the volume
    double sum_bound_ = 0;
    double degenerate_bound_ = 0;
    double flip_bound_ = 0;
    double clear_ = 0;
};

}  // namespace

namespace {

// How many of the threads that are wanted are worth it.
std::uint32_t threads_for(std::size_t size, std::uint32_t wanted, std::size_t least_part) {
    return size < 2 * least_part ? 1 : wanted;
}

}  // namespace

std::optional<ImportedMesh> import_triangles(const PolygonMesh& mesh, const ImportOptions& options,
                                             Fractions fractions, std::size_t least_part) {
    const std::size_t size = std::max(mesh.points.size(), mesh.face_count());
    return on_threads(threads_for(size, options.threads, least_part),
                      [&](std::uint32_t threads) -> std::optional<ImportedMesh> {
                          const Sharing sharing{threads, least_part};
                          if (!begins_by_threes(mesh, sharing)) return std::nullopt;
                          const TriangleView view = view_of(mesh);
                          if (!has_corners_in_range(view, sharing)) return std::nullopt;
                          return TriangleImporter(view, options, fractions, sharing).run();
                      });
}

std::optional<ImportedMesh> import_triangles(const TriangleView& mesh, const ImportOptions& options,
                                             Fractions fractions, std::size_t least_part) {
    const std::size_t size = std::max(mesh.points.size(), mesh.triangles.size());
    return on_threads(threads_for(size, options.threads, least_part),
                      [&](std::uint32_t threads) -> std::optional<ImportedMesh> {
                          const Sharing sharing{threads, least_part};
                          if (!has_corners_in_range(mesh, sharing)) return std::nullopt;
                          return TriangleImporter(mesh, options, fractions, sharing).run();
                      });
}

}  // namespace trisect::detail
