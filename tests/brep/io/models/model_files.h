// SPDX-License-Identifier: Apache-2.0
//
// Helpers of the tests of models: packages of 3MF and GLB files from their texts, expected errors.
#pragma once

#include <trisect/brep/io/models/zip_archive.h>
#include <trisect/brep/io/read_model.h>
#include <trisect/kernel/error.h>

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace trisect::io_test {

inline const std::string core_space =
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"";

inline const std::string one_relation =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Id=\"a\" Target=\"/3D/a.model\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

/// A package whose model part has this text.
inline std::string package(const std::string& model,
                           std::vector<std::pair<std::string, std::string>> more = {}) {
    more.insert(more.begin(), {{"_rels/.rels", one_relation}, {"3D/a.model", model}});
    return detail::zip_bytes(more);
}

/// The four faces of a tetrahedron as 3MF has them.
inline const std::string tetrahedron_mesh =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles>"
    "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
    "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"2\" v2=\"0\" v3=\"3\"/>"
    "</triangles></mesh>";

inline std::string model_text(const std::string& resources, const std::string& build,
                              const std::string& attributes = "") {
    return "<model " + core_space + " " + attributes + "><resources>" + resources +
           "</resources><build>" + build + "</build></model>";
}

/// A GLB file of a JSON text and a binary chunk.
inline std::string glb_file(std::string json, std::string binary = {}) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t n) {
        std::string out;
        for (int i = 0; i < 4; ++i) out += static_cast<char>((n >> (8 * i)) & 0xff);
        return out;
    };
    std::string chunks = word(json.size()) + "JSON" + json;
    if (!binary.empty()) chunks += word(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

inline void append_float(std::string& out, float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) out += static_cast<char>((bits >> (8 * i)) & 0xff);
}

inline Model model_in(const std::string& bytes, MeshFormat format, const ReadOptions& o = {},
                      ModelReport* report = nullptr) {
    return read_model(bytes, format, "test", o, report);
}

/// Expects an error of the kind whose message begins and goes on as given.
template <class Kind>
void expect_refused(const std::string& bytes, MeshFormat format, const std::string& start,
                    const std::string& part, const ReadOptions& o = {}) {
    try {
        (void)model_in(bytes, format, o);
        ADD_FAILURE() << "read without an error";
    } catch (const Kind& e) {
        const std::string message = e.what();
        EXPECT_TRUE(message.starts_with(start)) << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
    } catch (const std::exception& e) {
        ADD_FAILURE() << "another error: " << e.what();
    }
}

}  // namespace trisect::io_test
