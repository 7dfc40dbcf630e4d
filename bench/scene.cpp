// SPDX-License-Identifier: Apache-2.0

#include "scene.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/kernel/error.h>

#include "cliff_scenes.h"
#include "degenerate_scenes.h"
#include "dense_operands.h"
#include "record_scene.h"
#include "shapes.h"

namespace bench {

namespace {

using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

constexpr Matrix identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
const std::vector<Operation> all_operations{Operation::Union, Operation::Intersection,
                                            Operation::Difference, Operation::ExclusiveOr};

[[noreturn]] void unknown(const std::string& name) {
    throw trisect::UsageError("no such scene: " + name);
}

/// Faces cut into triangles, since not every engine does that.
PolygonMesh triangles_of(const PolygonMesh& mesh) {
    PolygonMesh out;
    out.points = mesh.points;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 2; i < loop.size(); ++i)
            out.add_triangle(loop[0], loop[i - 1], loop[i]);
    }
    return out;
}

PolygonMesh model(const std::string& path) {
    const char* models = std::getenv("TRISECT_MODELS");
    return triangles_of(trisect::read_mesh(
        std::filesystem::path(models == nullptr ? "../shared/models" : models) / path));
}

/// The words between colons.
std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words{""};
    for (const char c : name)
        if (c == ':')
            words.emplace_back();
        else
            words.back() += c;
    return words;
}

/// The level of the icosphere with about so many triangles.
int sphere_level(const std::string& scene, const std::string& size) {
    if (size == "5k") return 4;
    if (size == "20k") return 5;
    if (size == "82k") return 6;
    if (size == "328k") return 7;
    if (size == "1.3M") return 8;
    unknown(scene);
}

Scene pair(PolygonMesh a, PolygonMesh b) {
    Scene s;
    s.operands = {std::move(a), std::move(b)};
    s.operations = all_operations;
    return s;
}

Scene one_union(std::vector<PolygonMesh> operands) {
    Scene s;
    s.first_group = operands.size();
    s.operands = std::move(operands);
    s.operations = {Operation::Union};
    return s;
}

/// The word behind a prefix as a number of operands.
std::size_t count_of(const std::string& scene, const std::string& word, const char* prefix) {
    const std::string digits = word.substr(std::string_view(prefix).size());
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos)
        unknown(scene);
    const std::size_t n = std::strtoul(digits.c_str(), nullptr, 10);
    if (n < 2 || n > 10'000) unknown(scene);
    return n;
}

/// All operands combined by each operation; a difference is the first one less all others.
Scene dense_scene(const std::string& scene, const std::string& word) {
    Scene s;
    const auto less_tools = [&](std::vector<PolygonMesh> operands) {
        s = one_union(std::move(operands));
        s.operations = {Operation::Difference};
        return s;
    };
    if (word.starts_with("path")) return less_tools(plate_and_path(count_of(scene, word, "path")));
    if (word.starts_with("slot")) return less_tools(plate_and_slot(count_of(scene, word, "slot")));
    if (word.starts_with("drills"))
        return less_tools(plate_and_drills(count_of(scene, word, "drills"), false));
    if (word.starts_with("bores"))
        return less_tools(plate_and_drills(count_of(scene, word, "bores"), true));
    if (word.starts_with("dense")) {
        s = one_union(nearly_equal_solids(count_of(scene, word, "dense")));
    } else if (word.starts_with("onion")) {
        s = one_union(nested_solids(count_of(scene, word, "onion")));
    } else if (word.starts_with("swarm")) {
        s = one_union(solids_in_one_place(count_of(scene, word, "swarm")));
    } else if (word.starts_with("cylinders")) {
        s = one_union(turned_cylinders(count_of(scene, word, "cylinders")));
    } else if (word.starts_with("copies")) {
        s = one_union(copies_along_axis(count_of(scene, word, "copies")));
    } else if (word.starts_with("floor")) {
        s = one_union(prisms_on_floor(count_of(scene, word, "floor")));
    } else if (word.starts_with("stack")) {
        s = one_union(stacked_prisms(count_of(scene, word, "stack")));
    } else {
        unknown(scene);
    }
    s.operations = all_operations;
    return s;
}

