// SPDX-License-Identifier: Apache-2.0
//
// The cube grid: n³ unit cubes. Unite those with an even sum of coordinates one after the other,
// then the odd ones, then subtract the even ones, then the odd ones: 2n³ - 1 booleans in one chain,
// every one of which touches all its neighbours in faces, edges and vertices and in nothing else.
//
// What must come out follows from the occupancy of the grid alone and is computed from it here,
// without any geometry: the volume is the number of cubes, the area the number of exposed unit
// squares, the faces are the edge-connected groups of coplanar exposed squares, and the shells are
// the groups of squares connected over edges, where at an edge with two cubes diagonally opposite
// each cube keeps its own two squares.
//
//     cube_grid [--n 10] [--check-every 1] [--leaf-polygons 25]
//
// Prints one line a phase; exits with 1 at the first difference.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::Brep;
using trisect::ExactRational;
using trisect::Solid;
using Clock = std::chrono::steady_clock;

using Place = std::array<int, 3>;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }
    std::size_t count() {
        std::size_t n = 0;
        for (std::size_t i = 0; i < parent_.size(); ++i) n += find(i) == i ? 1U : 0U;
        return n;
    }

private:
    std::vector<std::size_t> parent_;
};

/// What the boundary of the occupied cubes must be.
struct Expected {
    std::size_t cubes = 0;
    std::size_t squares = 0;
    std::size_t faces = 0;
    std::size_t shells = 0;
};

class Grid {
public:
    explicit Grid(int n) : n_(n), full_(static_cast<std::size_t>(n * n * n), 0) {}

    void set(const Place& p, bool full) { full_[index(p)] = full ? 1 : 0; }
    [[nodiscard]] Expected expected() const;

private:
    /// An exposed side of a cube: towards direction 0..5 (axis, then sign).
    struct Square {
        Place cube;
        int direction;
        friend auto operator<=>(const Square&, const Square&) = default;
    };

    [[nodiscard]] std::size_t index(const Place& p) const {
        return static_cast<std::size_t>((p[0] * n_ + p[1]) * n_ + p[2]);
    }
    [[nodiscard]] bool full(const Place& p) const {
        for (const int c : p)
            if (c < 0 || c >= n_) return false;
        return full_[index(p)] != 0;
    }
    static Place moved(Place p, int direction) {
        p[static_cast<std::size_t>(direction / 2)] += direction % 2 == 0 ? -1 : 1;
        return p;
    }
    [[nodiscard]] std::vector<Square> exposed() const;
    [[nodiscard]] Square across(const Square& s, int towards) const;

    int n_;
    std::vector<char> full_;
};

std::vector<Grid::Square> Grid::exposed() const {
    std::vector<Square> out;
    for (int i = 0; i < n_; ++i)
        for (int j = 0; j < n_; ++j)
            for (int k = 0; k < n_; ++k)
                for (int d = 0; d < 6 && full({i, j, k}); ++d)
                    if (!full(moved({i, j, k}, d))) out.push_back({{i, j, k}, d});
    return out;  // sorted
}

/// The neighbour over one of the square's four edges, staying with the inside: the other square of
/// the same cube, unless the cube beside it is full.
Grid::Square Grid::across(const Square& s, int towards) const {
    const Place beside = moved(s.cube, towards);
    if (!full(beside)) return {s.cube, towards};
    const Place above = moved(beside, s.direction);
    if (!full(above)) return {beside, s.direction};
    return {above, towards % 2 == 0 ? towards + 1 : towards - 1};
}

Expected Grid::expected() const {
    const std::vector<Square> squares = exposed();
    DisjointSets faces(squares.size());
    DisjointSets shells(squares.size());
    for (std::size_t i = 0; i < squares.size(); ++i)
        for (int towards = 0; towards < 6; ++towards) {
            if (towards / 2 == squares[i].direction / 2) continue;
            const Square other = across(squares[i], towards);
            const auto at = std::lower_bound(squares.begin(), squares.end(), other);
            const auto j = static_cast<std::size_t>(at - squares.begin());
            shells.join(i, j);
            if (other.direction == squares[i].direction) faces.join(i, j);
        }
    Expected e;
    for (const char c : full_) e.cubes += c != 0 ? 1U : 0U;
    e.squares = squares.size();
    e.faces = faces.count();
    e.shells = shells.count();
    return e;
}

std::string mismatch(const char* what, std::size_t found, std::size_t wanted) {
    return std::string(what) + " is " + std::to_string(found) + ", not " + std::to_string(wanted);
}

/// Every directed edge as often as its opposite.
bool is_closed(const trisect::PolygonMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i];
            const std::uint32_t b = loop[(i + 1) % loop.size()];
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    for (const auto& [edge, sum] : balance)
        if (sum != 0) return false;
    return true;
}

