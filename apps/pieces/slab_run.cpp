// SPDX-License-Identifier: Apache-2.0
#include "slab_run.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/evaluate_within.h>
#include <trisect/bsp/native_file.h>
#include <trisect/kernel/error.h>

#include "folder_lock.h"
#include "gathered_file.h"
#include "piece.h"
#include "piecewise_file.h"
#include "slab_mesh.h"

namespace trisect::app {

namespace {

/// Triangles of one operand in slabs, appended to a file each. No file is open between writes:
/// there may be more slabs than a process may open.
class Distributor {
public:
    using Name = std::function<std::string(std::size_t slab)>;

    Distributor(std::size_t slabs, bool single, Name name)
        : single_(single), name_(std::move(name)), buffers_(slabs) {
        limit_ =
            std::clamp<std::size_t>((std::size_t{32} << 20) / slabs, 4096, std::size_t{1} << 20);
    }
    void add(std::size_t slab, const Corners& corners) {
        std::string& buffer = buffers_[slab];
        for (const Point3d& p : corners)
            for (const double x : p) {
                const auto f = static_cast<float>(x);
                buffer.append(
                    single_ ? reinterpret_cast<const char*>(&f) : reinterpret_cast<const char*>(&x),
                    single_ ? sizeof f : sizeof x);
            }
        if (buffer.size() >= limit_) flush(slab);
    }
    void finish() {
        for (std::size_t i = 0; i < buffers_.size(); ++i) flush(i);
    }

private:
    void flush(std::size_t slab) {
        const std::string name = name_(slab);
        std::ofstream out(name, std::ios::binary | std::ios::app);
        out.write(buffers_[slab].data(), static_cast<std::streamsize>(buffers_[slab].size()));
        out.close();
        if (!out)
            throw Error(ErrorCode::Input, name + ": cannot be written: " + std::strerror(errno));
        buffers_[slab].clear();
    }

