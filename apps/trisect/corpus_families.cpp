// SPDX-License-Identifier: Apache-2.0
#include "corpus_families.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace trisect::app {
namespace {

using enum BooleanOperation;
using Scenes = std::vector<BoxScene>;

Box cube(double x, double y, double z, double size) {
    return {{x, y, z}, {x + size, y + size, z + size}};
}

/// Union, intersection, difference and symmetric difference of two boxes.
void add_all_operations(Scenes& scenes, const std::string& name, const Box& a, const Box& b) {
    for (const BooleanOperation op : {Union, Intersection, Difference, SymmetricDifference})
        scenes.push_back({fmt::format("{}-{}", name, to_string(op)), op, {{a}, {b}}});
}

Scenes touching() {
    const Box a = cube(0, 0, 0, 4);
    const std::vector<std::pair<const char*, Box>> partners{
        {"face", cube(4, 0, 0, 4)},
        {"part-of-face", cube(4, 1, 2, 4)},
        {"inside-face", cube(4, 1, 1, 2)},
        {"edge", cube(4, 4, 0, 4)},
        {"part-of-edge", cube(4, 4, 1, 2)},
        {"vertex", cube(4, 4, 4, 4)},
        {"equal", a},
        {"corner-within", cube(0, 0, 0, 2)},
        {"face-within", cube(1, 1, 0, 2)},
        {"edge-within", cube(0, 0, 1, 2)},
        {"crossing", cube(2, 2, 2, 4)},
        {"sharing-two-planes", cube(2, 0, 0, 4)}};
    Scenes scenes;
    for (const auto& [name, b] : partners)
        add_all_operations(scenes, std::string("touching-") + name, a, b);
    return scenes;
}

/// Boxes that differ by the last bit of a coordinate.
Scenes twins(const std::string& name, double less, double more) {
    const Box a = cube(0, 0, 0, 1);
    Scenes scenes;
    add_all_operations(scenes, name + "-wider", a, {{0, 0, 0}, {more, 1, 1}});
    add_all_operations(scenes, name + "-larger", a, {{0, 0, 0}, {more, more, more}});
    add_all_operations(scenes, name + "-mixed", a, {{0, 0, 0}, {more, less, 1}});
    add_all_operations(scenes, name + "-gap", a, {{more, 0, 0}, {2, 1, 1}});
    add_all_operations(scenes, name + "-overlap", a, {{less, 0, 0}, {2, 1, 1}});
    return scenes;
}

Scenes partial_faces() {
    Scenes scenes;
    for (const int n : {3, 8}) {
        BoxScene stairs{fmt::format("partial-faces-{}", n), Union, {}};
        for (int i = 0; i < n; ++i)
            stairs.operands.push_back(
                {Box{{double(i), 0, 0}, {double(i + 1), double(n - i), double(i + 1)}}});
        scenes.push_back(std::move(stairs));
    }
    return scenes;
}

Scenes needles() {
    Scenes scenes;
    for (const int bits : {10, 20, 30}) {
        const double thin = std::ldexp(1.0, -bits);
        const Box along_x{{0, 0, 0}, {8, thin, thin}};
        const Box along_y{{4, -4, 0}, {4 + thin, 4, thin}};
        add_all_operations(scenes, fmt::format("needles-{}", bits), along_x, along_y);
    }
    return scenes;
}

Scenes thin_walls() {
    Scenes scenes;
    for (const int bits : {10, 30, 40}) {
        const double wall = std::ldexp(1.0, -bits);
        scenes.push_back(
            {fmt::format("thin-walls-{}", bits),
             Difference,
             {{cube(0, 0, 0, 1)}, {Box{{wall, wall, wall}, {1 - wall, 1 - wall, 1 - wall}}}}});
    }
    return scenes;
}

/// A block with n × n square holes.
BoxScene drilled(const std::string& name, int n, double depth) {
    BoxScene scene{name, Difference, {{Box{{0, 0, 0}, {2.0 * n + 1, 2.0 * n + 1, 2}}}}};
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            scene.operands.push_back(
                {Box{{2.0 * i + 1, 2.0 * j + 1, 2 - depth}, {2.0 * i + 2, 2.0 * j + 2, 3}}});
    return scene;
}

Scenes nested() {
    Scenes scenes;
    for (const int depth : {3, 6}) {
        BoxScene scene{fmt::format("nested-cavities-{}", depth), SymmetricDifference, {}};
        for (int i = 0; i < depth; ++i)
            scene.operands.push_back({cube(i, i, i, 2.0 * (depth - i) - 1)});
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

Scenes checkerboards() {
    Scenes scenes;
    for (const int n : {2, 4}) {
        BoxScene scene{fmt::format("checkerboard-{}", n), Union, {}};
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (int k = 0; k < n; ++k)
                    if ((i + j + k) % 2 == 0) scene.operands.push_back({cube(i, j, k, 1)});
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

/// Rods in two directions, each of one kind across all of the other [Paterson and Yao 1990].
Scenes rods() {
    Scenes scenes;
    for (const int n : {4, 12}) {
        BoxScene scene{fmt::format("rods-{}", n), Union, {}};
        const double length = 2.0 * n;
        for (int i = 0; i < n; ++i) {
            scene.operands.push_back({Box{{0, 2.0 * i, 0}, {length, 2.0 * i + 1, 1}}});
            scene.operands.push_back({Box{{2.0 * i, 0, 1}, {2.0 * i + 1, length, 2}}});
        }
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

Scenes sponges() {
    Scenes scenes;
    for (const int levels : {1, 2}) {
        const int size = levels == 1 ? 3 : 9;
        BoxScene scene{fmt::format("sponge-{}", levels), Difference, {{cube(0, 0, 0, size)}}};
        for (int level = 1, step = size; level <= levels; ++level, step /= 3) {
            for (int i = 0; i < size; i += step) {
                for (int j = 0; j < size; j += step) {
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        const double third = step / 3;
                        Box bar;
                        bar.low[axis] = -1;
                        bar.high[axis] = size + 1;
                        bar.low[(axis + 1) % 3] = i + third;
                        bar.high[(axis + 1) % 3] = i + 2 * third;
                        bar.low[(axis + 2) % 3] = j + third;
                        bar.high[(axis + 2) % 3] = j + 2 * third;
                        scene.operands.push_back({bar});
                    }
                }
            }
        }
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

/// A block carved to steps of random heights.
Scenes terrain(std::uint64_t seed) {
    constexpr int n = 8;
    BoxScene scene{fmt::format("terrain-{}", seed), Difference, {{Box{{0, 0, 0}, {n, n, n}}}}};
    std::uint64_t state = seed;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            state = state * 6364136223846793005U + 1442695040888963407U;
            const auto height = static_cast<double>((state >> 33) % n) + 1;
            if (height < n)
                scene.operands.push_back(
                    {Box{{double(i), double(j), height}, {double(i + 1), double(j + 1), n + 1}}});
        }
    }
    return {scene};
}

}  // namespace

std::vector<std::string> corpus_family_names() {
    return {"touching",   "twins",    "twins-double", "partial-faces", "needles",
            "thin-walls", "genus-64", "drill-grid",   "nested",        "checkerboard",
            "rods",       "sponge",   "terrain"};
}

std::vector<BoxScene> corpus_family(const std::string& name, std::uint64_t seed) {
    if (name == "touching") return touching();
    if (name == "twins") return twins(name, std::nextafter(1.0F, 0.0F), std::nextafter(1.0F, 2.0F));
    if (name == "twins-double")
        return twins(name, std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0));
    if (name == "partial-faces") return partial_faces();
    if (name == "needles") return needles();
    if (name == "thin-walls") return thin_walls();
    if (name == "genus-64") return {drilled("genus-64", 8, 3)};
    if (name == "drill-grid") return {drilled("drill-grid-5", 5, 1), drilled("drill-grid-9", 9, 1)};
    if (name == "nested") return nested();
    if (name == "checkerboard") return checkerboards();
    if (name == "rods") return rods();
    if (name == "sponge") return sponges();
    if (name == "terrain") return terrain(seed);
    throw UsageError("--family: '" + name + "' is not a family of the corpus");
}

}  // namespace trisect::app
