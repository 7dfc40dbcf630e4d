// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the command line, within one process: bytes are arguments, most of them words that the
// command knows, files of a small folder among them, some of them any characters. Whatever they
// are, the command answers with a documented exit code. Limits of memory and time are left out:
// they would strike the fuzzer itself (campaign-hostile has them). So are scenes of the corpus,
// which are many.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "byte_source.h"
#include "trisect/command_line.h"
#include "trisect/compare_hierarchies_command.h"

namespace {

namespace fs = std::filesystem;

struct File {
    std::string_view name;
    std::string_view text;
};

constexpr File files[] = {
    {"a.off",
     "OFF\n8 6 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n"
     "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"},
    {"b.obj",
     "v 1 1 1\nv 3 1 1\nv 3 3 1.5\nv 1 3 1\nv 2 2 4\n"
     "f 1 4 2\nf 2 4 3\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"},
    {"c.stl",
     "solid c\n"
     "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
     "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
     "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
     "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
     "endsolid c\n"},
    {"open.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n"},
    {"bad.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n"},
    {"points.txt", "0 0 0\n1 1 1\n0.5, 2, 1e-3\n"},
    {"pose.txt", "1 0 0 0.5\n0 1 0 0\n0 0 1 0.25\n"},
    {"moves.txt", "1 0 0 9 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n"},
    {"screw.txt", "screw 3 0 0 1  0 0 0  0 0 0.5\n"},
    {"frames.json",
     "{\"keyframes\": [{\"time\": 0, \"position\": [9, 0, 0]},"
     " {\"time\": 1, \"rotation\": [1, 1, 0, 0], \"position\": [0, 0, 0]}]}"},
};

constexpr std::string_view words[] = {
    // Sub-commands; those that make many frames or pixels are told to make few (arguments()).
    "union", "intersection", "difference", "xor", "info", "check", "diff", "verify", "convert",
    "tessellate", "locate", "sweep", "section", "render", "tree", "interfere",
    "compare-hierarchies",
    // Files.
    "a.off", "b.obj", "c.stl", "open.off", "bad.ply", "points.txt", "pose.txt", "moves.txt",
    "screw.txt", "frames.json", "missing.off", ".", "-", "a.off", "b.obj", "c.stl",
    // Outputs.
    "o.off", "o.obj", "o.stl", "o.ply", "o.png", "o.svg", "o.exact", "o",
    // Options.
    "-o", "--output", "--exact", "--boundary", "--source-faces", "--no-certificate", "--repair",
    "--assume-embedded", "--winding", "--mixed-lattices", "--op", "--points", "--point", "--motion",
    "--motion-of-a", "--until", "--width", "--plane", "--section", "--view", "--up",
    "--perspective", "--samples", "--edges", "--background", "--pose-a", "--pose-b", "--contacts",
    "--distance", "--nearer-than", "--structure", "--svg", "--places", "--within", "--pieces",
    "--matrix", "--scale", "--rotate", "--translate", "--deviation", "--json", "-q", "-v",
    "--progress", "--lattice", "--nonplanar", "--refit-move", "--format", "--input-format",
    "--help", "--version", "--",
    // Values.
    "positive", "nonzero", "round", "refuse", "triangulate", "refit", "touch", "overlap", "auto",
    "none", "all", "bar", "iso", "front", "x", "y", "z", "z=1", "z=0.3", "1,0,0,1", "0,0,0,0",
    "1,1,1", "1,2,3,37", "0,0,1,45", "0", "1", "2", "-1", "0.5", "1e-300", "1e308", "nan", "-8",
    "8", "light", "transparent", "obj", "off", "ply", "stl-ascii", "stl-binary", "aabb", "msp"};
static_assert(std::size(words) < 240);
constexpr unsigned subcommands = 17;
static_assert(words[subcommands - 1] == "compare-hierarchies");

void require(bool condition) {
    if (!condition) std::abort();
}

/// The folder in which the command works, made once and removed at the end.
class Folder {
public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "trisect-fuzz-XXXXXX").string();
        require(::mkdtemp(name.data()) != nullptr);
        path_ = name;
        for (const File& file : files) std::ofstream(path_ / file.name) << file.text;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

    [[nodiscard]] const fs::path& path() const { return path_; }
    /// Takes away what the command wrote.
    void clean() const {
        for (const auto& entry : fs::directory_iterator(path_)) {
            const std::string name = entry.path().filename().string();
            const auto is_kept = [&](const File& file) { return file.name == name; };
            if (std::none_of(std::begin(files), std::end(files), is_kept)) {
                fs::remove_all(entry.path());
            }
        }
    }

private:
    fs::path path_;
};

/// Standard streams go nowhere and the folder is the one to work in. In the end all is as before,
/// and the signals that the command blocks come through again.
class Visit {
public:
    explicit Visit(const fs::path& folder) : before_(fs::current_path()) {
        fs::current_path(folder);
        ::pthread_sigmask(SIG_SETMASK, nullptr, &signals_);
        const int nowhere = ::open("/dev/null", O_RDWR);
        require(nowhere >= 0);
        for (int i = 0; i < 3; ++i) {
            kept_[static_cast<std::size_t>(i)] = ::dup(i);
            ::dup2(nowhere, i);
        }
        ::close(nowhere);
    }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;
    ~Visit() {
        for (int i = 0; i < 3; ++i) {
            ::dup2(kept_[static_cast<std::size_t>(i)], i);
            ::close(kept_[static_cast<std::size_t>(i)]);
        }
        ::pthread_sigmask(SIG_SETMASK, &signals_, nullptr);
        std::error_code ignored;
        fs::current_path(before_, ignored);
    }

private:
    fs::path before_;
    std::array<int, 3> kept_{};
    sigset_t signals_{};
};

/// Characters that numbers, lists and options are made of; no '/', so that nothing outside of the
/// folder is named.
std::string literal(fuzz::ByteSource& bytes) {
    constexpr std::string_view characters = "0123456789.,-+=:eExyzWnai *\"\\\n\x01\xff%{}#";
    std::string out;
    for (unsigned n = bytes.below(12); n > 0; --n) {
        out += characters[bytes.below(static_cast<unsigned>(characters.size()))];
    }
    return out;
}

std::vector<std::string> arguments(fuzz::ByteSource& bytes) {
    std::vector<std::string> out{"trisect", "--threads", "1", "--max-work", "200000"};
    const std::size_t fixed = out.size();
    while (!bytes.is_empty() && out.size() < 24) {
        unsigned code = bytes.byte();
        // Nothing else works without a sub-command, so there is nearly always one at the front.
        if (out.size() == fixed && code < 240) code %= subcommands;
        if (code >= std::size(words)) {
            out.push_back(literal(bytes));
            continue;
        }
        out.emplace_back(words[code]);
        if (words[code] == "render") out.insert(out.end(), {"--size", "8x6"});
        if (words[code] == "compare-hierarchies") out.insert(out.end(), {"--frames", "2"});
    }
    return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    fuzz::ByteSource bytes(data, size);
    std::vector<std::string> texts = arguments(bytes);
    std::vector<char*> argv;
    for (std::string& text : texts) argv.push_back(text.data());
    argv.push_back(nullptr);
    int code = 0;
    {
        const Visit visit(folder.path());
        trisect::app::SubCommands commands = trisect::app::all_commands();
        commands.push_back(trisect::app::compare_hierarchies_command());
        code = trisect::app::run(static_cast<int>(argv.size()) - 1, argv.data(), commands);
    }
    require(code >= 0 && code <= 7);
    folder.clean();
    return 0;
}
