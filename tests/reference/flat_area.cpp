// SPDX-License-Identifier: Apache-2.0

#include "flat_area.h"

#include <algorithm>
#include <set>

namespace reference {

namespace {

struct Side {
    Point2 left;
    Point2 right;
    std::size_t operand = 0;
    int upward = 0;  // change of the winding number from below to above

    Rational height(const Rational& x) const {
        return left[1] + (right[1] - left[1]) * (x - left[0]) / (right[0] - left[0]);
    }
};

std::vector<Side> sides_of(const std::vector<FlatOperand>& operands) {
    std::vector<Side> out;
    for (std::size_t o = 0; o < operands.size(); ++o)
        for (const auto& outline : operands[o].outlines)
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const Point2& p = outline[i];
                const Point2& q = outline[(i + 1) % outline.size()];
                if (p[0] == q[0]) continue;
                out.push_back(p[0] < q[0] ? Side{p, q, o, 1} : Side{q, p, o, -1});
            }
    return out;
}

std::set<Rational> stops_of(const std::vector<Side>& sides) {
    std::set<Rational> out;
    for (const Side& s : sides) {
        out.insert(s.left[0]);
        out.insert(s.right[0]);
        for (const Side& t : sides) {
            const Rational begin = std::max(s.left[0], t.left[0]);
            const Rational end = std::min(s.right[0], t.right[0]);
            if (&t <= &s || begin >= end) continue;
            const Rational d = s.height(begin) - t.height(begin);
            const Rational e = s.height(end) - t.height(end);
            if (sign(d) * sign(e) < 0) out.insert(begin + (end - begin) * d / (d - e));
        }
    }
    return out;
}

}  // namespace

Rational flat_area(const std::vector<FlatOperand>& operands, const FlatFormula& formula) {
    const std::vector<Side> sides = sides_of(operands);
    const std::set<Rational> stops = stops_of(sides);
    Rational area = 0;
    for (auto stop = stops.begin(); stop != stops.end() && std::next(stop) != stops.end(); ++stop) {
        const Rational width = *std::next(stop) - *stop;
        const Rational middle = *stop + width / 2;
        std::vector<std::pair<Rational, const Side*>> here;
        for (const Side& s : sides)
            if (s.left[0] < middle && middle < s.right[0]) here.emplace_back(s.height(middle), &s);
        std::sort(here.begin(), here.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<int> winding(operands.size(), 0);
        for (std::size_t i = 0; i + 1 < here.size(); ++i) {
            winding[here[i].second->operand] += here[i].second->upward;
            std::vector<bool> inside;
            for (std::size_t o = 0; o < operands.size(); ++o)
                inside.push_back(operands[o].odd ? winding[o] % 2 != 0 : winding[o] > 0);
            if (formula(inside)) area += width * (here[i + 1].first - here[i].first);
        }
    }
    return area;
}

}  // namespace reference
