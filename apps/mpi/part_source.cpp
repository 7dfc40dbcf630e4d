// SPDX-License-Identifier: Apache-2.0
#include "part_source.h"

#include <algorithm>
#include <utility>

#include "message.h"
#include "trisect/failure.h"

namespace trisect::app {
namespace {

// A list of parts is sent when it has so many bytes.
constexpr std::size_t list_bytes = std::size_t{4} << 20;

// How many boxes are sampled: enough for the regions, which have some 2,048 parts each.
constexpr std::uint64_t least_sample = std::uint64_t{1} << 14;
constexpr std::uint64_t most_stride = 32;

std::uint64_t stride_of(std::uint64_t parts) {
    return std::clamp<std::uint64_t>(parts / least_sample, 1, most_stride);
}

void add_names(std::vector<std::string>& to, const std::vector<std::string>& names) {
    to.insert(to.end(), names.begin(), names.end());
    std::ranges::sort(to);
    to.erase(std::unique(to.begin(), to.end()), to.end());
}

// Places of names in a sorted list that has all of them.
std::vector<std::uint32_t> places_of(const std::vector<std::string>& names,
                                     const std::vector<std::string>& all) {
    std::vector<std::uint32_t> out;
    for (const std::string& name : names)
        out.push_back(
            static_cast<std::uint32_t>(std::ranges::lower_bound(all, name) - all.begin()));
    return out;
}

/// Lists of parts for all ranks.
class PartLists {
public:
    PartLists(std::size_t ranks, const PartSource::Send& send) : lists_(ranks), send_(send) {}
    void add(std::size_t rank, const ClashPart& part) {
        List& list = lists_[rank];
        ++list.parts;
        put_part(list.bytes, part);
        if (list.bytes.size() >= list_bytes) flush(rank, false);
    }
    void finish(std::size_t own) {
        for (std::size_t r = 0; r < lists_.size(); ++r)
            if (r != own) flush(r, true);
    }

private:
    struct List {
        std::uint64_t parts = 0;
        MessageWriter bytes;
    };
    void flush(std::size_t rank, bool is_last) {
        MessageWriter head;
        head.put(is_last);
        head.put(std::exchange(lists_[rank].parts, 0));
        send_(rank, head.take() + lists_[rank].bytes.take());
    }

