// SPDX-License-Identifier: Apache-2.0
#include "mend_report.h"

#include <trisect/brep/validate/defect.h>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "report_json.h"
#include "values.h"

namespace trisect::app {
namespace {

template <class Entry, class ToJson>
Json list_json(const std::vector<Entry>& all, std::size_t places, const ToJson& to_json) {
    Json out;
    out["count"] = all.size();
    out["first"] = Json::array();
    for (std::size_t i = 0; i < std::min(all.size(), places); ++i)
        out["first"].push_back(to_json(all[i]));
    return out;
}

Json face_json(std::uint32_t face) { return face == no_face ? Json() : Json(face); }

Json open_json(const OpenBoundary& b) {
    Json out;
    out["edges"] = b.edges;
    out["length"] = b.length;
    out["loop"] = b.is_loop;
    out["vertex"] = b.vertex;
    out["face"] = face_json(b.face);
    out["place"] = b.place;
    return out;
}

/// "3 faces turned over: 1, 5, 7, ..."
std::string faces_line(const char* title, const std::vector<std::uint32_t>& faces,
                       std::string_view what) {
    if (faces.empty()) return {};
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(faces.size(), 8); ++i)
        names += fmt::format("{}{}", i == 0 ? "" : ", ", faces[i]);
    if (faces.size() > 8) names += ", ...";
    return fmt::format("{:<13}{} {}: {}\n", title, faces.size(), what, names);
}

std::string left_text(const MendReport& report) {
    std::string out;
    for (const UnorientablePart& p : report.unorientable)
        out += fmt::format(
            "{:<13}the part of {} faces with face {} has no orientation: its faces contradict each "
            "other at the edge from vertex {} to {}\n",
            "left", p.faces, p.face, p.edge[0], p.edge[1]);
    for (const ShellLeft& s : report.shells_left)
        out += fmt::format(
            "{:<13}the shell of {} faces with face {}: {}\n", "left", s.faces, s.face,
            s.trouble == ShellTrouble::Open          ? "it is open"
            : s.trouble == ShellTrouble::NoVolume    ? "it encloses no volume"
            : s.trouble == ShellTrouble::MeetsOthers ? "it meets another shell"
                                                     : "it lies within shells that meet");
    if (report.duplicates_left != 0)
        out += fmt::format("{:<13}{} pairs of opposite faces with the same corners\n", "left",
                           report.duplicates_left);
    for (const OpenBoundary& b : report.open)
        out += fmt::format("{:<13}{} edges, {} long, {} vertex {} {}\n", "still open", b.edges,
                           number_text(b.length), b.is_loop ? "a loop at" : "at", b.vertex,
                           trisect::place_text(b.place));
    if (report.misoriented_edges != 0)
        out += fmt::format("{:<13}{} edges that faces do not run along as often each way\n",
                           "still open", report.misoriented_edges);
    return out;
}

/// Not more lines than a person reads.
std::string first_lines(const std::string& text, std::size_t most) {
    std::size_t at = 0;
    for (std::size_t line = 0; line < most; ++line) {
        at = text.find('\n', at);
        if (at == std::string::npos) return text;
        ++at;
    }
    const auto more = std::count(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), '\n');
    if (more == 0) return text;
    return text.substr(0, at) + fmt::format("{:<13}{} more; --json has them\n", "", more);
}

}  // namespace

Json mend_json(const MendReport& report, std::size_t places) {
    const auto same = [](std::uint32_t name) { return Json(name); };
    Json out;
    out["turned_faces"] = list_json(report.turned_faces, places, same);
    out["turned_shells"] = report.turned_shells;
    out["unorientable"] = list_json(report.unorientable, places, [](const UnorientablePart& p) {
        return Json{{"face", face_json(p.face)}, {"faces", p.faces}, {"edge", p.edge}};
    });
    out["shells_left"] = list_json(report.shells_left, places, [](const ShellLeft& s) {
        return Json{
            {"face", face_json(s.face)}, {"faces", s.faces}, {"trouble", name_of(s.trouble)}};
    });
    out["joined_vertices"] = list_json(report.joined, places, [](const JoinedVertex& j) {
        return Json{{"vertex", j.vertex}, {"into", j.into}, {"move", j.move}};
    });
    out["divided_edges"] = list_json(report.divided, places, [](const DividedEdge& d) {
        return Json{{"edge", d.edge}, {"vertex", d.vertex}, {"gap", d.gap}};
    });
    out["cut_faces"] = list_json(report.cut_faces, places, same);
    out["degenerate_faces"] = list_json(report.degenerate_faces, places, same);
    out["duplicate_faces"] = list_json(report.duplicate_faces, places, same);
    out["duplicates_left"] = report.duplicates_left;
    out["filled_holes"] = report.filled_holes;
    out["max_move"] = report.max_move;
    out["max_gap"] = report.max_gap;
    out["open"] = list_json(report.open, places, open_json);
    out["misoriented_edges"] = report.misoriented_edges;
    out["lattice"] = lattice_json(report.lattice);
    return out;
}

std::string mend_text(const MendReport& report) {
    std::string out;
    if (!report.joined.empty())
        out += fmt::format("{:<13}{} vertices became others, moved by {} at most\n", "joined",
                           report.joined.size(), number_text(report.max_move));
    if (!report.divided.empty())
        out += fmt::format("{:<13}edges by {} vertices, {} away at most\n", "divided",
                           report.divided.size(), number_text(report.max_gap));
    out += faces_line("cut", report.cut_faces, "faces into triangles");
    out += faces_line("left out", report.degenerate_faces, "faces without area");
    out += faces_line("left out", report.duplicate_faces, "faces that others repeat");
    if (report.filled_holes != 0)
        out += fmt::format("{:<13}{} holes\n", "filled", report.filled_holes);
    out += faces_line("turned over", report.turned_faces, "faces");
    if (report.turned_shells != 0)
        out += fmt::format("{:<13}{} shells\n", "turned over", report.turned_shells);
    if (out.empty()) out = fmt::format("{:<13}nothing\n", "mended");
    return out + first_lines(left_text(report), 12);
}

}  // namespace trisect::app
