// SPDX-License-Identifier: Apache-2.0
//
// Volumes of GDML, and what is placed in each.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "gdml_solids.h"

namespace trisect::app {

struct GdmlDaughter {
    std::string name;
    std::uint32_t solid = 0;
    std::array<double, 12> pose{};  ///< in the frame of the mother, in steps
    bool is_rounded = false;        ///< the pose turns by no quarter turns
};

/// A logical volume: its placements are judged once, wherever and how often it is placed itself.
struct GdmlVolume {
    std::string name;
    std::uint32_t solid = 0;
    std::vector<GdmlDaughter> daughters;
    std::vector<std::string> left_out;  ///< placements that are not supported, with their places
};

/// All volumes of the section `structure`, in its order. Assemblies, which have no solid, are
/// what they place. \throw InputError, LimitError
[[nodiscard]] std::vector<GdmlVolume> gdml_volumes(const GdmlSource& source,
                                                   const GdmlSolids& solids);

}  // namespace trisect::app
