// SPDX-License-Identifier: Apache-2.0
#include "part_messages.h"

#include <utility>

#include "message.h"
#include "rank_task.h"

namespace trisect::app {

// FNV-1a, whose low bits alone are not mixed well.
std::uint64_t identity_hash(std::string_view id) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    hash = (hash ^ (hash >> 32)) * 0x9e3779b97f4a7c15U;
    return hash ^ (hash >> 29);
}

BoxedPart boxed(ClashPart part, const std::vector<ClashFile>& files) {
    const Bounds box = posed_box(files[part.file].box.value(), part.pose);
    const std::uint64_t hash = identity_hash(part.id);
    return {std::move(part), box, hash};
}

std::string bytes_of(const ManifestSummary& summary) {
    MessageWriter out;
    out.put(summary.is_whole);
    out.put(summary.has_twice);
    out.put(summary.parts);
    out.put_texts(summary.files);
    out.put_texts(summary.groups);
    out.put(std::uint64_t{summary.blocks.size()});
    for (const auto& [block, id] : summary.blocks) {
        out.put(block);
        out.put_text(id);
    }
    return out.take();
}

ManifestSummary manifest_summary_of(const std::string& bytes) {
    MessageReader in(bytes);
    ManifestSummary out;
    out.is_whole = in.get<bool>();
    out.has_twice = in.get<bool>();
    out.parts = in.get<std::uint64_t>();
    out.files = in.get_texts();
    out.groups = in.get_texts();
    out.blocks.resize(in.get<std::uint64_t>());
    for (auto& [block, id] : out.blocks) {
        block = in.get<std::uint64_t>();
        id = in.get_text();
    }
    return out;
}

std::string bytes_of(const std::vector<ClashFile>& files) {
    MessageWriter out;
    out.put(std::uint64_t{files.size()});
    for (const ClashFile& file : files) put_file(out, file);
    return out.take();
}

std::vector<ClashFile> clash_files_of(const std::string& bytes) {
    MessageReader in(bytes);
    std::vector<ClashFile> out(in.get<std::uint64_t>());
    for (ClashFile& file : out) file = get_file(in);
    return out;
}

std::string bytes_of(const PartSurvey& survey) {
    MessageWriter out;
    out.put(survey.boxes);
    out.put_list(survey.sample);
    out.put(std::uint64_t{survey.missing.size()});
    for (const auto& [file, id] : survey.missing) {
        out.put(file);
        out.put_text(id);
    }
    out.put_text(survey.failed_part);
    out.put_text(survey.failure);
    out.put(survey.code);
    return out.take();
}

PartSurvey part_survey_of(const std::string& bytes) {
    MessageReader in(bytes);
    PartSurvey out;
    out.boxes = in.get<std::uint64_t>();
    out.sample = in.get_list<SampledBox>();
    out.missing.resize(in.get<std::uint64_t>());
    for (auto& [file, id] : out.missing) {
        file = in.get<std::uint32_t>();
        id = in.get_text();
    }
    out.failed_part = in.get_text();
    out.failure = in.get_text();
    out.code = in.get<int>();
    return out;
}

std::string bytes_of(const RegionPlan& plan) {
    MessageWriter out;
    out.put_list(plan.regions.nodes());
    out.put_list(plan.regions.cells());
    out.put(plan.most_load);
    out.put_list(plan.owners);
    return out.take();
}

RegionPlan region_plan_of(const std::string& bytes) {
    MessageReader in(bytes);
    auto nodes = in.get_list<ClashDivision::Node>();
    auto cells = in.get_list<Bounds>();
    const auto most_load = in.get<double>();
    return {ClashDivision(std::move(nodes), std::move(cells)), most_load,
            in.get_list<std::uint32_t>()};
}

std::string bytes_of(const TileSurvey& survey) {
    MessageWriter out;
    out.put(std::uint64_t{survey.regions.size()});
    for (const auto& [region, tiles] : survey.regions) {
        out.put(region);
        out.put_list(tiles);
    }
    return out.take();
}

TileSurvey tile_survey_of(const std::string& bytes) {
    MessageReader in(bytes);
    TileSurvey out;
    out.regions.resize(in.get<std::uint64_t>());
    for (auto& [region, tiles] : out.regions) {
        region = in.get<std::uint32_t>();
        tiles = in.get_list<TileFacts>();
    }
    return out;
}

}  // namespace trisect::app
