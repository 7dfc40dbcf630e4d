// SPDX-License-Identifier: Apache-2.0
//
// Why nothing is missed. Let x be a point of the polygon and of a triangle t of the boundary. Take
// a point y inside of t, near x and on no plane but its own. Inside and outside meet at y, so the
// way of y through the tree ends on a node's plane, that of t; x is in the closure of every region
// on that way. At each node x is on the side of y or on the plane, and where it is on the plane, or
// so near that doubles cannot decide, both sides are visited. So the polygon, cut on the safe side,
// comes to that node and touches its plane, where t is listed. Splitting planes above change
// nothing: y is on none of them.
//
// Cuts. A corner's value n·x + d has an error below 2^-49 of the sum of magnitudes, and what the
// corner's own error makes of it; `bound` is the largest of both. A polygon is cut at twice the
// bound beyond the plane: the value of the new corner is off by less than the bound, so all that is
// truly on this side stays. A new corner is off by 2^-51 of the largest coordinate across its edge;
// the error has room for 64 cuts, and a polygon is not cut more often.

#include <trisect/bsp/hierarchies/partitions/plane_tree.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/interference/boxes/box_gap.h>
#include <trisect/kernel/convex_polygon.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>

namespace trisect::hierarchies {

using detail::Vector3;

namespace {

constexpr std::uint32_t most_cuts = 64;
/// Where planes meet at small angles, what is within the errors of both is this much longer.
constexpr double much = 0x1p16;

struct Value {
    double at = 0;
    double bound = 0;
};

Value value_of(const Vector3& n, double d, const Vector3& p, double error) {
    double terms = std::abs(d);
    double normals = 0;
    double at = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double term = n[k] * p[k];
        at += term;
        terms += std::abs(term);
        normals += std::abs(n[k]);
    }
    return {at + d, 0x1p-49 * terms + 1.01 * (error * normals)};
}

// Its triangle may reach out of the cell that it is indexed in.
MspPolygon msp_polygon(const detail::InterferenceModelData& model,
                       const detail::ModelTriangle& triangle) {
    std::array<LatticePoint, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = model.brep.point(triangle.vertex[k]).lattice();
    MspPolygon r{ConvexPolygon::from_triangle(p[0], p[1], p[2]), triangle.face.index, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        const bool is_diagonal = !triangle.edge[k].is_valid();
        r.edges.push_back(is_diagonal ? MspPolygon::none : triangle.edge[k].index);
        r.vertices.push_back(triangle.vertex[k].index);
    }
    return r;
}

}  // namespace

RoughPolygon RoughPolygon::triangle(const Vector3& a, const Vector3& b, const Vector3& c,
                                    double error) {
    RoughPolygon r;
    r.count = 3;
    r.corner[0] = a;
    r.corner[1] = b;
    r.corner[2] = c;
    double far = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (const double v : r.corner[i]) far = std::max(far, std::abs(v));
    r.error = error + 0x1p-44 * far;
    return r;
}

bool PlaneTree::Values::all_below(std::uint32_t count) const {
    return std::all_of(at.begin(), at.begin() + count, [this](double v) { return v < -bound; });
}

bool PlaneTree::Values::all_above(std::uint32_t count) const {
    return std::all_of(at.begin(), at.begin() + count, [this](double v) { return v > bound; });
}

PlaneTree::Node PlaneTree::node_of(const Plane& plane) {
    Node n;
    for (int k = 0; k < 3; ++k) n.normal[static_cast<std::size_t>(k)] = plane.approx_normal(k);
    n.offset = plane.approx_offset();
    return n;
}

PlaneTree::Values PlaneTree::values_of(const Node& node, const RoughPolygon& polygon) {
    Values r;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Value v = value_of(node.normal, node.offset, polygon.corner[i], polygon.error);
        r.at[i] = v.at;
        r.bound = std::max(r.bound, v.bound);
    }
    return r;
}

