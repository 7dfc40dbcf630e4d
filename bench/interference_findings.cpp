// SPDX-License-Identifier: Apache-2.0
//
// The placements that people know by name, asked of everybody: the six clash relations of a wall,
// walls in a row, blocks and dovetails that our own booleans cut, shells in shells, boxes of
// reports to FCL. Both bodies stand in the same frame, which is turned and moved in doubles. The
// answer that is right follows from the exact relation and, for those who ask about surfaces, from
// whether there is any contact; every answer that differs is a finding.
//
//     interference_findings        prints the tables of bench/results/interference_findings.md

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/kernel/pose.h>

#include "interference_peers.h"

namespace {

using interference_peers::Peers;
using interference_peers::Placement;
using trisect::Expression;
using trisect::make_box;
using trisect::PolygonMesh;
using trisect::Relation;
using trisect::Solid;
using Shift = std::array<double, 3>;

struct Frame {
    const char* name;
    Placement placement;
};

// Without a rotation, with one of doubles that is orthogonal up to rounding only, and far away.
const std::array<Frame, 3> frames{{
    {"as it is", interference_peers::home_placement},
    {"turned",
     {0.94096063217417758029, 0.29296840037289501035, 0.16959541586174811667, 0.1,
      -0.23569836841299879326, 0.92661523595848427348, -0.29296840037289506586, 0.3,
      -0.2429801799032638987, 0.23569836841299884878, 0.94096063217417758029, 7}},
    {"turned, far away",
     {0.94096063217417758029, 0.29296840037289501035, 0.16959541586174811667, 1e5,
      -0.23569836841299879326, 0.92661523595848427348, -0.29296840037289506586, 3e4,
      -0.2429801799032638987, 0.23569836841299884878, 0.94096063217417758029, 7e5}},
}};

// The frame after a translation, composed in doubles as a program would.
Placement moved(const Placement& frame, const Shift& by) {
    Placement out = frame;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) out[4 * i + 3] += frame[4 * i + j] * by[j];
    return out;
}

Expression solid(const PolygonMesh& mesh) { return Expression(Solid::from_mesh(mesh)); }
PolygonMesh triangles(const Expression& e) { return evaluate(e).to_mesh(); }
PolygonMesh box_mesh(const trisect::Point3d& lo, const trisect::Point3d& hi) {
    return triangles(solid(make_box(lo, hi)));
}

/// What was found: rows of the table, and counts per peer.
class Findings {
public:
    /// A and B, both in a frame; B is moved by `shift` before.
    void add(const std::string& name, const PolygonMesh& a, const PolygonMesh& b,
             const Shift& shift = {}) {
        for (const Frame& frame : frames) {
            Peers peers;
            const std::array<Placement, 1> placements{moved(frame.placement, shift)};
            interference_peers::add_fcl(peers, a, b, placements, frame.placement);
            interference_peers::add_cgal(peers, a, b, placements, frame.placement);
            ask(name + ", " + frame.name, a, frame.placement, b, placements[0], peers);
        }
    }
    void add_posed(const std::string& name, const PolygonMesh& a, const Placement& pose_a,
                   const PolygonMesh& b, const Placement& pose_b) {
        Peers peers;
        const std::array<Placement, 1> placements{pose_b};
        interference_peers::add_fcl(peers, a, b, placements, pose_a);
        interference_peers::add_cgal(peers, a, b, placements, pose_a);
        ask(name, a, pose_a, b, pose_b, peers);
    }
    /// Two boxes about the origin, for FCL's solvers for shapes as well.
    void add_boxes(const std::string& name, const std::array<double, 3>& a, const Placement& pose_a,
                   const std::array<double, 3>& b, const Placement& pose_b) {
        const auto mesh = [](const std::array<double, 3>& s) {
            return box_mesh({-s[0] / 2, -s[1] / 2, -s[2] / 2}, {s[0] / 2, s[1] / 2, s[2] / 2});
        };
        Peers peers;
        const std::array<Placement, 1> placements{pose_b};
        interference_peers::add_fcl(peers, mesh(a), mesh(b), placements, pose_a);
        interference_peers::add_cgal(peers, mesh(a), mesh(b), placements, pose_a);
        interference_peers::add_fcl_boxes(peers, a, b, placements, pose_a);
        ask(name, mesh(a), pose_a, mesh(b), pose_b, peers);
    }

