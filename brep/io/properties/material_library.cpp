// SPDX-License-Identifier: Apache-2.0
//
// MTL (Wavefront, Advanced Visualizer manual, appendix B). `Tr` is passed over: to some programs it
// is opacity, to others what is left of it. Words of options before the name of a
// picture are taken by their number; names of pictures go to the end of the line, as they may have
// blanks.
#include <trisect/brep/io/properties/material_library.h>

#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/formats/text_cursor.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {
namespace {

class LibraryReader {
public:
    LibraryReader(const InputText& source, BesideFiles& files,
                  std::map<std::string, LibraryMaterial>& materials)
        : text_(source, TextRules{.hash_comments = true, .continuation = false}),
          source_(source),
          files_(files),
          materials_(materials) {}

    void read() {
        while (text_.next_line()) {
            const std::string_view keyword = text_.word();
            if (keyword == "newmtl") {
                current_ = &materials_[rest_of_line()];
                *current_ = LibraryMaterial();
            } else if (keyword == "Kd" || keyword == "d" || keyword == "map_Kd") {
                if (current_ == nullptr)
                    source_.fail(keyword.data(), shown_word(keyword) + " before any material");
                statement(keyword);
            }
        }
    }

private:
    void statement(std::string_view keyword) {
        if (keyword == "map_Kd") return picture();
        if (keyword == "Kd") return diffuse();
        if (text_.at_line_end()) return;
        color()[3] = level(text_.real("an opacity"));
    }

    ModelColor& color() {
        if (!current_->color) current_->color = ModelColor{255, 255, 255, 255};
        return *current_->color;
    }

    static std::uint8_t level(double number) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(number, 0.0, 1.0)));
    }

    /// One number stands for three; spectra and XYZ are passed over.
    void diffuse() {
        const char* const first = text_.here();
        const std::string_view word = text_.word();
        if (word == "spectral" || word == "xyz") return;
        text_.go_back_to(first);
        std::array<double, 3> numbers{};
        numbers[0] = text_.real("a colour");
        numbers[1] = numbers[2] = numbers[0];
        if (!text_.at_line_end()) {
            numbers[1] = text_.real("a colour");
            numbers[2] = text_.real("a colour");
        }
        for (std::size_t i = 0; i < 3; ++i) color()[i] = level(numbers[i]);
    }

    void picture() {
        for (;;) {
            const char* const at = (void(text_.at_line_end()), text_.here());
            const std::string_view word = text_.word();
            if (word.size() < 2 || word[0] != '-' || (word[1] >= '0' && word[1] <= '9')) {
                text_.go_back_to(at);
                break;
            }
            option(word);
        }
        current_->picture = rest_of_line();
    }

    void option(std::string_view word) {
        if (word == "-o" || word == "-s" || word == "-t") {
            numbers();
            files_.remark("pictures are not moved or scaled: " + shown_word(word) +
                          " of a material is passed over");
            return;
        }
        const std::string_view value = text_.word();
        if (word == "-clamp")
            current_->wrap = value == "on" ? TextureWrap::Clamp : TextureWrap::Repeat;
        if (word == "-mm") (void)text_.word();
    }

    void numbers() {
        for (int i = 0; i < 3; ++i) {
            const char* const at = (void(text_.at_line_end()), text_.here());
            const std::string_view word = text_.word();
            double value = 0;
            const auto [stop, error] =
                nearest_double(word.data(), word.data() + word.size(), value);
            if (word.empty() || error != std::errc{} || stop != word.data() + word.size()) {
                text_.go_back_to(at);
                return;
            }
        }
    }

    std::string rest_of_line() { return std::string(text_.rest_of_line()); }

    TextCursor text_;
    const InputText& source_;
    BesideFiles& files_;
    std::map<std::string, LibraryMaterial>& materials_;
    LibraryMaterial* current_ = nullptr;
};

}  // namespace

void read_material_library(std::string_view text, const std::string& name, const ReadLimits& limits,
                           BesideFiles& files, std::map<std::string, LibraryMaterial>& materials) {
    const InputText source(text, name, limits, false);
    LibraryReader(source, files, materials).read();
}

std::string material_library(const Model& model, const std::vector<std::string>& names,
                             const std::vector<std::string>& pictures) {
    std::string out = "# Trisect\n";
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        const ModelMaterial& material = model.materials[i];
        const ModelColor color = material.color.value_or(ModelColor{255, 255, 255, 255});
        out += "newmtl " + names[i] + "\n";
        TextWriter text(out);
        text << "Kd";
        for (std::size_t k = 0; k < 3; ++k) text << ' ' << color[k] / 255.0;
        text << '\n';
        if (color[3] != 255) text << "d " << color[3] / 255.0 << '\n';
        text.finish();
        if (material.texture == no_texture || pictures[material.texture].empty()) continue;
        const bool clamps = model.textures[material.texture].wrap[0] == TextureWrap::Clamp;
        out += std::string("map_Kd ") + (clamps ? "-clamp on " : "") + pictures[material.texture] +
               "\n";
    }
    return out;
}

}  // namespace trisect::detail
