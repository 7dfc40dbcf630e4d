// SPDX-License-Identifier: Apache-2.0
#include "clash_manifest.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "clash_id.h"
#include "manifest_parts.h"
#include "outcome.h"
#include "values.h"

namespace trisect::app {
namespace {

// Text of a share, at most.
constexpr std::uint64_t share_bytes = std::uint64_t{4} << 20;

// Reports are JSON, which has nothing else.
bool is_utf8(const std::string& text) {
    try {
        (void)Json(text).dump();
    } catch (const Json::exception&) {
        return false;
    }
    return true;
}

class ManifestReader {
public:
    explicit ManifestReader(const std::string& file) : file_(file) {}

    ClashManifest read() {
        bytes_ = read_file(file_, ReadLimits().bytes);
        if (file_.ends_with(".csv"))
            read_csv();
        else
            read_json();
        return finished();
    }

    /// Of parts alone, as they are mostly written; nothing where any is not.
    std::optional<ManifestShare> read_written(std::string_view text) {
        WrittenParts parts(text);
        WrittenPart written;
        while (parts.next(written)) {
            ClashPart part;
            part.name = written.name;
            part.id = written.id;
            part.group = group(written.group);
            set_pose(part, std::span(written.pose).first(written.numbers));
            add_part(std::move(part), written.file, "a part");
        }
        if (!parts.is_whole()) return std::nullopt;
        return share();
    }

    /// Of parts alone, with their brackets.
    ManifestShare read_share(std::string_view text) {
        for (const Json& p : without_parts(text, 1)) read_part(p);
        if (out_.parts.empty()) fail("a comma without a part");
        return share();
    }

    ClashManifest join(std::vector<std::optional<ManifestShare>>& shares, const PartsPlace& place) {
        bytes_ = read_file(file_, ReadLimits().bytes);
        for (auto& share : shares) {
            add_share(std::move(*share));
            share.reset();
        }
        std::string rest(bytes_.view().substr(0, place.begin));
        rest += bytes_.view().substr(place.end);
        const Json document = Json::parse(rest);
        if (!document.at("parts").empty()) fail("two lists of parts");
        read_sets(document);
        return finished();
    }

    ClashManifest head(std::string_view rest, std::vector<std::string> groups) {
        const Json document = Json::parse(rest);
        if (!document.at("parts").empty()) fail("two lists of parts");
        for (const std::string& name : groups) group(name);
        read_sets(document);
        if (out_.sets.empty()) add_default_set();
        return std::move(out_);
    }

private:
    ManifestShare share() {
        return {std::move(out_.parts), std::move(out_.files), std::move(out_.groups)};
    }

    ClashManifest finished() {
        out_.key = long_text_id(bytes_.view());
        if (out_.sets.empty()) add_default_set();
        std::ranges::sort(out_.parts, {}, &ClashPart::id);
        const auto twice = std::ranges::adjacent_find(out_.parts, {}, &ClashPart::id);
        if (twice != out_.parts.end())
            fail(fmt::format("two parts of one identity: '{}'", twice->id));
        sort_files();
        return std::move(out_);
    }

    [[noreturn]] void fail(const std::string& what, std::uint64_t line = 0) const {
        throw InputError(FilePlace{file_, line, line != 0 ? 1U : 0U, 0}, what);
    }

    // Everything against everything.
    void add_default_set() {
        const std::vector<bool> all(out_.groups.size(), true);
        out_.sets.push_back({"all parts", all, all, ClashMode::Intersection, 0});
    }

    // Neighbours are often of one group.
    std::uint32_t group(const std::string& name) {
        if (last_group_ < out_.groups.size() && out_.groups[last_group_] == name)
            return last_group_;
        const auto [at, is_new] =
            groups_.try_emplace(name, static_cast<std::uint32_t>(groups_.size()));
        if (is_new) out_.groups.push_back(name);
        return last_group_ = at->second;
    }

    std::uint32_t file(const std::string& name) {
        const auto [at, is_new] =
            files_.try_emplace(name, static_cast<std::uint32_t>(out_.files.size()));
        if (is_new) {
            const std::filesystem::path path(name);
            out_.files.push_back(
                path.is_absolute() ? name
                                   : (std::filesystem::path(file_).parent_path() / path).string());
        }
        return at->second;
    }

