// SPDX-License-Identifier: Apache-2.0
//
// Random booleans on a small grid, where faces, edges and vertices of different operands coincide
// all the time, by independent engines that share no code above the kernel:
//
//  - the cell tree (evaluate), with random leaf size and wall position;
//  - the naive engine in rationals (tests/reference), which knows no tree;
//  - the classic BSP tree (build, merge, boundary), where the operands do not meet themselves.
//
// A pair is two operands under union, intersection, difference and symmetric difference. A formula
// has 5 to 20 operations over 2 to 6 operands, is evaluated in one pass and again step by step on
// the trees of the results before. Boundaries must be the same sets with the same faces.
//
// A chain has two to five steps with solids that integer maps take out of each other's grid. Its
// leaves are arranged in doubles, fragments of earlier steps included; how many is counted. Pairs
// and first steps are also evaluated without being divided, where they allow it, and must give the
// mesh that cells give.
//
// One of many is a union, an intersection, or one less all others, or these of each other, of three
// to eight operands or their complements, of which some are copies moved along the axes. It is
// evaluated pair by pair without a tree by one, two and four threads, in special position as well.
// An exclusive one is an exclusive or of such, evaluated likewise.
//
//     small_grid_booleans [--seed S] [--pairs N] [--formulas M] [--chains K] [--many L]
//                         [--exclusive E] [--threads T] [--fractions 1] [--only-pair I]
//                         [--only-formula I]
//                         [--only-chain I] [--only-many I] [--only-exclusive I]
//
// With --fractions 1 each operand is put on a lattice whose unit is 2^0, 2^2, 2^4, 2^8, 2^24, 2^56
// or 2^70, so that its coordinates have so many bits behind the point: the same sets, on all kinds
// of common lattices. The classic BSP tree is left out.
//
// Works in T processes; a crash of one is recorded with the case and the rest goes on. The last
// options repeat one case of the seed, which is how a disagreement is looked into. Exits with 1 if
// there was any.

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <trisect/bsp/boolean_rule.h>
#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/bsp_merge.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/classic/bsp_assembly.h>
#include <trisect/bsp/classic/bsp_boundary.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"
#include "engines/evaluate_stats.h"

namespace {

using Kind = reference::Expression::Kind;
using Clock = std::chrono::steady_clock;

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t pairs = 300;
    std::uint64_t formulas = 30;
    std::uint64_t chains = 0;
    std::uint64_t many = 0;
    std::uint64_t exclusive = 0;
    std::uint64_t threads = 1;
    bool fractions = false;
    std::optional<std::uint64_t> only_pair;
    std::optional<std::uint64_t> only_formula;
    std::optional<std::uint64_t> only_chain;
    std::optional<std::uint64_t> only_many;
    std::optional<std::uint64_t> only_exclusive;
};

/// Shared by the processes.
struct Counters {
    std::atomic<std::uint64_t> pairs;
    std::atomic<std::uint64_t> formulas;
    std::atomic<std::uint64_t> operations;  // of all formulas
    std::atomic<std::uint64_t> chains;
    std::atomic<std::uint64_t> many;
    std::atomic<std::uint64_t> exclusive;
    std::atomic<std::uint64_t> exclusive_pairwise;
    std::atomic<std::uint64_t> pairwise;            // of them
    std::atomic<std::uint64_t> doubtful;            // pairs of facets in those
    std::atomic<std::uint64_t> mixed_leaves;        // of all chains
    std::atomic<std::uint64_t> filtered_leaves;     // of them
    std::atomic<std::uint64_t> filtered_fragments;  // in those
    std::atomic<std::uint64_t> undivided;           // meshes of pairs and first steps
    std::atomic<std::uint64_t> conforming;          // of them
    std::atomic<std::uint64_t> results;             // cell tree against naive
    std::atomic<std::uint64_t> stepwise;            // cell tree, step by step, against naive
    std::atomic<std::uint64_t> classic;             // classic BSP tree against naive
    std::atomic<std::uint64_t> empty;               // expected results without boundary
    std::atomic<std::uint64_t> disagreements;
    std::atomic<std::uint64_t> wrong_flags;  // right boundary, wrong is_empty or is_whole_space
    std::atomic<std::uint64_t> crashes;
    std::atomic<std::uint64_t> microseconds_ours;
    std::atomic<std::uint64_t> microseconds_classic;
    std::atomic<std::uint64_t> microseconds_naive;
};

