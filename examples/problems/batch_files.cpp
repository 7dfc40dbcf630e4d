// SPDX-License-Identifier: Apache-2.0
//
// Cuts the same tool out of many files, in several processes; a bad file stops nothing, not even
// when it makes a process crash.
//
//     batch_files [folder with meshes]

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;
namespace fs = std::filesystem;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

PolygonMesh moved(const PolygonMesh& mesh, const Point3d& by) {
    return transformed(mesh, AffineMap::translation(by));
}

// Six parts, and two files as they come: one with a hole and one that breaks off. Nothing here
// starts threads, so that processes can be forked after it.
void make_files(const fs::path& folder) {
    fs::create_directories(folder);
    for (int i = 0; i < 6; ++i)
        write_mesh(folder / ("part" + std::to_string(i) + ".off"), make_box({4, 4, 2.0 + i}));
    PolygonMesh holed = make_box({1, 1, 1});
    holed.corners.resize(holed.corners.size() - 4);
    holed.face_begin.pop_back();
    write_mesh(folder / "with_a_hole.obj", holed);
    std::ofstream(folder / "torn.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 1 0";
}

// One file: what is cut off, and where it was written; or what is wrong.
std::string cut(const fs::path& path) {
    const auto tool = Solid::from_mesh(moved(make_cylinder(0.5, 100, 32), {2, 2, -50})) |
                      Solid::from_mesh(make_box({3, 3, 1}, {9, 9, 9}));
    try {
        const StopScope scope({.max_work = 10'000'000'000});  // no hour-long files
        const Solid part = Solid::from_mesh(read_mesh(path), {.embedding = Embedding::Check});
        const Solid rest = evaluate(part - tool, {.threads = 1});
        const Solid chips = evaluate(part & tool, {.threads = 1});
        if (exact_volume(rest) + exact_volume(chips) != exact_volume(part)) return "WRONG";
        write_mesh(path.stem().string() + "-cut.stl", rest.to_mesh(1));
        return "ok " + std::to_string(volume(chips)) + " of " + std::to_string(volume(part)) +
               " cut off";
    } catch (const Error& error) {
        return "error " + std::to_string(static_cast<int>(error.code())) + ": " + error.what();
    }
}

// Every second file, or third, ..., and one line for each into a file.
void work(const std::vector<fs::path>& paths, std::size_t worker, std::size_t workers) {
    std::ofstream lines("batch" + std::to_string(worker) + ".txt");
    for (std::size_t i = worker; i < paths.size(); i += workers)
        lines << paths[i].filename().string() << ": " << cut(paths[i]) << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
    const fs::path folder = argc > 1 ? fs::path(argv[1]) : fs::path("batch_files");
    if (argc == 1) make_files(folder);
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
    std::ranges::sort(paths);

    constexpr std::size_t workers = 2;
    std::vector<pid_t> processes;
    for (std::size_t w = 0; w < workers; ++w) {
        const pid_t id = fork();
        expect(id >= 0, "a process");
        if (id == 0) {
            work(paths, w, workers);
            std::_Exit(0);
        }
        processes.push_back(id);
    }
    for (const pid_t id : processes) {
        int status = 0;
        waitpid(id, &status, 0);
        if (status != 0) std::cerr << "a process ended with status " << status << '\n';
    }
    std::vector<std::string> lines;
    for (std::size_t w = 0; w < workers; ++w) {
        std::ifstream file("batch" + std::to_string(w) + ".txt");
        for (std::string line; std::getline(file, line);) lines.push_back(line);
    }
    std::ranges::sort(lines);
    for (const std::string& line : lines) std::cout << line << '\n';
    const auto count = [&](const char* text) {
        return std::ranges::count_if(
            lines, [&](const std::string& l) { return l.find(text) != std::string::npos; });
    };
    expect(lines.size() == paths.size() && count(": WRONG") == 0, "a line for each file");
    if (argc == 1) {
        expect(count(": ok ") == 6, "six parts");
        expect(count("with_a_hole.obj: error 4: ") == 1, "no solid");
        expect(count("torn.obj: error 3: ") == 1 && count("torn.obj:5") == 1,
               "the place in the file");
    }
    return 0;
}
