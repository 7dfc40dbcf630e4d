// SPDX-License-Identifier: Apache-2.0
#include "large_pages.h"

#include <cstdlib>  // defines __GLIBC__

#ifdef __GLIBC__
#include <filesystem>
#include <fstream>
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

}  // namespace

// The allocator reads its tunables before main, and takes no such request later.
void demand_large_pages(int argc, char** argv) {
    if (argc < 3 || !__GLIBC_PREREQ(2, 35)) return;
    if (std::getenv(tunables) != nullptr || !are_on_demand()) return;
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
