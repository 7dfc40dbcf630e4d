// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of booleans: bytes are operands on a small grid and a formula in reverse Polish notation.
// Whatever it is, the boundary closes, taking apart and putting together gives the same set,
// volumes add up, and neither the size of leaves nor evaluating step by step makes a difference.
#include <trisect/brep/exact_rational.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/expression.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "grid_solids.h"

namespace {

using trisect::evaluate;
using trisect::Expression;
using trisect::Solid;

void require(bool condition) {
    if (!condition) std::abort();
}

trisect::EvaluateOptions leaves_of(std::uint32_t polygons) {
    trisect::EvaluateOptions options;
    options.leaf_polygons = polygons;
    options.threads = 1;
    return options;
}

Expression formula(fuzz::ByteSource& bytes, const std::vector<Solid>& operands) {
    std::vector<Expression> stack{operands[0]};
    for (int step = 0; step < 24 && !bytes.is_empty(); ++step) {
        const unsigned code = bytes.below(6 + static_cast<unsigned>(operands.size()));
        if (code >= 6) {
            stack.emplace_back(operands[code - 6]);
        } else if (code == 0) {
            stack.back() = ~stack.back();
        } else if (stack.size() > 1) {
            const Expression b = stack.back();
            stack.pop_back();
            const Expression& a = stack.back();
            stack.back() = code == 1   ? a | b
                           : code == 2 ? a & b
                           : code == 3 ? a - b
                           : code == 4 ? a ^ b
                                       : b - a;
        }
    }
    Expression all = stack[0];
    for (std::size_t i = 1; i < stack.size(); ++i) all = all ^ stack[i];
    return all;
}

bool is_same_set(const Expression& a, const Expression& b) {
    const Solid rest = evaluate(a ^ b, leaves_of(10));
    return rest.is_empty() || (!rest.is_whole_space() && rest.to_brep().is_empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::ByteSource bytes(data, size);
    std::vector<Solid> operands;
    const unsigned count = 2 + bytes.below(3);
    for (unsigned i = 0; i < count; ++i) operands.push_back(fuzz::grid_solid(bytes));
    const Expression e = formula(bytes, operands);
    const Solid& c = operands.back();

    const Solid whole = evaluate(e, leaves_of(4));
    require(is_same_set(whole, evaluate(e, leaves_of(1000))));
    const Solid left = evaluate(whole - c, leaves_of(4));
    const Solid common = evaluate(whole & c, leaves_of(25));
    require(is_same_set(left | common, whole));
    require(is_same_set(evaluate(whole ^ c) ^ c, whole));
    if (!whole.is_whole_space()) {
        const auto volume = [](const Solid& s) { return trisect::exact_volume(s.to_brep()); };
        require(volume(left) + volume(common) == volume(whole));
        if (volume(whole).sign() >= 0) (void)whole.to_mesh();  // unbounded sets have none
    }
    return 0;
}