/// A chain whose tools are all there before it starts.
Scene short_chain(PolygonMesh stock, std::vector<PolygonMesh> tools) {
    Scene s;
    s.operands = {std::move(stock)};
    s.operands.insert(s.operands.end(), tools.begin(), tools.end());
    shapes::put_on_one_lattice(s.operands);
    auto all = std::make_shared<std::vector<PolygonMesh>>(s.operands.begin() + 1, s.operands.end());
    s.operands.resize(1);
    s.operations = {Operation::Difference};
    s.steps = all->size();
    s.step = [all](std::size_t i) { return Step{Operation::Difference, (*all)[i], {}}; };
    return s;
}

Scene models_scene(const std::string& scene, const std::string& word) {
    if (word != "bunny" && word != "armadillo" && word != "cow") unknown(scene);
    const std::string suffix = word == "bunny" ? "100k" : word == "cow" ? "100K" : "";
    const PolygonMesh mesh = model("large/" + word + suffix + ".obj");
    return pair(mesh, shapes::turned(mesh));
}

Scene spheres_scene(const std::string& scene, const std::string& size) {
    const PolygonMesh sphere = shapes::icosphere(sphere_level(scene, size));
    return pair(sphere, shapes::moved(sphere, shapes::along_1_2_3(0.5)));
}

PolygonMesh small_sphere(double radius, const Point3d& centre) {
    Matrix m = identity;
    for (std::size_t k = 0; k < 3; ++k) m[k][k] = radius;
    return shapes::moved(shapes::icosphere(2), m, centre);
}

Scene small_cut_scene(const std::string& scene, const std::vector<std::string>& words) {
    PolygonMesh part = shapes::icosphere(sphere_level(scene, words[1]));
    PolygonMesh tool = small_sphere(0.1, shapes::along_1_2_3(1));
    if (words.size() > 2 && words[2] == "indexed") {
        Scene s = short_chain(std::move(part), {std::move(tool)});
        s.indexed = true;
        return s;
    }
    if (words.size() > 2) {
        if (words[2] != "near" && words[2] != "far") unknown(scene);
        const Point3d before =
            words[2] == "near" ? Point3d{0.48, 0.36, 0.8} : shapes::along_1_2_3(-1);
        Scene s = short_chain(std::move(part), {small_sphere(0.1, before), std::move(tool)});
        s.untimed = 1;
        return s;
    }
    Scene s = pair(std::move(part), std::move(tool));
    s.operations = {Operation::Difference};
    return s;
}

std::vector<PolygonMesh> scattered(const PolygonMesh& shape) {
    shapes::Random random(1);
    std::vector<PolygonMesh> out;
    for (int i = 0; i < 1000; ++i) {
        const Matrix m = random.rotation();
        out.push_back(shapes::moved(shape, m, random.in_unit_box()));
    }
    return out;
}

Scene many_scene(const std::string& scene, const std::string& word) {
    if (word == "cubes")
        return one_union(scattered(shapes::block({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05})));
    if (word == "spheres") {
        Matrix m = identity;
        for (std::size_t k = 0; k < 3; ++k) m[k][k] = 0.08;
        return one_union(scattered(shapes::moved(shapes::icosphere(1), m, {})));
    }
    if (word != "tori") unknown(scene);
    std::vector<PolygonMesh> tori;
    for (int i = 0; i < 50; ++i) tori.push_back(model("variadic/t1_" + std::to_string(i) + ".off"));
    return one_union(std::move(tori));
}

/// Where the milling tool is at a cut: layers of 20 rows of 50, to and fro, every layer 0.0096
/// below the one before and shifted a little, so that cuts do not repeat.
Point3d mill_position(std::size_t cut) {
    const std::size_t layer = cut / 1000;
    const std::size_t row = cut % 1000 / 50;
    const std::size_t column = row % 2 == 0 ? cut % 50 : 49 - cut % 50;
    const auto along = [](double start, double step, std::size_t n) {
        return start + step * static_cast<double>(n);
    };
    return {along(0.1031415926, 0.0159, column) + 0.0031 * static_cast<double>(layer % 5),
            along(0.1027182818, 0.0411, row) + 0.0083 * static_cast<double>(layer % 5),
            along(1.0057721566, -0.0096, layer)};
}

