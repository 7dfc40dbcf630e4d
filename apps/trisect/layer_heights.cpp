// SPDX-License-Identifier: Apache-2.0
#include "layer_heights.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <cmath>

#include "line_words.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t heights_file_limit = std::uint64_t{1} << 26;

void check_count(double count) {
    if (!(count <= static_cast<double>(most_layers)))
        throw LimitError(fmt::format("more than {} layers", most_layers));
}

bool is_list(std::string_view text) {
    try {
        static_cast<void>(parse_numbers(text, "--heights"));
        return true;
    } catch (const UsageError&) {
        return false;
    }
}

std::vector<double> listed(const std::string& text) {
    std::vector<double> out = is_list(text)
                                  ? parse_numbers(text, "--heights")
                                  : parse_heights(read_file(text, heights_file_limit).view(), text);
    check_count(static_cast<double>(out.size()));
    return out;
}

double plane_in(PlaneIn place, double from, double step, double i) {
    const double part = place == PlaneIn::Middle ? 0.5 : place == PlaneIn::Top ? 1 : 0;
    return from + (i + part) * step;
}

}  // namespace

void HeightRequest::check() const {
    const int given = (step ? 1 : 0) + (count ? 1 : 0) + (heights.empty() ? 0 : 1);
    if (given != 1) throw UsageError("which layers? One of --step, --count and --heights");
    if (step && !(*step > 0)) throw UsageError("--step: must be positive");
    if (count && *count == 0) throw UsageError("--count: must be positive");
    if (count) check_count(static_cast<double>(*count));
    if (from && to && !(*from < *to)) throw UsageError("--from: must be below --to");
    if (!heights.empty() && (from || to || plane != PlaneIn::Middle))
        throw UsageError("--heights: goes without --from, --to and --at");
}

LayerHeights layer_heights(const HeightRequest& request,
                           const std::optional<std::array<double, 2>>& ends) {
    LayerHeights out;
    if (!request.heights.empty()) {
        out.planes = listed(request.heights);
        return out;
    }
    if (!ends && !(request.from && request.to)) return out;
    const double from = request.from ? *request.from : (*ends)[0];
    const double to = request.to ? *request.to : (*ends)[1];
    if (!(from < to)) return out;
    const auto fixed = static_cast<double>(request.count.value_or(0));
    const double step = request.step ? *request.step : to / fixed - from / fixed;
    if (!std::isfinite(step) || !(from + step > from) || !(to - step < to))
        throw LimitError("the step is too small beside the heights");
    if (request.step) check_count(to / step - from / step - 1);
    for (double i = 0; request.count ? i < fixed : plane_in(PlaneIn::Middle, from, step, i) < to;
         ++i) {
        out.planes.push_back(plane_in(request.plane, from, step, i));
        out.steps.push_back({from + i * step, from + (i + 1) * step});
    }
    return out;
}

std::vector<double> parse_heights(std::string_view text, const std::string& name) {
    std::vector<double> out;
    FilePlace place{name, 0, 0, 0};
    while (!text.empty()) {
        ++place.line;
        for (const LineWord& word : words_of(without_comment(take_line(text)))) {
            try {
                out.push_back(parse_number(word.text, "height"));
            } catch (const UsageError& e) {
                throw InputError(FilePlace{name, place.line, word.column, 0}, e.what());
            }
        }
    }
    return out;
}

}  // namespace trisect::app
