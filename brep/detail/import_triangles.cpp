// SPDX-License-Identifier: Apache-2.0
//
// Nearly all meshes are triangles whose sides cancel by name. For them import is a handful of
// linear passes: round, weld, look at every triangle once, match the sides. Whatever is found to be
// otherwise is left to the long way, which starts afresh, so that only one place words errors.
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
//   positive. Else is_flipped is asked. Exponents are kept in a range where nothing overflows and
//   what underflows is far below m.
// - Volume. Six times the volume is the sum of N (a_z + b_z + c_z - 3 o_z) over all triangles, by
//   the divergence theorem for (0, 0, z), for any o. A term is below 6 D_x D_y D_z and has a
//   relative error of a few u; adding n of them costs n u of the sum of their sizes. A sum beyond
//   n (n + 16) 2^-52 times that bound has the right sign. Else volume_sign decides, exactly.

#include <trisect/brep/detail/import_triangles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/detail/import_findings.h>
#include <trisect/brep/detail/side_balance.h>
#include <trisect/brep/detail/volume_sign.h>
#include <trisect/brep/detail/weld_points.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

bool is_triangle_mesh(const PolygonMesh& mesh) {
    const std::vector<std::uint32_t>& begin = mesh.face_begin;
    const std::size_t n = mesh.points.size();
    if (begin.empty() || mesh.corners.size() != 3 * (begin.size() - 1)) return false;
    if (begin.size() > (std::size_t{1} << 30) || n >= (std::size_t{1} << 32)) return false;
    std::uint32_t wrong = 0;
    for (std::size_t f = 0; f < begin.size(); ++f)
        wrong |= begin[f] ^ static_cast<std::uint32_t>(3 * f);
    std::uint32_t largest = 0;
    for (const std::uint32_t c : mesh.corners) largest = std::max(largest, c);
    return wrong == 0 && (mesh.corners.empty() || largest < n);
}

// How far the points extend along each axis.
Point3d extents(std::span<const LatticePoint> points) {
    std::array<std::int64_t, 3> low;
    std::array<std::int64_t, 3> high;
    low.fill(coordinate_limit);
    high.fill(-coordinate_limit);
    for (const LatticePoint& p : points) {
        const std::array<std::int64_t, 3> c{p.x, p.y, p.z};
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], c[k]);
            high[k] = std::max(high[k], c[k]);
        }
    }
    Point3d d{};
    if (points.empty()) return d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = static_cast<double>(high[k] - low[k]);
    return d;
}

class TriangleImporter {
public:
    TriangleImporter(const PolygonMesh& mesh, const ImportOptions& options)
        : input_(mesh), options_(options) {}

    std::optional<ImportedMesh> run() {
        const Lattice lattice = options_.lattice.value_or(choose_lattice(input_.points));
        out_.mesh.lattice = lattice;
        check_stop(input_.points.size());
        points() = to_lattice(input_.points, lattice, out_.report.lattice);
        check_stop(input_.face_count());
        // A closed surface has half as many points as triangles, give or take.
        names_ = weld_in_place(points(), input_.face_count() / 2 + input_.face_count() / 16);
        out_.report.welded_points = input_.points.size() - points().size();
        check_stop();
        rename_corners();
        look_at_triangles();
        check_stop();
        if (!sides_cancel(points().size(), triangles())) return std::nullopt;
        out_.report.inside_out = is_inside_out();
        drop_degenerate();
        drop_unused_points();
        return std::move(out_);
    }

private:
    std::vector<LatticePoint>& points() { return out_.mesh.points; }
    std::vector<Triangle>& triangles() { return out_.mesh.triangles; }

    void rename_corners() {
        triangles().resize(input_.face_count());
        const std::uint32_t* corner = input_.corners.data();
        for (Triangle& t : triangles()) {
            t = {corner[0], corner[1], corner[2]};
            corner += 3;
        }
        if (names_.empty()) return;
        for (Triangle& t : triangles()) t = {names_[t[0]], names_[t[1]], names_[t[2]]};
    }

