// SPDX-License-Identifier: Apache-2.0
//
// Broad phases of scenes on moving boxes, one thread. Cubes of side 0.5 to 1.5 in a room of
// so many unit cubes a body that about a quarter of it is full. Each frame all of them move: by a
// hundredth of their side and reflected at the walls ("coherent"), or anywhere ("jumping"). Prints
// a line of JSON for every number of boxes, kind of motion and broad phase.
//
//     broad_phases [--frames 101] [--bodies N]...
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/scene/broad_phases.h>

#include "shapes.h"

namespace {

using nlohmann::json;
using trisect::detail::BodyBox;
using trisect::detail::BodyPair;
using trisect::detail::BroadPhase;

struct Options {
    int frames = 101;
    std::vector<std::uint32_t> bodies;
};

struct Kind {
    const char* name;
    std::unique_ptr<BroadPhase> (*make)();
};

constexpr std::array kinds{Kind{"sweep and prune", trisect::detail::make_sweep_and_prune},
                           Kind{"box tree", trisect::detail::make_box_tree},
                           Kind{"hash grid", trisect::hierarchies::make_hash_grid},
                           Kind{"hierarchical grid", trisect::hierarchies::make_hierarchical_grid}};

struct Cube {
    std::array<double, 3> centre{};
    std::array<double, 3> velocity{};
    double half = 0;

    [[nodiscard]] BodyBox box() const {
        BodyBox out;
        for (std::size_t k = 0; k < 3; ++k) {
            out.lo[k] = centre[k] - half;
            out.hi[k] = centre[k] + half;
        }
        return out;
    }
};

class Motion {
public:
    Motion(std::uint32_t bodies, bool jumps)
        : room_(std::cbrt(4.0 * bodies)), jumps_(jumps), random_(7), cubes_(bodies) {
        for (Cube& c : cubes_) {
            c.half = 0.25 + 0.5 * random_.uniform();
            place(c);
            for (double& v : c.velocity) v = (random_.uniform() - 0.5) * 0.02 * 2 * c.half;
        }
    }
    [[nodiscard]] const std::vector<Cube>& cubes() const { return cubes_; }
    void step() {
        for (Cube& c : cubes_) {
            if (jumps_) {
                place(c);
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                c.centre[k] += c.velocity[k];
                if (c.centre[k] < 0 || c.centre[k] > room_) c.velocity[k] = -c.velocity[k];
            }
        }
    }

private:
    void place(Cube& c) {
        for (double& x : c.centre) x = room_ * random_.uniform();
    }
    double room_;
    bool jumps_;
    shapes::Random random_;
    std::vector<Cube> cubes_;
};

double at(std::vector<double> values, double part) {
    std::ranges::sort(values);
    const auto last = static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(std::lround(part * last))];
}

std::size_t run(const char* name, std::unique_ptr<BroadPhase> phase, std::uint32_t bodies,
                bool jumps, int frames) {
    Motion motion(bodies, jumps);
    for (std::uint32_t i = 0; i < bodies; ++i) phase->insert(i, motion.cubes()[i].box());
    std::vector<BodyPair> pairs;
    phase->pairs(pairs);
    std::vector<double> times;
    std::size_t sum = 0;
    for (int f = 0; f < frames; ++f) {
        motion.step();
        const auto start = std::chrono::steady_clock::now();
        for (std::uint32_t i = 0; i < bodies; ++i) phase->update(i, motion.cubes()[i].box());
        phase->pairs(pairs);
        times.push_back(
            1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        sum += pairs.size();
    }
    json line;
    line["broad_phase"] = name;
    line["bodies"] = bodies;
    line["motion"] = jumps ? "jumping" : "coherent";
    line["pairs_per_frame"] = static_cast<double>(sum) / frames;
    line["median_us"] = at(times, 0.5);
    line["p99_us"] = at(times, 0.99);
    line["box_tests"] = phase->work().box_tests;
    line["moves"] = phase->work().moves;
    std::printf("%s\n", line.dump().c_str());
    std::fflush(stdout);
    return sum;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string_view name = argv[i];
        if (name == "--frames") options.frames = std::max(1, std::atoi(argv[i + 1]));
        if (name == "--bodies")
            options.bodies.push_back(static_cast<std::uint32_t>(std::atoi(argv[i + 1])));
    }
    if (options.bodies.empty()) options.bodies = {100, 1000, 10000, 100000};
    for (const std::uint32_t bodies : options.bodies) {
        for (const bool jumps : {false, true}) {
            std::size_t expected = 0;
            for (const Kind& kind : kinds) {
                const std::size_t sum = run(kind.name, kind.make(), bodies, jumps, options.frames);
                if (&kind == kinds.data()) expected = sum;
                if (sum == expected) continue;
                std::fprintf(stderr, "the broad phases disagree\n");
                return 1;
            }
        }
    }
    return 0;
}
