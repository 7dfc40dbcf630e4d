// SPDX-License-Identifier: Apache-2.0
//
// PageData: arrays of numbers in a page of HTML.
// They lie one after the other, deflated together and written in base64.
#pragma once

#include <trisect/kernel/point3d.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "outcome.h"

namespace trisect::app {

/// Bytes of several arrays, with their places for the reader.
class PageData {
public:
    void add(const std::string& name, std::string_view bytes);
    void add_floats(const std::string& name, const std::vector<float>& values);
    /// The first bytes of all numbers, then the second ones and so on: they are alike.
    void add_doubles(const std::string& name, std::span<const double> values);
    /// Three doubles a point, all as above.
    void add_points(const std::string& name, std::span<const Point3d> points);
    /// As differences, see below.
    void add_integers(const std::string& name, std::span<const std::uint32_t> values);
    /// By name, the first byte and how many there are.
    [[nodiscard]] const Json& places() const { return places_; }
    /// \throw LimitError when there is no memory
    [[nodiscard]] std::string in_base64() const;

private:
    std::string bytes_;
    Json places_ = Json::object();
};

/// Differences of integers, the sign in the last bit, seven bits a byte, the lowest first: most
/// take one byte or two where one number is near the one before.
class Differences {
public:
    void add(std::int64_t value);
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::int64_t last_ = 0;
};

/// JSON within a script: no text of it ends the element.
[[nodiscard]] std::string script_text(const Json& json);

}  // namespace trisect::app
