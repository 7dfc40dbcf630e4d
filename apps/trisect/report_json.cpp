// SPDX-License-Identifier: Apache-2.0
#include "report_json.h"

namespace trisect::app {

Json defects_json(const ValidationReport& report) {
    Json list = Json::array();
    for (const Defect& defect : report.defects()) {
        Json entry;
        entry["kind"] = name_of(defect.kind);
        entry["severity"] = defect.severity() == Severity::Error ? "error" : "warning";
        entry["vertices"] = defect.vertices;
        entry["faces"] = defect.faces;
        entry["place"] = defect.place;
        entry["sentence"] = defect.sentence;
        list.push_back(std::move(entry));
    }
    return list;
}

Json defect_counts_json(const ValidationReport& report) {
    Json counts = Json::object();
    for (std::size_t k = 0; k < defect_kind_count; ++k) {
        const auto kind = static_cast<DefectKind>(k);
        if (report.count(kind) != 0) counts[std::string(name_of(kind))] = report.count(kind);
    }
    return counts;
}

Json remarks_json(std::span<const FileRemark> remarks) {
    Json list = Json::array();
    for (const FileRemark& remark : remarks) {
        Json entry;
        entry["kind"] = name_of(remark.kind);
        entry["count"] = remark.count;
        entry["of"] = remark.of;
        if (remark.first.line != 0) {
            entry["line"] = remark.first.line;
            entry["column"] = remark.first.column;
        } else {
            entry["offset"] = remark.first.offset;
        }
        entry["sentence"] = remark.sentence;
        list.push_back(std::move(entry));
    }
    return list;
}

Json model_json(const Model& model) {
    Json out;
    out["unit"] = model.unit.empty() ? Json() : Json(model.unit);
    out["parts"] = Json::array();
    for (const ModelPart& part : model.parts) {
        Json entry;
        entry["name"] = part.name;
        entry["vertices"] = part.mesh.points.size();
        entry["faces"] = part.mesh.face_count();
        out["parts"].push_back(std::move(entry));
    }
    return out;
}

Json lattice_json(const LatticeReport& report) {
    Json out;
    out["exponent"] = report.lattice.exponent;
    out["lossless"] = report.lossless;
    out["moved"] = report.moved;
    out["max_move"] = report.max_move;
    return out;
}

}  // namespace trisect::app
