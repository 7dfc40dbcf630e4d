// SPDX-License-Identifier: Apache-2.0
//
// Real meshes: each closed mesh against itself, turned by 37 degrees and moved by a tenth of its
// box, under union, intersection and difference.
//
// Both operands are put on one lattice first, so that their volumes, and those of the results, are
// exact numbers of one world. Then V(A ∪ B) + V(A ∩ B) = V(A) + V(B) and V(A - B) + V(A ∩ B) = V(A)
// must hold as equations between fractions. Results must be closed, without faces that cancel each
// other; the two kinds of output (B-rep and triangles) must have the same size; and so must CGAL's
// corefinement with exact points, on the same doubles, to 1e-9, where it succeeds.
//
//     real_meshes [--json FILE] [--seconds 120] [--exact-limit N] [--list] PATH...
//
// A path is a mesh or a folder, searched with all below. Every mesh runs in a process of its own,
// and so does the peer, each with a limit of time: what crashes or hangs is recorded. Meshes that
// are open or inside out are named and left. --exact-limit leaves the fractions out where results
// have more cut vertices. Writes one JSON line a mesh, prints a Markdown table, and exits with 1
// if a result was wrong.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "bench/shapes.h"
#ifdef TRISECT_WITH_CGAL
#include "bench/corefinement.h"
#endif

namespace {

using nlohmann::json;
using trisect::Brep;
using trisect::DefectKind;
using trisect::ExactRational;
using trisect::LatticeMesh;
using trisect::PolygonMesh;
using trisect::Solid;
using Clock = std::chrono::steady_clock;

constexpr std::array names{"union", "intersection", "difference"};

struct Options {
    std::string json_file;
    unsigned seconds = 120;
    std::size_t exact_limit = std::numeric_limits<std::size_t>::max();
    bool list = false;
    std::vector<std::filesystem::path> paths;
};

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// ---------------------------------------------------------------------------------------------
// Operands
// ---------------------------------------------------------------------------------------------

PolygonMesh in_doubles(const LatticeMesh& mesh) {
    PolygonMesh out;
    for (const auto& p : mesh.points) out.points.push_back(trisect::to_user(p, mesh.lattice));
    for (const auto& [a, b, c] : mesh.triangles) out.add_triangle(a, b, c);
    return out;
}

struct Operands {
    LatticeMesh a;
    LatticeMesh b;
    bool embedded = true;
};

/// Fills the report; nothing when the mesh bounds no solid.
std::optional<Operands> operands_of(const std::filesystem::path& path, bool validate,
                                    json& report) {
    trisect::ImportOptions options;
    options.require_closed = false;
    const auto imported = trisect::import_mesh(trisect::read_mesh(path), options);
    report["triangles"] = imported.mesh.triangles.size();
    const auto refuse = [&](const char* status) {
        report["status"] = status;
        return std::nullopt;
    };
    if (imported.mesh.triangles.empty()) return refuse("empty");
    if (!imported.report.closed) return refuse("open");
    if (imported.report.inside_out) return refuse("inside out");

    PolygonMesh a = in_doubles(imported.mesh);
    PolygonMesh b = shapes::turned(a);
    auto points = a.points;
    points.insert(points.end(), b.points.begin(), b.points.end());
    options.lattice = trisect::choose_lattice(points);
    auto on_lattice_a = trisect::import_mesh(a, options);
    auto on_lattice_b = trisect::import_mesh(b, options);
    report["lattice"] = options.lattice->exponent;
    report["max_move"] =
        std::max(on_lattice_a.report.lattice.max_move, on_lattice_b.report.lattice.max_move);
    if (!on_lattice_a.report.closed || !on_lattice_b.report.closed)
        return refuse("open after rounding");
    Operands out{std::move(on_lattice_a.mesh), std::move(on_lattice_b.mesh), true};
    for (const LatticeMesh* mesh : {&out.a, &out.b}) {
        if (!validate) break;
        const auto found = trisect::validate(*mesh);
        if (found.count(DefectKind::SelfIntersection) != 0) out.embedded = false;
        for (const DefectKind kind :
             {DefectKind::SelfIntersection, DefectKind::ShellNesting, DefectKind::InsideOutShell,
              DefectKind::NonManifoldEdge, DefectKind::DuplicateOppositeFaces})
            if (found.count(kind) != 0)
                report["defects"][std::string(trisect::name_of(kind))] = found.count(kind);
        if (!found.is_solid()) out.embedded = false;
    }
    report["status"] = out.embedded ? "solid" : "not embedded";
    return out;
}

// ---------------------------------------------------------------------------------------------
// Checks of a result
// ---------------------------------------------------------------------------------------------

/// Edges by vertex numbers: directed edges without opposite.
std::size_t open_edges(const PolygonMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i];
            const std::uint32_t b = loop[(i + 1) % loop.size()];
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    return static_cast<std::size_t>(
        std::ranges::count_if(balance, [](const auto& e) { return e.second != 0; }));
}

