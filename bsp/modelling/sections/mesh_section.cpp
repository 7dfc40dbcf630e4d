// SPDX-License-Identifier: Apache-2.0
//
// A triangle with corners on both sides of the plane has one edge that goes down through it and one
// that goes up, and its side leads from the first to the second. A corner of the section is thus an
// edge of the mesh, or a corner of it that lies in the plane, and is found by that name.

#include <trisect/bsp/modelling/sections/mesh_section.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include <trisect/bsp/modelling/sections/section_numbers.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

// The sum of |n p| over the axes, which bounds errors of n . p.
double size_of_level(const Point3d& normal, const Point3d& p) {
    return std::fabs(normal[0] * p[0]) + std::fabs(normal[1] * p[1]) + std::fabs(normal[2] * p[2]);
}

}  // namespace

MeshSection::MeshSection(const PolygonMesh& mesh, const SliceFrame& frame)
    : frame_(frame), near_(mesh.points), is_double_(mesh.points.size(), 1) {
    triangles_.reserve(mesh.face_count());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto t = mesh.face(f);
        triangles_.push_back({t[0], t[1], t[2]});
    }
    find_levels();
}

MeshSection::MeshSection(const ExactMesh& mesh, const SliceFrame& frame)
    : frame_(frame),
      triangles_(mesh.triangles),
      near_(to_polygon_mesh(mesh).points),
      exact_(&mesh) {
    is_double_.reserve(near_.size());
    for (const Point& p : mesh.points) is_double_.push_back(p.is_lattice() ? 1 : 0);
    find_levels();
}

// Three products, two sums and the rounding of points: less than 2^-50 of the size together.
void MeshSection::find_levels() {
    const std::size_t w = frame_.along();
    const double sign = frame_.normal()[w];
    level_.reserve(near_.size());
    if (!frame_.is_axis()) error_.reserve(near_.size());
    for (const Point3d& p : near_) {
        if (frame_.is_axis()) {
            level_.push_back(sign * p[w]);
            continue;
        }
        const Point3d& n = frame_.normal();
        const double level = n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
        const double error = 0x1p-49 * size_of_level(n, p) + 0x1p-1000;
        const bool is_known = std::isfinite(level) && std::isfinite(error);
        level_.push_back(is_known ? level : 0);
        error_.push_back(is_known ? error : std::numeric_limits<double>::infinity());
    }
}

std::array<double, 2> MeshSection::range_of(std::uint32_t triangle) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::array<double, 2> out{infinite, -infinite};
    for (const std::uint32_t v : triangles_[triangle]) {
        const double error = error_.empty() ? 0 : error_[v];
        out = {std::min(out[0], level_[v] - error), std::max(out[1], level_[v] + error)};
    }
    return out;
}

// Along an axis the nearest double is on the same side, or in the plane.
int MeshSection::side_in_doubt(std::uint32_t v, double height) const {
    const double above = level_[v] - height;
    if (error_.empty()) {
        if (is_double_[v] != 0) return 0;
    } else if (std::fabs(above) > error_[v] + 0x1p-52 * std::fabs(height)) {
        return above > 0 ? 1 : -1;
    }
    return SectionNumbers::exact_side(*this, v, height);
}

bool MeshSection::has_face_in(const SectionPlane& plane) const {
    return std::ranges::any_of(plane.triangles, [&](std::uint32_t t) {
        return std::ranges::all_of(triangles_[t],
                                   [&](std::uint32_t v) { return side(v, plane.height) == 0; });
    });
}

namespace {

/// The corners of one section, by name.
class SectionCorners {
public:
    SectionCorners(const MeshSection& mesh, const SectionPlane& plane, MeshSection::Place place)
        : mesh_(mesh),
          height_(plane.height),
          in_plane_(place == MeshSection::Place::Below ? 1 : -1),
          named_(2 * plane.triangles.size()),
          numbers_(mesh, plane.height) {}

