// SPDX-License-Identifier: Apache-2.0
//
// A tree grows from the root, breadth first, so that the children of a node are next to each other.
// A rule divides the triangles of a node into groups; it may also say where it wants the centres. A
// node's sphere is the smaller one of that about the wanted centre and of a fitted one (but spheres
// of `Vertices` stay where they were put, or they would not be what they are called).
//
// The medial axis. A ball inside of the solid that touches its boundary in several places covers
// much of it and stands out little. Of the balls that belong to a node's vertices eight are chosen
// so that the sum of the volumes of the spheres that result is small: simulated annealing over
// exchanges of one ball (Hubbard 1996 improves his medial spheres the same way). Everything is
// sampled to a bounded size, and the random numbers of a node depend on its number alone.

#include <trisect/bsp/hierarchies/volumes/sphere_trees.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <utility>

#include <trisect/bsp/hierarchies/volumes/kdop.h>
#include <trisect/bsp/hierarchies/volumes/medial_balls.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::hierarchies {

namespace {

using detail::Vector3;

constexpr std::size_t arity = 8;
constexpr std::size_t leaf_triangles = 4;

// A group of the triangles of a node, by the numbers that `assign` gives them.
struct Division {
    std::vector<std::uint8_t> group;              // of each triangle, in the order of the node
    std::vector<std::optional<Vector3>> centers;  // of each group, where wanted
};

// Data of the model for all rules, in units of the frame.
struct Surface {
    const detail::InterferenceModelData& model;
    TreeFrame frame;
    std::vector<std::array<Vector3, 3>> corners;

    explicit Surface(const detail::InterferenceModelData& m) : model(m), frame(m) {
        corners.reserve(m.triangles.size());
        for (const detail::ModelTriangle& t : m.triangles)
            corners.push_back({frame(m.position(t.vertex[0])), frame(m.position(t.vertex[1])),
                               frame(m.position(t.vertex[2]))});
    }
    [[nodiscard]] Vector3 middle(std::uint32_t t) const {
        Vector3 c{};
        for (const Vector3& p : corners[t])
            for (std::size_t k = 0; k < 3; ++k) c[k] += p[k] / 3;
        return c;
    }
    // How large a sphere about `center` must be for the triangle.
    [[nodiscard]] double reach(const Vector3& center, std::uint32_t t) const {
        double most = 0;
        for (const Vector3& p : corners[t]) most = std::max(most, squared_distance(p, center));
        return std::sqrt(most);
    }
};

class OctreeRule {
public:
    explicit OctreeRule(const Surface& surface) : surface_(surface), cells_{{{0, 0, 0}, 1}} {}

    static constexpr bool keeps_centers = false;

    Division divide(std::uint32_t node, std::span<const std::uint32_t> triangles) {
        Cell cell = cells_[node];
        Division d;
        // Cubes with everything in one eighth are passed over.
        do {
            d.group.clear();
            unsigned used = 0;
            for (const std::uint32_t t : triangles) {
                const Vector3 m = surface_.middle(t);
                unsigned octant = 0;
                for (std::size_t k = 0; k < 3; ++k)
                    if (m[k] > cell.center[k]) octant |= 1U << k;
                d.group.push_back(static_cast<std::uint8_t>(octant));
                used |= 1U << octant;
            }
            if ((used & (used - 1)) != 0) break;
            cell = cell.eighth(d.group.front());
        } while (cell.half > 0x1p-40);
        d.centers.resize(arity);
        divided_ = cell;
        return d;
    }
    void add_child(std::size_t group) { cells_.push_back(divided_.eighth(group)); }

private:
    struct Cell {
        Vector3 center{};
        double half = 1;
        [[nodiscard]] Cell eighth(std::size_t octant) const {
            Cell c{center, 0.5 * half};
            for (std::size_t k = 0; k < 3; ++k)
                c.center[k] += (octant >> k & 1U) != 0 ? c.half : -c.half;
            return c;
        }
    };

    const Surface& surface_;
    std::vector<Cell> cells_;  // of each node
    Cell divided_;
};

// Each triangle to the centre from which it needs the smallest sphere.
void assign_to_centers(const Surface& surface, std::span<const std::uint32_t> triangles,
                       Division& d) {
    d.group.clear();
    for (const std::uint32_t t : triangles) {
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t g = 0; g < d.centers.size(); ++g)
            if (const double r = surface.reach(*d.centers[g], t); r < least) {
                least = r;
                best = g;
            }
        d.group.push_back(static_cast<std::uint8_t>(best));
    }
}

