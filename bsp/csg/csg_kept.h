// SPDX-License-Identifier: Apache-2.0
//
// CsgKept: shapes and groups that were made, by the keys of their content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include <trisect/bsp/csg/csg_evaluate.h>

namespace trisect::detail {

class CsgKept {
public:
    /// `across_programs`: all that is made of other nodes is kept as well, for the next program.
    explicit CsgKept(bool across_programs = false) : across_programs_(across_programs) {}
    [[nodiscard]] bool is_across_programs() const { return across_programs_; }

    /// Another program begins. What the last one did not use is dropped, and all where a file that
    /// it read has changed.
    void begin();

    /// Null when it was not made. Valid until begin().
    [[nodiscard]] const Solid* solid(const std::string& key);
    [[nodiscard]] const Expression* formula(const std::string& key);
    const Solid& keep(const std::string& key, const Solid& solid);
    const Expression& keep_formula(const std::string& key, const Expression& formula);
    /// Its number. Colours of earlier programs stay, as what is kept has them.
    std::int32_t number_of(const CsgColor& color);
    [[nodiscard]] const std::vector<CsgColor>& colors() const { return colors_; }
    /// What CsgReport::color_of_source says.
    void note_color(std::uint32_t source, std::int32_t color);
    [[nodiscard]] const std::map<std::uint32_t, std::uint32_t>& color_of_source() const {
        return color_of_source_;
    }

    void note_file(const std::filesystem::path& file);
    [[nodiscard]] bool have_files_changed() const;

private:
    struct Made {
        std::map<std::string, Solid> solids;
        std::map<std::string, Expression> formulas;
    };
    struct FileState {
        std::filesystem::file_time_type written;
        std::uintmax_t size = 0;
        friend bool operator==(const FileState&, const FileState&) = default;
    };
    [[nodiscard]] static FileState state_of(const std::filesystem::path& file);

    bool across_programs_;
    std::vector<CsgColor> colors_;
    std::map<std::uint32_t, std::uint32_t> color_of_source_;
    Made now_;
    Made before_;
    std::map<std::filesystem::path, FileState> files_;
};

}  // namespace trisect::detail
