// SPDX-License-Identifier: Apache-2.0
//
// PropertyCollector: gathers properties of corners in any order.
// A channel exists once a corner has numbers in it.
#pragma once

#include <trisect/brep/corner_properties.h>
#include <trisect/brep/io/formats/input_text.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace trisect::detail {

/// The channels that files of all formats have in common.
inline constexpr std::size_t uv_width = 2;
inline constexpr std::size_t normal_width = 3;
inline constexpr std::size_t color_width = 4;

class PropertyCollector {
public:
    /// `source` must outlive this; its limits hold, and errors name it.
    explicit PropertyCollector(const InputText& source) : source_(&source) {}

    /// The number of a channel, which is made when it is first asked for.
    std::size_t channel(PropertyMeaning meaning, std::size_t width, const std::string& name);
    std::size_t uv() { return channel(PropertyMeaning::TextureCoordinates, uv_width, "uv"); }
    std::size_t normal() { return channel(PropertyMeaning::Normal, normal_width, "normal"); }
    std::size_t color() { return channel(PropertyMeaning::Color, color_width, "color"); }
    std::size_t linear_color() {
        return channel(PropertyMeaning::LinearColor, color_width, "color");
    }

    /// As many numbers as the channel is wide. `at` is the place for a LimitError.
    void set(std::size_t channel, std::size_t corner, std::span<const double> numbers,
             const char* at);

    /// Channels without a number are left out.
    [[nodiscard]] CornerProperties finish(std::size_t corners) const;

private:
    struct Column {
        PropertyChannel channel;
        std::vector<double> values;
    };
    const InputText* source_;
    std::vector<Column> columns_;
    std::uint64_t numbers_ = 0;
};

}  // namespace trisect::detail
