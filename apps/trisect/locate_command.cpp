// SPDX-License-Identifier: Apache-2.0
//
// locate A --points FILE: where points are: inside, outside, or on which face, edge or vertex of
// the boundary. Points are taken exactly as given, so "on" means on and nothing else.
#include <trisect/bsp/brep_index.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "commands.h"
#include "locate_points.h"
#include "mesh_files.h"
#include "queried_set.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::array kinds{Location::Inside, Location::Outside, Location::OnFace, Location::OnEdge,
                           Location::OnVertex};

std::string place_text(const Place& place) {
    switch (place.location) {
        case Location::OnFace:
            return fmt::format("face {}", place.face.index);
        case Location::OnEdge:
            return fmt::format("edge {}", place.edge.index);
        case Location::OnVertex:
            if (place.vertex.is_valid()) return fmt::format("vertex {}", place.vertex.index);
            // Edges that cross: there is no vertex in the boundary, but a point of several edges.
            return fmt::format("edge {}", place.edge.index);
        case Location::Inside:
        case Location::Outside:
            break;
    }
    return to_string(place.location);
}

/// The faces of the inputs that meet there.
Json sources_json(const Place& place, const QueriedSet& set) {
    Json list = Json::array();
    for (std::size_t i = 0; i < place.face_count; ++i) {
        const auto operand = set.operand_number(place.faces[i].operand);
        Json entry;
        entry["input"] = operand ? Json(*operand) : Json();
        entry["face"] = place.faces[i].face;
        list.push_back(std::move(entry));
    }
    return list;
}

Json place_json(const std::array<double, 3>& point, const Place& place, const QueriedSet& set) {
    Json entry;
    entry["point"] = point;
    entry["location"] = to_string(place.location);
    if (place.face.is_valid()) entry["face"] = place.face.index;
    if (place.edge.is_valid()) entry["edge"] = place.edge.index;
    if (place.vertex.is_valid()) entry["vertex"] = place.vertex.index;
    if (place.is_on_boundary()) entry["sources"] = sources_json(place, set);
    return entry;
}

Json counts_json(const std::vector<Place>& places) {
    Json counts;
    for (const Location kind : kinds) {
        counts[to_string(kind)] =
            std::count_if(places.begin(), places.end(),
                          [kind](const Place& place) { return place.location == kind; });
    }
    return counts;
}

std::vector<std::array<double, 3>> points_of(const LocateOptions& options) {
    std::vector<std::array<double, 3>> points = options.points;
    if (options.points_file.empty()) return points;
    const auto read = read_points(options.points_file);
    points.insert(points.end(), read.begin(), read.end());
    return points;
}

void check_options(const LocateOptions& options) {
    if (options.points_file.empty() && options.points.empty()) {
        throw UsageError("which points? --points FILE or --point X,Y,Z");
    }
    std::vector<std::string> names = options.set.inputs;
    names.push_back(options.points_file);
    check_standard_input(names);
}

}  // namespace

void add_locate_command(CLI::App& app, LocateOptions& options) {
    CLI::App* command =
        app.add_subcommand("locate", "where points are: inside, outside, face N, edge N, vertex N");
    add_query_options(*command, options.set);
    command
        ->add_option("--points", options.points_file,
                     "file of points, three numbers a line; '-' is the standard input")
        ->type_name("FILE");
    command
        ->add_option_function<std::vector<std::string>>(
            "--point",
            [&options](const auto& texts) {
                for (const std::string& s : texts) {
                    options.points.push_back(parse_tuple<3>(s, "--point"));
                }
            },
            "one point; may be repeated, and comes before those of a file")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("X,Y,Z");
}

Outcome run_locate(Session& session, const LocateOptions& options) {
    check_options(options);
    session.plan(4);
    const auto points = points_of(options);
    const QueriedSet set = read_set(session, options.set);
    const BrepIndex index =
        session.stage("index", [&] { return BrepIndex(set.solid).with_brep(); });
    const auto threads = static_cast<unsigned>(std::max(0, session.options().threads));
    const std::vector<Place> places =
        session.stage("locate", [&] { return index.locate(points, threads); });
    Outcome out;
    out.document["schema"] = "trisect.locate/1";
    describe_inputs(options.set, set, out.document);
    out.document["counts"] = counts_json(places);
    out.document["points"] = Json::array();
    if (session.options().json) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            out.document["points"].push_back(place_json(points[i], places[i], set));
        }
    } else {
        for (const Place& place : places) out.answer += place_text(place) + "\n";
    }
    out.document["seconds"] = session.seconds();
    return out;
}

}  // namespace trisect::app
