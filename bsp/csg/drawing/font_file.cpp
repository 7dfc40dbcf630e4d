// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/font_file.h>

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string_view>

#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

constexpr const char* default_font = "Liberation Sans:style=Regular";

struct DestroyPattern {
    void operator()(FcPattern* p) const { FcPatternDestroy(p); }
};
using Pattern = std::unique_ptr<FcPattern, DestroyPattern>;

const FcChar8* bytes_of(const std::string& text) {
    return reinterpret_cast<const FcChar8*>(text.c_str());
}

/// Loading takes some ten milliseconds, so it is done once.
FcConfig* configuration() {
    static FcConfig* const loaded = [] {
        FcConfig* config = FcInitLoadConfigAndFonts();
        const char* folders = std::getenv("OPENSCAD_FONT_PATH");
        std::string_view rest = folders == nullptr ? "" : folders;
        while (config != nullptr && !rest.empty()) {
            const std::size_t end = std::min(rest.find(':'), rest.size());
            const std::string folder(rest.substr(0, end));
            if (!folder.empty()) FcConfigAppFontAddDir(config, bytes_of(folder));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        return config;
    }();
    return loaded;
}

std::string text_of(const Pattern& pattern, const char* property, int index) {
    FcChar8* out = nullptr;
    if (FcPatternGetString(pattern.get(), property, index, &out) != FcResultMatch) return {};
    return reinterpret_cast<const char*>(out);
}

bool is_same_family(const std::string& a, const std::string& b) {
    return FcStrCmpIgnoreCase(bytes_of(a), bytes_of(b)) == 0;
}

}  // namespace

FontFile find_font(const std::string& pattern) {
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);
    FcConfig* const config = configuration();
    const bool is_blank = pattern.find_first_not_of(" \t") == std::string::npos;
    const std::string wanted_name = is_blank ? default_font : pattern;
    const Pattern wanted(FcNameParse(bytes_of(wanted_name)));
    if (config == nullptr || !wanted)
        throw UnsupportedError("no font is found for '" + pattern.substr(0, 60) + "'");
    const std::string family = text_of(wanted, FC_FAMILY, 0);
    FcPatternAddBool(wanted.get(), FC_OUTLINE, FcTrue);
    FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
    FcConfigSubstitute(config, wanted.get(), FcMatchPattern);
    FcDefaultSubstitute(wanted.get());
    FcResult result = FcResultNoMatch;
    const Pattern match(FcFontMatch(config, wanted.get(), &result));
    FontFile out;
    if (match) out.path = text_of(match, FC_FILE, 0);
    if (out.path.empty())
        throw UnsupportedError("no font is found for '" + pattern.substr(0, 60) + "'");
    (void)FcPatternGetInteger(match.get(), FC_INDEX, 0, &out.face);
    out.family = text_of(match, FC_FAMILY, 0);
    out.has_family = family.empty();
    for (int i = 0; !out.has_family; ++i) {
        const std::string name = text_of(match, FC_FAMILY, i);
        if (name.empty()) break;
        out.has_family = is_same_family(name, family);
    }
    return out;
}

}  // namespace trisect::detail