class VerticesRule {
public:
    explicit VerticesRule(const Surface& surface) : surface_(surface) {}

    static constexpr bool keeps_centers = true;

    // Each next vertex is the one that is farthest from those before it (Gonzalez 1985).
    Division divide(std::uint32_t /*node*/, std::span<const std::uint32_t> triangles) {
        Division d;
        std::vector<Vector3> points;
        for (const std::uint32_t t : triangles)
            for (const Vector3& p : surface_.corners[t]) points.push_back(p);
        std::vector<double> away(points.size(), std::numeric_limits<double>::infinity());
        std::size_t next = 0;
        while (d.centers.size() < arity && away[next] > 0) {
            d.centers.emplace_back(points[next]);
            for (std::size_t i = 0; i < points.size(); ++i)
                away[i] = std::min(away[i], squared_distance(points[i], points[next]));
            next = static_cast<std::size_t>(std::ranges::max_element(away) - away.begin());
        }
        assign_to_centers(surface_, triangles, d);
        return d;
    }
    void add_child(std::size_t /*group*/) {}

private:
    const Surface& surface_;
};

class MedialRule {
public:
    explicit MedialRule(const Surface& surface)
        : surface_(surface), ball_of_vertex_(surface.model.positions.size()) {
        for (const MedialBall& b : medial_balls(surface.model, surface.frame, 2048))
            ball_of_vertex_[b.vertex] = b.center;
    }

    static constexpr bool keeps_centers = false;

    Division divide(std::uint32_t node, std::span<const std::uint32_t> triangles) {
        std::mt19937_64 random(node + 1);
        const std::vector<Vector3> candidates = candidates_of(triangles, random);
        std::vector<std::uint32_t> sample(triangles.begin(), triangles.end());
        if (sample.size() > max_sample) {
            std::ranges::shuffle(sample, random);
            sample.resize(max_sample);
        }
        Division d;
        for (const std::size_t c : anneal(candidates, sample, random))
            d.centers.emplace_back(candidates[c]);
        assign_to_centers(surface_, triangles, d);
        return d;
    }
    void add_child(std::size_t /*group*/) {}

private:
    static constexpr std::size_t max_candidates = 48;
    static constexpr std::size_t max_sample = 192;
    static constexpr int exchanges = 160;

    // Centres of balls of the vertices, and middles of triangles where there are too few.
    [[nodiscard]] std::vector<Vector3> candidates_of(std::span<const std::uint32_t> triangles,
                                                     std::mt19937_64& random) const {
        std::vector<Vector3> c;
        for (const std::uint32_t t : triangles)
            for (const VertexId v : surface_.model.triangles[t].vertex)
                if (ball_of_vertex_[v.index]) c.push_back(*ball_of_vertex_[v.index]);
        std::ranges::shuffle(c, random);
        if (c.size() > max_candidates - arity) c.resize(max_candidates - arity);
        const std::size_t step = std::max<std::size_t>(1, triangles.size() / arity);
        for (std::size_t i = 0; i < triangles.size() && c.size() < max_candidates; i += step)
            c.push_back(surface_.middle(triangles[i]));
        return c;
    }

    // Numbers of the candidates chosen.
    [[nodiscard]] std::vector<std::size_t> anneal(const std::vector<Vector3>& candidates,
                                                  const std::vector<std::uint32_t>& sample,
                                                  std::mt19937_64& random) const {
        std::vector<double> reach(candidates.size() * sample.size());
        for (std::size_t c = 0; c < candidates.size(); ++c)
            for (std::size_t i = 0; i < sample.size(); ++i)
                reach[c * sample.size() + i] = surface_.reach(candidates[c], sample[i]);
        const auto cost_of = [&](const std::vector<std::size_t>& chosen) {
            std::array<double, arity> radius{};
            for (std::size_t i = 0; i < sample.size(); ++i) {
                std::size_t best = 0;
                for (std::size_t g = 1; g < chosen.size(); ++g)
                    if (reach[chosen[g] * sample.size() + i] <
                        reach[chosen[best] * sample.size() + i])
                        best = g;
                radius[best] = std::max(radius[best], reach[chosen[best] * sample.size() + i]);
            }
            double sum = 0;
            for (const double r : radius) sum += r * r * r;
            return sum;
        };
        std::vector<std::size_t> all(candidates.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        std::ranges::shuffle(all, random);
        std::vector<std::size_t> chosen(
            all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(arity, all.size())));
        double cost = cost_of(chosen);
        std::vector<std::size_t> best = chosen;
        double least = cost;
        double temperature = 0.2 * cost;
        for (int step = 0; step < exchanges && chosen.size() < all.size(); ++step) {
            std::vector<std::size_t> other = chosen;
            other[random() % other.size()] = random() % candidates.size();
            const double changed = cost_of(other);
            const double chance = static_cast<double>(random() >> 11) * detail::unit_roundoff;
            if (changed < cost || std::exp((cost - changed) / temperature) > chance) {
                chosen = std::move(other);
                cost = changed;
                if (cost < least) {
                    least = cost;
                    best = chosen;
                }
            }
            temperature *= 0.96;
        }
        return best;
    }

