// SPDX-License-Identifier: Apache-2.0
//
// inside_out_shell and shell_nesting. A shell is a set of triangles connected over edges with two
// faces; where more faces meet, shells stay apart unless one of them would be open there. Closed
// shells bound a solid if the winding number changes between 0 and 1 across each: outside a shell
// that encloses positive volume it must be 0, outside one that encloses negative volume 1. The
// winding number just outside a shell is that of one of its corners with respect to all other
// shells, counted along a ray in direction +x that starts there. The ray is moved by an
// infinitesimal (0, e, e²), so that it passes no corner or edge. A corner that lies on another
// shell tells nothing about that shell; then the next corner is asked.

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>

#include <trisect/brep/import/volume_sign.h>
#include <trisect/brep/validate/checked_mesh.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct Shell {
    Triangles triangles;
    std::uint32_t face = 0;  // the first one
    bool closed = true;
    int volume = 0;
};

class ShellFinder {
public:
    explicit ShellFinder(const CheckedMesh& m) : m_(m), root_(m.mesh.face_count()) {
        std::iota(root_.begin(), root_.end(), 0U);
        m.edges.for_each_edge([this](std::uint32_t, std::uint32_t, std::span<const EdgeUse> uses) {
            if (uses.size() == 2) join(uses[0].face(), uses[1].face());
        });
        m.edges.for_each_edge([this](std::uint32_t, std::uint32_t, std::span<const EdgeUse> uses) {
            if (uses.size() > 2) join_where_open(uses);
        });
        open_.assign(root_.size(), false);
        m.edges.for_each_edge([this](std::uint32_t, std::uint32_t, std::span<const EdgeUse> uses) {
            for (const auto& [root, net] : net_by_shell(uses))
                if (net != 0) open_[root] = true;
        });
    }

    [[nodiscard]] std::vector<Shell> shells() {
        constexpr auto none = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> index(root_.size(), none);
        std::vector<Shell> out;
        for (std::size_t t = 0; t < m_.mesh.triangles.size(); ++t) {
            const std::uint32_t f = m_.mesh.face_of_triangle[t];
            const std::uint32_t r = find(f);
            if (index[r] == none) {
                index[r] = static_cast<std::uint32_t>(out.size());
                out.push_back({{}, f, !open_[r], 0});
            }
            out[index[r]].triangles.push_back(m_.mesh.triangles[t]);
            shell_of_triangle.push_back(index[r]);
        }
        for (Shell& s : out)
            if (s.closed) s.volume = volume_sign(m_.mesh.points, s.triangles);
        return out;
    }

