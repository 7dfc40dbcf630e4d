// SPDX-License-Identifier: Apache-2.0
//
// InterferenceModel: a solid prepared for interference queries under poses.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include <trisect/brep/brep.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/lattice.h>

namespace trisect {

namespace detail {
class LazyModel;
struct InterferenceModelAccess;
}  // namespace detail

/// What a model is like.
struct InterferenceModelStats {
    std::size_t faces = 0;
    std::size_t triangles = 0;
    std::size_t shells = 0;
    std::size_t box_levels = 0;      ///< of the tree of oriented boxes
    std::size_t bytes = 0;           ///< of triangles, positions and boxes, without the B-rep
    double brep_seconds = 0;         ///< Solid::to_brep
    double triangulate_seconds = 0;  ///< triangles of all faces
    double boxes_seconds = 0;        ///< the tree of oriented boxes
};

/// The boundary of a solid with maximal faces, cut into triangles, with what queries under motion
/// need beside it. All entities that such queries name (FaceId, EdgeId, VertexId) are those of
/// `brep()`; its faces name their sources (Brep::source).
///
/// Poses are applied to the solid, never to the model: nothing in it ever moves.
///
/// Solids answer the same questions without one, by the tree that they have
/// (solid_interference.h). A model gives entities of a B-rep and certificates, and many questions
/// about a solid that stays as it is are faster by one.
///
/// Immutable value; copying shares. Safe to use from many threads. The empty solid is allowed: it
/// is disjoint from everything, and a model that was moved from is that of the empty solid. Cost:
/// none at first. Solid::to_brep when the B-rep is first needed, and O(n log n) beside it at the
/// first question; other threads wait.
class InterferenceModel {
public:
    /// Of the empty solid.
    InterferenceModel();
    /// A solid imported under Embedding::Resolve is resolved first.
    /// \throw UnsupportedError when the solid is unbounded; what evaluate() throws
    explicit InterferenceModel(const Solid& solid);
    /// The same with an index that exists already; its B-rep is taken over where it has one.
    explicit InterferenceModel(const BrepIndex& index);

    [[nodiscard]] const Solid& solid() const;
    /// Made at the first call. \throw what Solid::to_brep throws
    [[nodiscard]] const Brep& brep() const;
    /// Points and planes of the B-rep are in units of this lattice.
    [[nodiscard]] Lattice lattice() const;
    [[nodiscard]] bool is_empty() const;
    /// Makes all that questions need.
    [[nodiscard]] std::size_t triangle_count() const;
    /// The same.
    [[nodiscard]] InterferenceModelStats stats() const;
    /// The index over the solid, without a B-rep unless the model was made with one. Made at the
    /// first call, which others wait for.
    [[nodiscard]] const BrepIndex& index() const;

private:
    friend struct detail::InterferenceModelAccess;

    [[nodiscard]] const detail::LazyModel& shared() const {
        return shared_ != nullptr ? *shared_ : *empty_model();
    }
    [[nodiscard]] static const std::shared_ptr<const detail::LazyModel>& empty_model();

    std::shared_ptr<const detail::LazyModel> shared_;
};

}  // namespace trisect