    const Surface& surface_;
    std::vector<std::optional<Vector3>> ball_of_vertex_;
};

template <class Rule>
class Builder {
public:
    explicit Builder(const detail::InterferenceModelData& model)
        : surface_(model), rule_(surface_) {
        shape_.order.resize(model.triangles.size());
        std::iota(shape_.order.begin(), shape_.order.end(), 0U);
    }

    SphereTree run() {
        add_node({0, shape_.order.size(), 1}, std::nullopt);
        for (std::uint32_t node = 0; node < parts_.size(); ++node) {
            const Part part = parts_[node];
            shape_.depth = std::max(shape_.depth, part.level);
            if (part.end - part.begin <= leaf_triangles)
                shape_.nodes[node] = {static_cast<std::uint32_t>(part.begin),
                                      static_cast<std::uint16_t>(part.end - part.begin), true};
            else
                divide(node, part);
        }
        return {surface_.frame, std::move(shape_), std::move(volumes_)};
    }

private:
    struct Part {
        std::size_t begin;
        std::size_t end;
        unsigned level;
    };

    void add_node(const Part& part, const std::optional<Vector3>& center) {
        std::vector<Vector3> corners;
        for (std::size_t i = part.begin; i < part.end; ++i)
            for (const Vector3& p : surface_.corners[shape_.order[i]]) corners.push_back(p);
        const double error = surface_.frame.error;
        Sphere sphere;
        if (center) sphere = SphereKind::fit_about(*center, corners, error);
        if (!center || !Rule::keeps_centers) {
            const Sphere fitted = SphereKind::fit(corners, error);
            if (!center || fitted.radius < sphere.radius) sphere = fitted;
        }
        parts_.push_back(part);
        shape_.nodes.emplace_back();
        volumes_.push_back(sphere);
    }

    void divide(std::uint32_t node, const Part& part) {
        const std::span<std::uint32_t> triangles =
            std::span(shape_.order).subspan(part.begin, part.end - part.begin);
        Division d = rule_.divide(node, triangles);
        if (std::ranges::count(d.group, d.group.front()) ==
            static_cast<std::ptrdiff_t>(d.group.size()))
            deal_out(d);

        const std::vector<std::uint32_t> before(triangles.begin(), triangles.end());
        const auto first = static_cast<std::uint32_t>(parts_.size());
        std::size_t at = part.begin;
        std::uint16_t count = 0;
        for (std::size_t g = 0; g < d.centers.size(); ++g) {
            const std::size_t begin = at;
            for (std::size_t i = 0; i < before.size(); ++i)
                if (d.group[i] == g) shape_.order[at++] = before[i];
            if (at == begin) continue;
            add_node({begin, at, part.level + 1}, d.centers[g]);
            rule_.add_child(g);
            ++count;
        }
        shape_.nodes[node] = {first, count, false};
    }
    // Triangles that a rule cannot decide apart: by their order.
    static void deal_out(Division& d) {
        d.centers.assign(arity, std::nullopt);
        for (std::size_t i = 0; i < d.group.size(); ++i)
            d.group[i] = static_cast<std::uint8_t>(i * arity / d.group.size());
    }

    Surface surface_;
    Rule rule_;
    TreeShape shape_;
    std::vector<Sphere> volumes_;
    std::vector<Part> parts_;
};

}  // namespace

SphereTree build_sphere_tree(const detail::InterferenceModelData& model,
                             SphereConstruction construction) {
    switch (construction) {
        case SphereConstruction::Octree:
            return Builder<OctreeRule>(model).run();
        case SphereConstruction::MedialAxis:
            return Builder<MedialRule>(model).run();
        case SphereConstruction::Vertices:
            break;
    }
    return Builder<VerticesRule>(model).run();
}