Scene milling_scene(const std::string& scene, const std::vector<std::string>& words) {
    Scene s;
    const int n = words[1] == "1k"     ? 10
                  : words[1] == "25k"  ? 46
                  : words[1] == "99k"  ? 91
                  : words[1] == "400k" ? 183
                                       : 0;
    if (n == 0) unknown(scene);
    s.steps = words.size() > 2 ? std::strtoul(words[2].c_str(), nullptr, 10) : 1000;
    if (s.steps == 0 || s.steps > 100'000) unknown(scene);
    s.operations = {Operation::Difference};
    s.operands = {shapes::block({0, 0, 0}, {1, 1, 1}, n)};
    shapes::put_on_one_lattice(s.operands);
    const auto ball = std::make_shared<PolygonMesh>(small_sphere(0.03, {}));
    // The block and all tools have their largest coordinate between 1/8 and 2, hence one lattice.
    s.step = [ball](std::size_t i) {
        std::vector<PolygonMesh> tool{shapes::moved(*ball, mill_position(i))};
        shapes::put_on_one_lattice(tool);
        return Step{Operation::Difference, std::move(tool[0]), {}};
    };
    return s;
}

/// 10³ unit cubes: those with an even sum of coordinates united one by one, then the odd ones, then
/// the even ones subtracted, then the odd ones. What is left is empty.
Scene grid_scene() {
    auto places = std::make_shared<std::vector<Point3d>>();
    for (int parity = 0; parity < 2; ++parity)
        for (int i = 0; i < 1000; ++i) {
            const int x = i / 100;
            const int y = i / 10 % 10;
            const int z = i % 10;
            if ((x + y + z) % 2 == parity)
                places->push_back(
                    {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
    const auto cube = [places](std::size_t i) {
        const Point3d& p = (*places)[i % 1000];
        return shapes::block(p, {p[0] + 1, p[1] + 1, p[2] + 1});
    };
    Scene s;
    s.operands = {cube(0)};
    s.operations = {Operation::Difference};
    s.steps = 1999;
    s.step = [cube](std::size_t i) {
        return Step{i + 1 < 1000 ? Operation::Union : Operation::Difference, cube(i + 1), {}};
    };
    return s;
}

std::vector<PolygonMesh> cubes(double pitch) {
    std::vector<PolygonMesh> out;
    for (int i = 0; i < 1000; ++i) {
        const Point3d p{pitch * (i / 100), pitch * (i / 10 % 10), pitch * (i % 10)};
        out.push_back(shapes::block(p, {p[0] + 1, p[1] + 1, p[2] + 1}));
    }
    return out;
}

/// Cubes of side 2 turned about the z axis by equal parts of a right angle.
std::vector<PolygonMesh> fan(int n, const Point3d& centre) {
    const PolygonMesh cube = shapes::block({-1, -1, -1}, {1, 1, 1});
    std::vector<PolygonMesh> out;
    for (int i = 0; i < n; ++i)
        out.push_back(shapes::moved(cube, shapes::rotation({0, 0, 1}, 90.0 * i / n), centre));
    return out;
}

Scene gears_scene() {
    Scene s;
    s.operands = fan(50, {});
    s.first_group = s.operands.size();
    for (PolygonMesh& m : fan(50, {1, 0.25, 0})) s.operands.push_back(std::move(m));
    s.operations = all_operations;
    return s;
}

Scene beams_scene() {
    PolygonMesh along_x;
    PolygonMesh along_y;
    for (int i = 0; i < 20; ++i) {
        const double at = 2.0 * i;
        shapes::append(along_x, shapes::block({-1, at, 0}, {40, at + 1, 1}));
        shapes::append(along_y, shapes::block({at, -1, 0.5}, {at + 1, 40, 1.5}));
    }
    return pair(std::move(along_x), std::move(along_y));
}

/// A prism over a star of ten corners, from height 1/2 to 1.
PolygonMesh star(double x, double y, double degrees) {
    constexpr std::uint32_t n = 10;
    PolygonMesh out;
    for (const double z : {0.5, 1.0}) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const double radius = i % 2 == 0 ? 0.4375 : 0.25;
            const double angle = (degrees + 36.0 * i) * std::numbers::pi / 180;
            out.points.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle), z});
        }
        out.points.push_back({x, y, z});
    }
    constexpr std::uint32_t up = n + 1;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        out.add_triangle(n, j, i);
        out.add_triangle(n + up, i + up, j + up);
        out.add_triangle(i, j, j + up);
        out.add_triangle(i, j + up, i + up);
    }
    return out;
}

