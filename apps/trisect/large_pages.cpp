// SPDX-License-Identifier: Apache-2.0
#include "large_pages.h"

#include <cstdlib>  // defines __GLIBC__

#ifdef __GLIBC__
#include <trisect/brep/io/mesh_format.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include <unistd.h>
#endif

namespace trisect::app {

#ifdef __GLIBC__
namespace {

constexpr const char* tunables = "GLIBC_TUNABLES";

bool are_on_demand() {
    std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
    std::string line;
    return std::getline(file, line) && line.find("[madvise]") != std::string::npos;
}

/// Programs in OpenSCAD's evaluated form gain nothing from large pages, unless they read files.
bool is_program_alone(const std::filesystem::path& path) {
    if (path.extension() != ".csg") return false;
    std::ifstream file(path, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    return text.find("import") == std::string::npos && text.find("surface") == std::string::npos;
}

/// Whether the arguments name meshes, models and programs and no other files, and all of these
/// together are small. Other files, say a manifest, name further ones.
bool name_little(int argc, char** argv) {
    constexpr std::uintmax_t little = 256 << 10;
    std::uintmax_t bytes = 0;
    for (int i = 2; i < argc; ++i) {
        std::error_code failed;
        const std::filesystem::path path(argv[i]);
        if (!std::filesystem::exists(path, failed)) continue;
        const std::uintmax_t size = std::filesystem::file_size(path, failed);
        if (failed) return false;
        bytes += size;
        if (bytes > little) return false;
        if (!mesh_format_of_extension(path) && !is_program_alone(path)) return false;
    }
    return bytes > 0;
}

}  // namespace

// The allocator reads its tunables before main, and takes no such request later.
void demand_large_pages(int argc, char** argv) {
    if (argc < 3 || !__GLIBC_PREREQ(2, 35)) return;
    if (std::getenv(tunables) != nullptr || name_little(argc, argv) || !are_on_demand()) return;
    if (::setenv(tunables, "glibc.malloc.hugetlb=1", 0) != 0) return;
    // By its own name, under which processes are listed. Where that fails, the program goes on.
    std::error_code failed;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
    if (!failed) (void)::execv(program.c_str(), argv);
}
#else
void demand_large_pages(int /*argc*/, char** /*argv*/) {}
#endif

}  // namespace trisect::app