/// Where a process is, so that its parent knows what it crashed on.
struct Progress {
    std::atomic<std::uint64_t> next_case;
};

/// The bits behind the point of an operand.
int fraction_bits(const Options& options, reference::Random& random) {
    constexpr std::array<int, 7> bits{0, 2, 4, 8, 24, 56, 70};
    return options.fractions ? bits[random.below(7)] : 0;
}

template <class T>
T* shared(std::size_t count) {
    void* memory =
        mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    T* out = static_cast<T*>(memory);
    for (std::size_t i = 0; i < count; ++i) new (out + i) T{};
    return out;
}

class Timer {
public:
    explicit Timer(std::atomic<std::uint64_t>& sum) : sum_(sum) {}
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    ~Timer() {
        sum_ += static_cast<std::uint64_t>(
            std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - start_).count());
    }

private:
    std::atomic<std::uint64_t>& sum_;
    Clock::time_point start_ = Clock::now();
};

trisect::BooleanRule rule_of(Kind kind) {
    switch (kind) {
        case Kind::Union:
            return trisect::BooleanRule::set_union();
        case Kind::Intersection:
            return trisect::BooleanRule::set_intersection();
        case Kind::Difference:
            return trisect::BooleanRule::set_difference();
        default:
            return trisect::BooleanRule::symmetric_difference();
    }
}

trisect::BspTree classic_tree(const reference::Expression& expression,
                              const std::vector<trisect::BspTree>& trees) {
    if (expression.kind == Kind::Leaf) return trees[expression.operand];
    trisect::BspTree out = classic_tree(expression.children[0], trees);
    if (expression.kind == Kind::Complement) return out.complement();
    for (std::size_t i = 1; i < expression.children.size(); ++i)
        out = merge(out, classic_tree(expression.children[i], trees), rule_of(expression.kind));
    return out;
}

std::size_t operation_count(const reference::Expression& expression) {
    std::size_t n = expression.children.empty() ? 0 : expression.children.size() - 1;
    for (const auto& child : expression.children) n += operation_count(child);
    return n;
}

/// Operands, expression, and how to evaluate it.
class Case {
public:
    Case(const Options& options, Counters& counters, std::string name, reference::Random& random,
         std::size_t operands)
        : counters_(counters), name_(std::move(name)), fractions_(options.fractions) {
        embedded_ = random.chance(1, 2);
        operands_ = reference::random_family(random, operands, embedded_);
        if (!embedded_ && random.chance(1, 2))
            for (auto& o : operands_) o = reference::with_folds(random, o, 4);
        constexpr std::array<std::uint32_t, 4> leaf_sizes{3, 8, 25, 1000};
        constexpr std::array<std::uint32_t, 4> wall_offsets{1, 61, 127, 191};
        options_.leaf_polygons = leaf_sizes[random.below(4)];
        offset_.emplace(wall_offsets[random.below(4)]);
        const bool assume = embedded_ && random.chance(1, 2);
        // Half of the cases have one lattice.
        const int common = fraction_bits(options, random);
        const bool one_lattice = options.fractions && random.chance(1, 2);
        for (const auto& o : operands_)
            solids_.push_back(
                engines::solid(o, assume ? trisect::Embedding::Assume : trisect::Embedding::Resolve,
                               one_lattice ? common : fraction_bits(options, random)));
    }

    [[nodiscard]] std::size_t operand_count() const { return operands_.size(); }

