// SPDX-License-Identifier: Apache-2.0
#include "rank_task.h"

#include "message.h"

namespace trisect::app {
namespace {

void put_groups(MessageWriter& out, const std::vector<bool>& groups) {
    out.put(std::uint64_t{groups.size()});
    for (const bool is_in : groups) out.put(is_in);
}

std::vector<bool> get_groups(MessageReader& in) {
    std::vector<bool> out(in.get<std::uint64_t>());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = in.get<bool>();
    return out;
}

void put_file(MessageWriter& out, const ClashFile& file) {
    out.put(file.box.has_value());
    out.put(file.box.value_or(Bounds{}));
    out.put(file.triangles);
    out.put_text(file.failure);
}

ClashFile get_file(MessageReader& in) {
    ClashFile out;
    const bool has_box = in.get<bool>();
    const auto box = in.get<Bounds>();
    if (has_box) out.box = box;
    out.triangles = in.get<std::uint64_t>();
    out.failure = in.get_text();
    return out;
}

}  // namespace

std::string bytes_of(const RankStart& start) {
    MessageWriter out;
    out.put_text(start.manifest);
    out.put_text(start.key);
    out.put(start.groups);
    out.put(std::uint64_t{start.sets.size()});
    for (const ClashSet& set : start.sets) {
        out.put_text(set.name);
        put_groups(out, set.a);
        put_groups(out, set.b);
        out.put(set.mode);
        out.put(set.clearance);
    }
    return out.take();
}

RankStart rank_start_of(const std::string& bytes) {
    MessageReader in(bytes);
    RankStart out;
    out.manifest = in.get_text();
    out.key = in.get_text();
    out.groups = in.get<std::uint64_t>();
    out.sets.resize(in.get<std::uint64_t>());
    for (ClashSet& set : out.sets) {
        set.name = in.get_text();
        set.a = get_groups(in);
        set.b = get_groups(in);
        set.mode = in.get<ClashMode>();
        set.clearance = in.get<double>();
    }
    return out;
}

std::string bytes_of(const RankTask& task) {
    MessageWriter out;
    out.put(task.kind);
    out.put(task.piece);
    out.put(std::uint64_t{task.files.size()});
    for (const std::string& name : task.files) out.put_text(name);
    out.put(task.cell);
    out.put(std::uint64_t{task.parts.size()});
    for (const TilePart& part : task.parts) {
        out.put(part.box);
        out.put(part.file);
        out.put_text(part.id);
        out.put(part.pose);
    }
    return out.take();
}

RankTask rank_task_of(const std::string& bytes) {
    MessageReader in(bytes);
    RankTask out;
    out.kind = in.get<RankTask::Kind>();
    out.piece = in.get<std::uint64_t>();
    out.files.resize(in.get<std::uint64_t>());
    for (std::string& name : out.files) name = in.get_text();
    out.cell = in.get<Bounds>();
    out.parts.resize(in.get<std::uint64_t>());
    for (TilePart& part : out.parts) {
        part.box = in.get<ClashBox>();
        part.file = in.get<std::uint32_t>();
        part.id = in.get_text();
        part.pose = in.get<std::array<double, 12>>();
    }
    return out;
}

std::string bytes_of(const RankResult& result) {
    MessageWriter out;
    out.put(result.kind);
    out.put(result.piece);
    put_file(out, result.file);
    out.put(result.slices);
    out.put_text(result.records.empty()
                     ? "[]"
                     : result.records.dump(-1, ' ', false, Json::error_handler_t::replace));
    out.put(result.code);
    out.put_text(result.message);
    out.put(result.pairs);
    out.put(result.work);
    out.put(result.seconds);
    out.put(result.memory);
    out.put(result.reads);
    out.put(result.received);
    return out.take();
}

RankResult rank_result_of(const std::string& bytes) {
    MessageReader in(bytes);
    RankResult out;
    out.kind = in.get<RankResult::Kind>();
    out.piece = in.get<std::uint64_t>();
    out.file = get_file(in);
    out.slices = in.get<std::uint32_t>();
    out.records = Json::parse(in.get_text());
    out.code = in.get<int>();
    out.message = in.get_text();
    out.pairs = in.get<std::uint64_t>();
    out.work = in.get<std::uint64_t>();
    out.seconds = in.get<double>();
    out.memory = in.get<std::uint64_t>();
    out.reads = in.get<std::uint64_t>();
    out.received = in.get<std::uint64_t>();
    return out;
}

std::string bytes_of(const SharedParts& share) {
    MessageWriter out;
    out.put(share.number);
    out.put(share.parts.has_value());
    if (!share.parts) return out.take();
    for (const auto* const names : {&share.parts->files, &share.parts->groups}) {
        out.put(std::uint64_t{names->size()});
        for (const std::string& name : *names) out.put_text(name);
    }
    out.put(std::uint64_t{share.parts->parts.size()});
    for (const ClashPart& part : share.parts->parts) {
        out.put_text(part.id);
        out.put_text(part.name == part.id ? std::string() : part.name);
        out.put(part.file);
        out.put(part.group);
        out.put(part.pose);
    }
    return out.take();
}

SharedParts shared_parts_of(const std::string& bytes) {
    MessageReader in(bytes);
    SharedParts out;
    out.number = in.get<std::uint64_t>();
    if (!in.get<bool>()) return out;
    ManifestShare& share = out.parts.emplace();
    for (auto* const names : {&share.files, &share.groups}) {
        names->resize(in.get<std::uint64_t>());
        for (std::string& name : *names) name = in.get_text();
    }
    share.parts.resize(in.get<std::uint64_t>());
    for (ClashPart& part : share.parts) {
        part.id = in.get_text();
        part.name = in.get_text();
        if (part.name.empty()) part.name = part.id;  // no name is empty
        part.file = in.get<std::uint32_t>();
        part.group = in.get<std::uint32_t>();
        part.pose = in.get<std::array<double, 12>>();
    }
    return out;
}

Json file_json(const ClashFile& file) {
    Json out;
    if (file.box) {
        out["lo"] = file.box->lo;
        out["hi"] = file.box->hi;
    }
    out["triangles"] = file.triangles;
    if (!file.failure.empty()) out["error"] = file.failure;
    return out;
}

ClashFile file_of_json(const Json& json) {
    ClashFile out;
    if (json.contains("lo")) {
        Bounds box;
        box.lo = json.at("lo").get<std::array<double, 3>>();
        box.hi = json.at("hi").get<std::array<double, 3>>();
        out.box = box;
    }
    out.triangles = json.at("triangles").get<std::uint64_t>();
    out.failure = json.value("error", std::string());
    return out;
}

}  // namespace trisect::app
