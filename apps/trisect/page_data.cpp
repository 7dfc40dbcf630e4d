// SPDX-License-Identifier: Apache-2.0
#include "page_data.h"

#include <trisect/kernel/error.h>

#include <zlib.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace trisect::app {
namespace {

static_assert(std::endian::native == std::endian::little);

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word =
                word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : digits[(word >> (18 - 6 * k)) & 63];
    }
    return out;
}

}  // namespace

void PageData::add(const std::string& name, std::string_view bytes) {
    while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
    places_[name] = {bytes_.size(), bytes.size()};
    bytes_ += bytes;
}

void PageData::add_floats(const std::string& name, const std::vector<float>& values) {
    std::string bytes(values.size() * sizeof(float), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    add(name, bytes);
}

void PageData::add_doubles(const std::string& name, std::span<const double> values) {
    std::string bytes(values.size() * sizeof(double), '\0');
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto of_value = std::bit_cast<std::array<char, sizeof(double)>>(values[i]);
        for (std::size_t b = 0; b < sizeof(double); ++b) bytes[b * values.size() + i] = of_value[b];
    }
    add(name, bytes);
}

void PageData::add_points(const std::string& name, std::span<const Point3d> points) {
    std::vector<double> all;
    all.reserve(3 * points.size());
    for (const Point3d& p : points) all.insert(all.end(), p.begin(), p.end());
    add_doubles(name, all);
}

void PageData::add_integers(const std::string& name, std::span<const std::uint32_t> values) {
    Differences differences;
    for (const std::uint32_t n : values) differences.add(n);
    add(name, differences.bytes());
}

std::string PageData::in_base64() const {
    uLongf size = compressBound(static_cast<uLong>(bytes_.size()));
    std::string out(size, '\0');
    const int result = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                                 reinterpret_cast<const Bytef*>(bytes_.data()),
                                 static_cast<uLong>(bytes_.size()), Z_DEFAULT_COMPRESSION);
    if (result != Z_OK) throw LimitError("no memory for the data of the page");
    out.resize(size);
    return base64(out);
}

void Differences::add(std::int64_t value) {
    const std::int64_t d = value - last_;
    last_ = value;
    auto n = static_cast<std::uint64_t>(d < 0 ? -2 * d - 1 : 2 * d);
    for (; n >= 128; n >>= 7) bytes_ += static_cast<char>((n & 127) | 128);
    bytes_ += static_cast<char>(n);
}

std::string script_text(const Json& json) {
    std::string out = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    for (std::size_t at = out.find("</"); at != std::string::npos; at = out.find("</", at + 3))
        out.insert(at + 1, "\\");
    return out;
}

}  // namespace trisect::app
