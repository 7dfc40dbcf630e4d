// SPDX-License-Identifier: Apache-2.0
//
// view A MORE --op difference -o page.html: a page that shows a solid in a browser.
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "commands.h"
#include "output_name.h"
#include "queried_set.h"
#include "view_page.h"

namespace trisect::app {
namespace {

std::string title_of(const ViewOptions& options, const std::vector<std::string>& names) {
    if (names.size() == 1) return names[0];
    return fmt::format("{} of {} solids", options.set.operation, names.size());
}

ViewedSolid viewed(const ViewOptions& options, const QueriedSet& set, Brep brep) {
    ViewedSolid out;
    for (const std::string& name : options.set.inputs)
        out.operands.push_back(std::filesystem::path(name).filename().string());
    out.title = title_of(options, out.operands);
    for (const FaceId f : brep.faces())
        out.operand_of.push_back(set.operand_number(brep.source(f).operand));
    out.brep = std::move(brep);
    if (set.operands.size() > 1 && !options.no_inputs)
        for (const Operand& o : set.operands) out.inputs.push_back(o.solid.to_mesh());
    return out;
}

}  // namespace

void add_view_command(CLI::App& app, ViewOptions& options) {
    CLI::App* command = app.add_subcommand("view", "a page (HTML) that shows a solid in a browser");
    add_query_options(*command, options.set);
    command->add_option("-o,--output", options.output, "page; '-' is the standard output")
        ->required()
        ->type_name("FILE");
    command->add_flag("--no-inputs", options.no_inputs,
                      "leave the inputs out of the page of a boolean");
}

Outcome run_view(Session& session, const ViewOptions& options) {
    check_output_name(session, options.output, ".html");
    check_outputs(session, {options.output});
    session.plan(5);
    const QueriedSet set = read_set(session, options.set);
    Brep brep = session.interruptible_stage("assemble", [&] { return set.solid.to_brep(); });
    const BrepCounts counts = brep.counts();
    const std::string page =
        session.stage("page", [&] { return page_text(viewed(options, set, std::move(brep))); });
    session.stage("write", [&] { session.write_output(options.output, page); });
    Outcome out;
    out.document["schema"] = "trisect.view/1";
    describe_inputs(options.set, set, out.document);
    out.document["output"] = options.output;
    out.document["bytes"] = page.size();
    out.document["faces"] = counts.faces;
    out.document["edges"] = counts.edges;
    out.document["vertices"] = counts.vertices;
    out.document["seconds"] = session.seconds();
    out.remarks = fmt::format("page         {} faces, {} edges, {} vertices, {} bytes\n",
                              counts.faces, counts.edges, counts.vertices, page.size());
    return out;
}

}  // namespace trisect::app