    void compare(const reference::Expression& expression, bool stepwise) {
        const Wanted wanted = naive(expression);
        if (wanted.boundary.empty()) ++counters_.empty;
        guarded("cell tree", expression, [&] {
            const Timer timer(counters_.microseconds_ours);
            const auto result = trisect::evaluate(engines::formula(expression, solids_), options_);
            ++counters_.results;
            return check(result, wanted);
        });
        if (!stepwise)
            guarded("undivided", expression, [&] {
                bool conforming = false;
                const auto difference = engines::undivided_difference(
                    engines::formula(expression, solids_), options_, &conforming);
                counters_.undivided += difference ? 1U : 0U;
                counters_.conforming += conforming ? 1U : 0U;
                return difference.value_or("");
            });
        if (stepwise)
            guarded("cell tree, step by step", expression, [&] {
                const Timer timer(counters_.microseconds_ours);
                const auto result = stepwise_solid(expression);
                ++counters_.stepwise;
                return check(result, wanted);
            });
        if (embedded_ && !fractions_)
            guarded("classic BSP tree", expression, [&] {
                const Timer timer(counters_.microseconds_classic);
                ++counters_.classic;
                return classic_difference(expression, wanted);
            });
    }

private:
    struct Wanted {
        reference::CanonicalBoundary boundary;
        bool unbounded = false;
    };

    Wanted naive(const reference::Expression& expression) {
        const Timer timer(counters_.microseconds_naive);
        const auto result = reference::evaluate(operands_, expression);
        return {reference::canonical_boundary(result.cells), result.unbounded};
    }

    std::string check(const trisect::Solid& result, const Wanted& wanted) {
        if (std::string why = engines::difference(result.to_brep(), wanted.boundary); !why.empty())
            return why;
        if (!wanted.unbounded)
            if (std::string why = engines::open_edge(engines::boundary_mesh(result)); !why.empty())
                return why;
        const bool nothing = wanted.boundary.empty() && !wanted.unbounded;
        const bool everything = wanted.boundary.empty() && wanted.unbounded;
        if (result.is_empty() == nothing && result.is_whole_space() == everything) return {};
        // One report will do: all have the same cause.
        if (counters_.wrong_flags++ == 0)
            std::printf("WRONG FLAG %s: is_empty() or is_whole_space()\n", name_.c_str());
        return {};
    }

    /// Every operation on the tree of the results before.
    trisect::Solid stepwise_solid(const reference::Expression& expression) {
        if (expression.kind == Kind::Leaf) return solids_[expression.operand];
        trisect::Solid out = stepwise_solid(expression.children[0]);
        if (expression.kind == Kind::Complement) return trisect::evaluate(~out, options_);
        for (std::size_t i = 1; i < expression.children.size(); ++i) {
            const trisect::Solid next = stepwise_solid(expression.children[i]);
            const auto pair = reference::pair_expression(expression.kind);
            out = trisect::evaluate(engines::formula(pair, {out, next}), options_);
        }
        return out;
    }

    std::string classic_difference(const reference::Expression& expression, const Wanted& wanted) {
        if (trees_.empty())
            for (const auto& o : operands_)
                trees_.push_back(trisect::build_bsp(engines::lattice_mesh(o)));
        const trisect::BspTree tree = classic_tree(expression, trees_);
        const auto fragments = trisect::boundary_of(tree);
        if (fragments.empty()) {
            const auto location = tree.classify(trisect::LatticePoint{1000, 1001, 1002});
            if ((location == trisect::BspTree::Membership::Inside) != wanted.unbounded)
                return "without boundary, and not the right one of nothing and everything";
        }
        return engines::difference(trisect::brep_from_fragments(fragments, {}), wanted.boundary);
    }

    template <class Check>
    void guarded(const char* engine, const reference::Expression& expression, Check&& check) {
        std::string why;
        try {
            why = check();
        } catch (const std::exception& e) {
            why = std::string("exception: ") + e.what();
        }
        if (why.empty()) return;
        ++counters_.disagreements;
        std::printf("DISAGREEMENT %s, %s, leaf_polygons %u, splitting_offset %u, %s: %s\n",
                    name_.c_str(), engine, options_.leaf_polygons,
                    trisect::detail::SplittingOffset::of_thread(),
                    reference::to_string(expression).c_str(), why.c_str());
        std::fflush(stdout);
    }