    bool single_;
    Name name_;
    std::vector<std::string> buffers_;
    std::size_t limit_;
};

template <class Number>
void read_scratch(const std::string& name, SlabMesh& mesh) {
    const InputFile file(name);
    constexpr std::uint64_t at_once = 4096;
    std::vector<std::array<Number, 9>> records(at_once);
    const std::uint64_t all = file.size() / sizeof(records[0]);
    for (std::uint64_t at = 0; at < all; at += at_once) {
        const std::uint64_t n = std::min(at_once, all - at);
        file.read(at * sizeof(records[0]), {reinterpret_cast<char*>(records.data()),
                                            static_cast<std::size_t>(n * sizeof(records[0]))});
        for (std::uint64_t i = 0; i < n; ++i) {
            Corners c;
            for (std::size_t k = 0; k < 9; ++k)
                c[k / 3][k % 3] = static_cast<double>(records[i][k]);
            mesh.add(c);
        }
    }
}

Error with_slab(std::size_t slab, const Error& e) {
    return Error(e.code(), fmt::format("in slab {}: {}", slab, e.what()));
}

}  // namespace

SlabRun::SlabRun(SlabOptions options) : options_(std::move(options)), job_(job_of(options_)) {}

std::string SlabRun::path(const char* kind, std::size_t slab) const {
    return fmt::format("{}/{}-{:05}", options_.folder, kind, slab);
}

std::string SlabRun::scratch(std::size_t slab, std::size_t operand, std::size_t share) const {
    return fmt::format("{}.{}.{}", path("slab", slab), operand, share);
}

namespace {

constexpr double patience = 60;  // seconds; processes of a launcher that was killed end sooner

bool is_of_job(const std::filesystem::path& file) {
    return file.filename().string().starts_with("job");
}

// What says whose it is goes last: the next run must know what a killed one left. The lock stays.
void empty_folder(const std::string& name) {
    std::vector<std::filesystem::path> others;
    std::vector<std::filesystem::path> own;
    for (const auto& entry : std::filesystem::directory_iterator(name))
        (is_of_job(entry.path()) ? own : others).push_back(entry.path());
    std::erase(own, std::filesystem::path(lock_name(name)));
    for (const std::filesystem::path& p : others) std::filesystem::remove_all(p);
    for (const std::filesystem::path& p : own) std::filesystem::remove_all(p);
}

bool is_of_another(const std::string& folder) {
    if (!std::filesystem::exists(folder) || std::filesystem::is_empty(folder)) return false;
    return std::ranges::none_of(std::filesystem::directory_iterator(folder),
                                [](const auto& entry) { return is_of_job(entry.path()); });
}

bool can_be_streamed(const std::string& name) {
    try {
        (void)TriangleStream::open(name);
        return true;
    } catch (const UnsupportedError&) {
        return false;
    }
}

}  // namespace

// Its first file says of which job it is, so it is known from the beginning.
void SlabRun::begin() {
    if (!options_.natives.empty()) make_folder(options_.natives);
    if (is_of_another(options_.folder))
        throw Error(ErrorCode::Usage, options_.folder + ": is there already, and not of trisect");
    lock_.take(options_.folder, patience);
    if (options_.resume && has_plan())
        take_plan();
    else
        begin_anew();
    lock_.share();
}

void SlabRun::join_folder() { lock_.join(options_.folder); }

void SlabRun::begin_anew() {
    empty_folder(options_.folder);
    OutputStream out(options_.folder + "/job");
    out.write(job_.data(), job_.size());
    out.finish();
}

void SlabRun::gather() const {
    for (std::size_t k = 0; k < options_.inputs.size(); ++k) {
        const std::string name = gathered_name(options_, k);
        if (!std::filesystem::exists(name) && !can_be_streamed(options_.inputs[k]))
            gather_triangles(options_.inputs[k], name);
    }
}

bool SlabRun::has_plan() const { return read_plan(options_.folder + "/plan", job_).has_value(); }

void SlabRun::survey(std::size_t share, std::size_t shares) const {
    write_surveys(path("survey", share), survey_share(options_, share, shares));
}

void SlabRun::decide(std::size_t shares) {
    std::vector<Survey> surveys(options_.inputs.size());
    for (std::size_t s = 0; s < shares; ++s) {
        const std::vector<Survey> share = read_surveys(path("survey", s), surveys.size());
        for (std::size_t i = 0; i < surveys.size(); ++i) surveys[i].add(share[i]);
    }
    plan_ = make_plan(options_, surveys);
    write_plan(options_.folder + "/plan", plan_, job_);
    for (std::size_t s = 0; s < shares; ++s) std::filesystem::remove(path("survey", s));
}

void SlabRun::plan() {
    begin();
    gather();
    if (has_plan()) return;
    survey(0, 1);
    decide(1);
}

void SlabRun::take_plan() {
    const auto found = read_plan(options_.folder + "/plan", job_);
    if (!found)
        throw Error(ErrorCode::Input, options_.folder + ": another process sees no plan there");
    plan_ = *found;
}

std::vector<std::size_t> SlabRun::order() const {
    std::vector<std::size_t> out(count());
    std::iota(out.begin(), out.end(), 0);
    std::ranges::stable_sort(out, std::ranges::greater(),
                             [&](std::size_t i) { return plan_.slabs.load(i); });
    return out;
}

std::size_t SlabRun::distributed() const {
    std::ifstream file(options_.folder + "/distributed");
    std::size_t shares = 0;
    return file >> shares ? shares : 0;
}

void SlabRun::note_distributed(std::size_t shares) {
    OutputStream out(options_.folder + "/distributed");
    const std::string text = std::to_string(shares);
    out.write(text.data(), text.size());
    out.finish();
}

bool SlabRun::distribute(std::size_t share, std::size_t shares) {
    const Slabs& slabs = plan_.slabs;
    bool fits = true;
    for (std::size_t k = 0; k < options_.inputs.size(); ++k) {
        const auto stream = open_operand(options_, k);
        for (std::size_t i = 0; i < count(); ++i) std::filesystem::remove(scratch(i, k, share));
        Distributor out(count(), stream->is_single(),
                        [&](std::size_t i) { return scratch(i, k, share); });
        const std::uint64_t begin = stream->size() * share / shares;
        const std::uint64_t end = stream->size() * (share + 1) / shares;
        stream->read(begin, end, [&](std::uint64_t, const Corners& c) {
            const std::array<double, 3> x{c[0][slabs.axis()], c[1][slabs.axis()],
                                          c[2][slabs.axis()]};
            const auto [low, high] = std::ranges::minmax(x);
            const auto range = slabs.slabs_at(low, high);
            if (range[0] + 1 != range[1])
                fits = fits &&
                       std::ranges::none_of(x, [&](double at) { return slabs.has_wall_at(at); });
            for (std::size_t i = range[0]; i < range[1]; ++i) out.add(i, c);
        });
        out.finish();
    }
    return fits;
}

void SlabRun::move_walls() {
    plan_.slabs.move_walls();
    write_plan(options_.folder + "/plan", plan_, job_);
}

bool SlabRun::is_done(std::size_t slab) const {
    return std::filesystem::exists(path("piece", slab));
}

Solid SlabRun::operand_in(std::size_t slab, std::size_t operand, std::size_t shares) const {
    const Slabs& slabs = plan_.slabs;
    SlabMesh mesh({slabs.axis(), slabs.low(slab) - slabs.margin(),
                   slabs.high(slab) + slabs.margin(), slabs.quantum(), slabs.bound()});
    const bool single = open_operand(options_, operand)->is_single();
    std::uint64_t bytes = 0;
    for (std::size_t s = 0; s < shares; ++s)
        bytes += std::filesystem::file_size(scratch(slab, operand, s));
    if (bytes == 0) return {};
    mesh.reserve(bytes / (9 * (single ? sizeof(float) : sizeof(double))));
    for (std::size_t s = 0; s < shares; ++s)
        single ? read_scratch<float>(scratch(slab, operand, s), mesh)
               : read_scratch<double>(scratch(slab, operand, s), mesh);
    mesh.close();
    ImportedMesh imported = import_mesh(TriangleView{mesh.points(), mesh.triangles()});
    if (!imported.report.lattice.lossless)
        throw LimitError(options_.inputs[operand] + ": coordinates span more than 126 bits");
    return options_.embedding == Embedding::Check
               ? operand_within(std::move(imported.mesh))
               : Solid::from_lattice_mesh(std::move(imported.mesh), options_.embedding);
}

Expression SlabRun::formula_of(const std::vector<Solid>& operands) const {
    if (options_.operation == "union") return Expression::any_of(std::span(operands));
    if (options_.operation == "intersection") return Expression::all_of(std::span(operands));
    return operands[0] - Expression::any_of(std::span(operands).subspan(1));
}

void SlabRun::evaluate(std::size_t slab, std::size_t shares, const EvaluateOptions& options) try {
    const Slabs& slabs = plan_.slabs;
    const double bound = slabs.bound();
    Point3d low{-bound, -bound, -bound};
    Point3d high{bound, bound, bound};
    if (slab != 0) low[slabs.axis()] = slabs.low(slab);
    if (slab + 1 != slabs.count()) high[slabs.axis()] = slabs.high(slab);
    const Solid window = Solid::from_mesh(make_box(low, high));
    ExactMesh mesh;
    {
        std::vector<Solid> operands;
        for (std::size_t k = 0; k < options_.inputs.size(); ++k)
            operands.push_back(operand_in(slab, k, shares));
        EvaluateReport report;
        const Solid part = evaluate_within(window, formula_of(operands), options, &report);
        if (!report.lattice.lossless)
            throw LimitError("the operands together span more than 126 bits");
        operands.clear();
        mesh = part.to_exact_mesh(options.threads);
        if (!options_.natives.empty())
            write_native(part, fmt::format("{}/slab-{:05}.trisect", options_.natives, slab));
    }
    write_piece(path("piece", slab), piece_of(mesh, window.source_id(), slabs.axis(),
                                              low[slabs.axis()] / 2 + high[slabs.axis()] / 2));
    for (std::size_t k = 0; k < options_.inputs.size(); ++k)
        for (std::size_t s = 0; s < shares; ++s) std::filesystem::remove(scratch(slab, k, s));
} catch (const Error& e) {
    throw with_slab(slab, e);
}

PieceJoin SlabRun::joining() const {
    JoinFiles files{{}, {}, options_.output, options_.folder + "/joined"};
    for (std::size_t i = 0; i < count(); ++i) {
        files.pieces.push_back(path("piece", i));
        files.links.push_back(path("link", i));
    }
    return PieceJoin(std::move(files));
}

JoinedMesh SlabRun::join() const {
    const PieceJoin joining = this->joining();
    for (std::size_t i = 0; i < count(); ++i) joining.link(i);
    const JoinedMesh made = joining.begin();
    joining.write(0, 1);
    joining.finish();
    return made;
}

void SlabRun::clean() const {
    if (!lock_.is_held()) return;
    std::ifstream file(options_.folder + "/job");
    std::string job;
    if (!std::getline(file, job) || job != job_) return;
    try {
        empty_folder(options_.folder);
        std::filesystem::remove_all(options_.folder);
    } catch (const std::filesystem::filesystem_error&) {
        return;  // the result is there
    }
}

}  // namespace trisect::app