RoughPolygon PlaneTree::part(const RoughPolygon& polygon, const Values& values, double sign) {
    const double level = 2 * values.bound;
    RoughPolygon r;
    r.error = polygon.error;
    r.cuts = polygon.cuts + 1;
    const bool is_cut = polygon.cuts < most_cuts && polygon.count + 1 < RoughPolygon::most_corners;
    bool has_depth = false;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const std::size_t j = (i + 1) % polygon.count;
        const double p = sign * values.at[i];
        const double q = sign * values.at[j];
        has_depth = has_depth || p < -much * level;
        if (!is_cut) continue;
        if (p <= level) r.corner[r.count++] = polygon.corner[i];
        if ((p <= level) == (q <= level)) continue;
        const double t = std::clamp((level - p) / (q - p), 0.0, 1.0);
        for (std::size_t k = 0; k < 3; ++k)
            r.corner[r.count][k] =
                polygon.corner[i][k] + t * (polygon.corner[j][k] - polygon.corner[i][k]);
        ++r.count;
    }
    if (!is_cut) r = polygon;
    r.is_thin = polygon.is_thin || !has_depth;
    return r;
}

bool PlaneTree::push(const RoughPolygon& polygon, const Box& box,
                     FunctionRef<bool(std::uint32_t)> offer, CostCounters& counters) {
    for (const std::uint32_t i : strays_)
        if (offer(i)) return true;
    tasks_.assign(1, {root_, false, polygon});
    while (!tasks_.empty()) {
        Task task = tasks_.back();
        tasks_.pop_back();
        // What is on one side of a plane goes on as it is.
        while (task.ref >= 0) {
            ++counters.volume_tests;
            const auto at = static_cast<std::size_t>(task.ref);
            const Node& node = nodes_[at];
            if (at < splitters_.size()) {
                const bool near_below = splitters_[at].below.meets(box);
                const bool near_above = splitters_[at].above.meets(box);
                if (!near_below || !near_above) {
                    task.ref = near_below ? node.below : near_above ? node.above : nowhere;
                    continue;
                }
            }
            const Values values = values_of(node, task.polygon);
            if (values.all_below(task.polygon.count)) {
                task.ref = node.below;
                continue;
            }
            if (values.all_above(task.polygon.count)) {
                task.ref = node.above;
                continue;
            }
            const RoughPolygon below = part(task.polygon, values, 1);
            // A line in a node's plane has regions of faces on both sides; they are visited.
            if (!task.is_flat && node.on != out && node.on != in)
                tasks_.push_back({node.on, true, part(below, values_of(node, below), -1)});
            const RoughPolygon above = part(task.polygon, values, -1);
            if (above.count != 0) tasks_.push_back({node.above, task.is_flat, above});
            task.polygon = below;
            task.ref = below.count != 0 ? node.below : nowhere;
        }
        if (task.ref > first_list || task.ref == nowhere) continue;
        for (const std::uint32_t i : list(task.ref))
            if (offer(i)) return true;
    }
    return false;
}

// A region beyond a plane is at least as far as the plane; what is on a plane likewise. Beyond a
// splitting plane it is as far as the box around the boundary there.
void PlaneTree::find_near(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                          CostCounters& counters) {
    for (const std::uint32_t i : strays_) limit = offer(i);
    near_tasks_.assign(1, {0, root_});
    while (!near_tasks_.empty()) {
        const NearTask task = near_tasks_.back();
        near_tasks_.pop_back();
        if (task.least > limit) continue;
        if (task.ref <= first_list) {
            for (const std::uint32_t i : list(task.ref)) limit = offer(i);
            continue;
        }
        if (task.ref < 0) continue;
        ++counters.volume_tests;
        const auto index = static_cast<std::size_t>(task.ref);
        const Node& node = nodes_[index];
        if (index < splitters_.size()) {
            const double below = std::max(task.least, gap_between(splitters_[index].below, box));
            const double above = std::max(task.least, gap_between(splitters_[index].above, box));
            const bool first_below = below <= above;
            near_tasks_.push_back(first_below ? NearTask{above, node.above}
                                              : NearTask{below, node.below});
            near_tasks_.push_back(first_below ? NearTask{below, node.below}
                                              : NearTask{above, node.above});
            continue;
        }
        Vector3 middle{};
        double reach = 0;
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = 0.5 * box.lo[k] + 0.5 * box.hi[k];
            reach += std::abs(node.normal[k]) * (0.5 * box.hi[k] - 0.5 * box.lo[k]);
            square += node.normal[k] * node.normal[k];
        }
        const Value v = value_of(node.normal, node.offset, middle, 0);
        const double gap =
            (std::abs(v.at) - reach * detail::surely_more - 2 * v.bound) / std::sqrt(square);
        const double beyond = std::max(task.least, gap * detail::surely_less);
        // The nearer side is taken from the stack first.
        const bool is_below = v.at < 0;
        near_tasks_.push_back({beyond, is_below ? node.above : node.below});
        near_tasks_.push_back({beyond, node.on});
        near_tasks_.push_back({task.least, is_below ? node.below : node.above});
    }
}