    Counters& counters_;
    std::string name_;
    bool fractions_ = false;
    bool embedded_ = false;
    std::vector<reference::Operand> operands_;
    std::vector<trisect::Solid> solids_;
    std::vector<trisect::BspTree> trees_;
    trisect::EvaluateOptions options_;
    std::optional<trisect::detail::SplittingOffset> offset_;
};

reference::Random generator(std::uint64_t seed, std::uint64_t kind, std::uint64_t index) {
    reference::Random mix(seed * 2 + kind);
    return reference::Random(mix.next() + index);
}

std::string case_name(const Options& options, const char* option, std::uint64_t index) {
    return "--seed " + std::to_string(options.seed) + " " + option + " " + std::to_string(index);
}

void run_pair(const Options& options, std::uint64_t index, Counters& counters) {
    reference::Random random = generator(options.seed, 0, index);
    Case pair(options, counters, case_name(options, "--only-pair", index), random, 2);
    for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor})
        pair.compare(reference::pair_expression(kind), false);
    ++counters.pairs;
}

void run_formula(const Options& options, std::uint64_t index, Counters& counters) {
    reference::Random random = generator(options.seed, 1, index);
    Case formula(options, counters, case_name(options, "--only-formula", index), random,
                 2 + random.below(5));
    const auto expression =
        reference::random_expression(random, formula.operand_count(), 5 + random.below(16));
    counters.operations += operation_count(expression);
    formula.compare(expression, true);
    ++counters.formulas;
}

/// Why the last result of a chain is wrong; empty when it is right.
std::string chain_difference(const Options& chains, reference::Random& random, Counters& counters) {
    constexpr std::array<std::uint32_t, 4> leaf_sizes{3, 8, 25, 100};
    trisect::EvaluateOptions options;
    options.leaf_polygons = leaf_sizes[random.below(4)];
    // Else in general position.
    const bool on_grid = random.chance(1, 2);
    const auto operand = [&] {
        reference::Operand solid = reference::random_embedded_solid(random);
        return on_grid ? solid : engines::mapped(std::move(solid), random);
    };
    std::vector<reference::Operand> operands{operand()};
    auto expression = reference::Expression::leaf(0);
    trisect::Solid result =
        engines::solid(operands[0], trisect::Embedding::Assume, fraction_bits(chains, random));
    for (std::size_t steps = 2 + random.below(4); operands.size() <= steps;) {
        const Kind kind = random.chance(1, 3) ? Kind::Union : Kind::Difference;
        expression = reference::Expression::node(
            kind, {expression, reference::Expression::leaf(operands.size())});
        operands.push_back(operand());
        const trisect::Solid tool = engines::solid(operands.back(), trisect::Embedding::Assume,
                                                   fraction_bits(chains, random));
        const Timer timer(counters.microseconds_ours);
        trisect::test::EvaluateStats stats;
        const auto step = engines::formula(reference::pair_expression(kind), {result, tool});
        if (operands.size() == 2) {
            const auto difference = engines::undivided_difference(step, options);
            counters.undivided += difference ? 1U : 0U;
            if (!difference.value_or("").empty()) return "undivided: " + *difference;
        }
        result = evaluate(step, options, &stats);
        counters.mixed_leaves += stats.mixed_leaves;
        counters.filtered_leaves += stats.filtered_leaves;
        counters.filtered_fragments += stats.filtered_fragments;
    }
    const Timer timer(counters.microseconds_naive);
    const auto wanted = reference::evaluate(operands, expression);
    return engines::difference(result.to_brep(), reference::canonical_boundary(wanted.cells));
}

