// SPDX-License-Identifier: Apache-2.0
//
// A session from a file: solids have names, each line makes one or asks something.
//
//     session session.txt
//
//     NAME = box X Y Z | cylinder RADIUS HEIGHT SIDES | cone BOTTOM TOP HEIGHT SIDES | read PATH
//     NAME = move A X Y Z | turn A AXIS DEGREES
//     NAME = A OPERATOR B ...             with | & - ^, from left to right, in one pass
//     volume A [FRACTION]                 is printed, and compared with the fraction exactly
//     relation A B [WORD]
//     write A PATH

#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;
using Words = std::vector<std::string>;

class Session {
public:
    void run(const Words& words) {
        if (words.size() > 2 && words[1] == "=") {
            solids_.insert_or_assign(words[0], made(Words(words.begin() + 2, words.end())));
        } else if (words[0] == "volume") {
            const std::string found = exact_volume(solid(words.at(1))).to_string();
            answer(words, 2, found);
        } else if (words[0] == "relation") {
            answer(words, 3,
                   to_string(
                       interfere(solid(words.at(1)), Pose(), solid(words.at(2)), Pose()).relation));
        } else if (words[0] == "write") {
            write_mesh(words.at(2), solid(words.at(1)).to_mesh());
        } else {
            throw UsageError("unknown: " + words[0]);
        }
    }

private:
    const Solid& solid(const std::string& name) const {
        const auto found = solids_.find(name);
        if (found == solids_.end()) throw UsageError("there is no solid " + name);
        return found->second;
    }

    // Prints an answer; where the line says what it must be, that must be it.
    static void answer(const Words& words, std::size_t expected, const std::string& found) {
        for (std::size_t i = 0; i < expected; ++i) std::cout << words[i] << ' ';
        std::cout << found << '\n';
        if (words.size() > expected && words[expected] != found)
            throw UsageError("expected " + words[expected]);
    }

    Solid made(const Words& words) const {
        const auto number = [&](std::size_t i) { return std::stod(words.at(i)); };
        const auto sides = [&](std::size_t i) { return static_cast<std::uint32_t>(number(i)); };
        const std::string& what = words[0];
        if (what == "box") return Solid::from_mesh(make_box({number(1), number(2), number(3)}));
        if (what == "cylinder")
            return Solid::from_mesh(make_cylinder(number(1), number(2), sides(3)));
        if (what == "cone")
            return Solid::from_mesh(make_cone(number(1), number(2), number(3), sides(4)));
        if (what == "read")
            return Solid::from_mesh(read_mesh(words.at(1)), {.embedding = Embedding::Check});
        if (what == "move")
            return transformed(solid(words.at(1)),
                               AffineMap::translation({number(2), number(3), number(4)}));
        if (what == "turn") {
            Point3d axis{};
            axis.at(static_cast<std::size_t>(words.at(2).at(0) - 'x')) = 1;
            return transformed(solid(words.at(1)), AffineMap::rotation(axis, number(3)));
        }
        return evaluate(formula(words));
    }

    Expression formula(const Words& words) const {
        const std::map<std::string, std::function<Expression(Expression, Expression)>> operators{
            {"|", [](auto a, auto b) { return a | b; }},
            {"&", [](auto a, auto b) { return a & b; }},
            {"-", [](auto a, auto b) { return a - b; }},
            {"^", [](auto a, auto b) { return a ^ b; }}};
        Expression result = solid(words[0]);
        for (std::size_t i = 1; i + 1 < words.size(); i += 2)
            result = operators.at(words[i])(result, solid(words[i + 1]));
        return result;
    }

    std::map<std::string, Solid> solids_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: session FILE\n";
        return 2;
    }
    std::ifstream file(argv[1]);
    Session session;
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        std::istringstream rest(line.substr(0, line.find('#')));
        Words words;
        for (std::string word; rest >> word;) words.push_back(word);
        try {
            if (!words.empty()) session.run(words);
        } catch (const std::exception& error) {
            std::cerr << argv[1] << ':' << number << ": " << error.what() << '\n';
            return 1;
        }
    }
    return number == 0 ? 1 : 0;
}