std::optional<bool> PlaneTree::is_inside(const Vector3& p, double error,
                                         CostCounters& counters) const {
    Ref at = root_;
    while (at >= 0) {
        ++counters.volume_tests;
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        const Value v = value_of(node.normal, node.offset, p, error);
        if (std::abs(v.at) <= v.bound) return std::nullopt;
        at = v.at < 0 ? node.below : node.above;
    }
    return at == in;
}

// A concave function is climbed by its subgradients: always away from the nearest plane, in steps
// that become smaller, from anywhere.
InnerBall PlaneTree::ball_below(std::span<const Step> steps, std::uint32_t last,
                                const InnerBall& start) {
    InnerBall best;
    Vector3 p = start.center;
    double step = start.radius;
    for (int round = 0; round < 64; ++round, step *= 0.9) {
        double depth = HUGE_VAL;
        std::uint32_t nearest = 0;
        for (std::uint32_t s = last; s != 0; s = steps[s].before) {
            const double d = depth_below(p, steps[s].plane);
            if (d < depth) {
                depth = d;
                nearest = s;
            }
        }
        if (depth > best.radius) best = {p, depth * detail::surely_less};
        const Vector3& n = steps[nearest].plane.normal;
        const double norm = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (std::size_t k = 0; k < 3; ++k) p[k] -= step * (n[k] / norm);
    }
    return best;
}

std::vector<InnerBall> PlaneTree::inner_balls(const Box& bounds, std::size_t most) const {
    struct Open {
        Ref ref = out;
        std::uint32_t step = 0;  // the last one of the way there
        Box box;                 // around the region
    };
    // The first step is none.
    std::vector<Step> steps(1);
    std::vector<Open> open{{root_, 0, bounds}};
    const auto add = [&](Open from, const RoughPlane& plane, Ref ref) {
        if (ref == out || ref <= first_list) return;
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = -plane.offset / plane.normal[k];
            if (plane.normal[(k + 1) % 3] != 0 || plane.normal[(k + 2) % 3] != 0) continue;
            if (plane.normal[k] > 0)
                from.box.hi[k] = std::min(from.box.hi[k], at);
            else
                from.box.lo[k] = std::max(from.box.lo[k], at);
        }
        steps.push_back({plane, from.step});
        open.push_back({ref, static_cast<std::uint32_t>(steps.size() - 1), from.box});
    };
    std::vector<InnerBall> found;
    while (!open.empty()) {
        const Open at = open.back();
        open.pop_back();
        if (at.ref == in) {
            InnerBall start;
            for (std::size_t k = 0; k < 3; ++k) {
                start.center[k] = 0.5 * at.box.lo[k] + 0.5 * at.box.hi[k];
                start.radius = std::max(start.radius, 0.25 * (at.box.hi[k] - at.box.lo[k]));
            }
            const InnerBall ball = ball_below(steps, at.step, start);
            if (ball.radius > 0) found.push_back(ball);
            continue;
        }
        if (at.ref < 0) continue;
        const Node& node = nodes_[static_cast<std::size_t>(at.ref)];
        add(at, {node.normal, node.offset}, node.below);
        add(at, {{-node.normal[0], -node.normal[1], -node.normal[2]}, -node.offset}, node.above);
    }
    std::sort(found.begin(), found.end(),
              [](const InnerBall& a, const InnerBall& b) { return a.radius > b.radius; });
    if (found.size() > most) found.resize(most);
    return found;
}

