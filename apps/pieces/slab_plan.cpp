// SPDX-License-Identifier: Apache-2.0
#include "slab_plan.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <sys/stat.h>

#include <fmt/format.h>

#include <trisect/kernel/error.h>

#include "piece_join.h"
#include "piecewise_file.h"
#include "piecewise_import.h"

namespace trisect::app {

namespace {

// What a process has without anything to do, and what a triangle of a slab takes while it is
// evaluated: 360 bytes were measured, and 500 where the embedding is checked
// (bench/results/slabs.md).
constexpr std::uint64_t base_bytes = std::uint64_t{64} << 20;
constexpr std::uint64_t triangle_bytes = 600;
constexpr std::uint64_t usual_memory = std::uint64_t{1} << 30;
constexpr std::uint64_t least_memory = base_bytes + base_bytes / 2;
// Of a boolean that is not done in slabs: up to 480 were measured, where the embedding is checked.
constexpr std::uint64_t whole_bytes = 600;

std::uint64_t most_triangles(const SlabOptions& options) {
    const std::uint64_t memory = options.memory == 0 ? usual_memory : options.memory;
    if (memory < least_memory)
        throw LimitError(
            fmt::format("slabs of space need at least {} MiB of memory", least_memory >> 20));
    return (memory - base_bytes) / triangle_bytes;
}

// Nothing where a file is not read in pieces, or not as it should be: then it is read as a whole,
// which says what is wrong.
std::optional<std::uint64_t> triangles_of(const std::string& name) {
    try {
        if (TriangleStream::can_open(name)) return TriangleStream::open(name)->size();
        if (is_imported_in_pieces(name)) return guessed_triangles(name);
    } catch (const Error&) {
    }
    return std::nullopt;
}

}  // namespace

bool needs_slabs(const SlabOptions& options) {
    if (options.memory == 0 || !can_join_into(options.output)) return false;
    if (!is_slab_operation(options.operation)) return false;
    std::uint64_t triangles = 0;
    for (const std::string& name : options.inputs) {
        const auto found = triangles_of(name);
        if (!found) return false;
        triangles += *found;
    }
    const std::uint64_t base = options.memory < least_memory ? 0 : base_bytes;
    return triangles > (options.memory - base) / whole_bytes;
}

bool is_slab_operation(const std::string& operation) {
    return operation == "union" || operation == "intersection" || operation == "difference";
}

std::string job_of(const SlabOptions& options) {
    std::string out = fmt::format("{} {}", options.operation, static_cast<int>(options.embedding));
    for (const std::string& name : options.inputs) {
        struct stat facts {};
        if (::stat(name.c_str(), &facts) != 0)
            throw Error(ErrorCode::Input, name + ": no such file");
        out += fmt::format(" | {} {} {}", name, facts.st_size, facts.st_mtime);
    }
    return out;
}

std::string gathered_name(const SlabOptions& options, std::size_t operand) {
    return fmt::format("{}/operand-{:05}", options.folder, operand);
}

std::unique_ptr<TriangleStream> open_operand(const SlabOptions& options, std::size_t operand) {
    const std::string gathered = gathered_name(options, operand);
    return std::filesystem::exists(gathered) ? TriangleStream::open_gathered(gathered)
                                             : TriangleStream::open(options.inputs[operand]);
}

std::vector<Survey> survey_share(const SlabOptions& options, std::size_t share,
                                 std::size_t shares) {
    std::vector<Survey> out;
    for (std::size_t k = 0; k < options.inputs.size(); ++k)
        out.push_back(survey_of(*open_operand(options, k), options.inputs[k], share, shares));
    return out;
}

SlabPlan make_plan(const SlabOptions& options, const std::vector<Survey>& surveys) {
    SlabPlan plan;
    for (std::size_t i = 0; i < surveys.size(); ++i) {
        if (surveys[i].volume < 0)
            throw Error(ErrorCode::InvalidSolid,
                        options.inputs[i] + ": the boundary is inside out: its volume is negative");
        plan.triangles.push_back(surveys[i].triangles);
    }
    plan.slabs = Slabs::of(surveys, most_triangles(options), options.slabs);
    return plan;
}

void write_plan(const std::string& name, const SlabPlan& plan, const std::string& job) {
    std::string text = job + "\n";
    const Slabs& s = plan.slabs;
    text += fmt::format("{} {:a} {:a}\n", s.axis(), s.quantum(), s.bound());
    for (const std::uint64_t n : plan.triangles) text += fmt::format("{} ", n);
    text += "\n";
    for (std::size_t i = 0; i < s.count(); ++i)
        text += fmt::format("{} {:a}\n", s.load(i), s.high(i));
    OutputStream out(name);
    out.write(text.data(), text.size());
    out.finish();
}

std::optional<SlabPlan> read_plan(const std::string& name, const std::string& job) {
    std::ifstream file(name);
    std::string line;
    if (!std::getline(file, line) || line != job) return std::nullopt;
    const auto next_double = [](std::istream& in) {
        std::string word;
        in >> word;
        return std::strtod(word.c_str(), nullptr);
    };
    SlabPlan plan;
    std::size_t axis = 0;
    file >> axis;
    const double quantum = next_double(file);
    const double bound = next_double(file);
    std::getline(file, line);
    std::getline(file, line);
    std::istringstream counts(line);
    for (std::uint64_t n = 0; counts >> n;) plan.triangles.push_back(n);
    std::vector<double> walls;
    std::vector<std::uint64_t> loads;
    for (std::uint64_t load = 0; file >> load;) {
        loads.push_back(load);
        walls.push_back(next_double(file));
    }
    if (walls.empty() || axis > 2) return std::nullopt;
    walls.pop_back();
    plan.slabs = Slabs(axis, std::move(walls), std::move(loads), quantum, bound);
    return plan;
}

}  // namespace trisect::app
