// SPDX-License-Identifier: Apache-2.0
//
// Carves a word into a plate and makes the letters that fit into it without a gap.
//
//     carve_letters [result.off]

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

// Letters on a grid of 4 x 7: outlines, the first one outside, the others holes.
const std::map<char, std::vector<std::string>> letters{
    {'T', {"0 7  0 6  1.5 6  1.5 0  2.5 0  2.5 6  4 6  4 7"}},
    {'R',
     {"0 0  1 0  1 3  1.5 3  3 0  4 0  2.5 3  3 3  4 4  4 6  3 7  0 7",
      "1 4  1 6  2.5 6  3 5.5  3 4.5  2.5 4"}},
    {'I', {"1.5 0  2.5 0  2.5 7  1.5 7"}},
    {'S', {"0 0  3 0  4 1  4 3  3 4  1 4  1 6  4 6  4 7  1 7  0 6  0 4  1 3  3 3  3 1  0 1"}},
    {'E', {"0 0  4 0  4 1  1 1  1 3  3 3  3 4  1 4  1 6  4 6  4 7  0 7"}},
    {'C', {"1 0  4 0  4 1  1.5 1  1 1.5  1 5.5  1.5 6  4 6  4 7  1 7  0 6  0 1"}},
};

Outline outline_of(const std::string& text) {
    std::istringstream words(text);
    Outline out;
    for (Point2d p{}; words >> p[0] >> p[1];) out.push_back(p);
    return out;
}

double area(const Outline& loop) {
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point2d& q = loop[(i + 1) % loop.size()];
        twice += loop[i][0] * q[1] - q[0] * loop[i][1];
    }
    return std::abs(twice) / 2;
}

struct Letter {
    Solid solid;
    double area = 0;
    std::size_t corners = 0;
};

Letter make_letter(char name, double x, double low, double high) {
    std::vector<Outline> loops;
    Letter letter;
    for (const std::string& text : letters.at(name)) {
        Outline& loop = loops.emplace_back(outline_of(text));
        letter.area += letter.area == 0 ? area(loop) : -area(loop);
        letter.corners += loop.size();
        for (Point2d& p : loop) p[0] += x;
    }
    const std::vector<Outline> holes(loops.begin() + 1, loops.end());
    letter.solid = Solid::from_mesh(make_extrusion(loops[0], holes, low, high));
    return letter;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string word = "TRISECT";
    constexpr double depth = 0.75;
    constexpr double thickness = 2;
    std::vector<Letter> made;
    std::vector<Solid> solids;
    std::vector<Solid> through;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const double x = 5.0 * static_cast<double>(i);
        made.push_back(make_letter(word[i], x, thickness - depth, thickness));
        solids.push_back(made.back().solid);
        through.push_back(make_letter(word[i], x, -1, thickness + 1).solid);
    }
    const double length = 5.0 * static_cast<double>(word.size());
    const Solid plate = Solid::from_mesh(make_box({-1, -1, 0}, {length, 8, thickness}));
    const Solid carved = evaluate(plate - Expression::any_of(solids));

    // Areas on paper times the depth: all numbers are halves and quarters, so doubles are exact.
    double inked = 0;
    for (const Letter& letter : made) inked += letter.area;
    expect(exact_volume(carved) == exact_volume(plate) - ExactRational::from_double(inked * depth),
           "the volume that is left");

    // Deeper than the plate, the letters fall out, and the middle of the R with its own.
    const Solid pierced = evaluate(plate - Expression::any_of(through));
    expect(components(carved).size() == 1 && components(pierced).size() == 2, "two parts");

    // Each letter lies in its hollow: it touches the floor and the walls, and nowhere is a gap.
    std::size_t walls = 0;
    for (const Letter& letter : made) {
        expect(interfere(letter.solid, Pose(), carved, Pose()).relation == Relation::Touching,
               "a letter fits");
        std::size_t areas = 0;
        for (const NamedRegion& r : contact_regions(letter.solid, Pose(), carved, Pose())) {
            if (r.dimension != 2) continue;
            ++areas;
            expect(r.opposite, "solids on both sides");
        }
        // A wall for each side of the outline, and the floor.
        expect(areas == letter.corners + 1, "all walls touch");
        walls += letter.corners;
    }
    // So together they are the plate again, as a set and to the last bit.
    solids.push_back(carved);
    expect(evaluate(Expression::any_of(solids) ^ plate).is_empty(), "the plate again");

    write_mesh(argc > 1 ? argv[1] : "carve_letters.off", carved.to_mesh());
    std::cout << word << ": " << inked << " of area, " << exact_volume(carved).to_string() << " of "
              << exact_volume(plate).to_string() << " are left\n"
              << made.size() << " letters fit into their hollows, along " << walls << " walls\n";
    return 0;
}
