// SPDX-License-Identifier: Apache-2.0
#include "clash_merge.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "values.h"

namespace trisect::app {
namespace {

constexpr std::int64_t most_shards = 1'000'000;

Json read_report(const std::string& name) {
    const Json out = Json::parse(read_file(name, ReadLimits().bytes).view(), nullptr, false);
    if (!out.is_object() || out.value("schema", "") != "trisect.clash/1")
        throw InputError(FilePlace{name, 0, 0, 0}, "no JSON report of clashes");
    return out;
}

// All that reports of one run have in common.
Json common_of(Json report) {
    for (const char* key : {"shard", "clashes", "unanswered", "is_complete"}) report.erase(key);
    for (Json& set : report.at("sets")) set.erase("clashes");
    return report;
}

// Takes shard after shard.
class ShardMerger {
public:
    explicit ShardMerger(const ClashManifest& manifest) : manifest_(manifest) {}

    void add(const std::string& name) {
        Json report = read_report(name);
        try {
            const ClashShard shard = parse_shard(report.at("shard").get<std::string>());
            if (done_.empty()) done_.resize(shard.count);
            if (shard.count != done_.size() || (!common_.is_null() && common_of(report) != common_))
                throw UsageError(name + " is of another run than the reports before it");
            if (done_[shard.number]) throw UsageError(name + ": this shard was there before");
            done_[shard.number] = true;
            if (common_.is_null()) begin(report, name);
            for (const char* key : {"clashes", "unanswered"})
                for (Json& record : report.at(key))
                    (*key == 'c' ? out_.clashes : out_.unanswered).push_back(std::move(record));
        } catch (const Json::exception& e) {
            throw InputError(FilePlace{name, 0, 0, 0},
                             std::string("no report of a shard: ") + e.what());
        }
    }
    [[nodiscard]] ClashReport finish() {
        for (std::size_t i = 0; i < done_.size(); ++i)
            if (!done_[i])
                throw UsageError(
                    fmt::format("the report of shard {}/{} is missing", i + 1, done_.size()));
        sort_clashes(manifest_, out_.clashes);
        sort_clashes(manifest_, out_.unanswered);
        return std::move(out_);
    }

private:
    void begin(const Json& report, const std::string& name) {
        common_ = common_of(report);
        if (report.at("run").at("manifest") != manifest_.key)
            throw UsageError(name + " is of another manifest");
        out_.manifest = report.at("manifest").get<std::string>();
        for (const Json& record : report.at("missing")) out_.missing.push_back(record);
    }

    const ClashManifest& manifest_;
    std::vector<bool> done_;
    Json common_;
    ClashReport out_;
};

}  // namespace

ClashShard parse_shard(const std::string& text) {
    if (text.empty()) return {};
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) throw UsageError("--shard: I/N, such as 1/4");
    const std::int64_t number = parse_integer(text.substr(0, slash), "--shard");
    const std::int64_t count = parse_integer(text.substr(slash + 1), "--shard");
    if (number < 1 || count < number || count > most_shards)
        throw UsageError(
            fmt::format("--shard: I/N with I from 1 to N, which is at most {}", most_shards));
    return {static_cast<std::size_t>(number - 1), static_cast<std::size_t>(count)};
}

ClashReport merged_report(const ClashManifest& manifest, const std::vector<std::string>& shards) {
    ShardMerger merger(manifest);
    for (const std::string& name : shards) merger.add(name);
    return merger.finish();
}

// All records of a pair come from one piece of work, in the order of the sets.
void sort_clashes(const ClashManifest& manifest, std::vector<Json>& records) {
    using Key = std::tuple<std::uint32_t, std::uint32_t, std::size_t>;
    std::vector<Key> order(records.size());
    for (std::size_t i = 0; i < records.size(); ++i)
        order[i] = {part_number(manifest, records[i].at("a").get_ref<const std::string&>()),
                    part_number(manifest, records[i].at("b").get_ref<const std::string&>()), i};
    std::ranges::sort(order);
    std::vector<Json> sorted;
    sorted.reserve(records.size());
    for (const Key& key : order) sorted.push_back(std::move(records[std::get<2>(key)]));
    records = std::move(sorted);
}

}  // namespace trisect::app