    void print() const {
        std::printf("| placement | exact relation | boundaries meet | who says otherwise |\n");
        std::printf("|---|---|---|---|\n");
        for (const std::string& row : rows_) std::printf("%s\n", row.c_str());
        std::printf("\n%d placements. Answers that differ from the exact one:\n\n", asked_);
        std::printf(
            "| peer | asked | boundaries meet, unseen | apart, said to meet | one inside the "
            "other, unseen | exception |\n|---|---:|---:|---:|---:|---:|\n");
        for (const auto& [peer, c] : counts_)
            std::printf("| %s | %d | %d | %d | %d | %d |\n", peer.c_str(), c.asked, c.missed,
                        c.invented, c.inside, c.thrown);
    }

private:
    struct Count {
        int asked = 0;
        int missed = 0;
        int invented = 0;
        int inside = 0;
        int thrown = 0;
    };

    void ask(const std::string& name, const PolygonMesh& a, const Placement& pose_a,
             const PolygonMesh& b, const Placement& pose_b, Peers& peers) {
        const auto exact = interfere(trisect::InterferenceModel(Solid::from_mesh(a)),
                                     trisect::Pose::from_doubles(pose_a),
                                     trisect::InterferenceModel(Solid::from_mesh(b)),
                                     trisect::Pose::from_doubles(pose_b), {.contacts = true});
        const bool boundaries = !exact.contacts.empty();
        const bool solids = exact.relation != Relation::Disjoint;
        ++asked_;
        std::map<std::string, std::string> others;  // those of one opinion
        for (const auto& peer : peers) {
            const std::string what = verdict(*peer, boundaries, solids, counts_[peer->name()]);
            if (what.empty()) continue;
            std::string& names = others[what];
            names += (names.empty() ? "" : ", ") + peer->name();
        }
        if (others.empty()) return;
        std::string row = "| " + name + " | " + to_string(exact.relation) + " | " +
                          (boundaries ? "yes" : "no") + " |";
        for (const auto& [what, names] : others) row.append(" ").append(what + ": " + names + ".");
        rows_.push_back(row + " |");
    }

    static std::string verdict(interference_peers::Peer& peer, bool boundaries, bool solids,
                               Count& count) {
        ++count.asked;
        try {
            const bool said = peer.collide(0);
            if (said && !solids) {
                ++count.invented;
                return "meet";
            }
            if (!said && boundaries) {
                ++count.missed;
                return "apart";
            }
            if (!said && solids) {
                ++count.inside;
                return "apart (inside)";
            }
        } catch (const std::exception&) {
            ++count.thrown;
            return "throws";
        }
        return {};
    }

    int asked_ = 0;
    std::vector<std::string> rows_;
    std::map<std::string, Count> counts_;
};

void add_walls(Findings& findings) {
    const auto wall = box_mesh({0, 0, 0}, {4, 0.25, 3});
    const auto clash = [&](const char* name, const trisect::Point3d& lo,
                           const trisect::Point3d& hi) {
        findings.add(std::string("clash: ") + name, wall, box_mesh(lo, hi));
    };
    clash("protrudes", {1, -0.5, 1}, {1.5, 0.125, 1.5});
    clash("enveloped", {1, 0.0625, 1}, {1.5, 0.125, 1.5});
    clash("pierces", {1, -1, 1}, {1.5, 1, 1.5});
    clash("touches", {1, 0.25, 1}, {1.5, 1, 1.5});
    clash("encroaches", {1, 0.375, 1}, {1.5, 1, 1.5});
    clash("duplicate", {0, 0, 0}, {4, 0.25, 3});
    clash("inside, flush with one face", {1, 0.125, 1}, {1.5, 0.25, 1.5});

    const auto row = box_mesh({0, 0, 0}, {1000, 200, 3000});
    const auto aligned = [&](const char* name, double x, double y) {
        findings.add(std::string("walls in a row: ") + name, row, row, {x, y, 0});
    };
    aligned("overlap by 50", 950, 0);
    aligned("end to end", 1000, 0);
    aligned("along an edge", 1000, 200);
    aligned("one ulp apart", std::nextafter(1000, 2000), 0);
    aligned("one ulp deep", std::nextafter(1000, 0), 0);
}

void add_fits(Findings& findings) {
    const auto block = solid(make_box({0, 0, 0}, {10, 6, 5}));
    auto tail_mesh = trisect::make_prism({{3, 3}, {7, 3}, {6, 5}, {4, 5}}, 6);
    for (auto& p : tail_mesh.points) p = {p[0], 6 - p[2], p[1]};
    const auto tail = solid(tail_mesh);
    const auto groove = triangles(block - tail);
    const auto tongue = triangles(block & tail);
    findings.add("dovetail: home", groove, tongue);
    findings.add("dovetail: slid half way", groove, tongue, {0, 2.5, 0});
    findings.add("dovetail: slid out to the end", groove, tongue, {0, 6, 0});
    findings.add("dovetail: lifted by 1e-9", groove, tongue, {0, 0, 1e-9});
    findings.add("dovetail: out", groove, tongue, {0, 6.5, 0});

    const auto cube = box_mesh({0, 0, 0}, {2, 2, 2});
    findings.add("flush blocks: on a face", cube, cube, {0.5, 0.75, 2});
    findings.add("flush blocks: at an edge", cube, cube, {2, 0.5, 2});
    findings.add("flush blocks: at a corner", cube, cube, {2, 2, 2});
}

