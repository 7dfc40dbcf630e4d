// SPDX-License-Identifier: Apache-2.0
//
// Mending of meshes that bound no solid, by kinds.
//
// What keeps a mesh from bounding a solid is often small: faces that are turned over, two sheets
// that run along one seam with corners that differ in the last digits. Each kind of mending has its
// own option, all are off, and the report has every face and vertex that was touched. Nothing else
// changes. Whether the outcome bounds a solid is for validate() or import to say.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

/// What an inner shell means to `MendOptions::orient_shells`.
enum class InnerShells : std::uint8_t {
    Cavities,  ///< shells within others bound a cavity, then material, and so on
    Material   ///< each shell bounds its inside; those within others count twice until resolved
};

struct MendOptions {
    /// Turn faces over so that each edge of exactly two faces is used once each way. Of the two
    /// ways to orient a connected part the one that turns fewer faces is taken.
    bool orient_faces = false;
    /// Turn closed shells so that each bounds its inside, or as `inner_shells` says. After
    /// orient_faces.
    bool orient_shells = false;
    InnerShells inner_shells = InnerShells::Cavities;
    /// Close seams up to this distance, in the user's units; 0 closes T-junctions that are exact.
    /// Vertices of open edges become one, nearest pairs first, at the place of one of them; no
    /// vertex moves farther, and two vertices of a face never become one. Then an open edge is
    /// divided by vertices of open edges that lie within the distance.
    std::optional<double> seams = std::nullopt;
    /// Add a face where open edges form one simple loop in a plane, exactly. Each loop is taken by
    /// itself: of a ring that lacks its end face both loops are filled.
    bool fill_planar_holes = false;
    /// Of faces with the same corners keep one, or none where the edges balance without it.
    bool drop_duplicates = false;
    /// As in ImportOptions: coordinates are rounded to it first. By default they stay as they are.
    std::optional<Lattice> lattice = std::nullopt;

    /// Whether anything is asked for.
    [[nodiscard]] bool any() const {
        return orient_faces || orient_shells || seams || fill_planar_holes || drop_duplicates;
    }
};

/// A vertex that became another one.
struct JoinedVertex {
    std::uint32_t vertex = 0;
    std::uint32_t into = 0;
    double move = 0;  ///< user's units, rounded
    friend bool operator==(const JoinedVertex&, const JoinedVertex&) = default;
};

/// A vertex that was put into an open edge.
struct DividedEdge {
    std::array<std::uint32_t, 2> edge{};
    std::uint32_t vertex = 0;
    double gap = 0;  ///< between the vertex and the edge, user's units, rounded
    friend bool operator==(const DividedEdge&, const DividedEdge&) = default;
};

/// A connected part of the surface that has no orientation, as a Moebius strip.
struct UnorientablePart {
    std::uint32_t face = 0;               ///< its first one
    std::size_t faces = 0;                ///< how many it has
    std::array<std::uint32_t, 2> edge{};  ///< at which faces contradict each other
    friend bool operator==(const UnorientablePart&, const UnorientablePart&) = default;
};

/// Why a shell was not turned, nor found to be right.
enum class ShellTrouble : std::uint8_t {
    Open,          ///< it is not closed
    NoVolume,      ///< it encloses as much positive as negative volume
    MeetsOthers,   ///< it crosses or overlaps another shell (with Cavities)
    WithinMeeting  ///< it lies within shells that cross, or its place could not be found
};
/// As commands write it: "open", "no_volume", "meets_others", "within_meeting".
[[nodiscard]] std::string_view name_of(ShellTrouble trouble);

struct ShellLeft {
    std::uint32_t face = 0;  ///< its first one
    std::size_t faces = 0;
    ShellTrouble trouble{};
    friend bool operator==(const ShellLeft&, const ShellLeft&) = default;
};

/// Open edges that are connected.
struct OpenBoundary {
    std::size_t edges = 0;
    double length = 0;         ///< user's units, rounded
    std::uint32_t vertex = 0;  ///< one of its vertices
    std::uint32_t face = 0;    ///< one of its faces; no_face if it was added
    Point3d place{};           ///< of the vertex
    bool is_loop = false;      ///< two edges at each vertex
    friend bool operator==(const OpenBoundary&, const OpenBoundary&) = default;
};

/// Stands for faces that were added.
inline constexpr std::uint32_t no_face = 0xffffffffU;

/// Faces and vertices are those of the mesh that was given; of points of equal value the first.
/// Lists are in a fixed order; the same mesh and options give the same report.
struct MendReport {
    std::vector<std::uint32_t> turned_faces;  ///< ascending, for whatever reason
    std::size_t turned_shells = 0;
    std::vector<UnorientablePart> unorientable;
    std::vector<ShellLeft> shells_left;
    std::vector<JoinedVertex> joined;
    std::vector<DividedEdge> divided;
    std::vector<std::uint32_t> cut_faces;         ///< into triangles, since an edge was divided
    std::vector<std::uint32_t> degenerate_faces;  ///< left out while seams were closed
    std::vector<std::uint32_t> duplicate_faces;   ///< left out; another one has the same corners
    std::size_t duplicates_left = 0;  ///< pairs of opposite faces for which both ways leave gaps
    std::size_t filled_holes = 0;
    double max_move = 0;                ///< of a vertex that was joined, user's units
    double max_gap = 0;                 ///< between an edge and a vertex that divides it
    std::vector<OpenBoundary> open;     ///< what is still open, longest first
    std::size_t misoriented_edges = 0;  ///< of an even number of faces, not as often each way
    LatticeReport lattice;

    [[nodiscard]] bool changed() const;
    /// The boundary closes, as import sees it: open T-junctions that are exact count as closed.
    [[nodiscard]] bool is_closed() const { return open.empty() && misoriented_edges == 0; }
};

/// The mesh, and where its parts come from.
struct MendedMesh {
    PolygonMesh mesh;
    std::vector<std::uint32_t> source_of_face;  ///< by face: of the mesh that was given, or no_face
    std::vector<std::uint32_t> source_of_point;  ///< by point
    MendReport report;
};

/// In the order: seams, duplicates, holes, faces, shells. Decisions are exact, of coordinates on
/// their lattice. As in import, that keeps all bits of sets that span at most 126, but rounds where
/// only that closes the boundary; the report says so. Points of equal value are one vertex whatever
/// their index. Coordinates of the outcome are coordinates that were given, to the bit, unless
/// there is a lattice in the options. Where only faces and shells are turned, points, indices and
/// the order of faces stay; otherwise points of equal value become one, and points of no face are
/// left out.
///
/// Cost: O(n log n), some microseconds a triangle; most for seams along which many vertices lie
/// within the distance of each other. \throw UsageError for indices out of range or a distance that
/// is negative or not finite; LimitError for coordinates that are not finite, more than 2^31 faces,
/// a distance within which more than some hundred vertices for each vertex lie, and shells with too
/// many pairs of triangles to compare; by the StopScope
[[nodiscard]] MendedMesh mended(const PolygonMesh& mesh, const MendOptions& options);

}  // namespace trisect
