// SPDX-License-Identifier: Apache-2.0
//
// inside_out_shell and shell_nesting. A shell is a set of triangles connected over edges with two
// faces; where more faces meet, shells stay apart unless one of them would be open there. Closed
// shells bound a solid if the winding number changes between 0 and 1 across each: outside a shell
// that encloses positive volume it must be 0, outside one that encloses negative volume 1. The
// winding number just outside a shell is that of one of its corners with respect to all other
// shells (shell_nesting.h).

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>

#include <trisect/brep/import/volume_sign.h>
#include <trisect/brep/validate/checked_mesh.h>
#include <trisect/brep/validate/shell_nesting.h>
#include <trisect/brep/validate/triangle_tree.h>
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

class NestingCheck {
public:
    NestingCheck(const CheckedMesh& m, ValidationReport& report)
        : m_(m), report_(report), finder_(m), shells_(finder_.shells()) {}

    void run() {
        if (shells_.size() == 1) {
            if (shells_[0].closed) judge(shells_[0], 0);
            return;
        }
        TriangleTree tree(m_.mesh.points, m_.mesh.triangles);
        std::vector<bool> is_closed;
        for (const Shell& s : shells_) is_closed.push_back(s.closed);
        ShellNesting nesting(m_.mesh.points, m_.mesh.triangles, finder_.shell_of_triangle,
                             is_closed, tree);
        for (std::uint32_t s = 0; s < shells_.size(); ++s)
            if (shells_[s].closed && shells_[s].volume != 0)
                if (const auto w = nesting.winding_outside(s, shells_[s].triangles))
                    judge(shells_[s], *w);
    }

private:
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