void run_chain(const Options& options, std::uint64_t index, Counters& counters) {
    reference::Random random = generator(options.seed, 2, index);
    std::string why;
    try {
        why = chain_difference(options, random, counters);
    } catch (const std::exception& e) {
        why = std::string("exception: ") + e.what();
    }
    ++counters.chains;
    if (why.empty()) return;
    ++counters.disagreements;
    std::printf("DISAGREEMENT %s: %s\n", case_name(options, "--only-chain", index).c_str(),
                why.c_str());
    std::fflush(stdout);
}

/// Three to eight operands, on one lattice.
std::vector<reference::Operand> many_operands(reference::Random& random) {
    const std::size_t n = 3 + random.below(6);
    if (!random.chance(1, 3)) return reference::random_family(random, n, true);
    std::vector<reference::Operand> out;
    const std::size_t axis = random.below(3);
    while (out.size() < n) {
        if (out.empty() || random.chance(1, 4)) {
            out.push_back(reference::random_embedded_solid(random));
            continue;
        }
        reference::LatticePoint by{0, 0, 0};
        by[axis] = random.between(-3, 3);
        if (random.chance(1, 4)) by[(axis + 1) % 3] = random.between(-2, 2);
        out.push_back(reference::translated(out[random.below(out.size())], by));
    }
    return out;
}

reference::Expression flat_formula(reference::Random& random, std::size_t n) {
    using reference::Expression;
    const std::uint64_t kind = random.below(3);
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < n; ++i) {
        Expression leaf = Expression::leaf(i);
        const bool negated = kind == 2 ? i != 0 : random.chance(1, 6);
        terms.push_back(negated ? Expression::node(Kind::Complement, {leaf}) : leaf);
    }
    return Expression::node(kind == 0 ? Kind::Union : Kind::Intersection, terms);
}

// Unions, intersections and differences of each other. Leaves beyond the operands name these again.
reference::Expression nested_formula(reference::Random& random, std::size_t first, std::size_t end,
                                     std::size_t operands) {
    using reference::Expression;
    if (first + 1 == end) {
        Expression leaf = Expression::leaf(first % operands);
        return random.chance(1, 6) ? Expression::node(Kind::Complement, {leaf}) : leaf;
    }
    const std::size_t middle = first + 1 + random.below(end - first - 1);
    constexpr std::array kinds{Kind::Union, Kind::Intersection, Kind::Difference};
    const Kind kind = kinds[random.below(3)];
    Expression left = nested_formula(random, first, middle, operands);
    return Expression::node(kind, {std::move(left), nested_formula(random, middle, end, operands)});
}

reference::Expression exclusive_or(reference::Random& random, std::size_t n) {
    using reference::Expression;
    std::vector<Expression> terms;
    for (std::size_t i = 0; i < n; ++i) {
        const Expression leaf = Expression::leaf(i);
        terms.push_back(random.chance(1, 6) ? Expression::node(Kind::Complement, {leaf}) : leaf);
    }
    return Expression::node(Kind::Xor, terms);
}

/// Operands, and what is made of them.
struct ManyCase {
    std::vector<reference::Operand> operands;
    reference::Expression expression;
};

ManyCase many_case(reference::Random& random, std::uint64_t index, bool is_exclusive) {
    ManyCase out{many_operands(random), {}};
    auto& operands = out.operands;
    const bool is_nested = !is_exclusive && index % 3 == 2;
    if ((is_nested || is_exclusive) && index % 2 == 0)
        for (reference::Operand& o : operands) o = engines::mapped(o, random);
    const std::size_t leaves = operands.size() + (index % 4 == 3 ? 1 + random.below(4) : 0);
    if (is_exclusive)
        out.expression = exclusive_or(random, operands.size());
    else
        out.expression = is_nested ? nested_formula(random, 0, leaves, operands.size())
                                   : flat_formula(random, operands.size());
    return out;
}