/// Faces with the same exact corners and opposite normals.
std::size_t duplicate_opposite_faces(const Brep& brep) {
    const auto place = [&](trisect::VertexId v) {
        const auto copies = brep.copies(v);
        return copies.empty() ? v.index : std::ranges::min(copies).index;
    };
    std::map<std::vector<std::uint32_t>, std::vector<trisect::FaceId>> faces;
    std::size_t count = 0;
    for (const trisect::FaceId f : brep.faces()) {
        std::vector<std::uint32_t> corners;
        for (const trisect::HalfedgeId h : brep.halfedges(f))
            corners.push_back(place(brep.origin(h)));
        std::ranges::sort(corners);
        auto& same = faces[corners];
        for (const trisect::FaceId other : same)
            if (trisect::is_same_plane(brep.plane(f), brep.plane(other)) &&
                !trisect::same_orientation(brep.plane(f), brep.plane(other)))
                ++count;
        same.push_back(f);
    }
    return count;
}

std::size_t cut_vertices(const Brep& brep) {
    return static_cast<std::size_t>(std::ranges::count_if(
        brep.points(), [](const trisect::Point& p) { return !p.is_lattice(); }));
}

double relative(double found, double wanted) {
    if (found == wanted) return 0;
    return std::abs(found - wanted) / std::abs(wanted);
}

trisect::Expression expression(int operation, const Solid& a, const Solid& b) {
    if (operation == 0) return a | b;
    if (operation == 1) return a & b;
    return a - b;
}

Brep run_operation(int operation, const Solid& a, const Solid& b, json& out) {
    auto start = Clock::now();
    const Solid result = evaluate(expression(operation, a, b));
    out["evaluate_seconds"] = seconds_since(start);
    start = Clock::now();
    const PolygonMesh mesh = result.to_mesh();
    out["to_mesh_seconds"] = seconds_since(start);
    start = Clock::now();
    Brep brep = result.to_brep();
    out["to_brep_seconds"] = seconds_since(start);
    out["triangles"] = mesh.face_count();
    out["faces"] = brep.counts().faces;
    out["shells"] = brep.counts().shells;
    out["cut_vertices"] = cut_vertices(brep);
    out["volume"] = trisect::volume(brep);
    out["area"] = trisect::area(brep).value;
    const shapes::Size size = shapes::size_of(mesh);
    out["mesh_volume_error"] = relative(size.volume, out["volume"]);
    out["mesh_area_error"] = relative(size.area, out["area"]);
    out["open_edges"] = open_edges(mesh) + open_edges(trisect::to_polygon_mesh(brep));
    out["duplicate_opposite_faces"] = duplicate_opposite_faces(brep);
    return brep;
}

/// Called with the report whenever it has grown, in case the rest takes too long.
using Emit = std::function<void(const json&)>;

void run_ours(const std::filesystem::path& path, const Options& options, json& report,
              const Emit& emit) {
    const auto operands = operands_of(path, true, report);
    emit(report);
    if (!operands || options.list) return;
    const auto embedding =
        operands->embedded ? trisect::Embedding::Assume : trisect::Embedding::Resolve;
    const Solid a = Solid::from_lattice_mesh(operands->a, embedding);
    const Solid b = Solid::from_lattice_mesh(operands->b, embedding);
    std::array<Brep, 3> breps;
    std::size_t most_cut = 0;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        json& out = report["ours"][names[k]];
        breps[k] = run_operation(i, a, b, out);
        most_cut = std::max(most_cut, out["cut_vertices"].get<std::size_t>());
        emit(report);
    }
    if (most_cut > options.exact_limit) {
        report["identities"] = "not computed";
        return;
    }
    const auto start = Clock::now();
    std::array<ExactRational, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = trisect::exact_volume(breps[k]);
    // An operand that meets itself is the set that its resolution bounds.
    const auto own_volume = [&](const Solid& s, const LatticeMesh& mesh) {
        return operands->embedded ? trisect::exact_volume(mesh)
                                  : trisect::exact_volume(trisect::evaluate(s).to_brep());
    };
    const ExactRational va = own_volume(a, operands->a);
    const ExactRational vb = own_volume(b, operands->b);
    const bool first = v[0] + v[1] == va + vb;
    const bool second = v[2] + v[1] == va;
    report["identities"] = first && second ? "hold" : "VIOLATED";
    report["exact_seconds"] = seconds_since(start);
}

