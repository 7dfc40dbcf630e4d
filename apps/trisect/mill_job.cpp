// SPDX-License-Identifier: Apache-2.0
//
// Speed rests on the lattice: a cut is cheap where the tool's coordinates are whole numbers of the
// stock's unit. A stock of few digits has a coarse lattice (whole millimetres), on which no tool
// can be placed; it is imported to the finer lattice of the grid instead, which changes none of its
// coordinates.
#include "mill_job.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "mesh_files.h"
#include "operand.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t hashed_file_limit = std::uint64_t{16} << 30;

/// Of Fowler, Noll and Vo: enough to notice that an input was changed.
class InputHash {
public:
    void add(std::string_view bytes) {
        for (const char c : bytes) {
            value_ ^= static_cast<unsigned char>(c);
            value_ *= 0x100000001b3U;
        }
        value_ ^= bytes.size();
    }
    void add_file(const std::string& name) {
        if (name != "-") add(read_file(name, hashed_file_limit).view());
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

std::uint64_t hash_of(const MillOptions& o, int grid) {
    InputHash hash;
    for (const std::string* name : {&o.stock, &o.tool, &o.holder, &o.path}) hash.add_file(*name);
    for (const std::string& name : o.fixtures) hash.add_file(name);
    hash.add(fmt::format("{} {} {} {} {} {}", grid, number_text(o.chord), number_text(o.feed),
                         number_text(o.rapid_feed), o.touch, o.between));
    return hash.value();
}

double largest_coordinate(std::span<const Point3d> points) {
    double largest = 0;
    for (const Point3d& p : points)
        for (const double c : p) largest = std::max(largest, std::abs(c));
    return largest;
}

/// The largest coordinate of anything that is cut or moves.
double largest_of(const MillJob& job, const PolygonMesh& tool) {
    double largest = 0;
    for (const ToolMove& m : job.path.moves)
        largest = std::max(largest, largest_coordinate({&m.to, 1}));
    largest += largest_coordinate(tool.points);
    if (job.stock_bounds)
        largest = std::max(
            largest, largest_coordinate(std::array{job.stock_bounds->lo, job.stock_bounds->hi}));
    return largest;
}

/// The stock on a lattice as fine as the grid.
Solid stock_on_grid(Session& session, const MillOptions& options, const Operand& operand,
                    int grid) {
    if (operand.solid.lattice().exponent <= grid || has_exact_boundary(options.stock))
        return operand.solid;
    ImportOptions import;
    import.lattice = Lattice{grid};
    import.nonplanar = session.options().nonplanar;
    ImportedMesh imported = import_mesh(read_input(session, options.stock), import);
    const bool is_free = options.operands.assume_embedded || is_embedded(imported.mesh);
    return Solid::from_import(std::move(imported), is_free ? Embedding::Assume : Embedding::Check);
}

MillBody body_of(const Session& session, std::string name, const Operand& operand,
                 const OperandOptions& options) {
    return {std::move(name), resolved(session, operand.solid, options), operand.solid.source_id()};
}

/// The mesh as it is in the file: where shells overlap they are not joined.
PolygonMesh shells_in(const Session& session, const std::string& name, const Operand& operand) {
    return has_exact_boundary(name) ? operand.solid.to_mesh() : read_input(session, name);
}

MillTool swept_holder(const Session& session, const MillOptions& options, const Operand& operand,
                      MillJob& job) {
    const PolygonMesh mesh = shells_in(session, options.holder, operand);
    try {
        return MillTool(mesh, options.holder, job.grid, job.path.orientations);
    } catch (const UnsupportedError& e) {
        throw UnsupportedError(std::string(e.what()) +
                               " (--ends-only checks the holder at the ends of moves alone)");
    }
}

void make_steps(MillJob& job, const MillOptions& options) {
    Point3d at{};
    double time = 0;
    for (const ToolMove& move : job.path.moves) {
        MillStep step;
        step.is_rapid = move.is_rapid;
        step.is_placement = move.is_placement;
        step.orientation = move.orientation;
        step.line = move.line;
        step.to = job.grid.rounded(move.to);
        step.from = move.is_placement ? step.to : at;
        const Point3d a = job.grid.to_user(at);
        const Point3d b = job.grid.to_user(step.to);
        const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        if (!job.steps.empty())
            time += 60 * length / (move.feed > 0 ? move.feed : options.rapid_feed);
        step.end_time = time;
        const bool stands_still = !job.steps.empty() && !move.is_placement && step.to == at;
        at = step.to;
        if (!stands_still) job.steps.push_back(step);
    }
}

void describe_path(MillJob& job) {
    Json path;
    path["file"] = job.path.file;
    path["moves"] = job.path.moves.size();
    path["arcs"] = job.path.arcs;
    path["steps"] = job.steps.size();
    path["orientations"] = job.path.orientations.size();
    path["seconds"] = job.steps.empty() ? 0 : job.steps.back().end_time;
    path["notes"] = job.path.notes;
    job.facts["path"] = std::move(path);
    job.facts["grid"] = {{"exponent", job.grid.exponent()},
                         {"lattice", job.grid.lattice().exponent},
                         {"max_move", job.grid.max_move()},
                         {"tool_volume_added", job.tool->added_volume()}};
}

}  // namespace

Pose MillJob::pose_after(const MillStep& step) const {
    const Point3d p = grid.to_user(step.to);
    const std::array<double, 9>& m = path.orientations.at(step.orientation);
    return Pose::from_doubles(
        {m[0], m[1], m[2], p[0], m[3], m[4], m[5], p[1], m[6], m[7], m[8], p[2]});
}

MillJob read_mill_job(Session& session, const MillOptions& options) {
    MillJob job;
    job.path = read_tool_path(options.path, {options.chord, options.feed});
    for (const std::string& note : job.path.notes) session.note(job.path.file + ": " + note);
    std::vector<std::string> names{options.stock, options.tool, options.holder};
    names.insert(names.end(), options.fixtures.begin(), options.fixtures.end());
    const std::vector<Operand> operands = read_operands(session, names, options.operands);
    for (const Operand& operand : operands) job.facts["inputs"].push_back(operand.facts);
    job.stock_bounds = bounds(operands[0].solid);
    const PolygonMesh tool = shells_in(session, options.tool, operands[1]);
    const int wanted = options.grid.value_or(MillGrid::exponent_for(largest_of(job, tool)));
    const Solid stock = stock_on_grid(session, options, operands[0], wanted);
    job.stock_source = stock.source_id();
    job.stock = resolved(session, stock, options.operands);
    job.stock_volume = volume(job.stock);
    job.stock.refine();
    job.grid = MillGrid(stock.lattice(), wanted);
    job.tool.emplace(tool, options.tool, job.grid, job.path.orientations);
    job.holder = body_of(session, "holder", operands[2], options.operands);
    if (options.between) job.holder_parts = swept_holder(session, options, operands[2], job);
    for (std::size_t i = 0; i < options.fixtures.size(); ++i)
        job.fixtures.push_back(
            body_of(session, options.fixtures[i], operands[3 + i], options.operands));
    make_steps(job, options);
    job.hash = hash_of(options, job.grid.exponent());
    describe_path(job);
    return job;
}

}  // namespace trisect::app