    void look_at_triangles() {
        set_bounds();
        used_.resize(points().size());
        // Bytes may alias anything: what the loop reads must not be read through `this`.
        std::uint8_t* const used = used_.data();
        const LatticePoint* const point = points().data();
        const double clear = clear_;
        const std::int64_t z0 = points().empty() ? 0 : 3 * points()[0].z;
        double sum = 0;
        std::uint32_t f = 0;
        for (const auto& [i, j, k] : triangles()) {
            const LatticePoint& a = point[i];
            const LatticePoint& b = point[j];
            const LatticePoint& c = point[k];
            used[i] = used[j] = used[k] = 1;
            const double n = static_cast<double>(b.x - a.x) * static_cast<double>(c.y - a.y) -
                             static_cast<double>(b.y - a.y) * static_cast<double>(c.x - a.x);
            sum += n * static_cast<double>(a.z + b.z + c.z - z0);
            if (std::fabs(n) < clear) look_closely(f);
            ++f;
        }
        sum_ = sum;
    }

    void set_bounds() {
        const Point3d d = extents(points());
        const double n = static_cast<double>(triangles().size());
        const double largest = std::max({d[0], d[1], d[2]});
        const double squares = largest * largest;
        sum_bound_ = n * (n + 16) * 0x1p-52 * 6 * d[0] * d[1] * d[2];
        degenerate_bound_ = 0x1p-49 * squares;
        flip_bound_ = 9 * (32 * largest + 32 + 0x1p-48 * squares);
        const bool in_range = std::abs(out_.mesh.lattice.exponent) <= 300;
        if (!in_range) flip_bound_ = HUGE_VAL;
        clear_ = out_.report.lattice.lossless ? degenerate_bound_ : flip_bound_;
        clear_ = std::max(clear_, 0.5);  // a component of zero is never clear
    }

    // For triangles whose normal is small or has a small z component.
    [[gnu::noinline]] void look_closely(std::uint32_t f) {
        const Triangle& t = triangles()[f];
        const LatticePoint& a = points()[t[0]];
        const Point3d u = as_doubles(points()[t[1]] - a);
        const Point3d v = as_doubles(points()[t[2]] - a);
        const double n =
            std::max({std::fabs(u[1] * v[2] - u[2] * v[1]), std::fabs(u[2] * v[0] - u[0] * v[2]),
                      std::fabs(u[0] * v[1] - u[1] * v[0])});
        if (n >= clear_) return;
        if (n <= degenerate_bound_ && are_collinear(a, points()[t[1]], points()[t[2]]))
            degenerate_.push_back(f);
        if (!out_.report.lattice.lossless && n < flip_bound_ && rounding_flips(f))
            ++out_.report.lattice.flipped_faces;
    }

    bool rounding_flips(std::uint32_t f) const {
        return is_flipped(
            input_.face(f), [&](std::uint32_t c) { return input_.points[c]; },
            [&](std::uint32_t c) {
                return as_doubles(out_.mesh.points[names_.empty() ? c : names_[c]]);
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
        std::fill(used_.begin(), used_.end(), std::uint8_t{0});
        auto dropped = degenerate_.begin();
        for (std::uint32_t f = 0; f < triangles().size(); ++f) {
            if (dropped != degenerate_.end() && *dropped == f) {
                ++dropped;
                continue;
            }
            for (const std::uint32_t v : triangles()[f]) used_[v] = 1;
            triangles()[face.size()] = triangles()[f];
            face.push_back(f);
        }
        triangles().resize(face.size());
    }

    void drop_unused_points() {
        if (std::find(used_.begin(), used_.end(), std::uint8_t{0}) == used_.end()) return;
        std::vector<std::uint32_t> name(points().size());
        std::uint32_t n = 0;
        for (std::size_t i = 0; i < name.size(); ++i) {
            if (used_[i] == 0) continue;
            points()[n] = points()[i];
            name[i] = n++;
        }
        points().resize(n);
        for (Triangle& t : triangles()) t = {name[t[0]], name[t[1]], name[t[2]]};
    }

    const PolygonMesh& input_;
    const ImportOptions& options_;
    ImportedMesh out_;
    std::vector<std::uint32_t> names_;  ///< of the input's points; empty: their indices
    std::vector<std::uint8_t> used_;
    std::vector<std::uint32_t> degenerate_;
    double sum_ = 0;  ///< six times the volume
    double sum_bound_ = 0;
    double degenerate_bound_ = 0;
    double flip_bound_ = 0;
    double clear_ = 0;
};

}  // namespace

std::optional<ImportedMesh> import_triangles(const PolygonMesh& mesh,
                                             const ImportOptions& options) {
    if (!is_triangle_mesh(mesh)) return std::nullopt;
    return TriangleImporter(mesh, options).run();
}

}  // namespace trisect::detail