std::vector<SphereLevel> tightness(const InterferenceModel& model, const SphereTree& tree,
                                   std::size_t most) {
    const double lattice_unit = std::ldexp(1.0, model.lattice().exponent);
    // A point of the sphere is at most its radius farther outside than the centre.
    const auto protrusion = [&](const Sphere& s) {
        Vector3 center;
        for (std::size_t k = 0; k < 3; ++k)
            center[k] = lattice_unit *
                        (tree.frame.origin[k] + tree.frame.unit * static_cast<double>(s.center[k]));
        const double radius = lattice_unit * tree.frame.unit * static_cast<double>(s.radius);
        const auto distance = model.index().distance(center);
        const bool inside = model.index().locate(center).location == Location::Inside;
        return std::max(0.0, radius + (inside ? -distance->lo : distance->hi)) *
               detail::surely_more;
    };
    std::vector<SphereLevel> levels;
    std::vector<std::uint32_t> nodes{0};
    for (;;) {
        SphereLevel level;
        level.spheres = nodes.size();
        for (const std::uint32_t n : nodes) {
            const double p = protrusion(tree.volumes[n]);
            level.largest_protrusion = std::max(level.largest_protrusion, p);
            level.mean_protrusion += p / static_cast<double>(nodes.size());
            const double radius =
                lattice_unit * tree.frame.unit * static_cast<double>(tree.volumes[n].radius);
            level.volume += 4.0 / 3 * std::numbers::pi * radius * radius * radius;
        }
        levels.push_back(level);
        std::vector<std::uint32_t> below;
        for (const std::uint32_t n : nodes) {
            const TreeNode& node = tree.shape.nodes[n];
            if (node.leaf) {
                below.push_back(n);
                continue;
            }
            for (std::uint32_t k = 0; k < node.count; ++k) below.push_back(node.first + k);
        }
        if (below.size() == nodes.size() || below.size() > most) return levels;
        nodes = std::move(below);
    }
}

namespace {

std::string_view name_of(SphereConstruction construction) {
    switch (construction) {
        case SphereConstruction::Octree:
            return "sphere-octree";
        case SphereConstruction::MedialAxis:
            return "sphere-medial";
        case SphereConstruction::Vertices:
            break;
    }
    return "sphere-vertices";
}

double reach_of(const Sphere& a, const Sphere& b) {
    return static_cast<double>(a.radius) + static_cast<double>(b.radius);
}

// Points of the spheres are not farther apart than this.
double farthest_points(const Sphere& a, const Sphere& b) {
    return (std::sqrt(squared_distance(a.middle(), b.middle())) + reach_of(a, b)) *
           detail::surely_more;
}

// B moved along d, |d| = 1, by this or more does not meet A. Rounded up: numbers are of the size of
// the distance and the radii, and a root of what is off by 2^-48 of a square by 2^-24 of it.
double last_contact(const Sphere& a, const Sphere& b, const Vector3& d) {
    const Vector3 w = detail::minus(b.middle(), a.middle());
    const double along = detail::dot(w, d);
    const double reach = reach_of(a, b);
    const double scale = detail::dot(w, w) + reach * reach;
    const double square = reach * reach - (detail::dot(w, w) - along * along) + 0x1p-46 * scale;
    if (square < 0) return 0;
    const double exit = std::sqrt(square) - along + 0x1p-46 * std::sqrt(scale);
    return exit > 0 ? exit * detail::surely_more : 0;
}

}  // namespace

SphereTrees::SphereTrees(const InterferenceModel& a, const InterferenceModel& b,
                         SphereConstruction construction)
    : VolumeHierarchy(
          a, b,
          [=](const detail::InterferenceModelData& m) {
              return build_sphere_tree(m, construction);
          },
          name_of(construction)) {}

template <class Take>
void SphereTrees::open_larger(std::uint32_t i, std::uint32_t j, Take&& take) const {
    const TreeNode& na = a_.shape.nodes[i];
    const TreeNode& nb = b_.shape.nodes[j];
    const bool opens_b =
        na.leaf || (!nb.leaf && b_.volumes[j].radius * static_cast<float>(b_.frame.unit) >
                                    a_.volumes[i].radius * static_cast<float>(a_.frame.unit));
    if (opens_b)
        for (std::uint32_t k = 0; k < nb.count; ++k) take(i, nb.first + k);
    else
        for (std::uint32_t k = 0; k < na.count; ++k) take(na.first + k, j);
}

