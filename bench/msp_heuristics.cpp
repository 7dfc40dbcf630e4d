// SPDX-License-Identifier: Apache-2.0
//
// MspTree: what the choice of cuts does to its size, its build time and point location, for whole
// boundaries; and what a tree in each small cell gives beside BrepIndex, which looks at the
// polygons of a cell one by one.
//
//     msp_heuristics [--faces N] MESH...
//
// Primitives are measured always, meshes with more than N faces (20000) only in cells. Times are
// processor times of one thread. Prints Markdown.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/bsp/solid.h>

namespace {

using namespace trisect;

double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

constexpr std::array<std::pair<MspHeuristic, const char*>, 4> heuristics{{
    {MspHeuristic::AsGiven, "as given"},
    {MspHeuristic::LeastSplits, "least splits"},
    {MspHeuristic::Balanced, "balance + splits"},
    {MspHeuristic::LargestFirst, "largest first"},
}};

struct Box {
    std::array<std::int64_t, 3> lo;
    std::array<std::int64_t, 3> hi;
};

Box box_of(const std::vector<LatticePoint>& points) {
    Box b{{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::max(),
           std::numeric_limits<std::int64_t>::max()},
          {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::min(),
           std::numeric_limits<std::int64_t>::min()}};
    for (const LatticePoint& p : points) {
        for (int k = 0; k < 3; ++k) {
            const auto i = static_cast<std::size_t>(k);
            b.lo[i] = std::min(b.lo[i], p[k].to_integer());
            b.hi[i] = std::max(b.hi[i], p[k].to_integer());
        }
    }
    return b;
}

std::vector<LatticePoint> uniform_points(const Box& box, std::size_t count) {
    std::mt19937_64 random(1);
    std::vector<LatticePoint> points(count);
    const auto coordinate = [&](std::size_t k) {
        return box.lo[k] + static_cast<std::int64_t>(
                               random() % static_cast<std::uint64_t>(box.hi[k] - box.lo[k] + 1));
    };
    for (LatticePoint& p : points) p = {coordinate(0), coordinate(1), coordinate(2)};
    return points;
}

/// Nanoseconds a point; the sum of kinds keeps the compiler honest.
template <class Locate>
double time_of(const std::vector<LatticePoint>& points, Locate&& locate) {
    std::size_t sum = 0;
    const double start = now();
    for (const LatticePoint& p : points) sum += locate(p);
    const double seconds = now() - start;
    if (sum == 1) std::fputs("", stderr);
    return seconds / static_cast<double>(points.size()) * 1e9;
}

void measure_whole(const std::string& name, const Brep& brep) {
    std::vector<LatticePoint> corners;
    for (const Point& p : brep.points()) {
        LatticePoint c;
        const auto near = [&p](std::size_t k) {
            return static_cast<std::int64_t>(p.approximation().c[k]);
        };
        c = {near(0), near(1), near(2)};
        corners.push_back(c);
    }
    const auto points = uniform_points(box_of(corners), 20000);
    for (const auto& [heuristic, label] : heuristics) {
        MspOptions options;
        options.split_heuristic = heuristic;
        const double start = now();
        const MspTree tree = MspTree::from_brep(brep, options);
        const double build = now() - start;
        const MspStats s = tree.stats();
        const double ns = time_of(points, [&](const LatticePoint& p) {
            return static_cast<std::size_t>(tree.locate(p).kind());
        });
        std::printf("| %s | %s | %zu | %.2f | %zu | %zu | %zu | %zu | %.0f | %.1f | %.0f |\n",
                    name.c_str(), label, s.faces, s.fragments_per_polygon(), s.nodes[3], s.nodes[2],
                    s.nodes[1], s.space_depth, s.bytes_per_face(), build * 1e3, ns);
        std::fflush(stdout);
    }
}

/// A k-d tree of walls with an MspTree in each cell.
class Cells {
public:
    Cells(const LatticeMesh& mesh, std::size_t polygons, const MspOptions& options)
        : mesh_(mesh), limit_(polygons), options_(options) {
        std::vector<std::uint32_t> all(mesh.triangles.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
        nodes_.emplace_back();
        divide(0, std::move(all), box_of(mesh.points), 0);
    }
    [[nodiscard]] MspTree::Ref locate(const LatticePoint& p) const {
        std::size_t at = 0;
        while (nodes_[at].axis >= 0)
            at = nodes_[at].child + (p[nodes_[at].axis] > nodes_[at].position ? 1U : 0U);
        return trees_[nodes_[at].child].locate(p);
    }
    [[nodiscard]] std::size_t cells() const { return filled_; }
    [[nodiscard]] std::size_t listed() const { return listed_; }
    [[nodiscard]] double tree_seconds() const { return tree_seconds_; }
    [[nodiscard]] std::size_t tree_bytes() const {
        std::size_t sum = 0;
        for (const MspTree& t : trees_) sum += t.stats().bytes + sizeof(MspTree);
        return sum;
    }

private:
    struct Node {
        int axis = -1;
        std::int64_t position = 0;  // the wall is a half unit beyond
        std::size_t child = 0;      // or the number of the tree
    };

    [[nodiscard]] const LatticePoint& corner(std::uint32_t t, std::size_t i) const {
        return mesh_.points[mesh_.triangles[t][i]];
    }

    void divide(std::size_t at, std::vector<std::uint32_t>&& list, Box box, int level) {
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (box.hi[k] - box.lo[k] > box.hi[axis] - box.lo[axis]) axis = k;
        if (list.size() <= limit_ || level > 60 || box.hi[axis] - box.lo[axis] < 4) {
            finish(at, list, box);
            return;
        }
        const std::int64_t position = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
        std::array<std::vector<std::uint32_t>, 2> parts;
        for (const std::uint32_t t : list) {
            std::array<bool, 2> reaches{};
            for (std::size_t i = 0; i < 3; ++i)
                reaches[corner(t, i)[static_cast<int>(axis)] > position ? 1 : 0] = true;
            for (std::size_t s = 0; s < 2; ++s)
                if (reaches[s]) parts[s].push_back(t);
        }
        // Walls do not part what meets in one point or passes through as a whole.
        if (level > 12 && 2 * (parts[0].size() + parts[1].size()) > 3 * list.size()) {
            finish(at, list, box);
            return;
        }
        list = {};
        const std::size_t child = nodes_.size();
        nodes_[at] = {static_cast<int>(axis), position, child};
        nodes_.resize(child + 2);
        Box lower = box;
        Box upper = box;
        lower.hi[axis] = position;
        upper.lo[axis] = position + 1;
        divide(child, std::move(parts[0]), lower, level + 1);
        divide(child + 1, std::move(parts[1]), upper, level + 1);
    }

    void finish(std::size_t at, const std::vector<std::uint32_t>& list, const Box& box) {
        nodes_[at].child = trees_.size();
        std::vector<MspPolygon> polygons;
        for (const std::uint32_t t : list) {
            MspPolygon p;
            p.shape = ConvexPolygon::from_triangle(corner(t, 0), corner(t, 1), corner(t, 2));
            p.face = t;
            p.edges = {3 * t, 3 * t + 1, 3 * t + 2};
            p.vertices = {mesh_.triangles[t][0], mesh_.triangles[t][1], mesh_.triangles[t][2]};
            polygons.push_back(std::move(p));
        }
        std::vector<Plane> walls;
        for (int k = 0; k < 3; ++k) {
            const auto i = static_cast<std::size_t>(k);
            walls.push_back(Plane::axis_aligned(k, 2, 2 * box.hi[i] + 1));
            walls.push_back(Plane::axis_aligned(k, 2, 2 * box.lo[i] - 1).flipped());
        }
        const double start = now();
        trees_.push_back(MspTree::from_polygons(polygons, walls, MspTree::Leaf::Out, options_));
        tree_seconds_ += now() - start;
        listed_ += list.size();
        if (!list.empty()) ++filled_;
    }

    const LatticeMesh& mesh_;
    std::size_t limit_;
    MspOptions options_;
    std::vector<Node> nodes_;
    std::vector<MspTree> trees_;
    std::size_t listed_ = 0;
    std::size_t filled_ = 0;
    double tree_seconds_ = 0;
};

void measure_cells(const std::string& name, const LatticeMesh& mesh) {
    const auto points = uniform_points(box_of(mesh.points), 200000);
    const auto near = [&mesh] {  // the corners themselves, in another order
        std::vector<LatticePoint> corners = mesh.points;
        std::shuffle(corners.begin(), corners.end(), std::mt19937_64(2));
        return corners;
    }();
    const Solid solid = Solid::from_lattice_mesh(mesh);
    const double start = now();
    const BrepIndex index(solid);
    const auto by_index = [&index](const LatticePoint& p) {
        return static_cast<std::size_t>(index.locate(p).location);
    };
    static_cast<void>(by_index(points.front()));
    const double index_seconds = now() - start;
    const double index_ns = time_of(points, by_index);
    const double index_near = time_of(near, by_index);
    std::printf("| %s | BrepIndex | %zu | | | %.0f | | %.0f | %.0f |\n", name.c_str(),
                mesh.triangles.size(), index_seconds * 1e3, index_ns, index_near);
    for (const std::size_t limit : {25U, 60U}) {
        for (const auto& [heuristic, label] : heuristics) {
            MspOptions options;
            options.split_heuristic = heuristic;
            const Cells cells(mesh, limit, options);
            const auto locate = [&cells](const LatticePoint& p) {
                return static_cast<std::size_t>(cells.locate(p).kind());
            };
            std::printf(
                "| %s | cells of %zu, %s | %zu | %zu | %.1f | %.0f | %.0f | %.0f | %.0f |\n",
                name.c_str(), limit, label, mesh.triangles.size(), cells.cells(),
                static_cast<double>(cells.listed()) / static_cast<double>(cells.cells()),
                cells.tree_seconds() * 1e3,
                static_cast<double>(cells.tree_bytes()) /
                    static_cast<double>(mesh.triangles.size()),
                time_of(points, locate), time_of(near, locate));
            std::fflush(stdout);
        }
    }
}

Brep brep_of(const PolygonMesh& mesh) { return Solid::from_mesh(mesh).to_brep(); }

// Plates with holes, cut out of each other: faces that are not convex, computed corners.
Brep machined() {
    const auto solid = [](const PolygonMesh& m) { return Solid::from_mesh(m); };
    Expression e = solid(make_box({-20, -20, -4}, {20, 20, 4}));
    for (int x = -2; x <= 2; ++x) {
        for (int y = -2; y <= 2; ++y) {
            PolygonMesh hole = make_cylinder(2, 20, 16);
            for (Point3d& p : hole.points) {
                p[0] += 7.5 * x;
                p[1] += 7.5 * y;
                p[2] -= 10;
            }
            e = e - solid(hole);
        }
    }
    return evaluate(e).to_brep();
}

int run(int argc, char** argv) {
    std::size_t most = 20000;
    std::vector<std::string> files;
    for (int i = 1; i < argc; ++i) {
        if (std::string_view(argv[i]) == "--faces" && i + 1 < argc) {
            most = std::strtoul(argv[++i], nullptr, 10);
        } else {
            files.emplace_back(argv[i]);
        }
    }
    std::vector<std::pair<std::string, LatticeMesh>> meshes;
    for (const std::string& f : files)
        meshes.emplace_back(std::filesystem::path(f).stem().string(),
                            import_mesh(read_mesh(f)).mesh);

    std::puts(
        "| solid | choice | faces | fragments/polygon | planes cut | lines | points | depth |"
        " bytes/face | build ms | ns/point |");
    std::puts("|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|");
    measure_whole("cube", brep_of(make_box({1, 1, 1})));
    measure_whole("plate with 25 holes", machined());
    measure_whole("torus 64x32", brep_of(make_torus(4, 1.5, 64, 32)));
    measure_whole("icosphere 5120", brep_of(make_icosphere(1, 4)));
    for (const auto& [name, mesh] : meshes)
        if (mesh.triangles.size() <= most) measure_whole(name, brep_from_lattice_mesh(mesh));

    std::puts(
        "\n| solid | structure | triangles | cells | polygons/cell | build ms | bytes/triangle |"
        " ns/uniform point | ns/vertex |");
    std::puts("|---|---|---:|---:|---:|---:|---:|---:|---:|");
    for (const auto& [name, mesh] : meshes) measure_cells(name, mesh);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "msp_heuristics: %s\n", e.what());
        return 1;
    }
}