    // Its files are as they can be opened already.
    void add_share(ManifestShare&& share) {
        std::vector<std::uint32_t> groups;
        for (const std::string& name : share.groups) groups.push_back(group(name));
        std::vector<std::uint32_t> files;
        for (const std::string& name : share.files) {
            const auto [at, is_new] =
                files_.try_emplace(name, static_cast<std::uint32_t>(out_.files.size()));
            if (is_new) out_.files.push_back(name);
            files.push_back(at->second);
        }
        for (ClashPart& part : share.parts) {
            part.group = groups[part.group];
            part.file = files[part.file];
            out_.parts.push_back(std::move(part));
        }
    }

    // Two names may be one: "a.off", and the same with its folder.
    void sort_files() {
        std::vector<std::string> sorted = out_.files;
        std::ranges::sort(sorted);
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        for (ClashPart& part : out_.parts)
            part.file = static_cast<std::uint32_t>(
                std::ranges::lower_bound(sorted, out_.files[part.file]) - sorted.begin());
        out_.files = std::move(sorted);
    }

    void add_part(ClashPart part, const std::string& of_file, const std::string& where,
                  std::uint64_t line = 0) {
        if (of_file.empty()) fail(where + " has no file", line);
        if (part.name.empty()) part.name = of_file;
        if (part.id.empty()) part.id = part.name;
        part.file = file(of_file);
        for (const double v : part.pose)
            if (!std::isfinite(v)) fail(where + ": a pose with a number that is not finite", line);
        out_.parts.push_back(std::move(part));
    }

    static void set_pose(ClashPart& part, std::span<const double> numbers) {
        if (numbers.size() == 12) std::ranges::copy(numbers, part.pose.begin());
        if (numbers.size() == 3)
            for (std::size_t i = 0; i < 3; ++i) part.pose[4 * i + 3] = numbers[i];
    }

    // --- JSON ---

    void read_json() {
        try {
            const Json document = without_parts(bytes_.view(), 2);
            for (const Json& p : document.at("parts")) read_part(p);  // what is no object
            read_sets(document);
        } catch (const Json::parse_error& e) {
            throw InputError(FilePlace{file_, 0, 0, e.byte}, "no JSON");
        } catch (const Json::exception& e) {
            fail(std::string("not as a manifest should be: ") + e.what());
        }
    }

    // Each part is read when its end is reached, and forgotten: the document of all is many times
    // as large as what is kept of it.
    Json without_parts(std::string_view text, int depth_of_parts) {
        bool in_parts = depth_of_parts == 1;
        return Json::parse(text, [&](int depth, Json::parse_event_t event, Json& parsed) {
            if (event == Json::parse_event_t::key && depth == 1 && depth_of_parts == 2)
                in_parts = parsed == "parts";
            if (event != Json::parse_event_t::object_end || depth != depth_of_parts || !in_parts)
                return true;
            read_part(parsed);
            return false;
        });
    }

    /// One that is misspelt would be left out without a word.
    void expect_members(const Json& object, std::initializer_list<std::string_view> known,
                        const std::string& where) const {
        for (const auto& [name, value] : object.items())
            if (std::ranges::find(known, name) == known.end())
                fail(fmt::format("{}: '{}' is not known", where, name.substr(0, 40)));
    }

    void read_sets(const Json& document) {
        expect_members(document, {"parts", "sets"}, "the manifest");
        if (!document.contains("sets")) return;
        for (const Json& s : document.at("sets")) read_set(s);
    }

    void read_part(const Json& p) {
        const std::string where = fmt::format("part {}", out_.parts.size());
        expect_members(p, {"file", "name", "id", "group", "pose"}, where);
        ClashPart part;
        const std::string of_file = p.value("file", std::string());
        part.name = p.value("name", std::string());
        part.id = p.value("id", std::string());
        part.group = group(p.value("group", std::string()));
        if (p.contains("pose")) {
            const auto numbers = p.at("pose").get<std::vector<double>>();
            if (numbers.size() != 12 && numbers.size() != 3)
                fail(where + ": a pose has 12 numbers, or 3 of a translation");
            set_pose(part, numbers);
        }
        add_part(std::move(part), of_file, where);
    }