void run_many(const Options& options, std::uint64_t index, bool is_exclusive, Counters& counters) {
    reference::Random random = generator(options.seed, is_exclusive ? 4 : 3, index);
    const int bits = fraction_bits(options, random);
    const auto [operands, expression] = many_case(random, index, is_exclusive);
    std::string why;
    try {
        std::vector<trisect::Solid> solids;
        for (const auto& o : operands)
            solids.push_back(engines::solid(o, trisect::Embedding::Assume, bits));
        const auto wanted =
            reference::canonical_boundary(reference::evaluate(operands, expression).cells);
        std::uint64_t doubtful = 0;
        const auto difference = engines::pairwise_difference(engines::formula(expression, solids),
                                                             {}, wanted, doubtful);
        (is_exclusive ? counters.exclusive_pairwise : counters.pairwise) += difference ? 1U : 0U;
        counters.doubtful += doubtful;
        why = difference.value_or("");
    } catch (const std::exception& e) {
        why = std::string("exception: ") + e.what();
    }
    ++(is_exclusive ? counters.exclusive : counters.many);
    if (why.empty()) return;
    ++counters.disagreements;
    const char* const option = is_exclusive ? "--only-exclusive" : "--only-many";
    std::printf("DISAGREEMENT %s, %s: %s\n", case_name(options, option, index).c_str(),
                reference::to_string(expression).c_str(), why.c_str());
    std::fflush(stdout);
}

/// Cases are the pairs, then the formulas, then the chains, then those of many, then
/// exclusive ones.
void run_case(const Options& options, std::uint64_t index, Counters& counters) {
    if (index < options.pairs)
        run_pair(options, index, counters);
    else if (index < options.pairs + options.formulas)
        run_formula(options, index - options.pairs, counters);
    else if (index < options.pairs + options.formulas + options.chains)
        run_chain(options, index - options.pairs - options.formulas, counters);
    else {
        const std::uint64_t many = index - options.pairs - options.formulas - options.chains;
        const bool is_exclusive = many >= options.many;
        run_many(options, is_exclusive ? many - options.many : many, is_exclusive, counters);
    }
}

std::string name_of_case(const Options& options, std::uint64_t index) {
    if (index < options.pairs) return case_name(options, "--only-pair", index);
    index -= options.pairs;
    if (index < options.formulas) return case_name(options, "--only-formula", index);
    index -= options.formulas;
    if (index < options.chains) return case_name(options, "--only-chain", index);
    index -= options.chains;
    if (index < options.many) return case_name(options, "--only-many", index);
    return case_name(options, "--only-exclusive", index - options.many);
}

/// The cases next_case, next_case + threads, ...
pid_t start_worker(const Options& options, Progress& progress, Counters& counters) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child != 0) return child;
    const std::uint64_t cases =
        options.pairs + options.formulas + options.chains + options.many + options.exclusive;
    while (progress.next_case < cases) {
        run_case(options, progress.next_case, counters);
        progress.next_case += options.threads;
    }
    std::fflush(stdout);
    _exit(0);
}

void run_all(const Options& options, Counters& counters) {
    Progress* progress = shared<Progress>(options.threads);
    std::map<pid_t, std::uint64_t> workers;
    for (std::uint64_t i = 0; i < options.threads; ++i) {
        progress[i].next_case = i;
        workers[start_worker(options, progress[i], counters)] = i;
    }
    while (!workers.empty()) {
        int status = 0;
        const pid_t ended = waitpid(-1, &status, 0);
        const auto worker = workers.find(ended);
        if (worker == workers.end()) continue;
        const std::uint64_t i = worker->second;
        workers.erase(worker);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
        ++counters.crashes;
        const std::uint64_t at = progress[i].next_case;
        std::printf("CRASH %s\n", name_of_case(options, at).c_str());
        progress[i].next_case += options.threads;
        workers[start_worker(options, progress[i], counters)] = i;
    }
}