void run_peer([[maybe_unused]] const std::filesystem::path& path,
              [[maybe_unused]] const Options& options, json& report,
              [[maybe_unused]] const Emit& emit) {
#ifdef TRISECT_WITH_CGAL
    json ignored;
    const auto operands = operands_of(path, false, ignored);
    if (!operands) return;
    const PolygonMesh a = in_doubles(operands->a);
    const PolygonMesh b = in_doubles(operands->b);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto answer = corefinement::run(a, b, static_cast<corefinement::Operation>(k));
        json& out = report[names[k]];
        out["seconds"] = answer.import_seconds + answer.operation_seconds;
        if (answer.refusal.empty()) {
            const shapes::Size size = shapes::size_of(answer.mesh);
            out["triangles"] = answer.mesh.face_count();
            out["volume"] = size.volume;
            out["area"] = size.area;
        } else {
            out["refusal"] = answer.refusal;
        }
        emit(report);
    }
#else
    report["absent"] = true;
#endif
}

// ---------------------------------------------------------------------------------------------
// Processes
// ---------------------------------------------------------------------------------------------

std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = read(descriptor, buffer.data(), buffer.size())) > 0;)
        text.append(buffer.data(), static_cast<std::size_t>(n));
    return text;
}

/// The last complete line of what the child wrote, and how it ended under "end".
json in_a_child(unsigned seconds, const std::function<void(json&, const Emit&)>& work) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        alarm(seconds);
        const Emit emit = [&](const json& report) {
            const std::string line = report.dump() + "\n";
            if (write(ends[1], line.data(), line.size()) < 0) _exit(1);
        };
        json report = json::object();
        try {
            work(report, emit);
        } catch (const std::exception& e) {
            report["exception"] = e.what();
        }
        emit(report);
        _exit(0);
    }
    close(ends[1]);
    const std::string text = read_all(ends[0]);
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    json out = json::object();
    const std::size_t end = text.rfind('\n');
    if (end != std::string::npos) {
        const std::size_t before = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
        const std::size_t begin = before == std::string::npos ? 0 : before + 1;
        out = json::parse(text.substr(begin, end - begin));
    }
    if (WIFSIGNALED(status))
        out["end"] = WTERMSIG(status) == SIGALRM ? "time limit"
                                                 : "signal " + std::to_string(WTERMSIG(status));
    return out;
}

// ---------------------------------------------------------------------------------------------
// Verdicts and the table
// ---------------------------------------------------------------------------------------------

std::string text_or(const json& j, const char* key, const char* otherwise) {
    return j.contains(key) ? j[key].get<std::string>() : otherwise;
}

/// The first sentence, without line breaks and what would end a cell of the table.
std::string shortened(std::string text) {
    text = text.substr(0, text.find('\n')).substr(0, 70);
    std::ranges::replace(text, '|', '/');
    return text;
}

/// How far the peer's result is from ours; nothing where it has none.
std::optional<double> peer_error(const json& peer, const json& ours) {
    if (!peer.contains("volume")) return std::nullopt;
    return std::max(relative(peer["volume"], ours["volume"]), relative(peer["area"], ours["area"]));
}

/// What is wrong with our results; empty when nothing is.
std::string fault(const json& mesh) {
    if (mesh.contains("exception")) return "threw: " + shortened(mesh["exception"]);
    if (mesh.contains("end")) return mesh["end"];
    if (text_or(mesh, "identities", "") == "VIOLATED") return "identities violated";
    if (!mesh.contains("ours")) return {};
    for (const auto& [name, out] : mesh["ours"].items()) {
        if (out["open_edges"] != 0) return name + " is not closed";
        if (out["duplicate_opposite_faces"] != 0) return name + " has faces that cancel";
        if (out["mesh_volume_error"] > 1e-9 || out["mesh_area_error"] > 1e-9)
            return name + ": B-rep and triangles differ";
        if (mesh["status"] != "solid" || !mesh.contains("peer") || !mesh["peer"].contains(name))
            continue;
        if (peer_error(mesh["peer"][name], out).value_or(0) > 1e-9)
            return name + " differs from the peer's";
    }
    return {};
}

