// SPDX-License-Identifier: Apache-2.0
//
// Scenes of many moving bodies beside FCL's DynamicAABBTreeCollisionManager, on identical doubles
// and one thread unless asked otherwise. A frame moves all bodies and asks for all pairs that
// interfere: ours with the exact relation of each, FCL's whether their surfaces meet. Prints a line
// of JSON for every scene and engine; times are microseconds a frame.
//
//     compare_scene [--scene swarm|gears|chain]... [--frames 101] [--bodies 1000] [--threads 1]
//                   [--peer obb|obbrss|none]... [--broad-phase sweep|tree] [--contacts]
//
// swarm: 1,000 convex bodies of 80 faces that fly and tumble in a room (I-COLLIDE's scene, Cohen,
//        Lin, Manocha and Ponamgi 1995), about a tenth of it full.
// gears: mechanisms/gear.obj of TRISECT_MODELS on a square grid, neighbours in mesh, turning.
// chain: an arm of links joined by revolute joints that curls up among posts. Poses are exact
//        fractions; FCL gets them rounded to doubles.
//
// Answers are compared frame by frame. FCL does not see bodies inside others, and where two touch
// its doubles may say either: such pairs are counted, all others must agree.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/diagnostics.h>

#if defined(TRISECT_WITH_FCL)
#include "scene_peer.h"
#endif
#include "shapes.h"

