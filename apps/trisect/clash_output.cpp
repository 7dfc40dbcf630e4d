// SPDX-License-Identifier: Apache-2.0
#include "clash_output.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "output_name.h"

namespace trisect::app {
namespace {

enum class ReportFormat : std::uint8_t { Json, Csv, Bcf };

ReportFormat report_format_of(const std::string& name) {
    if (name.ends_with(".json")) return ReportFormat::Json;
    if (name.ends_with(".csv")) return ReportFormat::Csv;
    if (name.ends_with(".bcf") || name.ends_with(".bcfzip")) return ReportFormat::Bcf;
    throw UsageError(name + ": a report is .json, .csv, .bcf or .bcfzip");
}

std::string report_bytes(ReportFormat format, const ClashManifest& manifest,
                         const ClashReport& report, const ClashPicture& picture) {
    switch (format) {
        case ReportFormat::Json:
            return clash_json(manifest, report);
        case ReportFormat::Csv:
            return clash_csv(manifest, report);
        case ReportFormat::Bcf:
            break;
    }
    return clash_bcf(manifest, report, picture);
}

std::string first_clashes(const ClashManifest& manifest, const ClashReport& report) {
    constexpr std::size_t most_shown = 20;
    std::string out;
    Json read;
    for (std::size_t i = 0; i < std::min(most_shown, report.count()); ++i)
        out += clash_title(manifest, report.clash(i, read)) + "\n";
    if (report.count() > most_shown)
        out += fmt::format("and {} more\n", report.count() - most_shown);
    return out;
}

}  // namespace

void check_clash_outputs(const Session& session, const ClashOptions& options) {
    for (const std::string& name : options.outputs) {
        (void)report_format_of(name);
        check_outputs(session,
                      {options.outputs.front() == name ? "" : options.outputs.front(), name});
    }
}

void write_clash_outputs(Session& session, const ClashOptions& options,
                         const ClashManifest& manifest, const ClashReport& report,
                         const ClashPicture& picture) {
    const ClashPicture wanted = [&](std::size_t i) {
        return options.pictures.empty() ? std::string() : picture(i);
    };
    for (const std::string& name : options.outputs)
        session.write_output(name, report_bytes(report_format_of(name), manifest, report, wanted));
    if (options.pictures.empty()) return;
    const std::filesystem::path folder(options.pictures);
    std::filesystem::create_directories(folder);
    Json read;
    for (std::size_t i = 0; i < report.count(); ++i) {
        const std::string id = report.clash(i, read).at("id").get<std::string>();
        session.write_output((folder / (id + ".png")).string(), picture(i));
    }
}

Outcome clash_outcome(const ClashManifest& manifest, const ClashReport& report) {
    Outcome out;
    out.code = report.count() == 0 && report.is_complete() ? exit_done : exit_findings;
    out.document = clash_head_json(manifest, report);
    out.document["clashes"] = report.count();
    out.answer = first_clashes(manifest, report);
    if (!report.is_complete())
        out.remarks = fmt::format("incomplete: {} files left out, {} pairs without an answer",
                                  report.missing.size(), report.unanswered.size());
    return out;
}

}  // namespace trisect::app