void add_shells(Findings& findings) {
    const auto ball = [](double radius) { return solid(trisect::make_icosphere(radius, 2)); };
    const auto nested = triangles((ball(8) - ball(6)) | (ball(4) - ball(2)));
    findings.add("nested shells: ball in the inner cavity", nested, triangles(ball(1)));
    findings.add("nested shells: ball that fills it", nested, triangles(ball(2)));
    findings.add("nested shells: ball in the matter", nested, triangles(ball(0.5)), {7, 0, 0});
    findings.add("nested shells: shell between them", nested, triangles(ball(5) - ball(4.5)));
    findings.add("nested shells: skin in the matter", nested, triangles(ball(7.5) - ball(6.5)));
    findings.add("nested shells: all within a ball", nested, triangles(ball(9)));
}

void add_reports(Findings& findings) {
    findings.add_boxes(
        "boxes of fcl#399", {0.23768037557601928711, 0.15702305734157562256, 0.25},
        {-0.099432387353076273628, 0.99504432079443971837, 0, 0.29526406526565551758,
         -0.99504432079443971837, -0.099432387353076273628, 0, -0.013230856508016586304, 0, 0, 1,
         0},
        {0.010000000000000000208, 0.78165709972381591797, 0.25},
        {0.99506598442099225554, 0.099215354901756730444, 0, 0.22759585694545214629,
         -0.099215354901756730444, 0.99506598442099225554, 0, 0.14974093549228112421, 0, 0, 1, 0});
    findings.add_boxes(
        "boxes of fcl#493", {0.5, 0.5, 0.5},
        {0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556,
         2.0770063995786869349, -0.19134171618254486313, 0.96936494951283913579,
         0.15401279915737359216, 0.48468247475641951239, -0.19509032201612822033,
         -0.19134171618254486313, 0.96193976625564348026, 1.1543291419087275962},
        {0.5, 0.5, 0.5},
        {0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556, 2,
         -0.19134171618254486313, 0.96936494951283913579, 0.15401279915737359216, 0,
         -0.19509032201612822033, -0.19134171618254486313, 0.96193976625564348026, 1.25});
    // fcl#319: a box and a cylinder, turned about z by quaternions.
    const auto turned = [](double w, double z, const Shift& t) {
        const double n = w * w + z * z;
        const double c = (w * w - z * z) / n;
        const double s = 2 * w * z / n;
        return Placement{c, -s, 0, t[0], s, c, 0, t[1], 0, 0, 1, t[2]};
    };
    auto cylinder = triangles(solid(trisect::make_cylinder(0.18, 0.18, 64)));
    for (auto& p : cylinder.points) p[2] -= 0.09;
    findings.add_posed("box and cylinder of fcl#319",
                       box_mesh({-0.025, -0.195, -0.735}, {0.025, 0.195, 0.735}),
                       turned(0.707107, 0.707107, {0.8, -0.385, 0.735}), cylinder,
                       turned(0.991445, -0.130526, {0.4, -0.4, 0.93}));

    // fcl#495: boxes side by side whose distance is about the rounding error of the pose.
    const std::array<double, 9> r{
        0.94096063217417758029,  0.29296840037289501035, 0.16959541586174811667,
        -0.23569836841299879326, 0.92661523595848427348, -0.29296840037289506586,
        -0.2429801799032638987,  0.23569836841299884878, 0.94096063217417758029};
    for (const double size : {0.25, 0.5, 10.0, 1000.0})
        for (const double gap : {-1e-15, -2.5e-16, -1e-16, 0.0, 1e-16, 2.5e-16, 1e-15}) {
            const auto pose = [&](double y) {
                return Placement{r[0], r[1],     r[2], r[1] * y, r[3], r[4],
                                 r[5], r[4] * y, r[6], r[7],     r[8], 5 * size + r[7] * y};
            };
            char name[80];
            std::snprintf(name, sizeof name, "boxes as in fcl#495, size %g, gap %g", size, gap);
            findings.add_boxes(name, {size, size, size}, pose(0), {size, size, size},
                               pose(size + gap * std::max(1.0, size)));
        }
}

}  // namespace

int main() {
    Findings findings;
    add_walls(findings);
    add_fits(findings);
    add_shells(findings);
    add_reports(findings);
    findings.print();
    return 0;
}