namespace {

using nlohmann::json;
using trisect::BodyId;
using trisect::InterferenceModel;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Relation;
using trisect::Scene;
using Rows = std::array<double, 12>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

struct Options {
    std::vector<std::string> scenes;
    std::vector<std::string> peers;
    int frames = 101;
    std::uint32_t bodies = 1000;
    std::uint32_t threads = 1;
    bool contacts = false;
    trisect::SceneOptions scene;
};

/// One thread is timed by what it has had of a processor, several by the clock on the wall.
bool one_thread = true;

double now() {
    if (one_thread) {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double at(std::vector<double> values, double part) {
    std::ranges::sort(values);
    const auto last = static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(std::lround(part * last))];
}

/// A scene that can be played: models, and each frame either poses or joints.
class Play {
public:
    virtual ~Play() = default;
    [[nodiscard]] virtual const std::vector<PolygonMesh>& models() const = 0;
    [[nodiscard]] virtual const std::vector<std::size_t>& model_of_body() const = 0;
    /// Puts the bodies into the scene, in order.
    virtual void fill(Scene& scene, const std::vector<InterferenceModel>& models) = 0;
    /// The next frame.
    virtual void step() = 0;
    virtual void place(Scene& scene) const = 0;
    /// The poses of all bodies, as doubles.
    [[nodiscard]] virtual std::vector<Rows> poses(const Scene& scene) const = 0;
};

Rows rows_of(const shapes::Matrix& m, const trisect::Point3d& t) {
    return {m[0][0], m[0][1], m[0][2], t[0],    m[1][0], m[1][1],
            m[1][2], t[1],    m[2][0], m[2][1], m[2][2], t[2]};
}

/// Every coordinate to a multiple of 2^-24, so that nothing is rounded at import.
void round_points(PolygonMesh& mesh) {
    for (trisect::Point3d& p : mesh.points)
        for (double& c : p) c = std::ldexp(std::round(std::ldexp(c, 24)), -24);
}

/// Bodies that stand by themselves and are placed by matrices of doubles.
class FreePlay : public Play {
public:
    [[nodiscard]] const std::vector<PolygonMesh>& models() const override { return models_; }
    [[nodiscard]] const std::vector<std::size_t>& model_of_body() const override {
        return model_of_body_;
    }
    void fill(Scene& scene, const std::vector<InterferenceModel>& models) override {
        for (std::size_t i = 0; i < model_of_body_.size(); ++i)
            ids_.push_back(scene.add(models[model_of_body_[i]], Pose::from_doubles(rows_[i])));
    }
    void place(Scene& scene) const override {
        for (std::size_t i = 0; i < ids_.size(); ++i)
            scene.set_pose(ids_[i], Pose::from_doubles(rows_[i]));
    }
    [[nodiscard]] std::vector<Rows> poses(const Scene&) const override { return rows_; }

protected:
    std::vector<PolygonMesh> models_;
    std::vector<std::size_t> model_of_body_;
    std::vector<Rows> rows_;

private:
    std::vector<BodyId> ids_;
};

class Swarm final : public FreePlay {
public:
    explicit Swarm(std::uint32_t bodies) : flights_(bodies) {
        for (int m = 0; m < 10; ++m) {
            PolygonMesh mesh = shapes::icosphere(1);
            const trisect::Point3d stretch{0.35 + 0.3 * random_.uniform(),
                                           0.35 + 0.3 * random_.uniform(),
                                           0.35 + 0.3 * random_.uniform()};
            for (trisect::Point3d& p : mesh.points)
                for (std::size_t k = 0; k < 3; ++k) p[k] *= stretch[k];
            round_points(mesh);
            models_.push_back(std::move(mesh));
        }
        // A ball of radius 1/2 is 0.52 in volume.
        room_ = std::cbrt(5.2 * bodies);
        for (std::uint32_t i = 0; i < bodies; ++i) {
            model_of_body_.push_back(i % models_.size());
            Flight& f = flights_[i];
            f.turn = random_.rotation();
            f.axis = random_.in_unit_box();
            for (std::size_t k = 0; k < 3; ++k) {
                f.axis[k] -= 0.5;
                f.at[k] = room_ * random_.uniform();
                f.velocity[k] = 0.02 * (random_.uniform() - 0.5);
            }
            f.degrees = 2 * random_.uniform();
        }
        take();
    }
    void step() override {
        for (Flight& f : flights_) {
            f.angle += f.degrees;
            for (std::size_t k = 0; k < 3; ++k) {
                f.at[k] += f.velocity[k];
                if (f.at[k] < 0 || f.at[k] > room_) f.velocity[k] = -f.velocity[k];
            }
        }
        take();
    }

private:
    struct Flight {
        shapes::Matrix turn{};
        trisect::Point3d axis{};
        trisect::Point3d at{};
        trisect::Point3d velocity{};
        double degrees = 0;
        double angle = 0;
    };
    void take() {
        rows_.clear();
        for (const Flight& f : flights_) {
            const shapes::Matrix spin = shapes::rotation(f.axis, f.angle);
            shapes::Matrix m{};
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    for (std::size_t k = 0; k < 3; ++k) m[i][j] += spin[i][k] * f.turn[k][j];
            rows_.push_back(rows_of(m, f.at));
        }
    }

    shapes::Random random_{11};
    std::vector<Flight> flights_;
    double room_ = 0;
};

std::filesystem::path model_file(const char* name) {
    const char* folder = std::getenv("TRISECT_MODELS");
    const std::filesystem::path path = std::filesystem::path(folder ? folder : "") / name;
    if (!std::filesystem::exists(path))
        throw std::runtime_error(path.string() + " is absent; set TRISECT_MODELS");
    return path;
}

/// Gears lie in the plane of x and z and turn about y.
class Gears final : public FreePlay {
public:
    explicit Gears(std::uint32_t bodies) {
        models_.push_back(trisect::read_mesh(model_file("mechanisms/gear.obj").string()));
        side_ = static_cast<std::uint32_t>(std::lround(std::sqrt(bodies)));
        model_of_body_.assign(std::size_t{side_} * side_, 0);
        take();
    }
    void step() override {
        angle_ += 0.5;
        take();
    }

private:
    void take() {
        rows_.clear();
        for (std::uint32_t i = 0; i < side_; ++i) {
            for (std::uint32_t j = 0; j < side_; ++j) {
                const double sign = (i + j) % 2 == 0 ? 1 : -1;
                rows_.push_back(rows_of(shapes::rotation({0, 1, 0}, sign * angle_ + 7.5 * (i % 2)),
                                        {2.05 * i, 0, 2.05 * j}));
            }
        }
    }
    std::uint32_t side_ = 0;
    double angle_ = 0;
};

class Chain final : public Play {
public:
    explicit Chain(std::uint32_t bodies) : links_(std::min(bodies, 16U)) {
        PolygonMesh link = trisect::make_box({-0.125, -0.125, 0}, {0.125, 0.125, 1.0625});
        PolygonMesh post = shapes::icosphere(2);
        round_points(post);
        models_ = {link, post};
        model_of_body_.push_back(0);
        for (std::uint32_t i = 1; i < links_; ++i) model_of_body_.push_back(0);
        for (std::uint32_t i = 0; i < posts; ++i) model_of_body_.push_back(1);
    }
    [[nodiscard]] const std::vector<PolygonMesh>& models() const override { return models_; }
    [[nodiscard]] const std::vector<std::size_t>& model_of_body() const override {
        return model_of_body_;
    }
    void fill(Scene& scene, const std::vector<InterferenceModel>& models) override {
        ids_.push_back(scene.add(models[0]));
        trisect::LinkOptions options;
        options.mount = Pose::from_translation({0, 0, 1});
        for (std::uint32_t i = 1; i < links_; ++i) {
            const std::array<std::int64_t, 3> axis{i % 2, 1 - i % 2, 0};
            ids_.push_back(scene.add_link(ids_.back(), models[0],
                                          trisect::Joint::revolute({0, 0, 0}, axis), options));
        }
        shapes::Random random(5);
        for (std::uint32_t i = 0; i < posts; ++i) {
            const trisect::Point3d u = random.in_unit_box();
            ids_.push_back(scene.add(
                models[1], Pose::from_translation({10 * u[0] - 5, 10 * u[1] - 5, 16 * u[2]})));
        }
    }
    void step() override { ++frame_; }
    void place(Scene& scene) const override {
        std::vector<Scene::JointValue> values;
        for (std::uint32_t i = 1; i < links_; ++i)
            values.push_back({ids_[i], {(frame_ + static_cast<int>(i % 3)) % 16 + 1, 64}});
        scene.set_joints(values);
    }
    [[nodiscard]] std::vector<Rows> poses(const Scene& scene) const override {
        std::vector<Rows> out;
        for (const BodyId id : ids_) out.push_back(scene.pose(id).approximate());
        return out;
    }
    [[nodiscard]] bool are_neighbours(const Pair& pair) const {
        return pair.second < links_ && pair.second == pair.first + 1;
    }

private:
    static constexpr std::uint32_t posts = 40;
    std::uint32_t links_;
    int frame_ = 0;
    std::vector<PolygonMesh> models_;
    std::vector<std::size_t> model_of_body_;
    std::vector<BodyId> ids_;
};

std::unique_ptr<Play> make_play(const std::string& name, const Options& options) {
    if (name == "gears") return std::make_unique<Gears>(options.bodies);
    if (name == "chain") return std::make_unique<Chain>(options.bodies);
    return std::make_unique<Swarm>(options.bodies);
}

/// Of all frames.
struct Record {
    std::vector<std::vector<std::pair<Pair, Relation>>> answers;
    std::vector<std::vector<Rows>> poses;
};

json times_json(const std::vector<double>& times) {
    return {{"median", at(times, 0.5)}, {"p99", at(times, 0.99)}};
}

Record play_ours(const std::string& name, const Options& options) {
    const std::unique_ptr<Play> play = make_play(name, options);
    const double start = now();
    std::vector<InterferenceModel> models;
    for (const PolygonMesh& mesh : play->models())
        models.emplace_back(trisect::Solid::from_mesh(mesh));
    Scene scene(options.scene);
    play->fill(scene, models);
    const double built = now() - start;
    Record record;
    std::vector<double> all;
    std::vector<double> set;
    std::vector<double> broad;
    std::vector<double> exact;
    std::map<std::string, std::size_t> relations;
    double boxes = 0;
    double kept = 0;
    trisect::SceneQueryOptions query;
    query.contacts = options.contacts;
    query.threads = options.threads;
    for (int f = 0; f <= options.frames; ++f) {
        play->step();
        const double t0 = now();
        play->place(scene);
        const double t1 = now();
        const trisect::Diagnostics<trisect::SceneCounters> diagnostics;
        const auto found = scene.interfering(query);
        const double t2 = now();
        if (f == 0) continue;  // everything is new
        all.push_back(1e6 * (t2 - t0));
        set.push_back(1e6 * (t1 - t0));
        const trisect::SceneCounters counters = diagnostics.counters();
        broad.push_back(1e6 * counters.broad_seconds);
        exact.push_back(1e6 * counters.exact_seconds);
        boxes += static_cast<double>(counters.boxes_met);
        kept += static_cast<double>(counters.kept);
        auto& answers = record.answers.emplace_back();
        for (const trisect::ScenePair& p : found) {
            answers.emplace_back(Pair(p.a.index, p.b.index), p.relation);
            ++relations[to_string(p.relation)];
        }
        record.poses.push_back(play->poses(scene));
    }
    json line;
    line["scene"] = name;
    line["engine"] = "trisect";
    line["bodies"] = scene.size();
    line["threads"] = options.threads;
    line["frames"] = options.frames;
    line["build_seconds"] = built;
    line["frame_us"] = times_json(all);
    line["set_us"] = times_json(set);
    line["broad_wall_us"] = times_json(broad);
    line["exact_wall_us"] = times_json(exact);
    line["boxes_met"] = boxes / options.frames;
    line["kept"] = kept / options.frames;
    line["relations"] = relations;
    std::printf("%s\n", line.dump().c_str());
    std::fflush(stdout);
    return record;
}

#if defined(TRISECT_WITH_FCL)
void play_peer(const std::string& name, const Options& options, const std::string& volume,
               const Record& ours) {
    const std::unique_ptr<Play> play = make_play(name, options);
    const auto* chain = dynamic_cast<const Chain*>(play.get());
    const double start = now();
    scene_peer::FclScene peer(
        play->models(), play->model_of_body(),
        volume == "obb" ? scene_peer::Volume::Obb : scene_peer::Volume::ObbRss);
    const double built = now() - start;
    std::vector<double> all;
    std::vector<double> narrow;
    double boxes = 0;
    std::size_t agreed = 0;
    std::map<std::string, std::size_t> missed;  // by our relation
    std::size_t extra = 0;
    for (std::size_t f = 0; f < ours.poses.size(); ++f) {
        const double t0 = now();
        auto found = peer.frame(ours.poses[f]);
        all.push_back(1e6 * (now() - t0));
        narrow.push_back(1e6 * peer.narrow_seconds());
        boxes += static_cast<double>(peer.boxes_met());
        if (chain) std::erase_if(found, [&](const Pair& p) { return chain->are_neighbours(p); });
        auto theirs = found.begin();
        for (const auto& [pair, relation] : ours.answers[f]) {
            while (theirs != found.end() && *theirs < pair) ++theirs, ++extra;
            if (theirs != found.end() && *theirs == pair) {
                ++theirs;
                ++agreed;
            } else {
                ++missed[to_string(relation)];
            }
        }
        extra += static_cast<std::size_t>(found.end() - theirs);
    }
    json line;
    line["scene"] = name;
    line["engine"] = "FCL " + volume;
    line["bodies"] = play->model_of_body().size();
    line["frames"] = ours.poses.size();
    line["build_seconds"] = built;
    line["frame_us"] = times_json(all);
    line["narrow_us"] = times_json(narrow);
    line["boxes_met"] = boxes / static_cast<double>(ours.poses.size());
    line["pairs_agreed"] = agreed;
    line["pairs_only_ours"] = missed;
    line["pairs_only_theirs"] = extra;
    std::printf("%s\n", line.dump().c_str());
    std::fflush(stdout);
}
#endif

Options parse(int argc, char** argv) {
    Options options;
    const auto value = [&](int& i) -> std::string {
        if (i + 1 >= argc) throw std::runtime_error(std::string(argv[i]) + " needs a value");
        return argv[++i];
    };
    for (int i = 1; i < argc; ++i) {
        const std::string_view name = argv[i];
        if (name == "--scene") {
            options.scenes.push_back(value(i));
        } else if (name == "--peer") {
            options.peers.push_back(value(i));
        } else if (name == "--frames") {
            options.frames = std::max(1, std::atoi(value(i).c_str()));
        } else if (name == "--bodies") {
            options.bodies = static_cast<std::uint32_t>(std::max(2, std::atoi(value(i).c_str())));
        } else if (name == "--threads") {
            options.threads = static_cast<std::uint32_t>(std::max(0, std::atoi(value(i).c_str())));
        } else if (name == "--contacts") {
            options.contacts = true;
        } else if (name == "--broad-phase") {
            options.scene.broad_phase = value(i) == "tree"
                                            ? trisect::SceneBroadPhase::BoxTree
                                            : trisect::SceneBroadPhase::SweepAndPrune;
        } else {
            throw std::runtime_error("unknown option " + std::string(name));
        }
    }
    if (options.scenes.empty()) options.scenes = {"swarm", "gears", "chain"};
    if (options.peers.empty()) options.peers = {"obb", "obbrss"};
    return options;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options options = parse(argc, argv);
        one_thread = options.threads == 1;
        for (const std::string& scene : options.scenes) {
            const Record ours = play_ours(scene, options);
#if defined(TRISECT_WITH_FCL)
            for (const std::string& peer : options.peers)
                if (peer != "none") play_peer(scene, options, peer, ours);
#endif
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "compare_scene: %s\n", e.what());
        return 1;
    }
    return 0;
}