    void add(const MeshSection::Triangle& t) {
        const std::array<int, 3> at{mesh_.side(t[0], height_), mesh_.side(t[1], height_),
                                    mesh_.side(t[2], height_)};
        std::uint32_t down = none;
        std::uint32_t up = none;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const int from = at[k] == 0 ? in_plane_ : at[k];
            const int to = at[next] == 0 ? in_plane_ : at[next];
            if (from > 0 && to < 0) down = number(t[next], at[next], t[k], at[k]);
            if (from < 0 && to > 0) up = number(t[k], at[k], t[next], at[next]);
        }
        if (down == up) return;
        sides_.push_back({down, up});
        first_of_.push_back(&t);
        last_of_.push_back(&t);
    }

    [[nodiscard]] SectionSides finish() {
        leave_out_straight();
        SectionSides out;
        std::vector<std::uint32_t> place(ends_.size(), none);
        const auto placed = [&](std::uint32_t n) {
            if (place[n] == none) {
                place[n] = static_cast<std::uint32_t>(out.corners.size());
                out.corners.push_back(near_[n]);
                out.is_exact = out.is_exact && numbers_.is_exact(ends_[n], near_[n]);
            }
            return place[n];
        };
        for (const auto& [from, to] : sides_)
            if (from != none) {
                const std::uint32_t first = placed(from);
                out.sides.push_back({first, placed(to)});
            }
        return out;
    }

private:
    /// Numbers for pairs of numbers, in the order in which they come.
    class PairNumbers {
    public:
        /// For at most that many.
        explicit PairNumbers(std::size_t most) : slots_(std::bit_ceil(2 * most + 2)) {}

        /// The number, and whether it is a new one.
        std::pair<std::uint32_t, bool> find(std::uint32_t p, std::uint32_t q) {
            const std::uint64_t key = std::uint64_t{p} << 32U | q;
            std::size_t at = (key * 0x9e3779b97f4a7c15U) >> 20U & (slots_.size() - 1);
            while (slots_[at].number != none) {
                if (slots_[at].key == key) return {slots_[at].number, false};
                at = (at + 1) & (slots_.size() - 1);
            }
            slots_[at] = {key, count_};
            return {count_++, true};
        }

    private:
        struct Slot {
            std::uint64_t key = 0;
            std::uint32_t number = none;
        };
        std::vector<Slot> slots_;
        std::uint32_t count_ = 0;
    };

    using Ends = SectionNumbers::Name;
    std::uint32_t number(std::uint32_t below, int side_below, std::uint32_t above, int side_above) {
        if (side_below == 0) above = below;
        if (side_above == 0) below = above;
        const auto [n, is_new] = named_.find(below, above);
        if (is_new) {
            ends_.push_back({below, above});
            near_.push_back(numbers_.rounded(ends_.back()));
        }
        return n;
    }

    // Within an edge, sides are on one line where the triangles beside it are in one plane, and
    // nowhere else: the edge goes through the section's plane. Nothing where corners are no lattice
    // points, or doubles do not show whether the second side goes on or comes back.
    [[nodiscard]] std::optional<bool> goes_straight_by_triangles(
        std::uint32_t a, std::uint32_t b, std::uint32_t c, const MeshSection::Triangle& before,
        const MeshSection::Triangle& after) const {
        const auto [below, above] = ends_[b];
        if (below == above || mesh_.exact_mesh() == nullptr) return std::nullopt;
        const auto& points = mesh_.exact_mesh()->points;
        std::uint32_t apex = none;
        for (const std::uint32_t v : after)
            if (v != below && v != above) apex = v;
        for (const std::uint32_t v : {before[0], before[1], before[2], apex})
            if (!points[v].is_lattice()) return std::nullopt;
        const Plane plane = Plane::through(points[before[0]].lattice(), points[before[1]].lattice(),
                                           points[before[2]].lattice());
        if (side_of(points[apex].lattice(), plane) != Side::On) return false;
        const int along = sure_direction(near_[a], near_[b], near_[c]);
        if (along == 0) return std::nullopt;
        return along > 0;
    }
    [[nodiscard]] bool goes_straight(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                     const MeshSection::Triangle& before,
                                     const MeshSection::Triangle& after) const {
        if (surely_turns(near_[a], near_[b], near_[c])) return false;
        if (const auto known = goes_straight_by_triangles(a, b, c, before, after)) return *known;
        return numbers_.goes_straight(ends_[a], ends_[b], ends_[c]);
    }

