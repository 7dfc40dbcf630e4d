// SPDX-License-Identifier: Apache-2.0
#include "clash_gdml.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "clash_command.h"
#include "clash_files.h"
#include "clash_gdml_pair.h"
#include "clash_id.h"
#include "clash_output.h"
#include "clash_picture.h"
#include "clash_report.h"
#include "clash_tiles.h"
#include "gdml/gdml_geometry.h"
#include "parallel_each.h"

namespace trisect::app {
namespace {

using Numbers12 = std::array<double, 12>;
constexpr Numbers12 identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// A volume as a mother, or one that is placed in it.
struct Member {
    std::uint32_t volume = 0;
    std::uint32_t solid = 0;
    Numbers12 pose = identity;
    bool is_rounded = false;
    std::string id;
};

struct Pair {
    GdmlRule rule = GdmlRule::Apart;
    std::uint32_t a = 0;
    std::uint32_t b = 0;
};

class GdmlRun {
public:
    GdmlRun(Session& session, const ClashOptions& options)
        : session_(session),
          options_(options),
          document_(options.manifest,
                    std::string(read_file(options.manifest, ReadLimits().bytes).view())),
          values_(document_),
          source_{document_, values_, options.facets},
          solids_(source_),
          volumes_(gdml_volumes(source_, solids_)) {
        report_.manifest = options.manifest;
        list_members();
    }

    ClashReport& find() {
        session_.interruptible_stage("solids", [&] {
            make_solids();
            return 0;
        });
        session_.stage("prepare", [&] { list_pairs(); });
        session_.interruptible_stage("pairs", [&] {
            compare_all();
            return 0;
        });
        return report_;
    }
    void write() {
        session_.stage("write", [&] {
            write_clash_outputs(session_, options_, manifest_, report_,
                                [&](std::size_t i) { return picture(report_.clashes[i]); });
        });
    }
    [[nodiscard]] const ClashManifest& manifest() const { return manifest_; }
    [[nodiscard]] std::size_t pairs() const { return pairs_.size(); }

private:
    // --- What there is ---

    void list_members() {
        for (std::uint32_t v = 0; v < volumes_.size(); ++v) {
            const GdmlVolume& volume = volumes_[v];
            for (const std::string& what : volume.left_out) leave_out(volume.name, what, {});
            if (volume.daughters.empty()) continue;
            first_.push_back(static_cast<std::uint32_t>(members_.size()));
            members_.push_back({v, volume.solid, identity, false, volume.name});
            std::unordered_map<std::string, std::uint32_t> times;
            for (const GdmlDaughter& d : volume.daughters) {
                const std::uint32_t before = times[d.name]++;
                std::string id = volume.name + "/" + d.name;
                if (before != 0) id += fmt::format("#{}", before + 1);
                members_.push_back({v, d.solid, d.pose, d.is_rounded, std::move(id)});
            }
        }
        first_.push_back(static_cast<std::uint32_t>(members_.size()));
        fill_manifest();
    }

    /// Reports find parts in it by their identities.
    void fill_manifest() {
        for (const Member& m : members_) {
            ClashPart part;
            part.id = m.id;
            part.name = m.id;
            part.file = m.solid;
            manifest_.parts.push_back(std::move(part));
        }
        std::ranges::sort(manifest_.parts, {}, &ClashPart::id);
        const auto twice = std::ranges::adjacent_find(manifest_.parts, {}, &ClashPart::id);
        if (twice != manifest_.parts.end())
            document_.fail(document_.root(), "two parts of one identity: '" + twice->id + "'");
        manifest_.groups = {""};
        for (const char* name : {"overlaps", "protrusions"}) {
            ClashSet set;
            set.name = name;
            set.a = set.b = {true};
            manifest_.sets.push_back(std::move(set));
        }
    }

    void leave_out(const std::string& file, const std::string& why,
                   std::vector<std::string> parts) {
        if (!options_.keep_going) throw UnsupportedError(why);
        session_.note("left out: " + why);
        Json record;
        record["file"] = file;
        record["error"] = why;
        record["parts"] = std::move(parts);
        report_.missing.push_back(std::move(record));
    }

