// SPDX-License-Identifier: Apache-2.0
//
// Formulas over prisms of outlines on small grids, where everything coincides: areas as fractions
// against a planar engine in rationals, and the same sets as those of solids.
//
//     flat_regions [--seed S] [--areas N] [--sets M] [--only I]
//
// Prints a line for each difference, with the number that repeats it; exits with 1 if there was
// any. The first N numbers compare areas, the next M sets. In a set the result, and a formula over
// it, are taken through the tree of a solid.

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <string>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/point_2d.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/solid_measure.h>

#include "reference/flat_area.h"

namespace {

using reference::FlatFormula;
using reference::FlatOperand;
using trisect::Expression;
using trisect::Outline;
using trisect::Solid;

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t areas = 1000;
    std::uint64_t sets = 100;
    std::int64_t only = -1;
};

struct Operand {
    std::vector<Outline> outlines;
    bool odd = false;
};

struct Formula {
    std::vector<Operand> operands;
    std::vector<int> operations;  // between the value so far and the next operand
};

class CaseMaker {
public:
    explicit CaseMaker(std::uint64_t seed) : random_(seed) {}

    Formula make(bool few) {
        Formula out;
        // Whole numbers, decimal fractions, whose lines cross in no doubles, and halves of huge
        // ones.
        unit_ = std::array{1.0, 0.1, 0x1p40 + 0.5}[below(3)];
        grid_ = 2 + below(4);
        const std::size_t count = 1 + below(few ? 3 : 4);
        for (std::size_t o = 0; o < count; ++o) out.operands.push_back(operand());
        for (std::size_t o = 1; o < count; ++o)
            out.operations.push_back(static_cast<int>(below(4)));
        return out;
    }

private:
    std::size_t below(std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
    }
    Operand operand() {
        Operand out;
        out.odd = below(2) == 0;
        const std::size_t outlines = 1 + below(2);
        for (std::size_t i = 0; i < outlines; ++i) {
            Outline& outline = out.outlines.emplace_back();
            const std::size_t corners = 3 + below(4);
            for (std::size_t k = 0; k < corners; ++k)
                outline.push_back({unit_ * static_cast<double>(below(grid_ + 1)),
                                   unit_ * static_cast<double>(below(grid_ + 1))});
        }
        return out;
    }

    std::mt19937_64 random_;
    double unit_ = 1;
    std::size_t grid_ = 4;
};

Expression combined(const std::vector<Expression>& terms, const std::vector<int>& operations) {
    Expression out = terms[0];
    for (std::size_t i = 1; i < terms.size(); ++i) switch (operations[i - 1]) {
            case 0:
                out = out | terms[i];
                break;
            case 1:
                out = out & terms[i];
                break;
            case 2:
                out = out - terms[i];
                break;
            default:
                out = out ^ terms[i];
        }
    return out;
}

bool value_of(const std::vector<bool>& inside, const std::vector<int>& operations) {
    bool out = inside[0];
    for (std::size_t i = 1; i < inside.size(); ++i) switch (operations[i - 1]) {
            case 0:
                out = out || inside[i];
                break;
            case 1:
                out = out && inside[i];
                break;
            case 2:
                out = out && !inside[i];
                break;
            default:
                out = out != inside[i];
        }
    return out;
}

Solid prism_of(const Operand& operand) {
    return flat_prism(operand.outlines,
                      operand.odd ? trisect::OutlineRule::Odd : trisect::OutlineRule::Positive, 0,
                      1);
}

Expression flat_formula(const Formula& c) {
    std::vector<Expression> terms;
    for (const Operand& o : c.operands) terms.emplace_back(prism_of(o));
    return combined(terms, c.operations);
}

// A closed mesh with the winding number of the outlines: walls, and fans of triangles as caps.
void add_prism(trisect::PolygonMesh& mesh, const Outline& outline) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (const double z : {0.0, 1.0})
        for (const auto& [x, y] : outline) mesh.points.push_back({x, y, z});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = first + i;
        const std::uint32_t b = first + (i + 1) % n;
        mesh.add_triangle(a, b, n + b);
        mesh.add_triangle(a, n + b, n + a);
    }
    for (std::uint32_t i = 1; i + 1 < n; ++i) {
        mesh.add_triangle(first, first + i + 1, first + i);
        mesh.add_triangle(n + first, n + first + i, n + first + i + 1);
    }
}

Solid solid_of(const trisect::PolygonMesh& mesh) {
    try {
        return Solid::from_mesh(mesh, {.embedding = trisect::Embedding::Resolve,
                                       .inside_out = trisect::InsideOut::Accept});
    } catch (const trisect::Error&) {
        return {};  // nothing but flat facets
    }
}

reference::Rational rational(double v) { return reference::Rational(v); }