bool PlaneTree::has_inside(const InnerBall& ball, CostCounters& counters) const {
    // What is left of a ball at a corner is soon nothing.
    const double least = ball.radius * 0x1p-8;
    std::vector<BallTask> open{{ball, root_}};
    while (!open.empty()) {
        const BallTask task = open.back();
        open.pop_back();
        if (task.ref == in) return true;
        if (task.ref < 0 || task.ball.radius < least) continue;
        ++counters.volume_tests;
        const Node& node = nodes_[static_cast<std::size_t>(task.ref)];
        const RoughPlane plane{node.normal, node.offset};
        const auto below = part_below(task.ball, plane);
        const auto above = part_above(task.ball, plane);
        // The larger part is taken from the stack first.
        const bool first_below = below && (!above || below->radius < above->radius);
        if (first_below) open.push_back({*below, node.below});
        if (above) open.push_back({*above, node.above});
        if (below && !first_below) open.push_back({*below, node.below});
    }
    return false;
}

unsigned PlaneTree::depth() const {
    unsigned deepest = 0;
    std::vector<std::pair<Ref, unsigned>> open{{root_, 1}};
    while (!open.empty()) {
        const auto [at, level] = open.back();
        open.pop_back();
        deepest = std::max(deepest, level);
        if (at < 0) continue;
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        for (const Ref child : {node.below, node.on, node.above})
            open.push_back({child, level + 1});
    }
    return deepest;
}

// As the others will be.
void PlaneTree::trace_triangles(const detail::InterferenceModelData& model,
                                std::span<const Plane> planes,
                                FunctionRef<bool(Ref node, std::uint32_t triangle)> is_listed_at) {
    for (std::uint32_t i = 0; i < model.triangles.size(); ++i) {
        const detail::ModelTriangle& t = model.triangles[i];
        const Plane& own = model.brep.plane(t.face);
        const Ref face = first_list - static_cast<Ref>(t.face.index);
        bool is_stray = false;
        tasks_.assign(
            1, {root_, false,
                RoughPolygon::triangle(model.position(t.vertex[0]), model.position(t.vertex[1]),
                                       model.position(t.vertex[2]), model.position_error)});
        while (!tasks_.empty()) {
            const Task task = tasks_.back();
            tasks_.pop_back();
            if (task.ref < 0) {
                is_stray =
                    is_stray || (!task.polygon.is_thin && !(task.is_flat && task.ref == face));
                continue;
            }
            const auto at = static_cast<std::size_t>(task.ref);
            const Values values = values_of(nodes_[at], task.polygon);
            const bool below = values.all_below(task.polygon.count);
            const bool above = values.all_above(task.polygon.count);
            if (!below && !above && !task.is_flat && is_same_plane(planes[at], own)) {
                if (!is_listed_at(task.ref, i))
                    tasks_.push_back({nodes_[at].on, true, task.polygon});
                continue;
            }
            const RoughPolygon low = part(task.polygon, values, 1);
            const RoughPolygon high = part(task.polygon, values, -1);
            if (!above && low.count != 0) tasks_.push_back({nodes_[at].below, task.is_flat, low});
            if (!below && high.count != 0) tasks_.push_back({nodes_[at].above, task.is_flat, high});
        }
        if (is_stray) strays_.push_back(i);
    }
}

void PlaneTree::list_triangles(const detail::InterferenceModelData& model,
                               std::span<const Plane> planes) {
    std::vector<std::pair<Ref, std::uint32_t>> entries;
    trace_triangles(model, planes, [&entries](Ref node, std::uint32_t triangle) {
        entries.emplace_back(node, triangle);
        return true;
    });
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    first_.assign(1, 0);
    lists_.clear();
    for (std::size_t at = 0, e = 0; at < nodes_.size(); ++at) {
        for (; e < entries.size() && entries[e].first == static_cast<Ref>(at); ++e)
            lists_.push_back(entries[e].second);
        first_.push_back(static_cast<std::uint32_t>(lists_.size()));
        nodes_[at].on = first_[at] == first_[at + 1] ? out : first_list - static_cast<Ref>(at);
    }
}

