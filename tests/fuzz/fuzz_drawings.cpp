// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the readers of drawings: DXF, SVG, and pictures of heights. The first byte of an input
// chooses the format and says what the others are: bytes as they are, or words of the format, most
// of them where they belong. Checksums of pictures are made right, since they stop mutations. What
// is read is finite and within the limits.
#include <trisect/bsp/csg/drawing/picture.h>
#include <trisect/bsp/csg/drawing/read_dxf.h>
#include <trisect/bsp/csg/drawing/read_svg.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "byte_source.h"

namespace {

using fuzz::ByteSource;
using trisect::detail::Drawing;

void require(bool condition) {
    if (!condition) std::abort();
}

void check(const Drawing& drawing) {
    std::size_t corners = 0;
    const auto check_outline = [&](const trisect::Outline& outline) {
        corners += outline.size();
        for (const auto& p : outline) require(std::isfinite(p[0]) && std::isfinite(p[1]));
    };
    for (const auto& shape : drawing.shapes) {
        for (const auto& outline : shape.outlines) check_outline(outline);
        for (const auto& stroke : shape.strokes)
            for (const auto& piece : stroke) check_outline(piece);
    }
    require(corners <= 2 * trisect::detail::drawing_limit);
}

constexpr std::string_view dxf_words[] = {"0\nLINE\n",
                                          "0\nLWPOLYLINE\n",
                                          "0\nCIRCLE\n",
                                          "0\nARC\n",
                                          "0\nELLIPSE\n",
                                          "0\nINSERT\n",
                                          "0\nBLOCK\n",
                                          "0\nENDBLK\n",
                                          "2\nB\n",
                                          "8\nlayer\n",
                                          "0\nSECTION\n2\nBLOCKS\n",
                                          "0\nSECTION\n2\nENTITIES\n",
                                          "0\nENDSEC\n",
                                          "0\nEOF\n",
                                          "10\n1\n",
                                          "20\n2\n",
                                          "11\n3\n",
                                          "21\n1\n",
                                          "40\n2\n",
                                          "41\n0.5\n",
                                          "42\n6.28\n",
                                          "50\n90\n",
                                          "51\n10\n",
                                          "70\n1\n",
                                          "10\n-5\n",
                                          "20\n1e300\n",
                                          "40\n1e-9\n",
                                          "50\n1e30\n",
                                          "x\n"};

constexpr std::string_view svg_words[] = {"<rect x='1' y='2' width='30' height='4' rx='1'/>",
                                          "<circle cx='5' cy='5' r='3'/>",
                                          "<ellipse rx='3' ry='1e9'/>",
                                          "<line x1='1' x2='9' stroke-linecap='round'/>",
                                          "<polyline points='0,0 5,0 5,5' stroke-width='2'/>",
                                          "<polygon points='0,0 5,0 5,5 1e308 3'/>",
                                          "<g transform='",
                                          "rotate(30)",
                                          "scale(2 1e200)",
                                          "translate(1)",
                                          "skewX(45)",
                                          "'>",
                                          "</g>",
                                          "<path d='M1 1",
                                          " A5 2 10 0 1 7 7",
                                          " C1 2 3 4 5 6",
                                          " q1 1 2 0 t3 3",
                                          " s3 3 9 1",
                                          "h3V9",
                                          "z",
                                          "'/>",
                                          "<defs>",
                                          "</defs>",
                                          "<text>a</text>",
                                          "m-1-1"};

template <std::size_t N>
std::string words_of(ByteSource& source, const std::string_view (&words)[N]) {
    std::string out;
    while (!source.is_empty()) out += words[source.byte() % N];
    return out;
}

std::uint32_t checksum(std::string_view bytes) {
    std::uint32_t crc = ~std::uint32_t{0};
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; ++k) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

/// Behind a signature, with the checksum of each chunk as it should be.
std::string as_png(std::string_view bytes) {
    std::string out = "\x89PNG\r\n\x1a\n" + std::string(bytes);
    for (std::size_t at = 8; at + 12 <= out.size();) {
        std::size_t length = 0;
        for (std::size_t k = 0; k < 4; ++k)
            length = 256 * length + static_cast<unsigned char>(out[at + k]);
        if (length > out.size() - at - 12) break;
        const std::uint32_t crc = checksum(std::string_view(out).substr(at + 4, length + 4));
        for (unsigned k = 0; k < 4; ++k)
            out[at + 8 + length + k] = static_cast<char>(crc >> (24 - 8 * k));
        at += length + 12;
    }
    return out;
}

void read_dxf(const std::string& text) {
    const trisect::detail::InputText source(text, "fuzz", trisect::ReadLimits(), false);
    const auto sides = [](double radius) { return radius > 3 ? 12U : 5U; };
    check(trisect::detail::read_dxf(source, {"", {0, 0}, 1, sides}));
}

void read_svg(const std::string& text) {
    const trisect::detail::InputText source(text, "fuzz", trisect::ReadLimits(), false);
    check(trisect::detail::read_svg(source, {72, text.size() % 2 == 0}));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    ByteSource source(data + 1, size - 1);
    try {
        switch (data[0] % 6) {
            case 0:
                read_dxf(bytes);
                break;
            case 1:
            case 2:
                read_dxf("0\nSECTION\n2\nENTITIES\n" + words_of(source, dxf_words));
                break;
            case 3:
                read_svg(bytes);
                break;
            case 4:
                read_svg("<svg>" + words_of(source, svg_words) + "</svg>");
                break;
            default:
                (void)trisect::detail::png_brightness(as_png(bytes), "fuzz", 10'000);
        }
    } catch (const trisect::Error& e) {
        require(e.code() != trisect::ErrorCode::Internal);
    }
    return 0;
}
