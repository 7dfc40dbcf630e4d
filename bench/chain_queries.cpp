// SPDX-License-Identifier: Apache-2.0
//
// chain_queries: the first query of each kind after every cut of a chain, and warm speed on
// results. A cut costs what changes; this is about whether queries do, too.
//
//     chain_queries [--level N] [--cuts N] [--every N] [--path] [--unrefined] [--interference]
//                   [--small-holder] [--asked] [--repeat N] [--chains N] [--rebuild N] [--models]
//                   [--bytes] [--memory] [--count N] [--plate]
//
// --level: the stock has 20 · 4^N triangles. --plate: it is a rough plate, which is the same about
// each cut at every size, and no sphere, which is flatter there the larger it is. --unrefined: it
// is not divided beforehand. --path: cuts follow each other instead of lying all over the stock.
// --every: after so many cuts 20,000 points, one by one and as a batch, and a fresh index beside.
// --interference: a holder above each cut, by the solids themselves: first placed anew each time,
// then by a query that goes on. Above the cut its whole rim is equally near, beside it is not.
// --small-holder: as large as the ball that cuts, so as many facets are near whatever their number.
// --asked: first, questions at 20,000 places all over the stock, as to a stock that was used for
// a while; else each cut is where no question came near before.
// --repeat: the same chain so many times; of each cut and question the least time counts, so that
// the worst one is of the work and not of the machine.
// --chains: so many chains, each from the uncut stock at places of its own; means are of all. What
// questions made of the stock stays.
// --rebuild: after every so many cuts also what making everything anew takes, CGAL and FCL beside
// it; with --models an InterferenceModel, too.
// --bytes: of facts that each version adds. Walks through the whole tree after each cut, so times
// are longer.
// --memory: of the last version alone, and of its mesh as a fresh solid: refined, and after all
// the same questions.
// --count: under callgrind, the instructions of so many cuts after the fifth and of the last ones;
// see scripts/count-chain-instructions.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference_query.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

#include "chain_cuts.h"
#include "chain_facts.h"
#include "chain_memory.h"
#include "chain_rebuild.h"
#include "chain_series.h"

namespace {

using trisect::BrepIndex;
using trisect::Expression;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Solid;

struct Options {
    int level = 6;
    int cuts = 300;
    int every = 100;
    int rebuild = 0;
    int count = 0;
    int repeat = 1;
    int chains = 1;
    bool asked = false;
    bool path = false;
    bool refined = true;
    bool interference = false;
    bool models = false;
    bool bytes = false;
    bool memory = false;
    bool small_holder = false;
    bool plate = false;
};

Options parsed(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string arg = argv[i];
        const auto number = [&] { return std::max(0, i + 1 < argc ? std::atoi(argv[++i]) : 0); };
        if (arg == "--level") {
            o.level = number();
        } else if (arg == "--cuts") {
            o.cuts = number();
        } else if (arg == "--every") {
            o.every = std::max(1, number());
        } else if (arg == "--rebuild") {
            o.rebuild = number();
        } else if (arg == "--count") {
            o.count = number();
        } else if (arg == "--repeat") {
            o.repeat = std::max(1, number());
        } else if (arg == "--chains") {
            o.chains = std::max(1, number());
        } else if (arg == "--asked") {
            o.asked = true;
        } else if (arg == "--path") {
            o.path = true;
        } else if (arg == "--unrefined") {
            o.refined = false;
        } else if (arg == "--interference") {
            o.interference = true;
        } else if (arg == "--models") {
            o.models = true;
        } else if (arg == "--bytes") {
            o.bytes = true;
        } else if (arg == "--memory") {
            o.memory = true;
        } else if (arg == "--small-holder") {
            o.small_holder = true;
        } else if (arg == "--plate") {
            o.plate = true;
        } else {
            throw std::runtime_error("unknown option " + arg);
        }
    }
    if (o.count != 0 && !CallgrindParts::is_compiled_in())
        throw std::runtime_error("compiled without the header of callgrind");
    return o;
}

Solid solid_of(const PolygonMesh& mesh) {
    trisect::SolidOptions options;
    options.embedding = trisect::Embedding::Assume;
    return Solid::from_mesh(mesh, options);
}

trisect::EvaluateOptions one_thread() {
    trisect::EvaluateOptions o;
    o.threads = 1;
    return o;
}