PlaneTree::Ref PlaneTree::graft(const BspTree& tree, std::vector<Plane>& planes) {
    const auto first = static_cast<Ref>(nodes_.size());
    const auto ref = [first](BspTree::NodeId id) {
        if (!id.is_leaf()) return first + static_cast<Ref>(id.index());
        return id.label() == BspTree::Label::In ? in : out;
    };
    for (const BspTree::Node& n : tree.nodes()) {
        Node& node = nodes_.emplace_back(node_of(n.plane));
        node.below = ref(n.below);
        node.above = ref(n.above);
        planes.push_back(n.plane);
    }
    return ref(tree.root());
}

PlaneTree::Ref PlaneTree::graft(const MspTree& tree, std::vector<Plane>& planes) {
    const auto first = static_cast<Ref>(nodes_.size());
    const auto ref = [first](MspTree::Ref t) {
        if (!t.is_leaf()) return first + static_cast<Ref>(t.index());
        if (t.kind() == MspTree::Leaf::OnFace) return first_list - static_cast<Ref>(t.entity());
        return t.kind() == MspTree::Leaf::In ? in : out;
    };
    for (std::size_t i = 0; i < tree.node_count(); ++i) {
        const MspTree::Node& n = tree.node(MspTree::Ref::node(i));
        planes.push_back(tree.plane(n));
        Node& node = nodes_.emplace_back(node_of(planes.back()));
        node.below = ref(n.below);
        node.above = ref(n.above);
        // What is on a line in a plane is not needed.
        node.on = tree.dimension(MspTree::Ref::node(i)) == 3 ? ref(n.on) : out;
    }
    return ref(tree.root());
}

void PlaneTree::build_under_splitters(const detail::InterferenceModelData& model,
                                      std::vector<Plane>& planes,
                                      FunctionRef<Ref(const SplitCells::Cell& cell)> graft_cell) {
    const SplitCells splitters = SplitCells::over(model, most_in_cell);
    for (const SplitCells::SplittingPlane& w : splitters.splitters) {
        nodes_.push_back(node_of(w.plane));
        planes.push_back(w.plane);
        splitters_.push_back({w.box_below, w.box_above});
    }
    std::vector<Ref> roots;
    for (const SplitCells::Cell& cell : splitters.cells) roots.push_back(graft_cell(cell));
    const auto ref = [&roots](SplitCells::Ref r) {
        return r < 0 ? roots[static_cast<std::size_t>(~r)] : r;
    };
    for (std::size_t i = 0; i < splitters.splitters.size(); ++i) {
        nodes_[i].below = ref(splitters.splitters[i].below);
        nodes_[i].above = ref(splitters.splitters[i].above);
    }
    root_ = ref(splitters.root());
}

PlaneTree PlaneTree::classic(const detail::InterferenceModelData& model) {
    PlaneTree r;
    std::vector<Plane> planes;
    if (model.all_lattice)
        r.build_under_splitters(model, planes, [&](const SplitCells::Cell& cell) {
            return r.graft(build_bsp(cell.polygons), planes);
        });
    else
        // Nodes of lower dimension are left where they are, without a way to them.
        r.root_ = r.graft(MspTree::from_brep(model.brep), planes);
    r.list_triangles(model, planes);
    return r;
}

PlaneTree PlaneTree::multidimensional(const detail::InterferenceModelData& model) {
    PlaneTree r;
    std::vector<Plane> planes;
    if (model.all_lattice)
        r.build_under_splitters(model, planes, [&](const SplitCells::Cell& cell) {
            std::vector<MspPolygon> polygons;
            for (const std::uint32_t i : cell.triangles)
                polygons.push_back(msp_polygon(model, model.triangles[i]));
            return r.graft(MspTree::from_polygons(polygons, cell.splitters), planes);
        });
    else
        r.root_ = r.graft(MspTree::from_brep(model.brep), planes);
    r.first_ = model.first_triangle;
    r.lists_.resize(model.triangles.size());
    for (std::uint32_t i = 0; i < r.lists_.size(); ++i) r.lists_[i] = i;
    r.trace_triangles(model, planes, [](Ref, std::uint32_t) { return false; });
    return r;
}

}  // namespace trisect::hierarchies
