// SPDX-License-Identifier: Apache-2.0
//
// Source: the triangles of one import.
// A tree stores names (source, facet); corners and planes are looked up here, and planes are made
// on demand, near the cuts only.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/kinds/facet_kinds.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/lattice_move.h>
#include <trisect/kernel/plane.h>

namespace trisect::detail {

/// The facets of one imported mesh, or whole planes: the one unbounded facet of a half-space, or
/// the planes of an exact boundary, of which only fragments are listed. Immutable.
///
/// `serial` orders sources by their time of creation. Reference-counted by the polygons that name
/// it, so that a long chain of operations keeps exactly the sources that are still visible.
class Source {
public:
    static std::shared_ptr<const Source> make(LatticeMesh mesh, std::uint32_t threads = 1);
    /// The half-space below `plane`.
    static std::shared_ptr<const Source> half_space(const Plane& plane, Lattice lattice);
    /// One facet for each plane; all that is listed of them lies in the box.
    static std::shared_ptr<const Source> planes(std::vector<Plane> planes, Lattice lattice,
                                                const Box& box);
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    void retain() const { count_.fetch_add(1, std::memory_order_relaxed); }
    void release() const {
        if (count_.fetch_sub(1, std::memory_order_acq_rel) == 1) delete this;
    }

    [[nodiscard]] std::uint64_t serial() const { return serial_; }
    /// What results call a face of this source. Its own serial and number, unless the source was
    /// made of named faces.
    [[nodiscard]] FaceSource name_of(std::uint32_t facet) const {
        if (names_ == nullptr) return {operand_, face_of(facet)};
        return (*names_)[face_of(facet)];
    }
    /// What results call the operand that corners come from.
    [[nodiscard]] std::uint32_t operand() const { return operand_; }
    /// The names of faces, of a source that was made of named ones; else nothing.
    [[nodiscard]] std::span<const FaceSource> names() const {
        return names_ == nullptr ? std::span<const FaceSource>() : *names_;
    }
    /// Where components of a normal are equal, the first of these counts as the largest one.
    [[nodiscard]] const std::array<std::uint8_t, 3>& axes() const { return axes_; }
    /// Whether the facets are planes, without corners and edges.
    [[nodiscard]] bool is_half_space() const { return !planes_.empty(); }
    /// Whether all corners are whole, or all planes have the widths that such give them.
    [[nodiscard]] bool is_whole() const { return whole_; }
    /// Of a mesh: the most bits behind the point that a coordinate has.
    [[nodiscard]] int fraction_bits() const { return fraction_bits_; }
    /// The largest e for which all coordinates are multiples of 2^e: -fraction_bits() where that is
    /// not 0. Takes a look at all of them. \pre a mesh, not all 0.
    [[nodiscard]] int last_bit() const;
    /// Whether the box says nothing.
    [[nodiscard]] bool is_unbounded() const { return box_.hi[0] == coordinate_limit; }
    [[nodiscard]] Lattice lattice() const { return mesh_.lattice; }
    [[nodiscard]] const LatticeMesh& mesh() const { return mesh_; }
    [[nodiscard]] std::uint32_t facet_count() const {
        return static_cast<std::uint32_t>(is_half_space() ? planes_.size()
                                                          : mesh_.triangles.size());
    }
    /// The face that a facet is a part of, by its number in what was imported.
    [[nodiscard]] std::uint32_t face_of(std::uint32_t facet) const {
        return is_half_space() ? facet : mesh_.face_of(facet);
    }
    /// Of a mesh that meets itself in places; empty where nothing is known about that.
    [[nodiscard]] std::span<const FacetKind> kinds() const {
        return kinds_ == nullptr ? std::span<const FacetKind>() : *kinds_;
    }
    [[nodiscard]] const LatticePoint& corner(std::uint32_t facet, int i) const {
        return mesh_.points[mesh_.triangles[facet][static_cast<std::size_t>(i)]];
    }
    [[nodiscard]] std::uint32_t corner_index(std::uint32_t facet, int i) const {
        return mesh_.triangles[facet][static_cast<std::size_t>(i)];
    }
    /// Made from the corners: stored boxes would be twice the size of the mesh itself, and writing
    /// them would take as long as the rest of an import. Who needs many at a time packs them.
    [[nodiscard]] Box facet_box(std::uint32_t facet) const {
        if (is_half_space()) return box_;
        Box b;
        if (whole_) {
            for (int i = 0; i < 3; ++i) b.add_whole(corner(facet, i));
        } else {
            for (int i = 0; i < 3; ++i) b.add(corner(facet, i));
        }
        return b;
    }
    /// Contains all facets; of a mesh, the box of its points.
    [[nodiscard]] const Box& box() const { return box_; }