    // --- Solids ---

    void make_solids() {
        std::vector<std::uint32_t> wanted;
        for (const Member& m : members_) wanted.push_back(m.solid);
        std::ranges::sort(wanted);
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        made_ = solids_.make(wanted, session_.evaluation_options(options_.operands));
        models_.resize(made_.size());
        boxes_.resize(made_.size());
        std::size_t round = 0;
        double deviation = 0;
        for (const std::uint32_t s : wanted) {
            if (made_[s].code) {
                leave_out(solids_.name(s), made_[s].failure, parts_of(s));
                continue;
            }
            models_[s] = InterferenceModel(made_[s].solid);
            boxes_[s] = bounds(models_[s].solid());
            if (made_[s].is_round) ++round;
            deviation = std::max(deviation, made_[s].deviation);
        }
        Json& facts = report_.geometry;
        facts["volumes"] = volumes_.size();
        facts["solids"] = wanted.size();
        facts["round_solids"] = round;
        facts["facets"] = options_.facets;
        facts["deviation"] = deviation / steps_per_mm;
    }

    [[nodiscard]] std::vector<std::string> parts_of(std::uint32_t solid) const {
        std::vector<std::string> out;
        for (const Member& m : members_)
            if (m.solid == solid) out.push_back(m.id);
        return out;
    }

    // --- Pairs ---

    [[nodiscard]] bool is_there(const Member& m) const { return boxes_[m.solid].has_value(); }

    void list_pairs() {
        for (std::size_t i = 0; i + 1 < first_.size(); ++i) list_pairs(first_[i], first_[i + 1]);
    }

    /// The mother with each that is in it, wherever; and of these all pairs whose boxes meet.
    void list_pairs(std::uint32_t mother, std::uint32_t end) {
        std::vector<ClashBox> boxes;
        for (std::uint32_t m = mother + 1; m < end; ++m) {
            if (!is_there(members_[m])) continue;
            if (is_there(members_[mother])) pairs_.push_back({GdmlRule::Within, m, mother});
            boxes.push_back({posed_box(*boxes_[members_[m].solid], members_[m].pose), m, 0});
        }
        const ClashLimits limits(manifest_.sets, 1);
        const ClashTiles tiles(boxes, limits);
        std::vector<ClashCandidate> found;
        for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
            std::vector<ClashBox> here;
            for (const std::uint32_t b : tiles.boxes(tile)) here.push_back(boxes[b]);
            add_candidates(limits, here, tiles.cell(tile), found);
        }
        std::ranges::sort(found);
        for (const ClashCandidate& c : found) pairs_.push_back({GdmlRule::Apart, c.a, c.b});
    }

    [[nodiscard]] GdmlPart part(std::uint32_t number) const {
        const Member& m = members_[number];
        GdmlPart out;
        out.placed = {models_[m.solid], Pose::from_doubles(m.pose),
                      posed_box(*boxes_[m.solid], m.pose), m.id, 0};
        // A turn moves points by a rounding or two; a step is far more.
        out.deviation = made_[m.solid].deviation + (m.is_rounded ? rounding_of_corners : 0);
        return out;
    }

    void compare_all() {
        std::vector<GdmlFinding> findings(pairs_.size());
        std::vector<std::string> failures(pairs_.size());
        for_each_in_parallel(pairs_.size(), session_.limits(), [&](std::size_t i) {
            try {
                findings[i] = compare_gdml_parts(pairs_[i].rule, part(pairs_[i].a),
                                                 part(pairs_[i].b), options_.volumes);
            } catch (const Error& e) {
                if (!is_left_out(e, options_)) throw;
                failures[i] = e.what();
            }
        });
        std::array<std::size_t, 3> proofs{};
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            add(pairs_[i], findings[i], failures[i], proofs);
        report_.geometry["pairs"] = {
            {"compared", pairs_.size()},         {"exact", proofs[0]},
            {"beyond_deviation", proofs[1]},     {"of_facets", proofs[2]},
            {"clashes", report_.clashes.size()}, {"within_deviation", within_}};
    }

