// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/properties/property_collector.h>

#include <trisect/kernel/stop_scope.h>

#include <algorithm>

namespace trisect::detail {

std::size_t PropertyCollector::channel(PropertyMeaning meaning, std::size_t width,
                                       const std::string& name) {
    for (std::size_t i = 0; i < columns_.size(); ++i)
        if (columns_[i].channel.meaning == meaning && columns_[i].channel.name == name) return i;
    columns_.push_back({{name, meaning, width}, {}});
    return columns_.size() - 1;
}

void PropertyCollector::set(std::size_t channel, std::size_t corner,
                            std::span<const double> numbers, const char* at) {
    check_stop();
    Column& column = columns_[channel];
    const std::size_t needed = (corner + 1) * numbers.size();
    if (column.values.size() < needed) {
        numbers_ += needed - column.values.size();
        if (numbers_ > source_->limits().property_numbers) {
            source_->fail_limit(at, "more than " +
                                        std::to_string(source_->limits().property_numbers) +
                                        " numbers at corners, the limit for a file");
        }
        column.values.resize(needed, absent_number);
    }
    std::copy(numbers.begin(), numbers.end(),
              column.values.begin() + static_cast<std::ptrdiff_t>(corner * numbers.size()));
}

CornerProperties PropertyCollector::finish(std::size_t corners) const {
    CornerProperties out;
    std::vector<const Column*> used;
    for (const Column& column : columns_) {
        if (column.values.empty()) continue;
        used.push_back(&column);
        out.width += column.channel.width;
        out.channels.push_back(column.channel);
    }
    out.values.reserve(out.width * corners);
    for (std::size_t c = 0; c < corners; ++c) {
        for (const Column* column : used) {
            const std::size_t width = column->channel.width;
            for (std::size_t i = 0; i < width; ++i) {
                const std::size_t at = c * width + i;
                out.values.push_back(at < column->values.size() ? column->values[at]
                                                                : absent_number);
            }
        }
    }
    return out;
}

}  // namespace trisect::detail