    // A name or a list of names.
    std::vector<bool> groups_of(const Json& names, const std::string& where) {
        std::vector<bool> out(out_.groups.size());
        const Json list = names.is_array() ? names : Json::array({names});
        for (const Json& name : list) {
            const auto at = groups_.find(name.get<std::string>());
            if (at == groups_.end())
                fail(fmt::format("{}: no part is of group '{}'", where, name.get<std::string>()));
            out[at->second] = true;
        }
        return out;
    }

    void read_set(const Json& s) {
        ClashSet set;
        set.name = s.value("name", fmt::format("set {}", out_.sets.size()));
        const std::string where = fmt::format("set '{}'", set.name);
        expect_members(s, {"name", "a", "b", "mode", "allow_touching", "clearance"}, where);
        if (!s.contains("a")) fail(where + ": 'a' is missing, a group or a list of them");
        set.a = groups_of(s.at("a"), where);
        set.b = s.contains("b") ? groups_of(s.at("b"), where) : set.a;
        const std::string mode = s.value("mode", std::string("intersection"));
        const bool allow_touching = s.value("allow_touching", false);
        if (mode == "collision" && !allow_touching)
            set.mode = ClashMode::Collision;
        else if (mode == "clearance")
            set.mode = ClashMode::Clearance;
        else if (mode != "intersection" && mode != "collision")
            fail(fmt::format("{}: mode is intersection, collision or clearance", where));
        if (set.mode == ClashMode::Clearance) {
            if (!s.contains("clearance")) fail(where + ": 'clearance' is missing");
            set.clearance = s.at("clearance").get<double>();
            if (!(set.clearance >= 0) || !std::isfinite(set.clearance))
                fail(where + ": a clearance that is no distance");
        }
        out_.sets.push_back(std::move(set));
    }

    // --- CSV ---

    // Fields of a line, where "" in quotes stands for a quote.
    std::vector<std::string> fields_of(std::string_view line) const {
        std::vector<std::string> out(1);
        bool quoted = false;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const char c = line[i];
            if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
                out.back() += '"';
                ++i;
            } else if (c == '"') {
                quoted = !quoted;
            } else if (c == ',' && !quoted) {
                out.emplace_back();
            } else if (c != '\r') {
                out.back() += c;
            }
        }
        return out;
    }

    std::vector<double> numbers_of(std::string_view text, std::uint64_t line) const {
        std::vector<double> out;
        while (true) {
            const std::size_t begin = text.find_first_not_of(" \t;");
            if (begin == std::string_view::npos) return out;
            text.remove_prefix(begin);
            const std::size_t end = std::min(text.find_first_of(" \t;"), text.size());
            try {
                out.push_back(parse_number(text.substr(0, end), "pose"));
            } catch (const UsageError& e) {
                fail(e.what(), line);
            }
            text.remove_prefix(end);
        }
    }

    void read_csv() {
        std::string_view rest = bytes_.view();
        std::vector<std::string> columns;
        for (std::uint64_t line = 1; !rest.empty(); ++line) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            const std::vector<std::string> fields = fields_of(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
            if (fields.size() == 1 && fields[0].empty()) continue;
            if (columns.empty()) {
                columns = fields;
                if (std::ranges::find(columns, "file") == columns.end())
                    fail("the first line names the columns: file, pose, name, group, id", line);
                continue;
            }
            read_row(columns, fields, line);
        }
    }