/// How many results agree and how well; why the others do not, in the peer's words. Corefinement
/// does not resolve operands that meet themselves, so there it may differ.
std::string peer_verdict(const json& mesh) {
    if (!mesh.contains("peer") || !mesh.contains("ours")) return "";
    const json& peer = mesh["peer"];
    if (peer.contains("absent")) return "not built";
    double worst = 0;
    std::size_t agreeing = 0;
    std::map<std::string, std::string> reasons;  // to the operations
    for (const auto& [name, ours] : mesh["ours"].items()) {
        if (!peer.contains(name)) continue;
        const auto error = peer_error(peer[name], ours);
        std::array<char, 32> text{};
        if (!error) {
            reasons[shortened(peer[name]["refusal"])] += name + " ";
        } else if (*error <= 1e-9) {
            ++agreeing;
            worst = std::max(worst, *error);
        } else {
            std::snprintf(text.data(), text.size(), "differs by %.0e", *error);
            reasons[text.data()] += name + " ";
        }
    }
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%zu agree to %.0e", agreeing, worst);
    std::string out = agreeing == 0 ? "none agrees" : text.data();
    for (const auto& [reason, operations] : reasons) out += "; " + operations + reason;
    for (const char* key : {"end", "exception"})
        if (peer.contains(key)) out += "; " + shortened(peer[key]);
    return out;
}

double total_seconds(const json& mesh) {
    double sum = 0;
    for (const auto& [name, out] : mesh["ours"].items())
        sum += out["evaluate_seconds"].get<double>() + out["to_mesh_seconds"].get<double>();
    return sum;
}

void print_row(const json& mesh) {
    const auto number = [&](const char* operation) -> std::string {
        if (!mesh.contains("ours") || !mesh["ours"].contains(operation)) return "";
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.12g",
                      mesh["ours"][operation]["volume"].get<double>());
        return text.data();
    };
    std::string seconds;
    if (mesh.contains("ours")) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.3f", total_seconds(mesh));
        seconds = text.data();
    }
    const std::string wrong = fault(mesh);
    std::printf(
        "| %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", mesh["mesh"].get<std::string>().c_str(),
        mesh.contains("triangles") ? mesh["triangles"].dump().c_str() : "",
        text_or(mesh, "status", "unreadable").c_str(), number("union").c_str(),
        number("intersection").c_str(), seconds.c_str(), text_or(mesh, "identities", "").c_str(),
        wrong.empty() ? "" : wrong.c_str(), peer_verdict(mesh).c_str());
    std::fflush(stdout);
}

std::vector<std::filesystem::path> meshes_below(const std::vector<std::filesystem::path>& paths) {
    std::vector<std::filesystem::path> out;
    for (const auto& path : paths) {
        if (!std::filesystem::is_directory(path)) {
            out.push_back(path);
            continue;
        }
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
            if (entry.is_regular_file() &&
                trisect::mesh_format_of_extension(entry.path()).has_value())
                found.push_back(entry.path());
        std::ranges::sort(found);
        out.insert(out.end(), found.begin(), found.end());
    }
    return out;
}

json run_mesh(const std::filesystem::path& path, const Options& options) {
    json report = in_a_child(
        options.seconds, [&](json& out, const Emit& emit) { run_ours(path, options, out, emit); });
    report["mesh"] = path.parent_path().filename().string() + "/" + path.filename().string();
    if (report.contains("ours"))
        report["peer"] = in_a_child(options.seconds, [&](json& out, const Emit& emit) {
            run_peer(path, options, out, emit);
        });
    return report;
}

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--list") {
            out.list = true;
        } else if (word.starts_with("--")) {
            if (i + 1 == argc) return std::nullopt;
            const char* value = argv[++i];
            if (word == "--json")
                out.json_file = value;
            else if (word == "--seconds")
                out.seconds = static_cast<unsigned>(std::atoi(value));
            else if (word == "--exact-limit")
                out.exact_limit = std::strtoull(value, nullptr, 10);
            else
                return std::nullopt;
        } else {
            out.paths.emplace_back(word);
        }
    }
    if (out.paths.empty() || out.seconds == 0) return std::nullopt;
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::fprintf(stderr,
                     "usage: %s [--json FILE] [--seconds S] [--exact-limit N] [--list] PATH...\n",
                     argv[0]);
        return 2;
    }
    std::ofstream lines;
    if (!options->json_file.empty()) lines.open(options->json_file);
    std::printf(
        "| mesh | triangles | status | V(A + B) | V(A * B) | seconds | identities | fault | CGAL "
        "|\n"
        "|---|---:|---|---:|---:|---:|---|---|---|\n");
    std::size_t wrong = 0;
    std::map<std::string, std::size_t> statuses;
    for (const auto& path : meshes_below(options->paths)) {
        const json report = run_mesh(path, *options);
        if (lines.is_open()) lines << report.dump() << std::endl;
        print_row(report);
        ++statuses[text_or(report, "status", "unreadable")];
        wrong += fault(report).empty() || !report.contains("status") ? 0U : 1U;
    }
    std::printf("\n");
    for (const auto& [status, n] : statuses) std::printf("%zu %s, ", n, status.c_str());
    std::printf("%zu with a fault\n", wrong);
    return wrong == 0 ? 0 : 1;
}
