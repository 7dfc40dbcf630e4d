// SPDX-License-Identifier: Apache-2.0
//
// How fast meshes come in and go out, on one thread: arrays to lattice mesh (import_mesh), arrays
// to solid (Solid::from_mesh), and files of every format beside a plain read or write of the same
// bytes and CGAL's readers.
//
//     import_speed [--runs 9] [--mesh NAME]... [--format NAME]... [--no-files 1] [--no-peer 1]
//
// Meshes: bunny, armadillo, cow (100k triangles; in the folder large/ of TRISECT_MODELS),
// bunny_turned (the same with coordinates that the lattice must round), bunny_soup (every triangle
// with points of its own), sphere7 and sphere8 (icospheres of 328k and 1.3M triangles). One JSON
// line a row: cpu and seconds are medians of processor and wall time, which differ much on a busy
// machine, peak_mb is how much the resident memory grew above what it was
// before the call. Ways of one row take turns, so that a change of the machine's speed hits all.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <malloc.h>
#include <time.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/bsp/solid.h>

#include "cgal_readers.h"
#include "shapes.h"

namespace {

using nlohmann::json;
using trisect::MeshFormat;
using trisect::PlyEncoding;
using trisect::PolygonMesh;
namespace fs = std::filesystem;

struct Options {
    int runs = 9;
    bool files = true;
    bool peer = true;
    std::vector<std::string> meshes;
    std::vector<std::string> formats;  ///< none: all
};

/// Resident memory in megabytes: what `field` of /proc/self/status says.
double status_mb(const char* field) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(field))
            return std::strtod(line.c_str() + std::string(field).size() + 1, nullptr) / 1024;
    return 0;
}

/// How far the resident memory rises during `work`.
double peak_mb(const std::function<void()>& work) {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // sets the high-water mark back
    const double before = status_mb("VmRSS:");
    work();
    return status_mb("VmHWM:") - before;
}

/// Of this process, user and system.
double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// One way to do a job; `work` returns a count that must be equal for all ways, or 0 to refuse.
struct Way {
    std::string name;
    std::function<std::size_t()> work;
    bool counts = true;  ///< false: the count is not that of faces
};

json compare(json row, const std::vector<Way>& ways, int runs) {
    std::vector<std::vector<double>> seconds(ways.size());
    std::vector<std::vector<double>> cpu(ways.size());
    for (std::size_t i = 0; i < ways.size(); ++i) {
        std::size_t count = 0;
        row[ways[i].name]["peak_mb"] = peak_mb([&] { count = ways[i].work(); });
        if (ways[i].counts) row[ways[i].name]["faces"] = count;
    }
    for (int r = 0; r < runs; ++r)
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            const double cpu_start = cpu_seconds();
            static_cast<void>(ways[i].work());
            cpu[i].push_back(cpu_seconds() - cpu_start);
            const std::chrono::duration<double> d = std::chrono::steady_clock::now() - start;
            seconds[i].push_back(d.count());
        }
    for (std::size_t i = 0; i < ways.size(); ++i) {
        row[ways[i].name]["seconds"] = median(seconds[i]);
        row[ways[i].name]["cpu"] = median(cpu[i]);
        row[ways[i].name]["least"] = std::ranges::min(seconds[i]);
    }
    return row;
}

/// Reads all bytes of a file and does nothing with them.
std::size_t plain_read(const fs::path& file) {
    const auto size = static_cast<std::size_t>(fs::file_size(file));
    const auto bytes = std::make_unique_for_overwrite<char[]>(size);
    const int descriptor = ::open(file.c_str(), O_RDONLY);
    std::size_t done = 0;
    while (done < size) {
        const ssize_t n = ::read(descriptor, bytes.get() + done, size - done);
        if (n <= 0) break;
        done += static_cast<std::size_t>(n);
    }
    ::close(descriptor);
    return done;
}

std::size_t plain_write(const fs::path& file, const std::string& bytes) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n = ::write(descriptor, bytes.data() + done, bytes.size() - done);
        if (n <= 0) break;
        done += static_cast<std::size_t>(n);
    }
    ::close(descriptor);
    return done;
}

void print(const json& row) { std::cout << row.dump() << std::endl; }

void measure_import(const std::string& name, const PolygonMesh& mesh, int runs) {
    const json row{{"mesh", name}, {"job", "import"}, {"triangles", mesh.face_count()}};
    print(compare(
        row,
        {{"import_mesh", [&] { return trisect::import_mesh(mesh).mesh.triangles.size(); }},
         {"from_mesh",
          [&] { return trisect::Solid::from_mesh(mesh).is_empty() ? 0 : std::size_t{1}; }, false}},
        runs));
}

struct FileKind {
    const char* name;
    const char* extension;
    MeshFormat format;
    PlyEncoding encoding;
};

