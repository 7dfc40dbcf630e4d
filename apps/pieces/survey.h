// SPDX-License-Identifier: Apache-2.0
//
// Survey: the reach of all triangles of an operand.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <trisect/kernel/point3d.h>

#include "triangle_stream.h"

namespace trisect::app {

/// What one pass over an operand says, or over a share of it.
struct Survey {
    std::uint64_t triangles = 0;
    Point3d low{};
    Point3d high{};
    double volume = 0;  ///< rounded
    /// Every so many triangles one: its reach along the axes.
    std::uint64_t step = 1;
    struct Reach {
        std::array<double, 3> low;
        std::array<double, 3> high;
    };
    std::vector<Reach> sample;

    /// The next share of the same operand.
    void add(const Survey& next);
};

/// The sample of all shares together is that of one.
/// \throw Error (InvalidSolid) for coordinates that are not finite
[[nodiscard]] Survey survey_of(const TriangleStream& stream, const std::string& name,
                               std::size_t share, std::size_t shares);

/// One share of all operands, as a file.
void write_surveys(const std::string& name, const std::vector<Survey>& surveys);
/// \throw InputError for a file that is damaged
[[nodiscard]] std::vector<Survey> read_surveys(const std::string& name, std::size_t operands);

}  // namespace trisect::app
