// SPDX-License-Identifier: Apache-2.0
//
// FCL's continuous collision, beside first_contact. Without FCL nothing is answered.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include <trisect/brep/polygon_mesh.h>

namespace peer {

bool is_available();

class Body {
public:
    explicit Body(const trisect::PolygonMesh& mesh);
    struct Data;
    std::shared_ptr<const Data> data;
};

// FCL's solvers for pairs of meshes: samples (its default, ten of them) and conservative
// advancement.
enum class Solver { Samples, ManySamples, ConservativeAdvancement };

// The time of contact of b, translated from `start` (3x4, row by row) by a vector, with a at rest;
// nothing when FCL reports none.
std::optional<double> first_contact(const Body& a, const Body& b,
                                    const std::array<double, 12>& start,
                                    const std::array<double, 3>& by, Solver solver);

}  // namespace peer