    void add(const Pair& pair, GdmlFinding& finding, const std::string& failure,
             std::array<std::size_t, 3>& proofs) {
        if (!failure.empty()) {
            report_.unanswered.push_back(
                {{"a", members_[pair.a].id}, {"b", members_[pair.b].id}, {"error", failure}});
        } else if (finding.clash) {
            Json& record = *finding.clash;
            const std::string set = pair.rule == GdmlRule::Apart ? "overlaps" : "protrusions";
            record["set"] = set;
            record["id"] = clash_id({set, members_[pair.a].id, members_[pair.b].id});
            if (record.at("within_deviation").get<bool>()) ++within_;
            report_.clashes.push_back(std::move(record));
        } else {
            ++proofs.at(static_cast<std::size_t>(finding.proof));
        }
    }

    /// Parts are in steps, and so is what is looked at.
    [[nodiscard]] std::string picture(Json clash) const {
        for (Json& c : clash["point"]) c = c.get<double>() * steps_per_mm;
        clash["size"] = clash["size"].get<double>() * steps_per_mm;
        return clash_picture(clash, part(member_of(clash.at("a"))).placed,
                             part(member_of(clash.at("b"))).placed);
    }
    [[nodiscard]] std::uint32_t member_of(const std::string& id) const {
        return static_cast<std::uint32_t>(std::ranges::find(members_, id, &Member::id) -
                                          members_.begin());
    }

    Session& session_;
    const ClashOptions& options_;
    GdmlDocument document_;
    GdmlValues values_;
    GdmlSource source_;
    GdmlSolids solids_;
    std::vector<GdmlVolume> volumes_;
    std::vector<Member> members_;       // each mother, then what is in it
    std::vector<std::uint32_t> first_;  // of each mother, and the end
    std::vector<GdmlSolid> made_;
    std::vector<InterferenceModel> models_;
    std::vector<std::optional<Bounds>> boxes_;
    std::vector<Pair> pairs_;
    std::size_t within_ = 0;
    ClashManifest manifest_;
    ClashReport report_;
};

void check_options(const ClashOptions& options) {
    const auto refuse = [](bool is_given, const char* name) {
        if (is_given) throw UsageError(std::string(name) + ": not of a GDML geometry");
    };
    refuse(options.resume, "--resume");
    refuse(options.regions, "--regions");
    refuse(!options.shard.empty(), "--shard");
    refuse(!options.shards.empty(), "--merge");
    if (options.facets < 4 || options.facets > 3600 || options.facets % 4 != 0)
        throw UsageError("--facets: a multiple of 4 up to 3600");
}

}  // namespace

Outcome run_gdml_clash(Session& session, const ClashOptions& options) {
    check_options(options);
    session.plan(4);
    GdmlRun run(session, options);
    const ClashReport& report = run.find();
    run.write();
    Outcome out = clash_outcome(run.manifest(), report);
    out.document["seconds"] = session.seconds();
    const Json& pairs = report.geometry.at("pairs");
    const std::string remarks = fmt::format(
        "{} volumes, {} solids, {} pairs: {} apart or within exactly, {} by more than the "
        "deviation of facets, {} of facets alone, {} clashes, {} of them within the deviation",
        report.geometry.at("volumes").get<std::size_t>(),
        report.geometry.at("solids").get<std::size_t>(), run.pairs(),
        pairs.at("exact").get<std::size_t>(), pairs.at("beyond_deviation").get<std::size_t>(),
        pairs.at("of_facets").get<std::size_t>(), pairs.at("clashes").get<std::size_t>(),
        pairs.at("within_deviation").get<std::size_t>());
    out.remarks = out.remarks.empty() ? remarks : remarks + '\n' + out.remarks;
    return out;
}

}  // namespace trisect::app
