// SPDX-License-Identifier: Apache-2.0
//
// CornerProperties: numbers at the corners of the faces of a mesh.
// Texture coordinates, colours, normals, or whatever varies over faces.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trisect {

enum class PropertyMeaning : std::uint8_t {
    Any,                 ///< what the name says
    TextureCoordinates,  ///< u to the right and v upward; a picture spans 0 to 1
    Normal,              ///< a direction, of any length
    Color,               ///< red, green, blue and opacity in sRGB, 0 to 1
    LinearColor          ///< the same in amounts of light
};

/// Some columns of CornerProperties.
struct PropertyChannel {
    std::string name;
    PropertyMeaning meaning = PropertyMeaning::Any;
    std::size_t width = 1;
    friend bool operator==(const PropertyChannel&, const PropertyChannel&) = default;
};

/// What stands for a number that a corner does not have.
inline constexpr double absent_number = std::numeric_limits<double>::quiet_NaN();

/// Each corner of each face has its own numbers, so that neighbouring faces may differ where they
/// meet. Invariant: `values` has `width` numbers for each entry of PolygonMesh::corners; there are
/// no channels, or their widths add up to `width`.
struct CornerProperties {
    std::size_t width = 0;
    std::vector<double> values;
    std::vector<PropertyChannel> channels = {};  ///< empty: columns without names

    [[nodiscard]] std::span<const double> at(std::size_t corner) const {
        return std::span(values).subspan(corner * width, width);
    }
    /// The first column of the first channel of a meaning.
    [[nodiscard]] std::optional<std::size_t> column_of(PropertyMeaning meaning) const {
        std::size_t column = 0;
        for (const PropertyChannel& channel : channels) {
            if (channel.meaning == meaning) return column;
            column += channel.width;
        }
        return std::nullopt;
    }
    /// Absent numbers are equal to each other.
    friend bool operator==(const CornerProperties& a, const CornerProperties& b) {
        if (a.width != b.width || a.channels != b.channels || a.values.size() != b.values.size())
            return false;
        for (std::size_t i = 0; i < a.values.size(); ++i) {
            const bool both_absent = std::isnan(a.values[i]) && std::isnan(b.values[i]);
            if (!both_absent && a.values[i] != b.values[i]) return false;
        }
        return true;
    }
};

/// The channels of all, each once, in the order in which they appear.
/// \throw UsageError for channels of one name that differ, and where one has numbers without names
[[nodiscard]] std::vector<PropertyChannel> united_channels(
    std::span<const CornerProperties* const> all);

/// The same numbers under other channels, for so many corners; numbers that are not there are
/// absent.
[[nodiscard]] CornerProperties under_channels(const CornerProperties& properties,
                                              std::span<const PropertyChannel> channels,
                                              std::size_t corners);

struct PropertyPiece {
    const CornerProperties* properties = nullptr;
    std::size_t corners = 0;
};

/// One after the other, under the channels of all. \throw UsageError as united_channels
[[nodiscard]] CornerProperties joined_properties(std::span<const PropertyPiece> pieces);

}  // namespace trisect
