// SPDX-License-Identifier: Apache-2.0
//
// What scripts/mutate writes into sources: operators that turn into their neighbours when the
// mutant of their number is the one that TRISECT_MUTANT names, so that one program is all mutants.
// They evaluate each operand once, in constant expressions they are what they were.
//
// With TRISECT_MUTANTS_REACHED (a file to write) no mutant is active; the program notes which ones
// it meets (level 1), which of these would have had another value there (level 2), and which would
// not compile (level 3). A test that takes a mutant to level 1 at most cannot notice it.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace mutants {

struct State {
    static constexpr int limit = 1 << 17;
    int active = 0;
    const char* out = nullptr;
    std::array<unsigned char, limit> level{};

    State() : out(std::getenv("TRISECT_MUTANTS_REACHED")) {
        const char* number = std::getenv("TRISECT_MUTANT");
        active = out != nullptr ? -1 : number != nullptr ? std::atoi(number) : 0;
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    ~State() {
        std::FILE* file = out != nullptr ? std::fopen(out, "w") : nullptr;
        if (file == nullptr) return;
        for (int n = 0; n < limit; ++n)
            if (level[static_cast<unsigned>(n)] != 0)
                std::fprintf(file, "%d %d\n", n, level[static_cast<unsigned>(n)]);
        std::fclose(file);
    }
};

inline State state;

template <int N>
constexpr bool on() {
    if (std::is_constant_evaluated()) return false;
    return state.active == N;
}

/** Notes that the mutant was met, and its level: 1, or 2 where its value `differs`, or 3. */
template <int N>
constexpr void note(int level) {
    if (std::is_constant_evaluated() || state.active >= 0) return;
    if (state.level[N] < level) state.level[N] = static_cast<unsigned char>(level);
}

template <int N>
constexpr bool tracing() {
    return !std::is_constant_evaluated() && state.active < 0;
}

// Comparisons and arithmetic. `was` is what the source says, `is` the mutant.
#define TRISECT_MUTANT_OPERATOR(name, was, is)                                                    \
    template <int N, typename A, typename B>                                                      \
    constexpr auto name(const A& a, const B& b) {                                                 \
        using Result = std::decay_t<decltype(a was b)>;                                           \
        if constexpr (!requires { static_cast<Result>(a is b); })                                 \
            note<N>(3);                                                                           \
        else {                                                                                    \
            if (on<N>()) return static_cast<Result>(a is b);                                      \
            if constexpr (requires {                                                              \
                              static_cast<bool>((a was b) == static_cast<Result>(a is b));        \
                          }) {                                                                    \
                if (tracing<N>())                                                                 \
                    note<N>(static_cast<bool>((a was b) == static_cast<Result>(a is b)) ? 1 : 2); \
            } else                                                                                \
                note<N>(2);                                                                       \
        }                                                                                         \
        return static_cast<Result>(a was b);                                                      \
    }
TRISECT_MUTANT_OPERATOR(less, <, <=)
TRISECT_MUTANT_OPERATOR(less_equal, <=, <)
TRISECT_MUTANT_OPERATOR(greater, >, >=)
TRISECT_MUTANT_OPERATOR(greater_equal, >=, >)
TRISECT_MUTANT_OPERATOR(equal, ==, !=)
TRISECT_MUTANT_OPERATOR(not_equal, !=, ==)
TRISECT_MUTANT_OPERATOR(plus, +, -)
TRISECT_MUTANT_OPERATOR(minus, -, +)
TRISECT_MUTANT_OPERATOR(times, *, +)
#undef TRISECT_MUTANT_OPERATOR

#define TRISECT_MUTANT_ASSIGNMENT(name, was, is)       \
    template <int N, typename A, typename B>           \
    constexpr decltype(auto) name(A&& a, const B& b) { \
        if constexpr (requires { a is b; }) {          \
            if (on<N>()) return a is b;                \
        }                                              \
        note<N>(requires { a is b; } ? 2 : 3);         \
        return a was b;                                \
    }
TRISECT_MUTANT_ASSIGNMENT(plus_assign, +=, -=)
TRISECT_MUTANT_ASSIGNMENT(minus_assign, -=, +=)
#undef TRISECT_MUTANT_ASSIGNMENT

/** a && b, or a || b. What the second operand would be where it is not asked for is not known. */
template <int N, typename A, typename F>
constexpr bool both(const A& a, const F& second) {
    const bool first = static_cast<bool>(a);
    if (on<N>()) return first || second();
    if (!first) {
        note<N>(2);
        return false;
    }
    const bool result = second();
    note<N>(result ? 1 : 2);
    return result;
}

/** a || b, or a && b. */
template <int N, typename A, typename F>
constexpr bool either(const A& a, const F& second) {
    const bool first = static_cast<bool>(a);
    if (on<N>()) return first && second();
    if (first) {
        note<N>(2);
        return true;
    }
    const bool result = second();
    note<N>(result ? 2 : 1);
    return result;
}

/** The condition of an if: as it is, or always true (N), or always false (N + 1). */
template <int N, typename C>
constexpr bool condition(C&& c) {
    const bool result = static_cast<bool>(c);
    note<N>(result ? 1 : 2);
    note<N + 1>(result ? 2 : 1);
    return (result || on<N>()) && !on<N + 1>();
}

/** A constant, or another. */
template <int N, typename T>
constexpr T constant(T was, T is) {
    note<N>(2);
    return on<N>() ? is : was;
}

}  // namespace mutants
