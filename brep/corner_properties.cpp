// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/corner_properties.h>

#include <trisect/kernel/error.h>

#include <algorithm>

namespace trisect {
namespace {

constexpr std::size_t absent_column = static_cast<std::size_t>(-1);

/// For each column of `to`, the one of `from` that it comes from.
std::vector<std::size_t> columns_in(std::span<const PropertyChannel> from,
                                    std::span<const PropertyChannel> to) {
    std::vector<std::size_t> out;
    for (const PropertyChannel& wanted : to) {
        std::size_t first = 0;
        bool is_there = false;
        for (const PropertyChannel& channel : from) {
            is_there = channel == wanted;
            if (is_there) break;
            first += channel.width;
        }
        for (std::size_t i = 0; i < wanted.width; ++i)
            out.push_back(is_there ? first + i : absent_column);
    }
    return out;
}

}  // namespace

std::vector<PropertyChannel> united_channels(std::span<const CornerProperties* const> all) {
    std::vector<PropertyChannel> out;
    for (const CornerProperties* properties : all) {
        std::size_t width = 0;
        for (const PropertyChannel& channel : properties->channels) {
            width += channel.width;
            const auto same = std::find_if(out.begin(), out.end(), [&](const PropertyChannel& c) {
                return c.name == channel.name;
            });
            if (same == out.end())
                out.push_back(channel);
            else if (*same != channel)
                throw UsageError("properties of the name " + channel.name +
                                 " differ in what they mean");
        }
        if (width != properties->width)
            throw UsageError("properties whose channels do not add up to their width");
    }
    return out;
}

CornerProperties under_channels(const CornerProperties& properties,
                                std::span<const PropertyChannel> channels, std::size_t corners) {
    const std::vector<std::size_t> columns = columns_in(properties.channels, channels);
    CornerProperties out;
    out.width = columns.size();
    out.channels.assign(channels.begin(), channels.end());
    if (channels.size() == properties.channels.size() &&
        std::equal(channels.begin(), channels.end(), properties.channels.begin())) {
        out.values = properties.values;
        return out;
    }
    out.values.reserve(columns.size() * corners);
    for (std::size_t c = 0; c < corners; ++c)
        for (const std::size_t column : columns)
            out.values.push_back(column == absent_column
                                     ? absent_number
                                     : properties.values[c * properties.width + column]);
    return out;
}

CornerProperties joined_properties(std::span<const PropertyPiece> pieces) {
    std::vector<const CornerProperties*> all;
    all.reserve(pieces.size());
    for (const PropertyPiece& piece : pieces) all.push_back(piece.properties);
    CornerProperties out;
    out.channels = united_channels(all);
    for (const PropertyChannel& channel : out.channels) out.width += channel.width;
    for (const PropertyPiece& piece : pieces) {
        const CornerProperties more =
            under_channels(*piece.properties, out.channels, piece.corners);
        out.values.insert(out.values.end(), more.values.begin(), more.values.end());
    }
    return out;
}

}  // namespace trisect