AnytimeAnswer SphereTrees::answer_within(std::uint64_t tests, CostCounters& counters) {
    if (!pose_) update(counters);
    struct Open {
        double gap;
        std::uint32_t a;
        std::uint32_t b;
    };
    const auto later = [](const Open& x, const Open& y) { return x.gap > y.gap; };
    std::vector<Open> open;
    AnytimeAnswer answer;
    answer.at_most = std::numeric_limits<double>::infinity();
    const auto push = [&](std::uint32_t i, std::uint32_t j, double least) {
        ++answer.tests;
        const Moved moved = pose_->moved(b_.volumes[j]);
        answer.at_most =
            std::min(answer.at_most, a_.frame.unit * farthest_points(a_.volumes[i], moved));
        open.push_back({std::max(least, a_.frame.unit * pose_->gap(a_.volumes[i], moved)), i, j});
        std::ranges::push_heap(open, later);
    };
    push(0, 0, 0);
    while (answer.tests < tests) {
        const Open o = open.front();
        const TreeNode& na = a_.shape.nodes[o.a];
        const TreeNode& nb = b_.shape.nodes[o.b];
        if (na.leaf && nb.leaf) break;  // spheres cannot decide more
        std::ranges::pop_heap(open, later);
        open.pop_back();
        open_larger(o.a, o.b, [&](std::uint32_t i, std::uint32_t j) { push(i, j, o.gap); });
    }
    counters.volume_tests += answer.tests;
    answer.at_least = open.front().gap;
    answer.apart = answer.at_least > 0;
    return answer;
}

// Spheres meet last, when B goes along d, where the distance of their centres w + s d is the sum of
// their radii for the second time, or they never meet. When no spheres of a level meet any more the
// boundaries do not meet from there on, and since the solids are apart in the end they are apart
// all the way.
AnytimeDepth SphereTrees::depth_within(std::uint64_t tests, CostCounters& counters) {
    if (!pose_) update(counters);
    struct Open {
        double exit;
        std::uint32_t a;
        std::uint32_t b;
    };
    struct Direction {
        Vector3 d{};
        std::vector<Open> open;  // a heap, the pair that is left last in front
        bool done = false;
        [[nodiscard]] double bound() const { return open.front().exit; }
    };
    const auto sooner = [](const Open& x, const Open& y) { return x.exit < y.exit; };
    AnytimeDepth answer;
    const auto push = [&](Direction& way, std::uint32_t i, std::uint32_t j, double most) {
        ++answer.tests;
        const double exit = last_contact(a_.volumes[i], pose_->moved(b_.volumes[j]), way.d);
        way.open.push_back({std::min(most, exit), i, j});
        std::ranges::push_heap(way.open, sooner);
    };
    std::vector<Direction> ways;
    for (const double sign : {1.0, -1.0})
        for (const auto& axis : KDop<26>::directions) {
            Direction& way = ways.emplace_back();
            const double length =
                std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
            for (std::size_t k = 0; k < 3; ++k) way.d[k] = sign * axis[k] / length;
            push(way, 0, 0, std::numeric_limits<double>::infinity());
        }
    const auto best_open = [&ways]() -> Direction* {
        Direction* best = nullptr;
        for (Direction& w : ways)
            if (!w.done && (best == nullptr || w.bound() < best->bound())) best = &w;
        return best;
    };
    for (Direction* way = best_open(); way != nullptr && answer.tests < tests; way = best_open()) {
        const Open o = way->open.front();
        if (!(o.exit > 0) || (a_.shape.nodes[o.a].leaf && b_.shape.nodes[o.b].leaf)) {
            way->done = true;
            continue;
        }
        std::ranges::pop_heap(way->open, sooner);
        way->open.pop_back();
        open_larger(o.a, o.b, [&](std::uint32_t i, std::uint32_t j) { push(*way, i, j, o.exit); });
    }
    counters.volume_tests += answer.tests;
    const Direction& best = *std::ranges::min_element(ways, {}, &Direction::bound);
    answer.at_most = a_.frame.unit * best.bound();
    answer.direction = best.d;
    return answer;
}

std::unique_ptr<PairStructure> make_octree_spheres(const InterferenceModel& a,
                                                   const InterferenceModel& b) {
    return std::make_unique<SphereTrees>(a, b, SphereConstruction::Octree);
}
std::unique_ptr<PairStructure> make_medial_spheres(const InterferenceModel& a,
                                                   const InterferenceModel& b) {
    return std::make_unique<SphereTrees>(a, b, SphereConstruction::MedialAxis);
}
std::unique_ptr<PairStructure> make_vertex_spheres(const InterferenceModel& a,
                                                   const InterferenceModel& b) {
    return std::make_unique<SphereTrees>(a, b, SphereConstruction::Vertices);
}

}  // namespace trisect::hierarchies
