// SPDX-License-Identifier: Apache-2.0
//
// inside_out_shell and shell_nesting. Closed shells (shell_finder.h) bound a solid if the winding
// number changes between 0 and 1 across each: outside a shell that encloses positive volume it must
// be 0, outside one that encloses negative volume 1. The winding number just outside a shell is
// that of one of its corners with respect to all other shells (shell_nesting.h).

#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/import/shell_finder.h>
#include <trisect/brep/validate/checked_mesh.h>
#include <trisect/brep/validate/shell_nesting.h>
#include <trisect/brep/validate/triangle_tree.h>

namespace trisect::detail {

namespace {

class NestingCheck {
public:
    NestingCheck(const CheckedMesh& m, ValidationReport& report)
        : m_(m), report_(report), finder_(m.mesh, m.edges), shells_(finder_.shells()) {}

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