/// A plate less n x n stars, each turned otherwise, all flush with its upper side.
Scene engraving_scene(int n) {
    PolygonMesh stars;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) shapes::append(stars, star(i + 0.5, j + 0.5, 7.0 * i + j));
    const double side = n;
    Scene s = pair(shapes::block({0, 0, 0}, {side, side, 1}), std::move(stars));
    s.operations = {Operation::Difference};
    return s;
}

Scene hard_scene(const std::string& scene, const std::string& word) {
    if (word == "grid") return grid_scene();
    if (word == "menger3" || word == "menger4") {
        const int level = word == "menger3" ? 3 : 4;
        const double side = std::pow(3.0, level);
        return short_chain(shapes::block({0, 0, 0}, {side, side, side}),
                           {shapes::menger_bars(level, 0), shapes::menger_bars(level, 1),
                            shapes::menger_bars(level, 2)});
    }
    if (word == "beams") return beams_scene();
    if (word == "fan") return one_union(fan(20, {}));
    if (word == "gears") return gears_scene();
    if (word == "engrave") return engraving_scene(100);
    if (word == "engrave2500") return engraving_scene(50);
    if (word == "touch") return one_union(cubes(1));
    if (word == "overlap") return one_union(cubes(0.75));
    unknown(scene);
}

constexpr std::size_t slabs = 51;

/// The bunny between planes of equal distances; the first and the last part are slabs as well.
Scene slabs_scene(const std::string& scene, const std::vector<std::string>& words) {
    const bool boxes = words.size() == 3 && words[2] == "boxes";
    const bool oblique = words.size() == 3 && words[2] == "oblique";
    if (words.size() > 2 && !boxes && !oblique) unknown(scene);
    Scene s;
    s.operands = {model("large/bunny100k.obj")};
    s.operations = {Operation::Intersection};
    s.steps = slabs;
    s.parts = true;
    const Point3d normal = oblique ? Point3d{1, 2, 3} : Point3d{0, 0, 1};
    const auto height = [normal](const Point3d& p) {
        return normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2];
    };
    double low = height(s.operands[0].points[0]);
    double high = low;
    for (const Point3d& p : s.operands[0].points) {
        low = std::min(low, height(p));
        high = std::max(high, height(p));
    }
    const auto at = [low, high](std::size_t i) {
        const double part = static_cast<double>(i) / static_cast<double>(slabs);
        // Few bits: the same plane for all engines.
        return std::ldexp(std::round(std::ldexp(low + part * (high - low), 20)), -20);
    };
    if (!boxes) {
        s.step = [at, normal](std::size_t i) {
            Step step{Operation::Intersection, {}, {}};
            step.planes = {{normal[0], normal[1], normal[2], -at(i + 1)},
                           {-normal[0], -normal[1], -normal[2], at(i)}};
            return step;
        };
        return s;
    }
    s.step = [at](std::size_t i) {
        return Step{Operation::Intersection, shapes::block({-1, -1, at(i)}, {1, 1, at(i + 1)}), {}};
    };
    return s;
}

/// A plate less bores on a grid, prisms of 32 sides that reach through it, each turned otherwise.
Scene bores_scene(int n) {
    constexpr std::uint32_t sides = 32;
    PolygonMesh bores;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            PolygonMesh bore;
            for (const double z : {-0.5, 1.5})
                for (std::uint32_t k = 0; k < sides; ++k) {
                    const double angle = 0.3 * i + 0.7 * j + 2 * std::numbers::pi * k / sides;
                    bore.points.push_back(
                        {i + 0.5 + 0.35 * std::cos(angle), j + 0.5 + 0.35 * std::sin(angle), z});
                }
            for (std::uint32_t k = 0; k < sides; ++k) {
                const std::uint32_t l = (k + 1) % sides;
                bore.add_triangle(k, l, l + sides);
                bore.add_triangle(k, l + sides, k + sides);
                if (k < 2) continue;
                bore.add_triangle(0, k, k - 1);
                bore.add_triangle(sides, sides + k - 1, sides + k);
            }
            shapes::append(bores, bore);
        }
    const double side = n;
    Scene s = pair(shapes::block({0, 0, 0}, {side, side, 1}), std::move(bores));
    s.operations = {Operation::Difference};
    return s;
}

