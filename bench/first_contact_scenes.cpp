// SPDX-License-Identifier: Apache-2.0
//
// first_contact_scenes: times and results of first contact in the scenes of
// bench/results/first_contact.md, and where FCL is installed what its continuous collision says.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference/enclosed_contact.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/moving_points.h>
#include <trisect/kernel/diagnostics.h>

#include "first_contact_peer.h"

namespace {

using trisect::EnclosedMotion;
using trisect::FirstContact;
using trisect::FirstContactCounters;
using SearchDiagnostics = trisect::Diagnostics<FirstContactCounters>;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Screw;
using trisect::Solid;

// Processor time: what other programs do at the same time counts less.
struct Clock {
    static double now() { return static_cast<double>(std::clock()); }
};

double milliseconds_since(double start) {
    return (Clock::now() - start) * (1000.0 / static_cast<double>(CLOCKS_PER_SEC));
}

struct Body {
    PolygonMesh mesh;
    InterferenceModel model;
    peer::Body peer;

    explicit Body(PolygonMesh m) : mesh(std::move(m)), model(Solid::from_mesh(mesh)), peer(mesh) {}
};

double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

double percentile99(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v[v.size() * 99 / 100];
}

// One query, alone; prints what happened.
FirstContact report(const char* name, const Body& a, const Motion& ma, const Body& b,
                    const Motion& mb) {
    const trisect::Diagnostics<trisect::MotionCounters> of_features;
    (void)first_contact(a.model, ma, b.model, mb);
    const trisect::MotionCounters counters = of_features.counters();
    std::vector<double> times;
    FirstContact c;
    FirstContactCounters of_c;
    for (int i = 0; i < 3; ++i) {
        const SearchDiagnostics diagnostics;
        const auto start = Clock::now();
        c = first_contact(a.model, ma, b.model, mb);
        of_c = diagnostics.counters();
        times.push_back(milliseconds_since(start));
    }
    // The same without faces that move apart.
    trisect::FirstContactOptions options;
    options.leave_out_receding = true;
    const auto facing_start = Clock::now();
    const SearchDiagnostics facing_diagnostics;
    const FirstContact facing = first_contact(a.model, ma, b.model, mb, options);
    const double facing_time = milliseconds_since(facing_start);
    const FirstContactCounters of_facing = facing_diagnostics.counters();
    if (facing.time != c.time || facing.witnesses != c.witnesses)
        throw std::runtime_error(std::string("leaving out faces changes the answer: ") + name);
    std::printf("| %s | %zu / %zu | ", name, a.model.triangle_count(), b.model.triangle_count());
    if (c.exists())
        std::printf("%.12g | %zu", c.time->to_double(), c.witnesses.size());
    else
        std::printf("none | -");
    std::printf(" | %.2f | %.2f | %llu | %llu / %llu | %llu / %llu | %llu | %llu |\n",
                median(times), facing_time, static_cast<unsigned long long>(of_c.intervals),
                static_cast<unsigned long long>(of_c.box_tests),
                static_cast<unsigned long long>(of_facing.box_tests),
                static_cast<unsigned long long>(of_c.triangle_pairs),
                static_cast<unsigned long long>(of_facing.triangle_pairs),
                static_cast<unsigned long long>(counters.questions),
                static_cast<unsigned long long>(counters.exact));
    std::fflush(stdout);
    return c;
}

Body read(const std::string& name) {
    const char* models = std::getenv("TRISECT_MODELS");
    if (models == nullptr) throw std::runtime_error("no TRISECT_MODELS");
    return Body(trisect::read_mesh(std::filesystem::path(models) / name));
}

// A chain of screws of 22.62 degrees about an axis parallel to y.
Motion turns(const Pose& start, std::int64_t sense, const std::array<double, 3>& center,
             double shift, int pieces) {
    const Screw screw{{5, 0, sense, 0}, center, {0, shift, 0}};
    Motion m = Motion::screw(start, screw);
    for (int i = 1; i < pieces; ++i)
        m = m.then(Motion::screw(m.pose_at(trisect::ExactRational(i)), screw));
    return m;
}

void mechanisms() {
    std::puts(
        "| scene | triangles | first contact | witnesses | ms | ms, facing only | intervals |"
        " box tests / facing only | pairs / facing only |"
        " questions | exact |");
    std::puts("|---|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|");
    const Body screw = read("mechanisms/screw-big.obj");
    const Body nut = read("mechanisms/nut-big.obj");
    // (5, 0, 1, 0) turns by 22.62 degrees; the pitch of the thread is 1.3299.
    const double angle = 2 * std::atan2(1.0, 5.0) / (2 * std::acos(-1.0));
    const std::array<double, 3> axis{-0.0625, 0, -0.0281};
    const double step = -1.3299 * angle;
    report("screw into nut, one turn", nut, Motion(), screw, turns(Pose(), -1, axis, step, 16));
    report("screw into nut until the head stops it", nut, Motion(), screw,
           turns(Pose(), -1, axis, step, 96));
    report("screw, turned the wrong way", nut, Motion(), screw, turns(Pose(), 1, axis, step, 16));
    report("screw, pulled without turning", nut, Motion(), screw,
           Motion::translation(Pose(), {0, 1, 0}));

    const Body gear = read("mechanisms/gear-solid.obj");
    const std::array<double, 3> other{2.05, 0, 0};
    const Pose start = Pose::from_translation(other) * Pose::from_quaternion({15, 0, 2, 0});
    report("gears, one turns", gear, Motion(), gear, turns(start, 1, other, 0, 1));
    report("gears, one turns backwards", gear, Motion(), gear, turns(start, -1, other, 0, 1));
    report("gears in mesh, both turn", gear, turns(Pose(), -1, {}, 0, 8), gear,
           turns(start, 1, other, 0, 8));
}

// The same mechanisms at constant angular speed, which is not rational: certified intervals.
void enclosed_report(const char* name, const Body& a, const EnclosedMotion& ma, const Body& b,
                     const EnclosedMotion& mb) {
    using Outcome = trisect::EnclosedContact::Outcome;
    const auto start = Clock::now();
    const SearchDiagnostics diagnostics;
    const trisect::EnclosedContact c =
        enclosed_first_contact(a.model, ma, b.model, mb, {1e-9 * mb.duration()});
    const double ms = milliseconds_since(start);
    const FirstContactCounters of_c = diagnostics.counters();
    std::printf("| %s | ", name);
    switch (c.outcome) {
        case Outcome::None:
            std::printf("none | - | -");
            break;
        case Outcome::Contact:
            std::printf("contact | %.12g | %.2g", c.free_until, *c.contact_by - c.free_until);
            break;
        case Outcome::Undecided:
            std::printf("undecided | %.12g | -", c.free_until);
            break;
    }
    std::printf(" | %.2f | %llu | %llu | %llu |\n", ms,
                static_cast<unsigned long long>(of_c.intervals),
                static_cast<unsigned long long>(of_c.box_tests),
                static_cast<unsigned long long>(of_c.triangle_pairs));
    std::fflush(stdout);
}

void enclosed_mechanisms() {
    std::puts("\n| scene | outcome | free until | width | ms | intervals | box tests | pairs |");
    std::puts("|---|---|---|---:|---:|---:|---:|---:|");
    const double turn = 2 * std::acos(-1.0);
    const Body screw = read("mechanisms/screw-big.obj");
    const Body nut = read("mechanisms/nut-big.obj");
    const auto screwed = [&](double turns, double pitch) {
        return EnclosedMotion::turning(
            Pose(), {{0, -1, 0}, turns * turn, {-0.0625, 0, -0.0281}, {0, -turns * pitch, 0}},
            std::abs(turns));
    };
    enclosed_report("screw into nut, one turn", nut, EnclosedMotion(), screw, screwed(1, 1.3299));
    enclosed_report("screw, turned the wrong way", nut, EnclosedMotion(), screw,
                    screwed(-1, -1.3299));
    const Body gear = read("mechanisms/gear-solid.obj");
    const Pose start = Pose::from_translation({2.05, 0, 0}) * Pose::from_quaternion({15, 0, 2, 0});
    const auto turned = [&](const Pose& pose, double angle, double x) {
        return EnclosedMotion::turning(pose, {{0, 1, 0}, angle, {x, 0, 0}, {}});
    };
    enclosed_report("gears, one turns", gear, EnclosedMotion(), gear, turned(start, 0.5, 2.05));
    enclosed_report("gears in mesh, both turn", gear, turned(Pose(), -turn / 2, 0), gear,
                    turned(start, turn / 2, 2.05));
}

// Bodies that fall from random poses
// ---------------------------------------------------------------

struct Fall {
    Pose start;
    std::array<double, 12> start_doubles{};
    std::array<double, 3> by{};
};

std::vector<Fall> random_falls(std::size_t count, double height, double depth, double spread) {
    std::mt19937_64 random(20261121);
    const auto in = [&random](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    std::vector<Fall> falls;
    while (falls.size() < count) {
        std::array<std::int64_t, 4> q{};
        for (std::int64_t& c : q) c = static_cast<std::int64_t>(in(-1000, 1000));
        if (q == std::array<std::int64_t, 4>{}) continue;
        Fall f;
        const std::array<double, 3> at{in(-spread, spread), in(-spread, spread), height};
        f.start = Pose::from_quaternion(q, at);
        f.start_doubles = f.start.approximate();
        f.by = {0, 0, -depth};
        falls.push_back(f);
    }
    return falls;
}

struct PeerTally {
    std::size_t contacts = 0;
    std::size_t missed = 0;
    std::size_t invented = 0;
    double latest = 0;  // largest time reported after the exact one
    std::vector<double> ms;
};

void falls(const char* name, const Body& rest, const Body& falling,
           const std::vector<Fall>& falls) {
    std::vector<double> ours;
    std::vector<double> facing_only;
    std::array<std::uint64_t, 2> pairs{};
    std::array<std::uint64_t, 2> box_tests{};
    std::uint64_t left_out = 0;
    std::size_t contacts = 0;
    std::array<PeerTally, 2> peers;
    for (const Fall& f : falls) {
        const auto start = Clock::now();
        const SearchDiagnostics diagnostics;
        const FirstContact c =
            first_contact(rest.model, Motion(), falling.model, Motion::translation(f.start, f.by));
        ours.push_back(milliseconds_since(start));
        const FirstContactCounters of_c = diagnostics.counters();
        contacts += c.exists() ? 1U : 0U;
        trisect::FirstContactOptions options;
        options.leave_out_receding = true;
        const auto facing_start = Clock::now();
        const SearchDiagnostics facing_diagnostics;
        const FirstContact facing = first_contact(rest.model, Motion(), falling.model,
                                                  Motion::translation(f.start, f.by), options);
        facing_only.push_back(milliseconds_since(facing_start));
        const FirstContactCounters of_facing = facing_diagnostics.counters();
        if (facing.time != c.time || facing.witnesses != c.witnesses)
            throw std::runtime_error(std::string("leaving out faces changes the answer: ") + name);
        pairs[1] += of_c.triangle_pairs;
        pairs[0] += of_facing.triangle_pairs;
        box_tests[1] += of_c.box_tests;
        box_tests[0] += of_facing.box_tests;
        left_out += of_facing.separating_pairs;
        for (std::size_t k = 0; k < peers.size() && peer::is_available(); ++k) {
            PeerTally& t = peers[k];
            const auto peer_start = Clock::now();
            const auto s = peer::first_contact(rest.peer, falling.peer, f.start_doubles, f.by,
                                               static_cast<peer::Solver>(k));
            t.ms.push_back(milliseconds_since(peer_start));
            t.contacts += s ? 1U : 0U;
            if (c.exists() && !s) ++t.missed;
            if (!c.exists() && s) ++t.invented;
            if (c.exists() && s) t.latest = std::max(t.latest, *s - c.time->to_double());
        }
    }
    std::printf("| %s | exact | %zu of %zu | - | - | - | %.2f | %.2f |\n", name, contacts,
                falls.size(), median(ours), percentile99(ours));
    std::printf("| | exact, facing only | %zu | - | - | - | %.2f | %.2f |\n", contacts,
                median(facing_only), percentile99(facing_only));
    std::fprintf(
        stderr,
        "%s: box tests %llu of %llu, pairs of triangles %llu of %llu, %llu pairs of boxes "
        "left out\n",
        name, static_cast<unsigned long long>(box_tests[0]),
        static_cast<unsigned long long>(box_tests[1]), static_cast<unsigned long long>(pairs[0]),
        static_cast<unsigned long long>(pairs[1]), static_cast<unsigned long long>(left_out));
    static const std::array<const char*, 2> names{"FCL, 10 samples", "FCL, 1000 samples"};
    for (std::size_t k = 0; k < peers.size() && peer::is_available(); ++k)
        std::printf("| | %s | %zu | %zu | %zu | %.2g | %.2f | %.2f |\n", names[k],
                    peers[k].contacts, peers[k].missed, peers[k].invented, peers[k].latest,
                    median(peers[k].ms), percentile99(peers[k].ms));
    std::fflush(stdout);
}

void all_falls() {
    std::puts(
        "\n| scene | solver | contacts | missed | invented | late by up to | ms, median | 99% |");
    std::puts("|---|---|---:|---:|---:|---:|---:|---:|");
    const Body torus(trisect::make_torus(1, 0.25, 100, 100));
    falls("torus of 20,000 triangles falls past another", torus, torus,
          random_falls(100, 3, 6, 1.6));
    const Body plate(trisect::make_box({-2, -2, 0}, {2, 2, 0.05}));
    const Body pin(trisect::make_box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}));
    falls("small cube through a thin plate", plate, pin, random_falls(300, 3, 6, 2.2));
    const Body gear = read("mechanisms/gear-solid.obj");
    falls("gear falls past a gear", gear, gear, random_falls(200, 3, 6, 1.6));
}

}  // namespace

int main(int argc, char**) try {
    if (argc < 2) mechanisms();
    if (argc < 2) enclosed_mechanisms();
    all_falls();
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "first_contact_scenes: %s\n", e.what());
    return 1;
}
