// SPDX-License-Identifier: Apache-2.0
//
// Defect: a reason for a mesh to bound no solid, or a warning.
// ValidationReport is the list of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>

namespace trisect {

/// The order of the enumerators is the order of a report.
enum class DefectKind : std::uint8_t {
    OpenEdge,                ///< the faces' boundaries do not cancel along this edge
    FlippedFace,             ///< both faces of an edge traverse it in the same direction
    NonManifoldEdge,         ///< more than two faces at an edge
    TVertex,                 ///< edges that cancel only because a corner lies inside one of them
    NonManifoldVertex,       ///< the faces around a vertex form more than one fan
    RepeatedCorner,          ///< a loop names the same point in succession
    DegenerateFace,          ///< all corners on one line
    NonPlanarFace,           ///< corners not in one plane
    NonSimpleFace,           ///< a loop that crosses or folds onto itself
    DuplicateFace,           ///< same corners, same orientation
    DuplicateOppositeFaces,  ///< same corners, opposite orientation
    SelfIntersection,        ///< two faces cross or overlap
    FacesTouch,              ///< two faces meet in a point or along edges they do not share
    DuplicatePoint,          ///< two points with the same coordinates
    UnusedPoint,             ///< a point of no face
    InsideOutShell,          ///< an outermost shell that bounds its outside
    ShellNesting,            ///< a shell inside another one with the wrong orientation
    HoleOutsideFace,         ///< an inner loop outside its outer loop
    EmptyMesh                ///< no faces
};
inline constexpr std::size_t defect_kind_count = 19;

/// Errors: the mesh does not bound a solid. Warnings: it does, but they deserve attention.
enum class Severity : std::uint8_t { Warning, Error };

/// The name in reports and JSON, such as "open_edge".
[[nodiscard]] std::string_view name_of(DefectKind kind);
[[nodiscard]] Severity severity_of(DefectKind kind);

/// Where the defect is: indices into the mesh that was checked, a point in the user's units, and a
/// sentence for people.
struct Defect {
    DefectKind kind{};
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> faces;
    Point3d place{};
    std::string sentence;

    [[nodiscard]] Severity severity() const { return severity_of(kind); }
    friend bool operator==(const Defect&, const Defect&) = default;
};

/// What was found. Counts are exact; of each kind at most `list_limit` defects are listed, the
/// first ones in the order of the mesh, so that a report of a ruined million-face scan stays
/// readable. Regular value type; the same mesh gives the same report.
class ValidationReport {
public:
    explicit ValidationReport(std::size_t list_limit = 100) : list_limit_(list_limit) {}

    [[nodiscard]] const std::vector<Defect>& defects() const { return defects_; }
    [[nodiscard]] std::size_t count(DefectKind kind) const {
        return counts_[static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] std::size_t count(Severity severity) const;
    [[nodiscard]] bool empty() const;
    /// No defect of severity Error.
    [[nodiscard]] bool is_solid() const { return count(Severity::Error) == 0; }
    /// One line per kind: name, number, and the sentences of the first `places` of each; "no
    /// defects" for a good mesh. docs/invalid_solid.md says what to do.
    [[nodiscard]] std::string to_string(std::size_t places = 3) const;

    /// Counts a defect; `make()` returns it and is called only when it will be listed.
    template <class Make>
    void add(DefectKind kind, Make&& make) {
        if (counts_[static_cast<std::size_t>(kind)]++ < list_limit_)
            defects_.push_back(std::forward<Make>(make)());
    }
    /// What putting the mesh on a lattice changed; the checks are of the rounded mesh.
    [[nodiscard]] const LatticeReport& lattice() const { return lattice_; }
    void set_lattice(const LatticeReport& lattice) { lattice_ = lattice; }

    /// Sorts the list by kind; within a kind the order of discovery stays.
    void sort();

    friend bool operator==(const ValidationReport& a, const ValidationReport& b) {
        return a.counts_ == b.counts_ && a.defects_ == b.defects_;
    }

private:
    std::size_t list_limit_;
    std::array<std::size_t, defect_kind_count> counts_{};
    std::vector<Defect> defects_;
    LatticeReport lattice_;
};

/// Well-formed data that does not bound a solid. The message names the first errors with their
/// places; the report holds all of them.
class InvalidSolid : public Error {
public:
    /// `why` opens the message, for reports whose findings are not errors by themselves.
    explicit InvalidSolid(ValidationReport report, const std::string& why = "not a valid solid");
    [[nodiscard]] const ValidationReport& report() const noexcept { return report_; }

private:
    ValidationReport report_;
};

/// "(1, 2.5, -3)", shortest digits that read back as the same numbers.
[[nodiscard]] std::string place_text(const Point3d& p);
/// The lattice point in the user's units.
[[nodiscard]] Point3d to_user(const LatticePoint& p, Lattice lattice);

}  // namespace trisect