void print(const Counters& c) {
    const auto row = [](const char* name, const std::atomic<std::uint64_t>& value) {
        std::printf("| %s | %llu |\n", name, static_cast<unsigned long long>(value.load()));
    };
    const auto time_row = [](const char* name, const std::atomic<std::uint64_t>& value) {
        std::printf("| %s | %.1f |\n", name, static_cast<double>(value.load()) * 1e-6);
    };
    std::printf("| what | number |\n|---|---:|\n");
    row("pairs", c.pairs);
    row("formulas", c.formulas);
    row("operations in formulas", c.operations);
    row("chains", c.chains);
    row("their leaves that were arranged", c.mixed_leaves);
    row("of those, in doubles", c.filtered_leaves);
    row("fragments of earlier steps in those", c.filtered_fragments);
    row("meshes of pairs and first steps that were not divided", c.undivided);
    row("of those, of meshes that were not cut", c.conforming);
    row("formulas of many", c.many);
    row("of those, done pair by pair without a tree", c.pairwise);
    row("exclusive ones", c.exclusive);
    row("of those, done without a tree", c.exclusive_pairwise);
    row("pairs of facets in special position in those", c.doubtful);
    row("results of the cell tree compared with the naive engine", c.results);
    row("the same, formulas step by step", c.stepwise);
    row("results of the classic BSP tree compared with the naive engine", c.classic);
    row("results without boundary", c.empty);
    row("disagreements", c.disagreements);
    row("wrong is_empty() or is_whole_space()", c.wrong_flags);
    row("crashes", c.crashes);
    time_row("seconds in the cell tree and the comparison", c.microseconds_ours);
    time_row("seconds in the classic BSP tree and the comparison", c.microseconds_classic);
    time_row("seconds in the naive engine", c.microseconds_naive);
}

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i < argc; i += 2) {
        if (i + 1 == argc) return std::nullopt;
        char* end = nullptr;
        const std::uint64_t value = std::strtoull(argv[i + 1], &end, 10);
        if (end == argv[i + 1] || *end != '\0') return std::nullopt;
        const std::string name = argv[i];
        if (name == "--seed")
            out.seed = value;
        else if (name == "--pairs")
            out.pairs = value;
        else if (name == "--formulas")
            out.formulas = value;
        else if (name == "--chains")
            out.chains = value;
        else if (name == "--many")
            out.many = value;
        else if (name == "--exclusive")
            out.exclusive = value;
        else if (name == "--only-exclusive")
            out.only_exclusive = value;
        else if (name == "--only-many")
            out.only_many = value;
        else if (name == "--threads")
            out.threads = value;
        else if (name == "--fractions")
            out.fractions = value != 0;
        else if (name == "--only-pair")
            out.only_pair = value;
        else if (name == "--only-formula")
            out.only_formula = value;
        else if (name == "--only-chain")
            out.only_chain = value;
        else
            return std::nullopt;
    }
    if (out.threads == 0) return std::nullopt;
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::fprintf(stderr,
                     "usage: %s [--seed S] [--pairs N] [--formulas M] [--chains K] [--many L] "
                     "[--exclusive E]\n"
                     "       [--threads T] [--fractions 1] [--only-pair I] [--only-formula I]\n"
                     "       [--only-chain I] [--only-many I] [--only-exclusive I]\n",
                     argv[0]);
        return 2;
    }
    Counters& counters = *shared<Counters>(1);
    const auto start = Clock::now();
    if (options->only_pair)
        run_pair(*options, *options->only_pair, counters);
    else if (options->only_formula)
        run_formula(*options, *options->only_formula, counters);
    else if (options->only_chain)
        run_chain(*options, *options->only_chain, counters);
    else if (options->only_many)
        run_many(*options, *options->only_many, false, counters);
    else if (options->only_exclusive)
        run_many(*options, *options->only_exclusive, true, counters);
    else
        run_all(*options, counters);
    print(counters);
    std::printf("\nseed %llu, %.0f s\n", static_cast<unsigned long long>(options->seed),
                std::chrono::duration<double>(Clock::now() - start).count());
    return counters.disagreements + counters.wrong_flags + counters.crashes == 0 ? 0 : 1;
}
