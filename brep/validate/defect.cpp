// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/defect.h>

#include <algorithm>
#include <charconv>

namespace trisect {

namespace {

struct KindFacts {
    std::string_view name;
    Severity severity;
};

// In the order of DefectKind.
constexpr std::array<KindFacts, defect_kind_count> kind_facts{{
    {"open_edge", Severity::Error},
    {"flipped_face", Severity::Error},
    {"non_manifold_edge", Severity::Warning},
    {"t_vertex", Severity::Warning},
    {"non_manifold_vertex", Severity::Warning},
    {"repeated_corner", Severity::Warning},
    {"degenerate_face", Severity::Warning},
    {"non_planar_face", Severity::Warning},
    {"non_simple_face", Severity::Error},
    {"duplicate_face", Severity::Error},
    {"duplicate_opposite_faces", Severity::Error},
    {"self_intersection", Severity::Error},
    {"faces_touch", Severity::Warning},
    {"duplicate_point", Severity::Warning},
    {"unused_point", Severity::Warning},
    {"inside_out_shell", Severity::Error},
    {"shell_nesting", Severity::Error},
    {"hole_outside_face", Severity::Error},
    {"empty_mesh", Severity::Warning},
}};

void append_number(std::string& out, double v) {
    std::array<char, 32> buffer{};
    const auto r = std::to_chars(buffer.data(), buffer.data() + buffer.size(), v);
    out.append(buffer.data(), r.ptr);
}

// Errors; where there are none, the warnings for which the caller refuses the mesh.
std::string error_message(const ValidationReport& report, const std::string& why) {
    std::string s = why + ": ";
    const Severity severity = report.is_solid() ? Severity::Warning : Severity::Error;
    bool first = true;
    for (std::size_t k = 0; k < defect_kind_count; ++k) {
        const auto kind = static_cast<DefectKind>(k);
        if (severity_of(kind) != severity || report.count(kind) == 0) continue;
        if (!first) s += "; ";
        first = false;
        s += std::to_string(report.count(kind));
        s += ' ';
        s += name_of(kind);
        const auto& all = report.defects();
        const auto it =
            std::find_if(all.begin(), all.end(), [&](const Defect& d) { return d.kind == kind; });
        if (it != all.end()) s += " (first: " + it->sentence + ")";
    }
    return s;
}

}  // namespace

std::string_view name_of(DefectKind kind) {
    return kind_facts[static_cast<std::size_t>(kind)].name;
}

Severity severity_of(DefectKind kind) {
    return kind_facts[static_cast<std::size_t>(kind)].severity;
}

std::size_t ValidationReport::count(Severity severity) const {
    std::size_t n = 0;
    for (std::size_t k = 0; k < defect_kind_count; ++k)
        if (kind_facts[k].severity == severity) n += counts_[k];
    return n;
}

bool ValidationReport::empty() const {
    return std::all_of(counts_.begin(), counts_.end(), [](std::size_t n) { return n == 0; });
}

std::string ValidationReport::to_string(std::size_t places) const {
    if (empty()) return "no defects\n";
    std::string s;
    for (std::size_t k = 0; k < defect_kind_count; ++k) {
        if (counts_[k] == 0) continue;
        const auto kind = static_cast<DefectKind>(k);
        s += severity_of(kind) == Severity::Error ? "error: " : "warning: ";
        s += std::to_string(counts_[k]);
        s += ' ';
        s += name_of(kind);
        s += '\n';
        std::size_t shown = 0;
        for (const Defect& d : defects_) {
            if (d.kind != kind || shown >= places) continue;
            ++shown;
            s += "  " + d.sentence + '\n';
        }
    }
    return s;
}

void ValidationReport::sort() {
    std::stable_sort(defects_.begin(), defects_.end(),
                     [](const Defect& a, const Defect& b) { return a.kind < b.kind; });
}

InvalidSolid::InvalidSolid(ValidationReport report, const std::string& why)
    : Error(ErrorCode::InvalidSolid, error_message(report, why)), report_(std::move(report)) {}

std::string place_text(const Point3d& p) {
    std::string s = "(";
    for (std::size_t i = 0; i < 3; ++i) {
        if (i != 0) s += ", ";
        append_number(s, p[i]);
    }
    s += ')';
    return s;
}

Point3d to_user(const LatticePoint& p, Lattice lattice) {
    return {lattice.to_double(p.x.to_double()), lattice.to_double(p.y.to_double()),
            lattice.to_double(p.z.to_double())};
}

}  // namespace trisect
