// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/io/read_patches.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/formats/text_cursor.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::InputText;
using detail::TextCursor;
using detail::TextRules;

class PatchReader {
public:
    explicit PatchReader(const InputText& source)
        : source_(source), text_(source, TextRules{.hash_comments = true, .continuation = false}) {}

    std::vector<BezierPatch> read() {
        seek("the number of patches");
        const std::uint64_t count = text_.count("the number of patches");
        const char* at = text_.last_number();
        text_.expect_line_end();
        if (count > source_.limits().faces)
            source_.fail_limit(at,
                               "more than " + std::to_string(source_.limits().faces) + " patches");
        std::vector<BezierPatch> patches;
        for (std::uint64_t i = 0; i < count; ++i) {
            seek("patch " + std::to_string(i + 1) + " of " + std::to_string(count));
            patches.push_back(patch());
        }
        if (text_.seek_word()) {
            const std::string_view extra = text_.word();
            source_.fail(extra.data(), detail::shown_word(extra) + " after the last of the " +
                                           std::to_string(count) +
                                           " patches that the first line states");
        }
        return patches;
    }

private:
    void seek(const std::string& what) {
        if (!text_.seek_word()) source_.fail(text_.here(), "the file ends before " + what);
    }
    std::size_t degree(const char* what) {
        const std::uint64_t d = text_.count(what);
        if (d == 0 || d > BezierPatch::max_degree) text_.fail_word(what, "is not from 1 to 24");
        return d;
    }

    BezierPatch patch() {
        const char* at = text_.here();
        const std::size_t p = degree("the degree in u");
        const std::size_t q = degree("the degree in v");
        text_.expect_line_end();
        const std::size_t count = (p + 1) * (q + 1);
        points_ += count;
        if (points_ > source_.limits().vertices)
            source_.fail_limit(
                at, "more than " + std::to_string(source_.limits().vertices) + " control points");
        std::vector<Point3d> points;
        std::vector<double> weights;
        bool rational = false;
        for (std::size_t k = 0; k < count; ++k) {
            seek("control point " + std::to_string(k + 1) + " of " + std::to_string(count) +
                 " of a patch");
            const char* line = text_.here();
            Point3d c{};
            c[0] = text_.real("the x coordinate of a control point");
            c[1] = text_.real("the y coordinate of a control point");
            c[2] = text_.real("the z coordinate of a control point");
            points.push_back(c);
            const bool weighted = !text_.at_line_end();
            if (k == 0) rational = weighted;
            if (weighted != rational)
                source_.fail(line,
                             rational ? "a control point without a weight in a rational patch"
                                      : "a control point with a weight in a patch whose first ones "
                                        "have none");
            if (weighted) weights.push_back(text_.real("the weight of a control point"));
            text_.expect_line_end();
        }
        try {
            return {p, q, std::move(points), std::move(weights)};
        } catch (const UsageError& e) {
            source_.fail(at, e.what());
        }
    }

    const InputText& source_;
    TextCursor text_;
    std::uint64_t points_ = 0;
};

}  // namespace

std::vector<BezierPatch> read_patches(std::string_view text, const std::string& name,
                                      const ReadLimits& limits) {
    const InputText source(text, name, limits, false);
    if (text.size() > limits.bytes)
        throw LimitError(name + ": more than " + std::to_string(limits.bytes) +
                         " bytes, the limit for a file");
    return PatchReader(source).read();
}

std::vector<BezierPatch> read_patches(const std::filesystem::path& path, const ReadLimits& limits) {
    const FileBytes bytes = read_file(path, limits.bytes);
    return read_patches(bytes.view(), path.string(), limits);
}

std::string patches_text(std::span<const BezierPatch> patches) {
    std::string out;
    detail::TextWriter text(out);
    text << std::uint64_t{patches.size()} << '\n';
    for (const BezierPatch& p : patches) {
        text << std::uint64_t{p.degree_u()} << ' ' << std::uint64_t{p.degree_v()} << '\n';
        const bool rational =
            std::any_of(p.weights().begin(), p.weights().end(), [](double w) { return w != 1; });
        for (std::size_t k = 0; k < p.points().size(); ++k) {
            text << p.points()[k];
            if (rational) text << ' ' << p.weights()[k];
            text << '\n';
        }
    }
    text.finish();
    return out;
}

}  // namespace trisect
