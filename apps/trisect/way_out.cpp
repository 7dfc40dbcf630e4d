// SPDX-License-Identifier: Apache-2.0
#include "way_out.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace trisect::app {
namespace {

constexpr std::string_view nothing = "nothing is needed";

// In the order of DefectKind.
constexpr std::array<std::string_view, defect_kind_count> ways{
    "'trisect mend --seams D' closes gaps up to D, '--fill' planar holes",
    "'trisect mend --orient' turns faces over",
    nothing,
    "nothing is needed; 'trisect mend --seams 0' puts corners into the edges",
    nothing,
    "nothing is needed; 'trisect mend --seams 0' leaves it out",
    "nothing is needed; 'trisect mend --seams 0' leaves it out",
    "nothing is needed; '--nonplanar refit' moves corners",
    "'trisect resolve'; better cut the face into triangles where the mesh comes from",
    "'trisect mend --drop', or 'trisect resolve'",
    "'trisect mend --drop', or 'trisect resolve'",
    "'trisect resolve'",
    "nothing is needed; 'trisect resolve' takes the contact apart",
    nothing,
    nothing,
    "'trisect mend --shells' turns it over, or 'trisect resolve --winding nonzero'",
    "'trisect mend --shells' makes cavities of inner shells, 'trisect resolve' takes them as "
    "material",
    "none: such a B-rep was not made by this library",
    nothing,
};

template <class Visit>
void for_each_kind(const ValidationReport& report, Visit&& visit) {
    for (std::size_t k = 0; k < defect_kind_count; ++k)
        if (const auto kind = static_cast<DefectKind>(k); report.count(kind) != 0) visit(kind);
}

}  // namespace

std::string_view way_out(DefectKind kind) { return ways[static_cast<std::size_t>(kind)]; }

std::string ways_out_text(const ValidationReport& report) {
    std::string out;
    for_each_kind(report, [&](DefectKind kind) {
        out += fmt::format("way out of {}: {}\n", name_of(kind), way_out(kind));
    });
    return out;
}

std::string way_out_hint(const ValidationReport& report) {
    std::string out;
    for_each_kind(report, [&](DefectKind kind) {
        if (severity_of(kind) != Severity::Error) return;
        out += fmt::format("{}{}: {}", out.empty() ? "" : "; ", name_of(kind), way_out(kind));
        // Import does not look why an edge is open.
        if (kind == DefectKind::OpenEdge)
            out += ", '--orient' turns faces over if 'trisect check' finds flipped ones";
    });
    return out;
}

}  // namespace trisect::app
