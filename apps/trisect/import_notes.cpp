// SPDX-License-Identifier: Apache-2.0
#include "import_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "values.h"

namespace trisect::app {
namespace {

/// Of all inputs that were rounded.
struct RoundingSum {
    std::vector<const ImportNote*> inputs;
    std::size_t moved = 0;
    double max_move = 0;
    std::size_t flipped_faces = 0;
};

RoundingSum sum_of(std::span<const ImportNote> imports) {
    RoundingSum sum;
    for (const ImportNote& note : imports) {
        const LatticeReport& lattice = note.report.lattice;
        if (lattice.lossless) continue;
        sum.inputs.push_back(&note);
        sum.moved += lattice.moved;
        sum.max_move = std::max(sum.max_move, lattice.max_move);
        sum.flipped_faces += lattice.flipped_faces;
    }
    return sum;
}

void note_all_roundings(Session& session, std::span<const ImportNote> imports) {
    const RoundingSum sum = sum_of(imports);
    if (sum.inputs.size() > 1 && !session.options().verbose) {
        session.note(fmt::format(
            "{} and {} other input{}: rounded to their lattices: {} vertices moved, by at most {}; "
            "{} faces turned over",
            sum.inputs.front()->name, sum.inputs.size() - 1, sum.inputs.size() == 2 ? "" : "s",
            sum.moved, number_text(sum.max_move), sum.flipped_faces));
        return;
    }
    for (const ImportNote* note : sum.inputs)
        note_rounding(session, note->report.lattice, note->name);
}

void note_faces(Session& session, const ImportNote& note) {
    const ImportReport& report = note.report;
    if (report.nonplanar_faces != 0 && report.refitted_faces == 0) {
        session.note(fmt::format("{}: {} faces are not planar and were cut into triangles",
                                 note.name, report.nonplanar_faces));
    }
    if (report.refitted_faces != 0) {
        session.note(fmt::format("{}: {} faces were made planar; corners moved by at most {}",
                                 note.name, report.refitted_faces,
                                 number_text(report.max_refit_move)));
    }
    if (report.degenerate_faces_dropped != 0) {
        session.detail(fmt::format("{}: {} faces without area were left out", note.name,
                                   report.degenerate_faces_dropped));
    }
}

}  // namespace

void note_imports(Session& session, std::span<const ImportNote> imports) {
    note_all_roundings(session, imports);
    for (const ImportNote& note : imports) {
        note_model(session, note.name, note.unit, note.placed);
        note_faces(session, note);
    }
}

void note_model(Session& session, const std::string& name, const std::string& unit,
                const ModelReport& placed) {
    if (!unit.empty() && unit != "millimeter") {
        session.note(fmt::format("{}: in the unit {}; nothing is scaled", name, unit));
    }
    if (placed.rounded_vertices != 0) {
        session.note(fmt::format("{}: {} vertices rounded by transforms in the file, by at most {}",
                                 name, placed.rounded_vertices, number_text(placed.largest_move)));
    }
    for (const std::string& remark : placed.remarks)
        session.note(fmt::format("{}: {}", name, remark));
    if (placed.off_plane_corners != 0) {
        session.note(fmt::format(
            "{}: {} corners are farther from the planes of their faces than the file's "
            "uncertainty, "
            "by up to {}; they stay where they are",
            name, placed.off_plane_corners, number_text(placed.largest_plane_distance)));
    }
}

void note_rounding(Session& session, const LatticeReport& report, const std::string& name) {
    if (report.lossless) return;
    session.note(fmt::format(
        "{}: rounded to the lattice of unit 2^{}: {} vertices moved, by at most {}; {} faces "
        "turned over",
        name, report.lattice.exponent, report.moved, number_text(report.max_move),
        report.flipped_faces));
}

}  // namespace trisect::app
