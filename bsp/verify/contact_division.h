// SPDX-License-Identifier: Apache-2.0
//
// Division of faces at contacts until a mesh is certified.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/certificate.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/verify/contact_insertion.h>
#include <trisect/kernel/lattice.h>

namespace trisect::detail {

/// Sums of doubles, rounded up.
[[nodiscard]] double sum_up(double a, double b);

/// The defects of a mesh; without its intersections where there are too many to list.
[[nodiscard]] ValidationReport listed_defects(const PolygonMesh& mesh,
                                              const std::optional<Lattice>& lattice);

/// A mesh that is divided where its faces touch (ContactInsertion), in passes, since a pass divides
/// each face at one place, and for as long as that helps.
class ContactDivision {
public:
    /// `grain` is the unit of the coordinates, or 0; `lattice` is of the checks.
    ContactDivision(PolygonMesh mesh, double grain, const std::optional<Lattice>& lattice,
                    ContactInsertion::Rounding rounding);

    /// Nothing is inserted that is farther away than `reach`. Whether the mesh is certified now.
    bool run(double reach);

    PolygonMesh mesh;
    std::vector<std::uint32_t> parents;  ///< the triangle that each triangle is a part of
    /// Of the mesh; nothing where no face was divided.
    std::optional<Certificate> certificate;
    double moved = 0;             ///< no point of the surface moved farther
    std::size_t first_pairs = 0;  ///< that met at first

private:
    bool divide(const ValidationReport& report, double reach);

    double grain_;
    std::optional<Lattice> lattice_;
    ContactInsertion::Rounding rounding_;
};

}  // namespace trisect::detail
