// SPDX-License-Identifier: Apache-2.0
//
// Of shells that do not meet each lies within another one or outside of it as a whole, so that the
// number of shells around it says what it bounds. How they are turned does not matter for that.

#include <trisect/brep/mend/orient_shells.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/import/edge_table.h>
#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/brep/import/shell_finder.h>
#include <trisect/brep/mend/orient_faces.h>
#include <trisect/brep/validate/shell_nesting.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

constexpr std::uint64_t most_pairs = std::uint64_t{1} << 28;

PreparedMesh prepared(const MendingMesh& mesh) {
    PreparedMesh out;
    out.points = mesh.points;
    out.loop_begin = mesh.loop_begin;
    out.corners = mesh.corners;
    triangulate_faces(out);
    return out;
}

class ShellTurner {
public:
    ShellTurner(const PreparedMesh& mesh, InnerShells inner)
        : mesh_(mesh),
          inner_(inner),
          finder_(mesh, EdgeTable(mesh.points.size(), mesh.loop_begin, mesh.corners)),
          shells_(finder_.shells()),
          face_counts_(shells_.size(), 0),
          meets_(shells_.size(), false) {
        std::vector<std::uint32_t> shell_of_part(mesh.face_count(), none);
        for (std::uint32_t s = 0; s < shells_.size(); ++s)
            shell_of_part[finder_.part_of(shells_[s].face)] = s;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            shell_of_face_.push_back(shell_of_part[finder_.part_of(f)]);
            if (shell_of_face_.back() != none) ++face_counts_[shell_of_face_.back()];
        }
        if (are_nested()) find_meetings();
    }

    /// Of each shell: whether it must be turned, or why that is not known.
    struct Verdict {
        bool turns = false;
        std::optional<ShellTrouble> trouble;
    };
    [[nodiscard]] std::vector<Verdict> verdicts() {
        std::vector<bool> is_closed;
        for (const Shell& s : shells_) is_closed.push_back(s.closed);
        TriangleTree tree(mesh_.points, mesh_.triangles, finder_.shell_of_triangle);
        ShellNesting nesting(mesh_.points, mesh_.triangles, finder_.shell_of_triangle, is_closed,
                             tree);
        std::vector<Verdict> out;
        for (std::uint32_t s = 0; s < shells_.size(); ++s) {
            check_stop();
            out.push_back(verdict(s, nesting));
        }
        return out;
    }

    [[nodiscard]] const std::vector<Shell>& shells() const { return shells_; }
    [[nodiscard]] std::size_t face_count(std::uint32_t shell) const { return face_counts_[shell]; }
    /// Of faces; `none` for those without triangles that are connected to no others.
    [[nodiscard]] const std::vector<std::uint32_t>& shell_of_face() const { return shell_of_face_; }
    static constexpr std::uint32_t none = 0xffffffffU;

private:
    /// Whether a shell means something else where it lies within others.
    [[nodiscard]] bool are_nested() const {
        return inner_ == InnerShells::Cavities && shells_.size() > 1;
    }
    void find_meetings() {
        const auto& shell_of = finder_.shell_of_triangle;
        TriangleTree tree(mesh_.points, mesh_.triangles, shell_of);
        std::uint64_t pairs = 0;
        tree.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
            check_stop();
            if (++pairs > most_pairs)
                throw LimitError("mend: more than " + std::to_string(most_pairs) +
                                 " pairs of triangles of different shells to compare");
            const std::uint32_t s = shell_of[a];
            const std::uint32_t t = shell_of[b];
            if (s != t && !(meets_[s] && meets_[t]) && do_meet(a, b)) meets_[s] = meets_[t] = true;
            return true;
        });
    }
    [[nodiscard]] bool do_meet(std::uint32_t a, std::uint32_t b) const {
        auto corners = mesh_.triangles[a];
        auto others = mesh_.triangles[b];
        const ContactKind kind = find_contact(mesh_.points, corners, others).kind;
        if (kind == ContactKind::Cross || kind == ContactKind::Overlap) return true;
        std::ranges::sort(corners);
        std::ranges::sort(others);
        return corners == others;
    }
    [[nodiscard]] Verdict verdict(std::uint32_t s, ShellNesting& nesting) const {
        const Shell& shell = shells_[s];
        if (!shell.closed) return {false, ShellTrouble::Open};
        if (shell.volume == 0) return {false, ShellTrouble::NoVolume};
        if (meets_[s]) return {false, ShellTrouble::MeetsOthers};
        bool is_cavity = false;
        if (are_nested()) {
            const auto around = nesting.shells_around(s, shell.triangles);
            if (!around ||
                std::ranges::any_of(*around, [this](std::uint32_t o) { return meets_[o]; }))
                return {false, ShellTrouble::WithinMeeting};
            is_cavity = around->size() % 2 == 1;
        }
        return {(shell.volume > 0) == is_cavity, std::nullopt};
    }

    const PreparedMesh& mesh_;
    InnerShells inner_;
    ShellFinder finder_;
    std::vector<Shell> shells_;
    std::vector<std::uint32_t> shell_of_face_;
    std::vector<std::size_t> face_counts_;
    std::vector<bool> meets_;
};

}  // namespace

void orient_shells(MendingMesh& mesh, InnerShells inner, std::vector<bool>& turned,
                   MendReport& report) {
    const PreparedMesh triangles = prepared(mesh);
    end_step();
    ShellTurner turner(triangles, inner);
    const auto verdicts = turner.verdicts();
    for (std::uint32_t s = 0; s < verdicts.size(); ++s) {
        if (verdicts[s].turns) ++report.turned_shells;
        if (verdicts[s].trouble)
            report.shells_left.push_back({mesh.face_source[turner.shells()[s].face],
                                          turner.face_count(s), *verdicts[s].trouble});
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const std::uint32_t s = turner.shell_of_face()[f];
        if (s == ShellTurner::none || !verdicts[s].turns) continue;
        turn_face(mesh, f);
        turned[f] = !turned[f];
    }
}

}  // namespace trisect::detail
