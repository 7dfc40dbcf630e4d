// SPDX-License-Identifier: Apache-2.0
//
// Solid: a regularised set of points bounded by planar polygons.
// It is the value type of the library.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include <trisect/brep/brep.h>
#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/triangle_view.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>

namespace trisect {

namespace detail {
struct SolidState;
struct SolidAccess;
}  // namespace detail

class Expression;

/// Treatment of self-intersection of an imported boundary.
enum class Embedding : std::uint8_t {
    /// Taken to be free of self-intersection, with shells nested so that winding numbers are 0
    /// and 1. Only cells where operands meet are resolved.
    Assume,
    /// May intersect, overlap or contain itself: every cell is resolved.
    Resolve,
    /// Found out first (brep/validate/embedding.h): as Assume for a boundary that is embedded, else
    /// cells where facets meet others are resolved: all if most do. Some microseconds a triangle.
    Check
};

/// What happens to a boundary whose volume is negative. Under the positive winding rule it bounds
/// nothing, or next to nothing.
enum class InsideOut : std::uint8_t {
    Refuse,
    Accept  ///< for EvaluateOptions::Winding::NonZero; not together with Embedding::Assume
};

struct SolidOptions {
    ImportOptions import = {};
    Embedding embedding = Embedding::Assume;
    InsideOut inside_out = InsideOut::Refuse;
};

struct AssembleOptions {
    /// Join coplanar neighbours into maximal faces with holes; otherwise each face is what is left
    /// of one face of an operand.
    bool maximal_faces = true;
};

/// An immutable set, O(1) to copy, safe to read from many threads.
///
/// It may be empty, unbounded (half-space, complement) or the whole space. It is the closure of its
/// interior; its boundary is not part of the information in any other way. Inside is where the
/// winding number of the imported boundary is positive.
///
/// A solid that was moved from is the empty set, and so is one made of a null state.
class Solid {
public:
    /// The empty set.
    Solid();
    /// A formula is no solid yet: `Solid c = evaluate(a - b);`
    Solid(const Expression& formula) = delete;  // NOLINT(google-explicit-constructor)

    [[nodiscard]] static Solid whole_space();
    /// The points with a x + b y + c z + d <= 0, in the user's units, exactly.
    /// \throw UsageError when that is no plane, LimitError when the coefficients span more than
    /// some 80 bits.
    [[nodiscard]] static Solid half_space(const std::array<double, 4>& plane);
    /// The points below a plane in units of a lattice.
    [[nodiscard]] static Solid half_space(const Plane& plane, Lattice lattice);
    /// \throw InvalidSolid when the mesh is not closed and oriented; Error InvalidSolid when it is
    /// inside out, unless the options accept that.
    [[nodiscard]] static Solid from_mesh(const PolygonMesh& mesh, const SolidOptions& options = {});
    /// The same of triangles in memory of the caller: for most meshes nothing is copied before it
    /// is rounded and connected. \throw as above, LimitError for more than 2^32 - 1 corners
    [[nodiscard]] static Solid from_triangles(const TriangleView& mesh,
                                              const SolidOptions& options = {});
    /// Of an exact boundary, to the last bit: one that to_brep() or read_exact() returned. Where
    /// all corners are lattice points it becomes a mesh of triangles; other corners stay what they
    /// are, points that planes have in common, and faces are divided along planes of their
    /// neighbours. Faces of results name the boundary's by their numbers.
    ///
    /// A boundary with other corners is resolved under Embedding::Check.
    /// \throw Error (InvalidSolid) when it is inside out, unless that is accepted;
    /// UnsupportedError for an edge between two faces of one plane that is not between lattice
    /// points and on no plane that names its ends (assemble with maximal faces); LimitError.
    [[nodiscard]] static Solid from_brep(const Brep& brep, Embedding embedding = Embedding::Assume,
                                         InsideOut inside_out = InsideOut::Refuse);
    /// The same for a mesh that was imported before. \throw as from_mesh
    [[nodiscard]] static Solid from_import(ImportedMesh imported,
                                           Embedding embedding = Embedding::Assume,
                                           InsideOut inside_out = InsideOut::Refuse);
    /// \pre the mesh is closed and oriented, corner by corner.
    [[nodiscard]] static Solid from_lattice_mesh(LatticeMesh mesh,
                                                 Embedding embedding = Embedding::Assume);

    [[nodiscard]] Lattice lattice() const;
    /// Of a solid made from a mesh: what FaceSource::operand of its faces will be in every result.
    [[nodiscard]] std::uint32_t source_id() const;
    /// True for the empty set. Looks for one polygon of the boundary: O(1), but where none is.
    [[nodiscard]] bool is_empty() const;
    /// True for whole space.
    [[nodiscard]] bool is_whole_space() const;

    /// Divides large cells of the boundary now, once for all solids that share them; the set stays
    /// what it is. Without it the first small cut in a part reads all of the part, and each cut in
    /// a new place what is around that; after it a cut costs what is near it. O(n log n), about a
    /// tenth of a second for a million triangles. Safe to call from several threads. `threads`: how
    /// many may take part, 0 means one for every processor.
    void refine(std::uint32_t threads = 0) const;

    /// The boundary. Assembled anew at every call; costs O(n log n) in the faces. That of a
    /// complement has the volume below its faces negative. The empty set and whole space both have
    /// none: is_whole_space() distinguishes them.
    /// \throw UnsupportedError when the boundary is unbounded (a half-space).
    [[nodiscard]] Brep to_brep(const AssembleOptions& options = {}) const;
    /// Triangles with correctly rounded coordinates. Facets that nothing changed are copied; what
    /// is left of others is joined with its coplanar neighbours first. No vertex lies inside an
    /// edge (before rounding). `threads`: how many may take part, 0 means one for every processor;
    /// the mesh does not depend on it.
    /// \throw UnsupportedError when the set is unbounded: whole space would be read back as the
    /// empty set, and a complement as a mesh that is inside out.
    [[nodiscard]] PolygonMesh to_mesh(std::uint32_t threads = 0) const;
    /// The same, and which face of which operand each triangle is part of; `map.face` stays empty,
    /// since there is no B-rep. What was joined carries the name of its first face.
    [[nodiscard]] PolygonMesh to_mesh(MeshMap& map, std::uint32_t threads = 0) const;
    /// The same before coordinates are rounded. Also of a complement, with its faces turned over.
    /// \throw UnsupportedError when the boundary is unbounded.
    [[nodiscard]] ExactMesh to_exact_mesh(std::uint32_t threads = 0) const;

private:
    friend struct detail::SolidAccess;

    explicit Solid(std::shared_ptr<const detail::SolidState> state) : state_(std::move(state)) {}
    [[nodiscard]] const std::shared_ptr<const detail::SolidState>& state() const {
        return state_ != nullptr ? state_ : empty_state();
    }
    [[nodiscard]] static const std::shared_ptr<const detail::SolidState>& empty_state();

    std::shared_ptr<const detail::SolidState> state_;  // null: the empty set
};

}  // namespace trisect