/// Links of the B-rep, its Euler characteristic, and the mesh made from it.
std::string why_invalid(const Brep& brep) {
    for (const trisect::HalfedgeId h : brep.halfedges()) {
        const trisect::HalfedgeId t = brep.twin(h);
        if (t == h || brep.twin(t) != h || brep.origin(t) != brep.origin(brep.next(h)))
            return "halfedge " + std::to_string(h.index) + " is not paired";
    }
    std::size_t faces = 0;
    for (const trisect::ShellId s : brep.shells()) {
        const auto counts = brep.counts(s);
        faces += counts.faces;
        if (counts.euler_characteristic() % 2 != 0 || counts.euler_characteristic() > 2)
            return "a shell has an impossible Euler characteristic";
    }
    if (faces != brep.counts().faces) return "a face is in no shell or in several";
    if (!is_closed(trisect::to_polygon_mesh(brep))) return "the mesh is not closed";
    return {};
}

std::string difference(const Solid& solid, const Expected& expected) {
    const Brep brep = solid.to_brep();
    if (std::string why = why_invalid(brep); !why.empty()) return why;
    if (trisect::exact_volume(brep) != ExactRational(static_cast<std::int64_t>(expected.cubes)))
        return "volume is " + trisect::exact_volume(brep).to_string() + ", not " +
               std::to_string(expected.cubes);
    const trisect::Area area = trisect::area(brep);
    if (!area.exact || *area.exact != ExactRational(static_cast<std::int64_t>(expected.squares)))
        return "area is " + std::to_string(area.value) + ", not " +
               std::to_string(expected.squares);
    if (brep.counts().faces != expected.faces)
        return mismatch("number of faces", brep.counts().faces, expected.faces);
    if (brep.counts().shells != expected.shells)
        return mismatch("number of shells", brep.counts().shells, expected.shells);
    if (solid.is_empty() != (expected.cubes == 0)) return "is_empty() is wrong";
    return {};
}

struct Options {
    int n = 10;
    int check_every = 1;
    int leaf_polygons = 25;
};

class Campaign {
public:
    explicit Campaign(const Options& options) : options_(options), grid_(options.n) {
        evaluate_options_.leaf_polygons = static_cast<std::uint32_t>(options.leaf_polygons);
        for (int i = 0; i < options.n; ++i)
            for (int j = 0; j < options.n; ++j)
                for (int k = 0; k < options.n; ++k) places_[(i + j + k) % 2].push_back({i, j, k});
    }

    bool run() {
        std::printf(
            "| phase | steps | evaluate, s | checks, s | cubes | area | faces | shells |\n"
            "|---|---:|---:|---:|---:|---:|---:|---:|\n");
        const bool good = phase("unite even", 0, true) && phase("unite odd", 1, true) &&
                          phase("subtract even", 0, false) && phase("subtract odd", 1, false);
        if (good && (!chain_.is_empty() || !chain_.to_brep().is_empty()))
            return fail("at the end", "the solid is not empty");
        if (good) std::printf("\n%d booleans, %d checked, 0 differences\n", steps_ - 1, checks_);
        return good;
    }

private:
    bool phase(const char* name, int parity, bool unite) {
        double evaluating = 0;
        double checking = 0;
        Expected last;
        for (const Place& p : places_[parity]) {
            const auto start = Clock::now();
            step(p, unite);
            evaluating += seconds_since(start);
            const auto check_start = Clock::now();
            if (++steps_ % options_.check_every == 0 || p == places_[parity].back()) {
                last = grid_.expected();
                ++checks_;
                if (const std::string why = difference(chain_, last); !why.empty())
                    return fail(name, why);
            }
            checking += seconds_since(check_start);
        }
        std::printf("| %s | %zu | %.3f | %.1f | %zu | %zu | %zu | %zu |\n", name,
                    places_[parity].size(), evaluating, checking, last.cubes, last.squares,
                    last.faces, last.shells);
        std::fflush(stdout);
        return true;
    }

    void step(const Place& p, bool unite) {
        const trisect::Point3d low{double(p[0]), double(p[1]), double(p[2])};
        const Solid cube =
            Solid::from_mesh(trisect::make_box(low, {low[0] + 1, low[1] + 1, low[2] + 1}));
        grid_.set(p, unite);
        if (steps_ == 0)
            chain_ = cube;
        else
            chain_ = trisect::evaluate(unite ? chain_ | cube : chain_ - cube, evaluate_options_);
    }

    bool fail(const char* where, const std::string& why) const {
        std::printf("DIFFERENCE at step %d, %s: %s\n", steps_, where, why.c_str());
        return false;
    }

    Options options_;
    Grid grid_;
    trisect::EvaluateOptions evaluate_options_;
    std::array<std::vector<Place>, 2> places_;
    Solid chain_;
    int steps_ = 0;
    int checks_ = 0;
};

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i < argc; i += 2) {
        int* target = std::strcmp(argv[i], "--n") == 0               ? &out.n
                      : std::strcmp(argv[i], "--check-every") == 0   ? &out.check_every
                      : std::strcmp(argv[i], "--leaf-polygons") == 0 ? &out.leaf_polygons
                                                                     : nullptr;
        if (target == nullptr || i + 1 == argc) return std::nullopt;
        *target = std::atoi(argv[i + 1]);
        if (*target <= 0) return std::nullopt;
    }
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::fprintf(stderr, "usage: %s [--n N] [--check-every K] [--leaf-polygons L]\n", argv[0]);
        return 2;
    }
    try {
        return Campaign(*options).run() ? 0 : 1;
    } catch (const std::exception& e) {
        std::printf("DIFFERENCE: exception: %s\n", e.what());
        return 1;
    }
}