    void read_row(const std::vector<std::string>& columns, const std::vector<std::string>& fields,
                  std::uint64_t line) {
        if (fields.size() > columns.size()) fail("more fields than columns", line);
        ClashPart part;
        std::string of_file;
        std::string of_group;
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (columns[i] == "file") of_file = fields[i];
            if (columns[i] == "name") part.name = fields[i];
            if (columns[i] == "id") part.id = fields[i];
            if (columns[i] == "group") of_group = fields[i];
            if (columns[i] != "pose") continue;
            const std::vector<double> numbers = numbers_of(fields[i], line);
            if (!numbers.empty() && numbers.size() != 3 && numbers.size() != 12)
                fail("a pose has 12 numbers, or 3 of a translation, or none", line);
            set_pose(part, numbers);
        }
        part.group = group(of_group);
        for (const std::string& text : {of_file, part.name, part.id, of_group})
            if (!is_utf8(text)) fail("a name that is not UTF-8", line);
        add_part(std::move(part), of_file, "a part", line);
    }

    std::string file_;
    FileBytes bytes_;
    std::map<std::string, std::uint32_t> groups_;
    std::uint32_t last_group_ = 0;
    std::unordered_map<std::string, std::uint32_t> files_;
    ClashManifest out_;
};

}  // namespace

ClashManifest read_clash_manifest(const std::string& file) { return ManifestReader(file).read(); }

SharedManifest::SharedManifest(std::string file, std::size_t readers) : file_(std::move(file)) {
    if (file_.ends_with(".csv")) return;
    try {
        place_ = find_parts(InputFile(file_));
    } catch (const Error&) {
        return;  // no file that can be read in pieces
    }
    if (!place_) return;
    const std::uint64_t bytes = place_->end - place_->begin;
    shares_ = readers * (1 + bytes / (readers * share_bytes));
}

std::optional<ManifestShare> SharedManifest::read(std::size_t share) const {
    try {
        const InputFile manifest(file_);
        const auto [begin, end] = place_->share(manifest, share, shares_);
        if (begin == end) return ManifestShare();
        std::string text(end - begin + 2, '[');
        manifest.read(begin, std::span(text).subspan(1, end - begin));
        text.back() = ']';
        const std::string_view inner = std::string_view(text).substr(1, end - begin);
        if (auto written = ManifestReader(file_).read_written(inner)) return written;
        return ManifestReader(file_).read_share(text);
    } catch (const Error&) {
        return std::nullopt;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

ClashManifest SharedManifest::join(std::vector<std::optional<ManifestShare>> parts) const {
    const bool is_whole = parts.size() == shares_ &&
                          std::ranges::all_of(parts, [](const auto& p) { return p.has_value(); });
    if (!place_ || !is_whole) return read_clash_manifest(file_);
    try {
        return ManifestReader(file_).join(parts, *place_);
    } catch (const Error&) {
    } catch (const Json::exception&) {
    }
    return read_clash_manifest(file_);
}

std::optional<ClashManifest> SharedManifest::head(std::vector<std::string> files,
                                                  std::vector<std::string> groups,
                                                  std::string key) const {
    if (!place_) return std::nullopt;
    try {
        const InputFile text(file_);
        std::string rest(place_->begin + (text.size() - place_->end), '\0');
        text.read(0, std::span(rest).first(place_->begin));
        text.read(place_->end, std::span(rest).subspan(place_->begin));
        ClashManifest out = ManifestReader(file_).head(rest, std::move(groups));
        out.files = std::move(files);
        out.key = std::move(key);
        return out;
    } catch (const Error&) {
    } catch (const Json::exception&) {
    }
    return std::nullopt;
}

std::size_t SharedManifest::blocks() const {
    return (InputFile(file_).size() + bytes_of_an_id_block - 1) / bytes_of_an_id_block;
}

std::string SharedManifest::block_id(std::size_t block) const {
    const InputFile text(file_);
    const std::uint64_t begin = std::uint64_t{block} * bytes_of_an_id_block;
    std::string bytes(std::min<std::uint64_t>(bytes_of_an_id_block, text.size() - begin), '\0');
    text.read(begin, bytes);
    return clash_id({bytes});
}

std::uint32_t part_number(const ClashManifest& manifest, const std::string& id) {
    const auto at = std::ranges::lower_bound(manifest.parts, id, {}, &ClashPart::id);
    if (at == manifest.parts.end() || at->id != id)
        throw UsageError("the manifest has no part '" + id + "'");
    return static_cast<std::uint32_t>(at - manifest.parts.begin());
}

}  // namespace trisect::app