    // Where one side comes and one goes on in its direction, both become one.
    void leave_out_straight() {
        std::vector<std::uint32_t> in(ends_.size(), none);
        std::vector<std::uint32_t> out(ends_.size(), none);
        std::vector<std::uint8_t> is_simple(ends_.size(), 1);
        for (std::uint32_t s = 0; s < sides_.size(); ++s) {
            const auto [from, to] = sides_[s];
            if (out[from] != none) is_simple[from] = 0;
            if (in[to] != none) is_simple[to] = 0;
            out[from] = s;
            in[to] = s;
        }
        for (std::uint32_t n = 0; n < ends_.size(); ++n) {
            if (is_simple[n] == 0 || in[n] == none || out[n] == none || in[n] == out[n]) continue;
            const std::uint32_t before = sides_[in[n]][0];
            const std::uint32_t after = sides_[out[n]][1];
            if (before == after ||
                !goes_straight(before, n, after, *last_of_[in[n]], *first_of_[out[n]]))
                continue;
            sides_[in[n]][1] = after;
            last_of_[in[n]] = last_of_[out[n]];
            if (in[after] == out[n]) in[after] = in[n];
            sides_[out[n]] = {none, none};
        }
    }

    const MeshSection& mesh_;
    double height_;
    int in_plane_;  // the side of what is in the plane
    PairNumbers named_;
    SectionNumbers numbers_;
    std::vector<Ends> ends_;
    std::vector<Point2d> near_;
    std::vector<std::array<std::uint32_t, 2>> sides_;
    // By side: the triangles in which it begins and ends, which differ where sides became one.
    std::vector<const MeshSection::Triangle*> first_of_;
    std::vector<const MeshSection::Triangle*> last_of_;
};

}  // namespace

SectionSides MeshSection::right(const SectionPlane& plane, Place place) const {
    check_stop(plane.triangles.size());
    SectionCorners corners(*this, plane, place);
    for (const std::uint32_t t : plane.triangles) corners.add(triangles_[t]);
    return corners.finish();
}

// Counted first, so that what is stored is as long as it must be.
SectionStack::SectionStack(const MeshSection& mesh, std::span<const double> heights)
    : heights_(heights.begin(), heights.end()) {
    for (const double height : heights)
        if (!std::isfinite(height)) throw UsageError("the height of a section must be finite");
    std::ranges::sort(heights_);
    heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
    check_stop(mesh.triangle_count());
    const auto planes_of = [&](std::uint32_t triangle) {
        const auto [low, high] = mesh.range_of(triangle);
        const auto first = std::lower_bound(heights_.begin(), heights_.end(), low);
        const auto end = std::upper_bound(first, heights_.end(), high);
        return std::pair(static_cast<std::size_t>(first - heights_.begin()),
                         static_cast<std::size_t>(end - heights_.begin()));
    };
    // How many more there are than in the plane before, and then where each plane begins.
    std::vector<std::int64_t> more(heights_.size() + 1, 0);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto [first, end] = planes_of(t);
        ++more[first];
        --more[end];
    }
    begin_.push_back(0);
    std::int64_t in_plane = 0;
    for (std::size_t i = 0; i < heights_.size(); ++i) {
        in_plane += more[i];
        begin_.push_back(begin_.back() + static_cast<std::size_t>(in_plane));
        if (begin_.back() > most_sides)
            throw LimitError("the slices have more than 2^31 sides altogether");
    }
    triangles_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
        for (auto [i, end] = planes_of(t); i < end; ++i) triangles_[next[i]++] = t;
}

}  // namespace trisect::detail
