// SPDX-License-Identifier: Apache-2.0
//
// Programs that take DXF files to the letter want every table, the two blocks of the spaces and the
// dictionary of objects, each with a handle and the handle of its owner.
#include <fmt/format.h>

#include <string_view>

#include "layer_stack.h"
#include "values.h"

namespace trisect::app {
namespace {

// Handles of what all files have; layers and polylines follow.
constexpr int model_space = 0x20;
constexpr int paper_space = 0x21;
constexpr int root_dictionary = 0x30;
constexpr int group_dictionary = 0x31;
constexpr int first_free = 0x100;
constexpr int layer_table = 3;

class DxfText {
public:
    explicit DxfText(const LayerStack& stack) : stack_(stack) {}

    std::string document() {
        const std::size_t n = stack_.layers.size();
        std::size_t loops = 0;
        for (const Layer& layer : stack_.layers)
            for (const auto& region : layer.regions) loops += region.size();
        header(first_free + n + loops);
        section("CLASSES");
        end_section();
        tables();
        blocks();
        entities();
        objects();
        group(0, "EOF");
        return std::move(out_);
    }

private:
    void group(int code, std::string_view value) { out_ += fmt::format("{}\n{}\n", code, value); }
    void group(int code, double value) { group(code, number_text(value)); }
    void number(int code, std::size_t value) { group(code, fmt::format("{}", value)); }
    void handle(int code, std::size_t value) { group(code, fmt::format("{:X}", value)); }
    void section(std::string_view name) {
        group(0, "SECTION");
        group(2, name);
    }
    void end_section() { group(0, "ENDSEC"); }

    void header(std::size_t next_handle) {
        section("HEADER");
        group(9, "$ACADVER");
        group(1, "AC1015");
        group(9, "$HANDSEED");
        handle(5, next_handle);
        group(9, "$INSUNITS");
        number(70, 0);
        end_section();
    }

    void table(std::string_view name, std::size_t own, std::size_t count) {
        group(0, "TABLE");
        group(2, name);
        handle(5, own);
        handle(330, 0);
        group(100, "AcDbSymbolTable");
        number(70, count);
    }
    void end_table() { group(0, "ENDTAB"); }
    void entry(std::string_view type, std::size_t own, std::size_t owner, std::string_view record,
               std::string_view name) {
        group(0, type);
        handle(5, own);
        handle(330, owner);
        group(100, "AcDbSymbolTableRecord");
        group(100, record);
        group(2, name);
    }

    void line_types() {
        table("LTYPE", 2, 3);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string_view name = i == 0 ? "ByBlock" : i == 1 ? "ByLayer" : "Continuous";
            entry("LTYPE", 0x10 + i, 2, "AcDbLinetypeTableRecord", name);
            number(70, 0);
            group(3, i < 2 ? "" : "Solid line");
            number(72, 65);
            number(73, 0);
            group(40, 0.0);
        }
        end_table();
    }

    [[nodiscard]] std::string layer_name(std::size_t i) const {
        const auto digits = fmt::format("{}", stack_.layers.size()).size();
        return fmt::format("{:0{}}_at_{}", i, digits, number_text(stack_.layers[i].height));
    }
    void layer(std::size_t own, std::string_view name) {
        entry("LAYER", own, layer_table, "AcDbLayerTableRecord", name);
        number(70, 0);
        number(62, 7);
        group(6, "Continuous");
    }
    void layers() {
        table("LAYER", layer_table, stack_.layers.size() + 1);
        layer(0x13, "0");
        for (std::size_t i = 0; i < stack_.layers.size(); ++i) layer(first_free + i, layer_name(i));
        end_table();
    }

    void style() {
        table("STYLE", 4, 1);
        entry("STYLE", 0x14, 4, "AcDbTextStyleTableRecord", "Standard");
        number(70, 0);
        group(40, 0.0);
        group(41, 1.0);
        group(50, 0.0);
        number(71, 0);
        group(42, 2.5);
        group(3, "txt");
        group(4, "");
        end_table();
    }

    void tables() {
        section("TABLES");
        table("VPORT", 1, 0);
        end_table();
        line_types();
        layers();
        style();
        table("VIEW", 5, 0);
        end_table();
        table("UCS", 6, 0);
        end_table();
        table("APPID", 7, 1);
        entry("APPID", 0x15, 7, "AcDbRegAppTableRecord", "ACAD");
        number(70, 0);
        end_table();
        table("DIMSTYLE", 8, 0);
        group(100, "AcDbDimStyleTable");
        end_table();
        table("BLOCK_RECORD", 9, 2);
        entry("BLOCK_RECORD", model_space, 9, "AcDbBlockTableRecord", "*Model_Space");
        entry("BLOCK_RECORD", paper_space, 9, "AcDbBlockTableRecord", "*Paper_Space");
        end_table();
        end_section();
    }

    void block(std::size_t own, std::size_t record, std::string_view name) {
        for (const bool is_begin : {true, false}) {
            group(0, is_begin ? "BLOCK" : "ENDBLK");
            handle(5, is_begin ? own : own + 1);
            handle(330, record);
            group(100, "AcDbEntity");
            group(8, "0");
            group(100, is_begin ? "AcDbBlockBegin" : "AcDbBlockEnd");
            if (!is_begin) continue;
            group(2, name);
            number(70, 0);
            for (const int code : {10, 20, 30}) group(code, 0.0);
            group(3, name);
            group(1, "");
        }
    }
    void blocks() {
        section("BLOCKS");
        block(0x22, model_space, "*Model_Space");
        block(0x24, paper_space, "*Paper_Space");
        end_section();
    }

    void polyline(std::size_t own, const std::string& name, double elevation, const Outline& loop) {
        group(0, "LWPOLYLINE");
        handle(5, own);
        handle(330, model_space);
        group(100, "AcDbEntity");
        group(8, name);
        group(100, "AcDbPolyline");
        number(90, loop.size());
        number(70, 1);
        group(38, elevation);
        for (const auto& [x, y] : loop) {
            group(10, x);
            group(20, y);
        }
        // A direction across the plane, with which coordinates are those of space.
        if (stack_.axis.value_or(2) == 2) return;
        group(210, *stack_.axis == 0 ? 1.0 : 0.0);
        group(220, *stack_.axis == 1 ? -1.0 : 0.0);
        group(230, 0.0);
    }
    [[nodiscard]] double elevation(const Layer& layer) const {
        return (!stack_.axis ? 0 : *stack_.axis == 1 ? -layer.height : layer.height) + 0.0;
    }
    void entities() {
        section("ENTITIES");
        std::size_t own = first_free + stack_.layers.size();
        for (std::size_t i = 0; i < stack_.layers.size(); ++i) {
            const std::string name = layer_name(i);
            for (const auto& region : stack_.layers[i].regions)
                for (const Outline& loop : region)
                    polyline(own++, name, elevation(stack_.layers[i]), loop);
        }
        end_section();
    }

    void objects() {
        section("OBJECTS");
        for (const bool is_root : {true, false}) {
            group(0, "DICTIONARY");
            handle(5, is_root ? root_dictionary : group_dictionary);
            handle(330, is_root ? 0 : root_dictionary);
            group(100, "AcDbDictionary");
            number(281, 1);
            if (!is_root) continue;
            group(3, "ACAD_GROUP");
            handle(350, group_dictionary);
        }
        end_section();
    }

    const LayerStack& stack_;
    std::string out_;
};

}  // namespace

std::string dxf_of_layers(const LayerStack& stack) { return DxfText(stack).document(); }

}  // namespace trisect::app