class Chain {
public:
    Chain(const Options& o, ChainSeries& series)
        : options_(o),
          series_(series),
          cuts_(o.plate ? ChainCuts::Shape::Plate : ChainCuts::Shape::Sphere, o.level, o.path,
                o.small_holder),
          stock_(solid_of(cuts_.stock())),
          holder_(solid_of(cuts_.holder())),
          rebuild_(cuts_.holder(), o.models) {
        if (o.refined) stock_.refine();
        (void)BrepIndex(stock_);
        if (o.asked) ask_all_over();
        if (o.bytes) facts_.emplace(stock_);
    }

    void run() {
        const Solid uncut = stock_;
        for (int chain = 0; chain < options_.chains; ++chain) {
            stock_ = uncut;
            if (options_.interference) query_.emplace(stock_, holder_);
            cut_all();
        }
    }

    void cut_all() {
        for (int i = 1; i <= options_.cuts; ++i) {
            counters_.cut = i;
            const bool counted = (i > first_counted && i <= first_counted + options_.count) ||
                                 i > options_.cuts - options_.count;
            counted ? counters_.parts.begin() : counters_.parts.end();
            step(i);
            if (options_.count != 0) continue;
            if (i % options_.every == 0) warm(i);
        }
        counters_.parts.end();
    }

    void print() {
        Series::print_head();
        for (const Series* s : series_.all()) s->print();
        rebuild_.print();
        print_bytes();
        if (options_.memory) compare_memory();
    }

private:
    static constexpr int first_counted = 5;  // what happens once has happened

    // A point beside the cut, a ray towards it, a point above it; the holder above the tool, a
    // little off the stock.
    [[nodiscard]] ChainQuestions questions_at(const Point3d& at) const {
        const double r = cuts_.radius();
        const double holder = cuts_.holder_radius() + 0.1 * r;
        return {cuts_.above(at, -0.9 * r), cuts_.above(at, 2),      cuts_.middle(at),
                cuts_.above(at, 2 * r),    cuts_.above(at, holder), cuts_.aside(at, holder)};
    }

    void ask_all_over() {
        const BrepIndex index(stock_);
        constexpr int count = 20'000;
        for (int i = 0; i < count; ++i) {
            const Point3d at = cuts_.spread(i, count);
            const ChainQuestions q = questions_at(at);
            sum_ += static_cast<std::size_t>(index.locate(q.near).location);
            sum_ += index.first_facet(trisect::Segment{q.far, q.middle}) ? 1 : 0;
            sum_ += index.distance(q.above) ? 1 : 0;
            if (!options_.interference) continue;
            const Point3d on = cuts_.above(at, cuts_.holder_radius());
            const Pose touching = Pose::from_translation(on);
            sum_ += static_cast<std::size_t>(interfere(stock_, Pose(), holder_, touching).relation);
        }
    }

    void step(int i) {
        const Point3d at = cuts_.place(i);
        if (options_.memory) places_.push_back(at);
        const PolygonMesh tool = cuts_.ball_at(at);
        series_.cut.add(counters_, [&] {
            stock_ = evaluate(Expression(stock_) - Expression(solid_of(tool)), one_thread());
        });
        const ChainQuestions q = questions_at(at);
        std::optional<BrepIndex> index;
        series_.index.add(counters_, [&] { index.emplace(stock_); });
        series_.locate.add(
            counters_, [&] { sum_ += static_cast<std::size_t>(index->locate(q.near).location); });
        series_.ray.add(counters_, [&] {
            sum_ += index->first_facet(trisect::Segment{q.far, q.middle}) ? 1 : 0;
        });
        series_.nearest.add(counters_, [&] { sum_ += index->distance(q.above) ? 1 : 0; });
        if (options_.interference)
            ask_holder(Pose::from_translation(q.holder), Pose::from_translation(q.aside));
        if (facts_) added_.push_back(static_cast<double>(facts_->added_by(stock_)));
        if (options_.rebuild != 0 && i % options_.rebuild == 0) rebuild_.ask(stock_, q);
    }

    void ask_holder(const Pose& pose, const Pose& aside) {
        series_.interfere.add(counters_, [&] {
            sum_ += static_cast<std::size_t>(interfere(stock_, Pose(), holder_, pose).relation);
        });
        series_.aside.add(
            counters_, [&] { sum_ += boundary_distance(stock_, Pose(), holder_, aside) ? 1 : 0; });
        series_.rim.add(counters_,
                        [&] { sum_ += boundary_distance(stock_, Pose(), holder_, pose) ? 1 : 0; });
        series_.replace.add(counters_, [&] { query_->replace_a(stock_); });
        series_.query_relation.add(
            counters_, [&] { sum_ += static_cast<std::size_t>(query_->relation(Pose(), pose)); });
        series_.interfere_again.add(counters_, [&] {
            sum_ += static_cast<std::size_t>(interfere(stock_, Pose(), holder_, pose).relation);
        });
    }

