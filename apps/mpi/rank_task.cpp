// SPDX-License-Identifier: Apache-2.0
#include "rank_task.h"

#include <array>
#include <utility>

#include "part_store.h"

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

void put_order(MessageWriter& out, const RankOrder& order) {
    out.put(order.kind);
    out.put(order.owner);
    out.put_list(order.pieces);
}

RankOrder get_order(MessageReader& in) {
    RankOrder out;
    out.kind = in.get<RankOrder::Kind>();
    out.owner = in.get<std::uint32_t>();
    out.pieces = in.get_list<RankPiece>();
    return out;
}

// Most have found nothing.
void put_result(MessageWriter& out, const RankResult& result) {
    out.put(result.kind);
    out.put(result.piece);
    if (result.kind == RankResult::Kind::File) put_file(out, result.file);
    out.put(result.slices);
    out.put(std::uint64_t{result.records.size()});
    for (const ClashText& clash : result.records) {
        out.put_text(clash.a);
        out.put_text(clash.b);
        out.put_text(clash.set);
        out.put_text(clash.text);
        out.put(clash.is_answer);
    }
    out.put(std::uint64_t{result.parts.size()});
    for (const ClashPart& part : result.parts) put_part(out, part);
    out.put(result.code);
    out.put_text(result.message);
    out.put(result.pairs);
    out.put(result.work);
    out.put(result.seconds);
    if (result.kind == RankResult::Kind::End) out.put(result.end);
}

RankResult get_result(MessageReader& in) {
    RankResult out;
    out.kind = in.get<RankResult::Kind>();
    out.piece = in.get<std::uint64_t>();
    if (out.kind == RankResult::Kind::File) out.file = get_file(in);
    out.slices = in.get<std::uint32_t>();
    out.records.resize(in.get<std::uint64_t>());
    for (ClashText& clash : out.records) {
        clash.a = in.get_text();
        clash.b = in.get_text();
        clash.set = in.get_text();
        clash.text = in.get_text();
        clash.is_answer = in.get<bool>();
    }
    out.parts.resize(in.get<std::uint64_t>());
    for (ClashPart& part : out.parts) part = get_part(in);
    out.code = in.get<int>();
    out.message = in.get_text();
    out.pairs = in.get<std::uint64_t>();
    out.work = in.get<std::uint64_t>();
    out.seconds = in.get<double>();
    if (out.kind == RankResult::Kind::End) out.end = in.get<RankEnd>();
    return out;
}

}  // namespace

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

void put_part(MessageWriter& out, const ClashPart& part) {
    out.put_text(part.id);
    out.put_text(part.name == part.id ? std::string_view() : part.name);
    out.put(part.file);
    out.put(part.group);
    out.put(part.pose);
}

ClashPart get_part(MessageReader& in) {
    ClashPart out;
    out.id = in.get_text();
    out.name = in.get_text();
    if (out.name.empty()) out.name = out.id;  // no name is empty
    out.file = in.get<std::uint32_t>();
    out.group = in.get<std::uint32_t>();
    out.pose = in.get<std::array<double, 12>>();
    return out;
}

std::string bytes_of(const RankStart& start) {
    MessageWriter out;
    out.put_text(start.manifest);
    out.put_text(start.key);
    out.put(start.is_divided);
    out.put(start.parts);
    out.put_texts(start.files);
    out.put_texts(start.groups);
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
    out.is_divided = in.get<bool>();
    out.parts = in.get<std::uint64_t>();
    out.files = in.get_texts();
    out.groups = in.get_texts();
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

std::string bytes_of(const RankOrder& order) {
    MessageWriter out;
    put_order(out, order);
    return out.take();
}

RankOrder rank_order_of(const std::string& bytes) {
    MessageReader in(bytes);
    return get_order(in);
}

std::string bytes_of(const RankTask& task) {
    MessageWriter out;
    const FetchedTiles& fetched = *task.fetched;
    put_order(out, task.order);
    out.put(std::uint64_t{fetched.parts.size()});
    for (const ClashPart& part : fetched.parts) put_part(out, part);
    out.put(std::uint64_t{fetched.tiles.size()});
    for (const TileParts& tile : fetched.tiles) {
        out.put(tile.cell);
        out.put_list(tile.boxes);
        out.put_list(tile.parts);
    }
    out.put_list(fetched.places);
    return out.take();
}

RankTask rank_task_of(const std::string& bytes) {
    MessageReader in(bytes);
    RankTask out;
    out.order = get_order(in);
    FetchedTiles fetched;
    fetched.parts.resize(in.get<std::uint64_t>());
    for (ClashPart& part : fetched.parts) part = get_part(in);
    fetched.tiles.resize(in.get<std::uint64_t>());
    for (TileParts& tile : fetched.tiles) {
        tile.cell = in.get<Bounds>();
        tile.boxes = in.get_list<ClashBox>();
        tile.parts = in.get_list<std::uint32_t>();
    }
    fetched.places = in.get_list<std::uint32_t>();
    out.fetched = std::make_shared<const FetchedTiles>(std::move(fetched));
    return out;
}

TileParts RankTask::tile(std::size_t piece) const {
    if (store != nullptr)
        return store->tile(order.pieces.at(piece).region, order.pieces.at(piece).tile);
    // One tile is of all pieces, also of later orders.
    const std::size_t place = fetched->tiles.size() == 1 ? 0 : fetched->places.at(piece);
    return fetched->tiles.at(place);
}

const ClashPart& RankTask::part(std::uint32_t number) const {
    return store == nullptr ? fetched->parts.at(number) : store->part(number);
}

std::string bytes_of(const RankAnswer& answer) {
    MessageWriter out;
    out.put(answer.is_of_order);
    out.put(std::uint64_t{answer.results.size()});
    for (const RankResult& result : answer.results) put_result(out, result);
    out.put_list(answer.left);
    return out.take();
}

RankAnswer rank_answer_of(const std::string& bytes) {
    MessageReader in(bytes);
    RankAnswer out;
    out.is_of_order = in.get<bool>();
    out.results.resize(in.get<std::uint64_t>());
    for (RankResult& result : out.results) result = get_result(in);
    out.left = in.get_list<RankPiece>();
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

Json part_json(const ClashPart& part) {
    Json out;
    out["id"] = part.id;
    out["name"] = part.name;
    out["file"] = part.file;
    out["group"] = part.group;
    out["pose"] = part.pose;
    return out;
}

ClashPart part_of_json(const Json& json) {
    ClashPart out;
    out.id = json.at("id").get<std::string>();
    out.name = json.at("name").get<std::string>();
    out.file = json.at("file").get<std::uint32_t>();
    out.group = json.at("group").get<std::uint32_t>();
    out.pose = json.at("pose").get<std::array<double, 12>>();
    return out;
}

}  // namespace trisect::app
