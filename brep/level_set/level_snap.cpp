// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/level_set/level_snap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <trisect/brep/level_set/level_link.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {
namespace {

constexpr double most_of_edge = 0.25;
// Of twelve in a cell: six times the volume of each, in cells.
constexpr double volume_of_tetrahedron = 0.5;
constexpr double least_volume = volume_of_tetrahedron / 8;

struct Candidate {
    double distance = 0;  // in cells
    std::size_t node = 0;
    std::size_t other = 0;
    std::size_t crossing = 0;
};

class Snap {
public:
    Snap(const LevelGrid& grid, std::span<const LevelCrossing> crossings,
         std::vector<std::int8_t>& signs)
        : grid_(grid), crossings_(crossings), signs_(signs) {}

    std::unordered_map<std::size_t, Point3d> run() {
        for (const Candidate& c : candidates()) {
            check_stop();
            if (signs_[c.node] == 0 || signs_[c.other] == 0) continue;
            const NodePoint p = grid_.point(c.node);
            if (!grid_.is_inner(p)) continue;
            const Point3d place = place_on_edge(grid_, crossings_[c.crossing]);
            if (keeps_volumes(p, place)) take(p, c.node, place);
        }
        return std::move(moved_);
    }

private:
    std::vector<Candidate> candidates() const {
        std::vector<Candidate> out;
        for (std::size_t i = 0; i < crossings_.size(); ++i) {
            const LevelCrossing& c = crossings_[i];
            const double length = c.direction < LevelGrid::short_directions ? std::sqrt(0.75) : 1;
            const std::size_t other = other_end(grid_, c);
            if (c.at <= most_of_edge) out.push_back({c.at * length, c.node, other, i});
            if (1 - c.at <= most_of_edge) out.push_back({(1 - c.at) * length, other, c.node, i});
        }
        std::ranges::sort(
            out, {}, [](const Candidate& c) { return std::tuple(c.distance, c.node, c.crossing); });
        return out;
    }

    Point3d place_of(const NodePoint& p) const {
        const std::size_t node = grid_.number(p);
        return signs_[node] == 0 ? moved_.at(node) : grid_.place(p);
    }

    bool keeps_volumes(const NodePoint& p, const Point3d& place) const {
        std::array<Vector3, LevelLink::neighbours> around{};
        for (int i = 0; i < LevelLink::neighbours; ++i) {
            const Point3d q = place_of(LevelLink::neighbour(p, i));
            for (std::size_t k = 0; k < 3; ++k)
                around[static_cast<std::size_t>(i)][k] = (q[k] - place[k]) / grid_.cell_size()[k];
        }
        return std::ranges::all_of(LevelLink::triangles(), [&](const LevelLink::Triangle& t) {
            return dot(around[t[0]], cross(around[t[1]], around[t[2]])) >= least_volume;
        });
    }

    bool has_one_curve(const NodePoint& p) const {
        std::array<std::int8_t, LevelLink::neighbours> around{};
        for (int i = 0; i < LevelLink::neighbours; ++i)
            around[static_cast<std::size_t>(i)] = signs_[grid_.number(LevelLink::neighbour(p, i))];
        return LevelLink::has_one_curve(around);
    }

    void take(const NodePoint& p, std::size_t node, const Point3d& place) {
        const std::int8_t before = std::exchange(signs_[node], std::int8_t{0});
        bool fits = has_one_curve(p);
        for (int i = 0; fits && i < LevelLink::neighbours; ++i) {
            const NodePoint q = LevelLink::neighbour(p, i);
            if (signs_[grid_.number(q)] == 0) fits = has_one_curve(q);
        }
        if (fits)
            moved_[node] = place;
        else
            signs_[node] = before;
    }

    const LevelGrid& grid_;
    std::span<const LevelCrossing> crossings_;
    std::vector<std::int8_t>& signs_;
    std::unordered_map<std::size_t, Point3d> moved_;
};

}  // namespace

std::unordered_map<std::size_t, Point3d> move_nodes_to_surface(
    const LevelGrid& grid, std::span<const LevelCrossing> crossings,
    std::vector<std::int8_t>& signs) {
    return Snap(grid, crossings, signs).run();
}

}  // namespace trisect::detail
