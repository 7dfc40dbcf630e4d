// SPDX-License-Identifier: Apache-2.0
#include "clash_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "clash_id.h"
#include "values.h"
#include "xml_text.h"
#include "zip_file.h"

namespace trisect::app {
namespace {

constexpr std::array<const char*, 3> mode_names{"intersection", "collision", "clearance"};

const ClashPart& part_of(const ClashManifest& manifest, const Json& id) {
    return manifest.parts[part_number(manifest, id.get_ref<const std::string&>())];
}

std::string text_of(const Json& record, const char* key) {
    return record.at(key).get<std::string>();
}

// --- CSV ---

std::string field(std::string_view text) {
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
    std::string out = "\"";
    for (const char c : text) {
        out += c;
        if (c == '"') out += c;
    }
    return out + '"';
}

std::string number_field(const Json& record, const char* key, const char* member) {
    return record.contains(key) ? number_text(record.at(key).at(member).get<double>()) : "";
}

// --- BCF ---

constexpr const char* xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
// Reports are the same whenever they are made.
constexpr const char* creation = "1970-01-01T00:00:00Z";

std::string point_xml(const char* name, double x, double y, double z) {
    return fmt::format("<{0}><X>{1}</X><Y>{2}</Y><Z>{3}</Z></{0}>", name, number_text(x),
                       number_text(y), number_text(z));
}

std::string component_xml(const ClashPart& part) {
    // Identities of IFC have 22 characters.
    const bool is_ifc = part.id.size() == 22 && std::ranges::all_of(part.id, [](char c) {
                            return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
                                   (c >= 'a' && c <= 'z') || c == '_' || c == '$';
                        });
    if (is_ifc) return fmt::format("<Component IfcGuid=\"{}\"/>", part.id);
    return fmt::format("<Component><AuthoringToolId>{}</AuthoringToolId></Component>",
                       xml_text(part.id));
}

std::string viewpoint_xml(const ClashManifest& manifest, const Json& clash) {
    const std::string id = text_of(clash, "id");
    const Json& point = clash.at("point");
    const double size = std::max(clash.at("size").get<double>(), 1e-6);
    // From above, in front and to the left, as pictures are drawn.
    const double far = 4 * size;
    const double slant = 1 / std::sqrt(3.0);
    std::string out = xml_head;
    out += fmt::format("<VisualizationInfo Guid=\"{}\"><Components><Selection>{}{}</Selection>",
                       clash_id({"viewpoint", id}), component_xml(part_of(manifest, clash.at("a"))),
                       component_xml(part_of(manifest, clash.at("b"))));
    out += "<Visibility DefaultVisibility=\"true\"/></Components><OrthogonalCamera>";
    out += point_xml("CameraViewPoint", point[0].get<double>() + far * slant,
                     point[1].get<double>() - far * slant, point[2].get<double>() + far * slant);
    out += point_xml("CameraDirection", -slant, slant, -slant);
    out += point_xml("CameraUpVector", -1 / std::sqrt(6.0), 1 / std::sqrt(6.0), 2 / std::sqrt(6.0));
    out += fmt::format("<ViewToWorldScale>{}</ViewToWorldScale></OrthogonalCamera>",
                       number_text(2 * size));
    return out + "</VisualizationInfo>\n";
}

std::string markup_xml(const ClashManifest& manifest, const Json& clash, bool has_picture) {
    const std::string id = text_of(clash, "id");
    std::string text = fmt::format("Relation: {}.", text_of(clash, "relation"));
    if (clash.contains("volume"))
        text +=
            fmt::format(" Volume: {}.", number_text(clash.at("volume").at("value").get<double>()));
    if (clash.contains("distance"))
        text += fmt::format(" Distance: {}.",
                            number_text(clash.at("distance").at("upper").get<double>()));
    std::string out = xml_head;
    out += fmt::format(
        "<Markup><Topic Guid=\"{}\" TopicType=\"Clash\" TopicStatus=\"Open\"><Title>{}</Title>"
        "<Labels>{}</Labels><CreationDate>{}</CreationDate>"
        "<CreationAuthor>trisect</CreationAuthor><Description>{}</Description></Topic>",
        id, xml_text(clash_title(manifest, clash)), xml_text(text_of(clash, "set")), creation,
        xml_text(text));
    out += fmt::format(
        "<Viewpoints Guid=\"{}\"><Viewpoint>viewpoint.bcfv</Viewpoint>{}</Viewpoints>",
        clash_id({"viewpoint", id}), has_picture ? "<Snapshot>snapshot.png</Snapshot>" : "");
    return out + "</Markup>\n";
}

}  // namespace

std::string clash_title(const ClashManifest& manifest, const Json& clash) {
    return fmt::format("{} and {}: {}", part_of(manifest, clash.at("a")).name,
                       part_of(manifest, clash.at("b")).name, text_of(clash, "relation"));
}

Json clash_head_json(const ClashManifest& manifest, const ClashReport& report) {
    Json out;
    out["schema"] = "trisect.clash/1";
    out["manifest"] = report.manifest;
    if (!report.shard.empty()) {
        out["shard"] = report.shard;
        out["run"] = report.run;
    }
    out["parts"] = manifest.size();
    if (!report.geometry.is_null()) out["geometry"] = report.geometry;
    std::map<std::string, std::size_t> counts;
    for (const Json& clash : report.clashes) ++counts[text_of(clash, "set")];
    for (const ClashText& clash : report.texts) ++counts[clash.set];
    out["sets"] = Json::array();
    for (const ClashSet& set : manifest.sets) {
        Json s;
        s["name"] = set.name;
        s["mode"] = mode_names.at(static_cast<std::size_t>(set.mode));
        if (set.mode == ClashMode::Clearance) s["clearance"] = set.clearance;
        s["clashes"] = counts[set.name];
        out["sets"].push_back(std::move(s));
    }
    out["is_complete"] = report.is_complete();
    out["missing"] = report.missing;
    out["unanswered"] = report.unanswered;
    if (!report.undone.empty()) out["undone"] = report.undone;
    return out;
}

std::string clash_json(const ClashManifest& manifest, const ClashReport& report) {
    Json document = clash_head_json(manifest, report);
    document["clashes"] = report.clashes;
    std::string out = document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
    if (report.texts.empty()) return out;
    // Into the list, which is empty and the last member.
    constexpr std::string_view end = "]\n}\n";
    out.resize(out.size() - end.size());
    std::size_t bytes = out.size() + 2 * end.size();
    for (const ClashText& clash : report.texts) bytes += clash.text.size() + 4;
    out.reserve(bytes);
    const char* between = "\n  ";
    for (const ClashText& clash : report.texts) {
        out += between;
        out += clash.text;
        between = ",\n  ";
    }
    return (out += "\n ") += end;
}

std::string clash_csv(const ClashManifest& manifest, const ClashReport& report) {
    std::string out =
        "id,set,a,b,name_a,name_b,group_a,group_b,relation,x,y,z,size,distance,volume\n";
    Json read;
    for (std::size_t i = 0; i < report.count(); ++i) {
        const Json& clash = report.clash(i, read);
        const ClashPart& a = part_of(manifest, clash.at("a"));
        const ClashPart& b = part_of(manifest, clash.at("b"));
        const Json& p = clash.at("point");
        out += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", text_of(clash, "id"),
            field(text_of(clash, "set")), field(a.id), field(b.id), field(a.name), field(b.name),
            field(manifest.groups[a.group]), field(manifest.groups[b.group]),
            text_of(clash, "relation"), number_text(p[0].get<double>()),
            number_text(p[1].get<double>()), number_text(p[2].get<double>()),
            number_text(clash.at("size").get<double>()), number_field(clash, "distance", "upper"),
            number_field(clash, "volume", "value"));
    }
    return out;
}

std::string clash_bcf(const ClashManifest& manifest, const ClashReport& report,
                      const ClashPicture& picture) {
    ZipFile zip;
    zip.add("bcf.version",
            std::string(xml_head) +
                "<Version VersionId=\"2.1\"><DetailedVersion>2.1</DetailedVersion></Version>\n");
    Json read;
    for (std::size_t i = 0; i < report.count(); ++i) {
        const Json& clash = report.clash(i, read);
        const std::string folder = text_of(clash, "id") + "/";
        const std::string png = picture(i);
        zip.add(folder + "markup.bcf", markup_xml(manifest, clash, !png.empty()));
        zip.add(folder + "viewpoint.bcfv", viewpoint_xml(manifest, clash));
        if (!png.empty()) zip.add(folder + "snapshot.png", png);
    }
    return zip.finish();
}

}  // namespace trisect::app