Scene following_scene(const std::string& scene, const std::vector<std::string>& words) {
    if (words[1] == "slabs") return slabs_scene(scene, words);
    if (words[1] != "bores") unknown(scene);
    if (words.size() == 2) return bores_scene(20);
    if (words[2] == "10k") return bores_scene(100);
    unknown(scene);
}

/// The union of statues with that of spheres.
Scene record_scene(const std::string& scene, const std::vector<std::string>& words) {
    if (words[1] != "record") unknown(scene);
    std::size_t n = 100'000;
    if (words.size() > 2) {
        char* end = nullptr;
        n = std::strtoul(words[2].c_str(), &end, 10);
        if (*end != 0 || n == 0 || n > 1'000'000) unknown(scene);
    }
    Scene s;
    s.operands = statues_and_spheres(
        {model("large/armadillo.obj"), model("large/bunny100k.obj"), model("large/cow100K.obj")},
        n);
    s.first_group = statues_of_record;
    s.operations = {Operation::Intersection, Operation::Difference};
    return s;
}

Scene scene_of(const std::string& name) {
    const std::vector<std::string> words = words_of(name);
    if (words[0] == "cliff") return cliff_scene(words);
    if (words.size() < 2 || words.size() > 3) unknown(name);
    if (words[0] == "i") return following_scene(name, words);
    if (words[0] == "q") return record_scene(name, words);
    if (words[0] == "c") return small_cut_scene(name, words);
    if (words[0] == "e") return milling_scene(name, words);
    if (words[0] == "h" && words.size() > 2 && words[2] == "halves") {
        Scene s = dense_scene(name, words[1]);
        s.first_group = s.operands.size() / 2;
        return s;
    }
    if (words.size() > 2) unknown(name);
    if (words[0] == "a") return models_scene(name, words[1]);
    if (words[0] == "b") return spheres_scene(name, words[1]);
    if (words[0] == "d") return many_scene(name, words[1]);
    if (words[0] == "f") return hard_scene(name, words[1]);
    if (words[0] == "g")
        if (auto operands = degenerate_pair(words[1]))
            return pair(std::move(operands->first), std::move(operands->second));
    if (words[0] == "h") return dense_scene(name, words[1]);
    unknown(name);
}

constexpr std::string_view decimal_prefix = "decimal:";

/// A tenth of a mesh, with coordinates of six digits behind the point: the doubles of a text.
PolygonMesh in_decimals(PolygonMesh mesh) {
    for (Point3d& p : mesh.points)
        for (double& c : p) c = std::round(c * 1e5) / 1e6;
    return mesh;
}

Scene in_decimals(Scene scene) {
    for (PolygonMesh& m : scene.operands) m = in_decimals(std::move(m));
    if (scene.step)
        scene.step = [step = std::move(scene.step)](std::size_t i) {
            Step s = step(i);
            s.tool = in_decimals(std::move(s.tool));
            return s;
        };
    return scene;
}

}  // namespace

const char* name_of(Operation operation) {
    switch (operation) {
        case Operation::Union:
            return "union";
        case Operation::Intersection:
            return "intersection";
        case Operation::ExclusiveOr:
            return "xor";
        case Operation::Difference:
            break;
    }
    return "difference";
}

std::optional<Operation> operation_of(const std::string& name) {
    for (const Operation o : all_operations)
        if (name == name_of(o)) return o;
    return std::nullopt;
}

Scene make_scene(const std::string& name) {
    const bool is_decimal = name.starts_with(decimal_prefix);
    Scene s = scene_of(is_decimal ? name.substr(decimal_prefix.size()) : name);
    s.name = name;
    if (is_decimal) return in_decimals(std::move(s));
    if (!s.is_chain()) shapes::put_on_one_lattice(s.operands);
    return s;
}

}  // namespace bench
