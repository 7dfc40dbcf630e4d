// SPDX-License-Identifier: Apache-2.0
//
// Interference of solids on their own trees beside that of models, which are made of B-reps.
#pragma once

#include <cstdint>
#include <string>

#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/solid.h>

#include "interference_oracle.h"

namespace brute {

/// A body, evaluated in cells of so few polygons.
[[nodiscard]] trisect::Solid solid_of(const Body& body, std::uint32_t leaf_polygons);

/// What differs between interfere() of the solids, evaluated in cells of so few polygons, and of
/// their models; empty when nothing does. Relations both ways, with contacts and without, and the
/// kinds of contacts.
[[nodiscard]] std::string difference_of_solids(const Scene& scene, std::uint32_t leaf_polygons,
                                               trisect::Relation* relation = nullptr);

/// The same after each of some cuts of A by parts of B at random places, by solids that keep what
/// earlier questions prepared, and by a query that goes on.
[[nodiscard]] std::string difference_along_cuts(const Scene& scene, std::uint32_t leaf_polygons,
                                                reference::Random& random, int cuts);

}  // namespace brute