    [[nodiscard]] Plane support(std::uint32_t facet) const;
    /// The plane through edge i (corner i to corner i+1) that is parallel to the dominant axis of
    /// the support (of several, the first one before the source was moved); the facet lies below.
    [[nodiscard]] Plane edge_plane(std::uint32_t facet, int i) const {
        return edge_plane(facet, i, support(facet));
    }
    /// The same for a given support.
    [[nodiscard]] Plane edge_plane(std::uint32_t facet, int i, const Plane& support) const;

    /// The same facets under the same serial on the lattice of exponent `exponent`. Names keep
    /// their meaning. \throw LimitError when coordinates or coefficients leave the lattice's range,
    /// on a finer one, or have too many bits behind the point, on a coarser one.
    [[nodiscard]] std::shared_ptr<const Source> on_lattice(int exponent) const;
    /// A half-space under the same serial on a lattice of any exponent. \throw LimitError when its
    /// coefficients become too long.
    [[nodiscard]] std::shared_ptr<const Source> half_space_on(int exponent) const;
    /// The same facets under a new serial, moved without rounding. Names of faces and corners
    /// stay. A mirror turns each triangle over: its second and third corner change places.
    /// \throw LimitError when coordinates leave the lattice's range.
    [[nodiscard]] std::shared_ptr<const Source> moved(const LatticeMove& move) const;
    /// A mesh, or planes, whose faces have the names of others. \pre one name for each face, and
    /// the source is new
    static std::shared_ptr<const Source> named(std::shared_ptr<const Source> source,
                                               std::vector<FaceSource> names);
    /// A mesh whose facets have these kinds. \pre one for each facet, and the source is new
    static std::shared_ptr<const Source> of_kinds(std::shared_ptr<const Source> source,
                                                  std::vector<FacetKind> kinds);

    /// What a file has of a source beside its facets.
    struct Stored {
        std::uint32_t operand = 0;
        std::array<std::uint8_t, 3> axes{0, 1, 2};
        std::vector<FaceSource> names;           ///< by face; empty: the operand's
        const Source* of_same_serial = nullptr;  ///< null: the source has a serial of its own
    };
    /// \pre the source is new; there is a name for each face, or none
    static std::shared_ptr<const Source> stored(std::shared_ptr<const Source> source,
                                                Stored stored);
    /// Serials of sources to come are larger. Past 2^31 nothing changes.
    static void reserve_serials(std::uint64_t largest);
    /// As many serials in a row as nothing else has; the first of them.
    [[nodiscard]] static std::uint64_t take_serials(std::uint64_t count);

private:
    Source() = default;
    ~Source() = default;
    static std::shared_ptr<const Source> share(Source* source);
    [[nodiscard]] std::shared_ptr<const Source> planes_on_lattice(int exponent) const;
    [[noreturn]] void refuse_lattice(int exponent, const std::string& why) const;
    [[nodiscard]] int edge_axis(const Plane& support) const;

    [[nodiscard]] std::shared_ptr<const Source> renamed_as_this(
        std::shared_ptr<const Source> source) const;

    LatticeMesh mesh_;
    std::vector<Plane> planes_;
    Box box_;
    bool whole_ = true;
    int fraction_bits_ = 0;
    std::uint64_t serial_ = 0;
    std::uint32_t operand_ = 0;
    std::shared_ptr<const std::vector<FaceSource>> names_;  // by face; null: its own
    std::shared_ptr<const std::vector<FacetKind>> kinds_;   // by facet; may be null
    /// Where components of a normal are equal, the first of these axes counts as the largest one.
    std::array<std::uint8_t, 3> axes_{0, 1, 2};
    mutable std::atomic<std::uint32_t> count_{0};
};

}  // namespace trisect::detail