// Doubles of corners that are nearly on a line would say so.
bool turns_left(const trisect::Point2d& a, const trisect::Point2d& b, const trisect::Point2d& c) {
    const auto d = [](double p, double q) {
        return reference::Rational(rational(q) - rational(p));
    };
    return d(a[0], b[0]) * d(a[1], c[1]) > d(a[1], b[1]) * d(a[0], c[0]);
}

// As a formula over solids: an odd number of triangles, or a mesh.
Expression solid_formula(const Operand& operand) {
    trisect::PolygonMesh all;
    Expression odd = Solid();
    for (const Outline& outline : operand.outlines) {
        add_prism(all, outline);
        for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
            const auto& [a, b, c] = std::array{outline[0], outline[i], outline[i + 1]};
            const bool left = turns_left(a, b, c);
            trisect::PolygonMesh triangle;
            add_prism(triangle, left ? Outline{a, b, c} : Outline{a, c, b});
            odd = odd ^ solid_of(triangle);
        }
    }
    return operand.odd ? odd : Expression(solid_of(all));
}

std::string compare_areas(const Formula& c) {
    std::vector<FlatOperand> operands;
    for (const Operand& o : c.operands) {
        FlatOperand& out = operands.emplace_back();
        out.odd = o.odd;
        for (const Outline& outline : o.outlines) {
            auto& points = out.outlines.emplace_back();
            for (const auto& [x, y] : outline) points.push_back({rational(x), rational(y)});
        }
    }
    const reference::Rational wanted = reference::flat_area(
        operands, [&](const std::vector<bool>& inside) { return value_of(inside, c.operations); });
    const Solid result = evaluate(flat_formula(c));
    const std::string found = exact_volume(result).to_string();
    if (found != wanted.get_str()) return "volume " + found + " in place of " + wanted.get_str();
    const trisect::PolygonMesh mesh = result.to_mesh();
    const double rounded =
        mesh.face_count() == 0
            ? 0
            : volume(Solid::from_mesh(mesh, {.embedding = trisect::Embedding::Check}));
    if (!(std::abs(rounded - wanted.get_d()) <= 1e-9 * (1 + std::abs(wanted.get_d()))))
        return "a mesh of volume " + std::to_string(rounded);
    return {};
}

// Cases as text, to look at.
void print(const Formula& c) {
    for (const Operand& o : c.operands) {
        std::printf("%s", o.odd ? "odd" : "positive");
        for (const Outline& outline : o.outlines) {
            std::printf(" (");
            for (const auto& [x, y] : outline) std::printf(" %g,%g", x, y);
            std::printf(" )");
        }
        std::printf("\n");
    }
    for (const int o : c.operations) std::printf("%d ", o);
    std::printf("\n");
}

std::string compare_sets(const Formula& c) {
    std::vector<Expression> terms;
    for (const Operand& o : c.operands) terms.push_back(solid_formula(o));
    const Expression wanted = combined(terms, c.operations);
    const Solid result = evaluate(flat_formula(c));
    // As a solid among solids.
    if (!evaluate(wanted ^ result).is_empty()) return "another set";
    const double u = c.operands[0].outlines[0][0][0];
    const Solid cut = Solid::half_space({1, 2, 3, -u - 1});
    if (!evaluate((wanted - cut) ^ (result - cut)).is_empty()) return "another set when it is cut";
    // As an operand of the next one.
    const Expression next = result ^ prism_of(c.operands.back());
    const Expression next_wanted = wanted ^ solid_formula(c.operands.back());
    if (!evaluate(next_wanted ^ evaluate(next)).is_empty()) return "another set as an operand";
    return {};
}

bool run(const Options& options, std::uint64_t i) {
    const bool by_area = i < options.areas;
    const Formula c = CaseMaker(options.seed * 1'000'003 + i).make(!by_area);
    std::string difference;
    try {
        difference = by_area ? compare_areas(c) : compare_sets(c);
    } catch (const std::exception& e) {
        difference = e.what();
    }
    if (difference.empty()) return true;
    print(c);
    std::printf("case %llu: %s\n", static_cast<unsigned long long>(i), difference.c_str());
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        const std::uint64_t value = std::strtoull(argv[i + 1], nullptr, 10);
        if (name == "--seed") options.seed = value;
        if (name == "--areas") options.areas = value;
        if (name == "--sets") options.sets = value;
        if (name == "--only") options.only = static_cast<std::int64_t>(value);
    }
    if (options.only >= 0) return run(options, static_cast<std::uint64_t>(options.only)) ? 0 : 1;
    std::uint64_t differences = 0;
    for (std::uint64_t i = 0; i < options.areas + options.sets; ++i)
        differences += run(options, i) ? 0 : 1;
    std::printf("%llu areas and %llu sets, %llu differences\n",
                static_cast<unsigned long long>(options.areas),
                static_cast<unsigned long long>(options.sets),
                static_cast<unsigned long long>(differences));
    return differences == 0 ? 0 : 1;
}
