// SPDX-License-Identifier: Apache-2.0
//
// Heights of layers: a step, a number of layers, or a list.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::app {

/// Where in its step a layer's plane is.
enum class PlaneIn : std::uint8_t { Middle, Bottom, Top };

struct HeightRequest {
    std::optional<double> step;
    std::optional<std::uint64_t> count;
    std::string heights;  ///< numbers with commas between, or a file of them; empty: none
    std::optional<double> from;
    std::optional<double> to;
    PlaneIn plane = PlaneIn::Middle;

    /// \throw UsageError unless there is one of step, count and heights, and what goes with it
    void check() const;
};

struct LayerHeights {
    std::vector<double> planes;
    std::vector<std::array<double, 2>> steps;  ///< of each plane; none for a list
};

inline constexpr std::uint64_t most_layers = 1'000'000;

/// Between the ends of the solid, or those that were given: step i is from + i H to from + (i + 1)
/// H, and there are as many as have their middle below the upper end. A list goes as it is. Each
/// height is computed in doubles, once. `ends` is nothing for the empty set.
/// \throw LimitError beyond most_layers; UsageError, InputError for the list
[[nodiscard]] LayerHeights layer_heights(const HeightRequest& request,
                                         const std::optional<std::array<double, 2>>& ends);

/// Numbers with blanks, commas or new lines between them; # begins a comment. \throw InputError
[[nodiscard]] std::vector<double> parse_heights(std::string_view text, const std::string& name);

}  // namespace trisect::app
