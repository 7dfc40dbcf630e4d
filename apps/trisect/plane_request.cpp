// SPDX-License-Identifier: Apache-2.0
#include "plane_request.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include "values.h"

namespace trisect::app {

PlaneRequest PlaneRequest::from_text(std::string_view text, std::string_view option) {
    PlaneRequest request;
    if (text.size() == 1 || (text.size() > 1 && text[1] == '=')) {
        const auto axis = std::string_view("xyz").find(text.front());
        if (axis != std::string_view::npos) {
            request.axis_ = static_cast<int>(axis);
            if (text.size() > 1) request.position_ = parse_number(text.substr(2), option);
            return request;
        }
    }
    if (text.find(',') == std::string_view::npos) {
        throw UsageError(
            fmt::format("{}: '{}' is none of x, y, z, z=NUMBER and a,b,c,d", option, text));
    }
    request.coefficients_ = parse_tuple<4>(text, option);
    const auto& c = request.coefficients_;
    if (c[0] == 0 && c[1] == 0 && c[2] == 0) {
        throw UsageError(fmt::format("{}: a, b and c must not all be 0", option));
    }
    return request;
}

double PlaneRequest::position(const Bounds& bounds) const {
    const auto k = static_cast<std::size_t>(axis_.value());
    if (position_) return *position_;
    return bounds.lo[k] / 2 + bounds.hi[k] / 2;
}

std::array<double, 4> PlaneRequest::coefficients(const Bounds& bounds) const {
    if (!axis_) return coefficients_;
    const double sign = *axis_ == 1 ? -1 : 1;
    std::array<double, 4> out{};
    out[static_cast<std::size_t>(*axis_)] = sign;
    out[3] = -sign * position(bounds);
    return out;
}

}  // namespace trisect::app