    std::vector<std::uint32_t> shell_of_triangle;

private:
    std::uint32_t find(std::uint32_t i) {
        while (root_[i] != i) i = root_[i] = root_[root_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        root_[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::pair<std::uint32_t, std::int64_t>> net_by_shell(
        std::span<const EdgeUse> uses) {
        std::vector<std::pair<std::uint32_t, std::int64_t>> nets;
        check_stop();
        for (const EdgeUse& u : uses) {
            const std::uint32_t r = find(u.face());
            const auto it =
                std::find_if(nets.begin(), nets.end(), [r](const auto& n) { return n.first == r; });
            const std::int64_t step = u.is_forward() ? 1 : -1;
            if (it == nets.end()) {
                nets.emplace_back(r, step);
            } else {
                it->second += step;
            }
        }
        return nets;
    }
    void join_where_open(std::span<const EdgeUse> uses) {
        const auto nets = net_by_shell(uses);
        const bool open =
            std::any_of(nets.begin(), nets.end(), [](const auto& n) { return n.second != 0; });
        if (open)
            for (const auto& n : nets) join(n.first, nets[0].first);
    }

    const CheckedMesh& m_;
    std::vector<std::uint32_t> root_;
    std::vector<bool> open_;
};

// Sign of the turn a, b, p + (e, e²) in the (y, z) plane; never 0 for different a and b.
int perturbed_turn(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p) {
    const Int128 left = Int128{b.y - a.y} * (p.z - a.z);
    const Int128 right = Int128{b.z - a.z} * (p.y - a.y);
    if (left != right) return left > right ? 1 : -1;
    if (b.z != a.z) return b.z > a.z ? -1 : 1;
    return b.y > a.y ? 1 : -1;
}

// What the ray from p adds to the winding number at p: 1 where it leaves through t, -1 where it
// enters. \pre p is not on t.
int crossing(const LatticePoint& p, const std::array<LatticePoint, 3>& t) {
    // An edge parallel to the ray is a point in the projection: the triangle is seen edge-on.
    for (std::size_t i = 0; i < 3; ++i)
        if (t[i].y == t[(i + 1) % 3].y && t[i].z == t[(i + 1) % 3].z) return 0;
    const int s = perturbed_turn(t[0], t[1], p);
    if (perturbed_turn(t[1], t[2], p) != s || perturbed_turn(t[2], t[0], p) != s) return 0;
    // Counter-clockwise in (y, z): the normal has positive x, and the ray leaves through it if p
    // is below. On the plane, p is beside the triangle, and the perturbed ray cannot meet it.
    const Side side = side_of(p, Plane::through(t[0], t[1], t[2]));
    if (s > 0) return side == Side::Below ? 1 : 0;
    return side == Side::Above ? -1 : 0;
}

// Whether p lies on the closed triangle.
bool lies_on(const LatticePoint& p, const std::array<LatticePoint, 3>& t) {
    for (int i = 0; i < 3; ++i)
        if (p[i] < std::min({t[0][i], t[1][i], t[2][i]}) ||
            p[i] > std::max({t[0][i], t[1][i], t[2][i]}))
            return false;
    const Plane plane = Plane::through(t[0], t[1], t[2]);
    if (side_of(p, plane) != Side::On) return false;
    const int u = (plane.dominant_axis() + 1) % 3;
    const int v = (plane.dominant_axis() + 2) % 3;
    bool left = false;
    bool right = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const LatticePoint& a = t[i];
        const LatticePoint& b = t[(i + 1) % 3];
        const Int128 turn =
            Int128{b[u] - a[u]} * (p[v] - a[v]) - Int128{b[v] - a[v]} * (p[u] - a[u]);
        left = left || turn > 0;
        right = right || turn < 0;
    }
    return !(left && right);
}

class NestingCheck {
public:
    NestingCheck(const CheckedMesh& m, ValidationReport& report)
        : m_(m), report_(report), finder_(m), shells_(finder_.shells()) {}

    void run() {
        if (shells_.size() == 1) {
            if (shells_[0].closed) judge(shells_[0], 0);
            return;
        }
        const TriangleTree tree(m_.mesh.points, m_.mesh.triangles);
        for (std::uint32_t s = 0; s < shells_.size(); ++s)
            if (shells_[s].closed && shells_[s].volume != 0)
                if (const auto w = winding_outside(s, tree)) judge(shells_[s], *w);
    }

private:
    // Corners on other shells are tried in turn, but not for ever.
    static constexpr std::size_t corner_limit = 64;

    [[nodiscard]] std::optional<int> winding_outside(std::uint32_t s,
                                                     const TriangleTree& tree) const {
        std::size_t tried = 0;
        for (const auto& t : shells_[s].triangles)
            for (const std::uint32_t c : t) {
                if (++tried > corner_limit) return std::nullopt;
                if (const auto w = winding_at(m_.mesh.points[c], s, tree)) return w;
            }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<int> winding_at(const LatticePoint& p, std::uint32_t without,
                                                const TriangleTree& tree) const {
        LatticeBox ray;
        ray.add(p);
        ray.high[0] = coordinate_limit;
        int winding = 0;
        bool known = true;
        tree.for_each_in(ray, [&](std::uint32_t t) {
            const std::uint32_t shell = finder_.shell_of_triangle[t];
            if (shell == without || !shells_[shell].closed) return;
            const auto& corners = m_.mesh.triangles[t];
            const std::array<LatticePoint, 3> q{
                m_.mesh.points[corners[0]], m_.mesh.points[corners[1]], m_.mesh.points[corners[2]]};
            if (lies_on(p, q)) {
                known = false;
            } else {
                winding += crossing(p, q);
            }
        });
        return known ? std::optional(winding) : std::nullopt;
    }

    void judge(const Shell& s, int winding) {
        const int wanted = s.volume > 0 ? 0 : 1;
        if (s.volume == 0 || winding == wanted) return;
        const bool outermost = winding == 0;
        const auto kind = outermost ? DefectKind::InsideOutShell : DefectKind::ShellNesting;
        report_.add(kind, [&] {
            std::string text = "the shell of " + std::to_string(s.triangles.size()) +
                               " triangles with " + m_.face_text(s.face);
            text += outermost ? " encloses negative volume: it is inside out"
                              : " lies where the winding number is " + std::to_string(winding) +
                                    ", but is turned for " + std::to_string(wanted);
            return Defect{kind, {}, {s.face}, m_.face_place(s.face), std::move(text)};
        });
    }

    const CheckedMesh& m_;
    ValidationReport& report_;
    ShellFinder finder_;
    std::vector<Shell> shells_;
};

}  // namespace

void check_shells(const CheckedMesh& m, ValidationReport& report) { NestingCheck(m, report).run(); }

}  // namespace trisect::detail