constexpr FileKind file_kinds[] = {
    {"stl", ".stl", MeshFormat::StlBinary, PlyEncoding::BinaryLittleEndian},
    {"ply", ".ply", MeshFormat::Ply, PlyEncoding::BinaryLittleEndian},
    {"ply-ascii", ".ply", MeshFormat::Ply, PlyEncoding::Ascii},
    {"obj", ".obj", MeshFormat::Obj, PlyEncoding::Ascii},
    {"off", ".off", MeshFormat::Off, PlyEncoding::Ascii},
    {"stl-ascii", ".stl", MeshFormat::StlAscii, PlyEncoding::Ascii},
};

void measure_files(const std::string& name, const PolygonMesh& mesh, const Options& options) {
    const fs::path folder =
        fs::temp_directory_path() / ("import_speed_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    for (const FileKind& kind : file_kinds) {
        if (!options.formats.empty() &&
            std::ranges::find(options.formats, kind.name) == options.formats.end())
            continue;
        const fs::path file = folder / (name + kind.extension);
        const fs::path other = folder / ("filtered_" + name + kind.extension);
        trisect::WriteOptions as;
        as.format = kind.format;
        as.ply_encoding = kind.encoding;
        const std::string bytes = trisect::format_mesh(mesh, as).bytes;
        const json row{{"mesh", name},
                       {"format", kind.name},
                       {"triangles", mesh.face_count()},
                       {"bytes", bytes.size()}};
        json write = row;
        write["job"] = "write";
        print(compare(write,
                      {{"trisect",
                        [&] {
                            static_cast<void>(trisect::write_mesh(file, mesh, as));
                            return mesh.face_count();
                        }},
                       {"plain", [&] { return plain_write(other, bytes); }, false}},
                      options.runs));
        fs::remove(other);
        std::vector<Way> ways{
            {"trisect", [&] { return trisect::read_mesh(file).face_count(); }},
            {"plain", [&] { return plain_read(file); }, false},
        };
        if (options.peer) {
            ways.push_back({"cgal", [&] { return cgal_readers::read_mesh(file); }});
            ways.push_back({"cgal_soup", [&] { return cgal_readers::read_soup(file); }});
        }
        json read = row;
        read["job"] = "read";
        print(compare(read, ways, options.runs));
        fs::remove(file);
    }
    fs::remove_all(folder);
}

PolygonMesh soup_of(const PolygonMesh& mesh) {
    PolygonMesh out;
    for (const std::uint32_t c : mesh.corners) out.points.push_back(mesh.points[c]);
    out.face_begin = mesh.face_begin;
    out.corners.resize(mesh.corners.size());
    for (std::size_t i = 0; i < out.corners.size(); ++i)
        out.corners[i] = static_cast<std::uint32_t>(i);
    return out;
}

/// Nothing when the model is absent.
std::optional<PolygonMesh> make_mesh(const std::string& name) {
    if (name == "sphere7") return shapes::icosphere(7);
    if (name == "sphere8") return shapes::icosphere(8);
    const char* models = std::getenv("TRISECT_MODELS");
    const fs::path folder = fs::path(models == nullptr ? "../shared/models" : models) / "large";
    const fs::path path = folder / (name == "armadillo" ? "armadillo.obj"
                                    : name == "cow"     ? "cow100K.obj"
                                                        : "bunny100k.obj");
    if (!fs::exists(path)) {
        std::fprintf(stderr, "import_speed: %s is absent, set TRISECT_MODELS\n", path.c_str());
        return std::nullopt;
    }
    PolygonMesh mesh = trisect::read_mesh(path);
    if (name == "bunny_turned") return shapes::turned(mesh);
    if (name == "bunny_soup") return soup_of(mesh);
    return mesh;
}

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i < argc; i += 2) {
        if (i + 1 == argc) return std::nullopt;
        const std::string word = argv[i];
        if (word == "--runs")
            out.runs = std::atoi(argv[i + 1]);
        else if (word == "--mesh")
            out.meshes.emplace_back(argv[i + 1]);
        else if (word == "--format")
            out.formats.emplace_back(argv[i + 1]);
        else if (word == "--no-files")
            out.files = std::atoi(argv[i + 1]) == 0;
        else if (word == "--no-peer")
            out.peer = std::atoi(argv[i + 1]) == 0;
        else
            return std::nullopt;
    }
    if (out.meshes.empty())
        out.meshes = {"bunny", "bunny_turned", "bunny_soup", "armadillo", "cow", "sphere8"};
    if (out.runs <= 0) return std::nullopt;
    return out;
}

void run(const Options& options) {
    for (const std::string& name : options.meshes) {
        const auto mesh = make_mesh(name);
        if (!mesh) continue;
        measure_import(name, *mesh, options.runs);
        if (options.files && name != "bunny_soup") measure_files(name, *mesh, options);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::fprintf(stderr,
                     "usage: %s [--runs N] [--mesh NAME]... [--format NAME]... [--no-files 1] "
                     "[--no-peer 1]\n",
                     argv[0]);
        return 2;
    }
    try {
        run(*options);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "import_speed: %s\n", e.what());
        return 1;
    }
}