    std::vector<List> lists_;
    const PartSource::Send& send_;
};

}  // namespace

PartList part_list_of(const std::string& bytes) {
    MessageReader in(bytes);
    PartList out;
    out.is_last = in.get<bool>();
    out.parts.resize(in.get<std::uint64_t>());
    for (ClashPart& part : out.parts) part = get_part(in);
    return out;
}

void PartSource::read(const std::string& manifest, std::size_t rank, std::size_t ranks) {
    manifest_.emplace(manifest, ranks);
    is_whole_ = manifest_->shares() != 0;
    // Those that follow each other: parts that are near are mostly not far from each other there.
    const std::size_t end = manifest_->shares() * (rank + 1) / ranks;
    for (std::size_t i = manifest_->shares() * rank / ranks; i < end && is_whole_; ++i) {
        auto share = manifest_->read(i);
        is_whole_ = share.has_value();
        if (share) shares_.push_back({std::move(*share), {}, {}});
    }
    if (!is_whole_) return;
    for (std::size_t b = rank; b < manifest_->blocks(); b += ranks) {
        blocks_.push_back(b);
        block_ids_.push_back(manifest_->block_id(b));
    }
}

void PartSource::take(std::vector<ClashPart> parts) {
    shares_.clear();
    shares_.push_back({{std::move(parts), {}, {}}, {}, {}});
    find_hashes(shares_.back());
}

std::size_t PartSource::parts() const {
    std::size_t out = 0;
    for (const Share& share : shares_) out += share.read.parts.size();
    return out;
}

void PartSource::find_hashes(Share& share) {
    share.hashes.reserve(share.read.parts.size());
    for (const ClashPart& part : share.read.parts) share.hashes.push_back(identity_hash(part.id));
}

std::vector<std::vector<std::uint64_t>> PartSource::hashes(std::size_t ranks) {
    std::vector<std::vector<std::uint64_t>> out(ranks);
    for (auto& of_rank : out) of_rank.reserve(parts() / ranks * 9 / 8);
    for (Share& share : shares_) {
        find_hashes(share);
        for (const std::uint64_t hash : share.hashes) out[(hash >> 32) % ranks].push_back(hash);
    }
    return out;
}

ManifestSummary PartSource::summary() const {
    ManifestSummary out;
    out.is_whole = is_whole_;
    if (!is_whole_) return out;
    for (const Share& share : shares_) {
        out.parts += share.read.parts.size();
        add_names(out.files, share.read.files);
        add_names(out.groups, share.read.groups);
    }
    for (std::size_t i = 0; i < blocks_.size(); ++i)
        out.blocks.emplace_back(blocks_[i], block_ids_[i]);
    return out;
}

void PartSource::begin(const RankStart& start) {
    manifest_.reset();
    if (!start.is_divided) {
        std::erase_if(shares_, [](const Share& share) { return !share.read.files.empty(); });
        return;
    }
    for (Share& share : shares_) {
        const auto files = places_of(share.read.files, start.files);
        const auto groups = places_of(share.read.groups, start.groups);
        for (ClashPart& part : share.read.parts) {
            part.file = files[part.file];
            part.group = groups[part.group];
        }
    }
}

PartSurvey PartSource::survey(const RankStart& start, const std::vector<ClashFile>& files) const {
    PartSurvey out;
    const std::uint64_t stride = stride_of(start.parts);
    for (const Share& share : shares_)
        for (std::size_t i = 0; i < share.read.parts.size(); ++i) {
            const ClashPart& part = share.read.parts[i];
            try {
                if (!is_pose_for_certain(part.pose))
                    (void)clash_pose(start.manifest, part.id, part.pose);
            } catch (const Error&) {
                if (out.code != 0 && out.failed_part < part.id) continue;
                const Failure failure = current_failure();
                out.failed_part = part.id;
                out.failure = failure.message;
                out.code = failure.code;
            }
            const ClashFile& file = files[part.file];
            if (!file.failure.empty()) out.missing.emplace_back(part.file, part.id);
            if (!file.box) continue;
            ++out.boxes;
            if (share.hashes[i] % stride == 0)
                out.sample.push_back(
                    {share.hashes[i], {posed_box(*file.box, part.pose), 0, part.group}});
        }
    std::ranges::sort(out.sample, {}, &SampledBox::hash);
    return out;
}

void PartSource::find_boxes(const std::vector<ClashFile>& files) {
    for (Share& share : shares_) {
        if (!share.boxes.empty()) continue;
        share.boxes.reserve(share.read.parts.size());
        for (const ClashPart& part : share.read.parts) {
            const auto& box = files[part.file].box;
            share.boxes.push_back(box ? posed_box(*box, part.pose) : Bounds());
        }
    }
}

void PartSource::route(const RegionPlan& plan, double clearance,
                       const std::vector<ClashFile>& files, std::size_t own, std::size_t ranks,
                       const Keep& keep, const Send& send) {
    find_boxes(files);
    PartLists lists(ranks, send);
    std::vector<std::uint32_t> regions;
    std::vector<std::size_t> owners;
    for (Share& share : shares_) {
        for (std::size_t i = 0; i < share.read.parts.size(); ++i) {
            ClashPart& part = share.read.parts[i];
            if (!files[part.file].box) continue;
            regions.clear();
            owners.clear();
            plan.regions.for_each_cell(share.boxes[i], clearance, [&](std::uint32_t region) {
                regions.push_back(region);
                owners.push_back(plan.owners[region]);
            });
            std::ranges::sort(owners);
            owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
            for (const std::size_t owner : owners)
                if (owner != own) lists.add(owner, part);
            if (std::ranges::binary_search(owners, own))
                keep({std::move(part), share.boxes[i], share.hashes[i]}, regions);
        }
        share = {};
    }
    shares_.clear();
    lists.finish(own);
}

}  // namespace trisect::app