    void warm(int i) {
        constexpr std::size_t count = 20'000;
        std::vector<Point3d> uniform;
        std::vector<Point3d> near;
        for (std::size_t k = 0; k < count; ++k) {
            uniform.push_back(cuts_.in_box());
            near.push_back(cuts_.near_surface(0.005));
        }
        const BrepIndex index(stock_);
        const BrepIndex fresh(solid_of(stock_.to_mesh()));
        std::printf("| after %d cuts |", i);
        for (const auto* points : {&uniform, &near})
            for (const BrepIndex* b : {&index, &fresh})
                std::printf(" %s %s %.3f us, batch %.3f us |",
                            points == &uniform ? "uniform" : "near",
                            b == &index ? "result" : "fresh", one_by_one(*b, *points),
                            as_batch(*b, *points));
        std::printf(" %.1f MB |\n", static_cast<double>(index.stats().bytes) * 1e-6);
        std::fflush(stdout);
    }
    // Microseconds a point, the best of some times.
    [[nodiscard]] double one_by_one(const BrepIndex& index, const std::vector<Point3d>& points) {
        return best_of(points.size(), [&] {
            for (const Point3d& p : points)
                sum_ += static_cast<std::size_t>(index.locate(p).location);
        });
    }
    [[nodiscard]] double as_batch(const BrepIndex& index, const std::vector<Point3d>& points) {
        std::vector<trisect::Location> found(points.size());
        return best_of(points.size(), [&] { index.classify(points, found, 1); });
    }
    template <class Work>
    [[nodiscard]] static double best_of(std::size_t points, const Work& work) {
        double best = HUGE_VAL;
        for (int again = 0; again < 8; ++again) best = std::min(best, milliseconds_of(work));
        return 1000 * best / static_cast<double>(points);
    }
    void compare_memory() {
        query_.reset();
        facts_.reset();
        const PolygonMesh mesh = stock_.to_mesh(1);
        const std::size_t version = heap_of(stock_);
        const std::size_t before = heap_in_use();
        stock_ = solid_of(mesh);
        stock_.refine();
        (void)BrepIndex(stock_);
        const std::size_t fresh = heap_in_use() - before;
        for (const Point3d& at : places_) {
            const ChainQuestions q = questions_at(at);
            const BrepIndex index(stock_);
            sum_ += static_cast<std::size_t>(index.locate(q.near).location);
            sum_ += index.first_facet(trisect::Segment{q.far, q.middle}) ? 1 : 0;
            sum_ += index.distance(q.above) ? 1 : 0;
            if (!options_.interference) continue;
            const Pose pose = Pose::from_translation(q.holder);
            sum_ += static_cast<std::size_t>(interfere(stock_, Pose(), holder_, pose).relation);
            for (const Point3d& p : {q.holder, q.aside}) {
                const Pose there = Pose::from_translation(p);
                sum_ += boundary_distance(stock_, Pose(), holder_, there) ? 1 : 0;
            }
        }
        const std::size_t asked = heap_in_use() - before;
        std::printf(
            "\nthe last version %.1f MB, its mesh as a fresh solid %.1f, after all questions "
            "%.1f\n",
            1e-6 * static_cast<double>(version), 1e-6 * static_cast<double>(fresh),
            1e-6 * static_cast<double>(asked));
    }
    void print_bytes() const {
        if (added_.empty()) return;
        double sum = 0;
        for (const double b : added_) sum += b;
        std::printf("\nfacts that a version adds: mean %.1f kB, most %.1f kB\n",
                    1e-3 * sum / static_cast<double>(added_.size()),
                    1e-3 * *std::ranges::max_element(added_));
    }

    Options options_;
    ChainSeries& series_;
    ChainCuts cuts_;
    ChainCounters counters_;
    Solid stock_;
    Solid holder_;
    ChainRebuild rebuild_;
    std::optional<ChainFacts> facts_;
    std::vector<double> added_;
    std::vector<Point3d> places_;
    std::size_t sum_ = 0;
    std::optional<trisect::InterferenceQuery> query_;
};

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options options = parsed(argc, argv);
        ChainSeries series;
        for (int left = options.repeat; left-- > 0;) {
            for (Series* s : series.all()) s->again();
            Chain chain(options, series);
            chain.run();
            if (left == 0) chain.print();
        }
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "chain_queries: %s\n", e.what());
        return 1;
    }
}
