// SPDX-License-Identifier: Apache-2.0
//
// The quick ways of the readers beside the careful ones: the same meshes and the same errors at the
// same places, for good files, for files with odd spelling and for spoiled ones; and how much of a
// file goes the quick way.
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/quick_items.h>
#include <trisect/brep/io/formats/quick_text.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>

#include "support/mesh_files.h"

#include <charconv>
#include <cmath>
#include <random>

namespace {

using namespace trisect;
using namespace trisect::io_test;
using Random = std::mt19937_64;

struct Kind {
    MeshFormat format;
    PlyEncoding encoding = PlyEncoding::Ascii;
};

constexpr Kind kinds[] = {{MeshFormat::Obj},
                          {MeshFormat::Off},
                          {MeshFormat::StlAscii},
                          {MeshFormat::StlBinary},
                          {MeshFormat::Ply, PlyEncoding::Ascii},
                          {MeshFormat::Ply, PlyEncoding::BinaryLittleEndian},
                          {MeshFormat::Ply, PlyEncoding::BinaryBigEndian}};

std::string file(const PolygonMesh& mesh, const Kind& kind) {
    return format_mesh(mesh, {.format = kind.format, .ply_encoding = kind.encoding}).bytes;
}

struct Outcome {
    PolygonMesh mesh;
    std::string error;
};

Outcome read_as(const detail::InputText& source, MeshFormat format) {
    Outcome out;
    try {
        switch (format) {
            case MeshFormat::Obj:
                out.mesh = detail::read_obj(source);
                break;
            case MeshFormat::Off:
                out.mesh = detail::read_off(source);
                break;
            case MeshFormat::Ply:
                out.mesh = detail::read_ply(source);
                break;
            case MeshFormat::StlBinary:
                out.mesh = detail::read_stl_binary(source);
                break;
            default:
                out.mesh = detail::read_stl_ascii(source);
        }
    } catch (const Error& e) {
        out.error = std::to_string(static_cast<int>(e.code())) + " " + e.what();
    }
    return out;
}

/// Compares both ways; the number of items that went the quick way.
std::uint64_t compare(const std::string& text, MeshFormat format, const ReadLimits& limits = {}) {
    const detail::InputText source(text, "test", limits, format == MeshFormat::StlBinary);
    const Outcome careful = read_as(source.carefully(), format);
    const std::uint64_t before = detail::quick_items;
    const Outcome quick = read_as(source, format);
    EXPECT_EQ(quick.error, careful.error) << text.substr(0, 2000);
    EXPECT_TRUE(same_bits(quick.mesh, careful.mesh)) << text.substr(0, 2000);
    return detail::quick_items - before;
}

PolygonMesh triangles() { return make_icosphere(1.25, 2); }

TEST(QuickWays, AreTakenByNearlyAllOfAFile) {
    const PolygonMesh mesh = triangles();
    for (const Kind& kind : kinds) {
        const bool soup =
            kind.format == MeshFormat::StlAscii || kind.format == MeshFormat::StlBinary;
        const std::uint64_t items = mesh.face_count() + (soup ? 0 : mesh.points.size());
        const std::uint64_t quick = compare(file(mesh, kind), kind.format);
        EXPECT_GE(quick + 4, items);
        EXPECT_LE(quick, items);
    }
}

TEST(QuickWays, PolygonsOfManySizes) {
    PolygonMesh mesh = make_torus(3, 1, 12, 7);
    for (std::uint32_t n = 3; n < 20; ++n) {
        std::vector<std::uint32_t> loop;
        for (std::uint32_t i = 0; i < n; ++i) loop.push_back(i);
        mesh.add_face(loop);
    }
    for (const Kind& kind : kinds) {
        if (kind.format == MeshFormat::StlAscii || kind.format == MeshFormat::StlBinary) continue;
        EXPECT_GE(compare(file(mesh, kind), kind.format), 100U);
    }
}

TEST(QuickWays, NoneUnderLimitsThatTheyCannotCheck) {
    for (const Kind& kind : kinds) {
        const std::string text = file(triangles(), kind);
        compare(text, kind.format, {.vertices = 100});
        compare(text, kind.format, {.faces = 100});
        compare(text, kind.format, {.loop_corners = 2});
        compare(text, kind.format, {.line_bytes = 30});
        compare(text, kind.format, {.literal_characters = 5});
    }
}

/// Puts in, takes out or changes some bytes, mostly such as the format uses.
void spoil(Random& random, std::string& text) {
    static const std::string common = "0123456789.-+eE \t\r\n/#\\vfx\xFF\v";
    const auto byte = [&] {
        return random() % 8 == 0 ? static_cast<char>(random() % 256)
                                 : common[random() % common.size()];
    };
    for (std::uint64_t i = 1 + random() % 3; i > 0 && !text.empty(); --i) {
        const std::size_t at = random() % text.size();
        switch (random() % 4) {
            case 0:
                text.erase(at, 1 + random() % 3);
                break;
            case 1:
                text.insert(at, 1 + random() % 3, byte());
                break;
            case 2:
                text[at] = byte();
                break;
            default:
                if (random() % 8 == 0) text.resize(at);
        }
    }
}

TEST(QuickWays, SpoiledFilesGiveTheSameErrors) {
    Random random(11);
    const PolygonMesh mesh = make_icosphere(1.25, 1);
    for (const Kind& kind : kinds) {
        const std::string text = file(mesh, kind);
        for (int round = 0; round < 6000; ++round) {
            std::string spoiled = text;
            spoil(random, spoiled);
            compare(spoiled, kind.format);
            if (HasFailure()) return;
        }
    }
}

TEST(QuickWays, OddSpellings) {
    const std::string tail(80, '\n');  // so that all lines can be tried
    compare(
        "v 1 2 3\nv 1 2 4\nv 1 3 3\nf 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//2 3//3\nf 1/2/3 2/3/4 "
        "3/4/5\nf 1/ 2/ 3/\nf 1// 2// 3//\nf -1 -2 -3\nf 3 2 1 \nf 1\t2\t3\r\n" +
            tail,
        MeshFormat::Obj);
    compare("v 1 2 3 1\nv 1 2 4 # a\nv 1 3 \\\n3\nv  .5  5. +1\nv 1e2 1E-2 -0\nf 1 2 3\n" + tail,
            MeshFormat::Obj);
    compare("v 1 2 3\nv 1 2 4\nv 1 3 3\ng a\\\nf 1 2 3\n" + tail, MeshFormat::Obj);
    compare("v 1 2 3\nf 1 2 3\nv 1 2 4\nv 1 3 3\n" + tail, MeshFormat::Obj);
    compare("v 1 2 3\nf 1 2 9\nv 1 2 4\nv 1 3 3\n" + tail, MeshFormat::Obj);
    compare("OFF\n3 1 0\n1 2 3\n\n1 2 4 # c\n1 3 3\n3 0 1 2 255 0 0\n" + tail, MeshFormat::Off);
    compare("OFF\n3 1 0\n1 2 3 4\n1 2 4\n1 3 3\n3 0 1 2\n" + tail, MeshFormat::Off);
    compare("OFF\n3 1 0\n1 2 3\n1 2 4 4\n1 3 3\n3 0 1 2\n" + tail, MeshFormat::Off);
    compare(
        "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   "
        "vertex 0 1 0\n  endloop\n endfacet\nfacet normal nan nan nan\nouter loop\nvertex 0 0 "
        "0 vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nFACET normal 0 0 1\nouter "
        "loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n" +
            tail,
        MeshFormat::StlAscii);
}

/// What std::from_chars makes of the whole text; nothing when it does not take all of it.
std::optional<double> from_chars(const std::string& text) {
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
    return value;
}

/// Compares number() with from_chars; whether it took the number.
bool compare_number(const std::string& text) {
    const std::string line = text + "\n" + std::string(40, '\n');
    const detail::InputText source(line, "test", {}, false);
    detail::QuickText quick(source);
    quick.begin(source.begin());
    double value = 0;
    if (!quick.number(value) || !quick.line_end()) return false;
    const auto expected = from_chars(text);
    EXPECT_TRUE(expected &&
                std::bit_cast<std::uint64_t>(*expected) == std::bit_cast<std::uint64_t>(value))
        << text;
    return true;
}

std::string digits(double value) {
    std::string text;
    char buffer[64];
    text.assign(buffer, std::to_chars(buffer, buffer + sizeof(buffer), value).ptr);
    return text;
}

TEST(QuickNumber, ShortestDigitsOfDoublesAndFloats) {
    Random random(12);
    int taken = 0;
    for (int i = 0; i < 200000; ++i) {
        const double x = std::ldexp(static_cast<double>(static_cast<std::int64_t>(random()) >> 10),
                                    -static_cast<int>(random() % 75));
        taken += compare_number(digits(x)) ? 1 : 0;
        taken += compare_number(digits(static_cast<double>(static_cast<float>(x)))) ? 1 : 0;
    }
    EXPECT_GT(taken, 350000);
}

TEST(QuickNumber, HalfwayBetweenTwoDoublesAndBesideIt) {
    Random random(13);
    for (int i = 0; i < 100000; ++i) {
        // (2m + 1) / 2^s with 54 bits on top, written in full: a tie.
        const std::uint64_t m = (std::uint64_t{1} << 53) + (random() >> 12);
        const unsigned s = static_cast<unsigned>(random() % 4);
        std::uint64_t n = m | 1;
        for (unsigned k = 0; k < s; ++k) n *= 5;
        std::string text = std::to_string(n + random() % 3 - 1);
        if (s > 0) text.insert(text.size() - s, ".");
        compare_number(text);
    }
}

// No division normalises zero: shifting it by its 64 leading zeros is undefined.
TEST(QuickNumber, ZeroWithManyDecimals) {
    for (int decimals = 1; decimals < 40; ++decimals) {
        const std::string exponent = "e-" + std::to_string(decimals);
        for (const std::string sign : {"", "-"}) {
            EXPECT_EQ(compare_number(sign + "0" + exponent), decimals <= 22);
            compare_number(sign + "0." + std::string(static_cast<std::size_t>(decimals), '0'));
            compare_number(sign + "0.0" + exponent);
        }
    }
}

TEST(QuickNumber, AnyCharacters) {
    Random random(14);
    static const std::string common = "0123456789012345678901234567890.-+eE/x";
    for (int i = 0; i < 300000; ++i) {
        std::string text;
        for (std::uint64_t k = random() % 24; k > 0; --k) text += common[random() % common.size()];
        compare_number(text);
    }
}

}  // namespace
