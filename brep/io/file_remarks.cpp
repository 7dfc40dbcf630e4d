// SPDX-License-Identifier: Apache-2.0
//
// A second pass over the bytes, beside the readers: those are fast because they ignore all of this,
// and only `check` reports it. The file is well-formed, so words are skipped freely.
//
// STL states for each facet a normal that is redundant (3D Systems 1989: it "can be computed from
// the order of the vertices") and that programs therefore get wrong or leave out. Programs that
// shade or orient by it show another body than those that go by the corners.
#include <trisect/brep/io/file_remarks.h>

#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/formats/text_cursor.h>
#include <trisect/brep/polygon_mesh.h>

namespace trisect {
namespace {

using detail::InputText;
using detail::TextCursor;
using detail::TextRules;

/// Counts the findings of one kind and keeps the place of the first.
class Finding {
public:
    explicit Finding(RemarkKind kind) : kind_(kind) {}
    void add(const char* at) {
        if (count_++ == 0) first_ = at;
    }
    void append_to(std::vector<FileRemark>& out, const InputText& source, std::uint64_t of,
                   const std::string& sentence) const {
        if (count_ == 0) return;
        FileRemark remark;
        remark.kind = kind_;
        remark.count = count_;
        remark.of = of;
        remark.first = source.place(first_);
        remark.sentence = std::to_string(count_) + " of " + std::to_string(of) + " " + sentence +
                          " (first: " + remark.first.to_string() + ")";
        out.push_back(std::move(remark));
    }

private:
    RemarkKind kind_;
    std::uint64_t count_ = 0;
    const char* first_ = nullptr;
};

using FacetCorners = std::array<Point3d, 3>;

int exact_side(const FacetCorners& t, const Point3d& normal) {
    std::array<std::array<ExactRational, 3>, 2> edge;
    for (std::size_t e = 0; e < 2; ++e)
        for (std::size_t k = 0; k < 3; ++k)
            edge[e][k] =
                ExactRational::from_double(t[e + 1][k]) - ExactRational::from_double(t[0][k]);
    ExactRational sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        sum += ExactRational::from_double(normal[k]) *
               (edge[0][u] * edge[1][v] - edge[0][v] * edge[1][u]);
    }
    return sum.sign();
}

/// The sign of the product of a facet's normal and the one its corners wind about. Differences,
/// products and sums make at most seven roundings of 2^-53 relative to the sum of magnitudes; the
/// factor leaves room for fifty. Underflow makes the bound zero and overflow makes it infinite;
/// both go to the exact sign.
int side_of_normal(const FacetCorners& t, const Point3d& normal) {
    double sum = 0;
    double magnitude = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        const double a = (t[1][u] - t[0][u]) * (t[2][v] - t[0][v]);
        const double b = (t[1][v] - t[0][v]) * (t[2][u] - t[0][u]);
        sum += normal[k] * (a - b);
        magnitude += std::abs(normal[k]) * (std::abs(a) + std::abs(b));
    }
    if (magnitude > 1e-250 && std::abs(sum) > 5e-15 * magnitude) return sum > 0 ? 1 : -1;
    return exact_side(t, normal);
}

class NormalRemarks {
public:
    void facet(const std::optional<Point3d>& normal, const FacetCorners& corners, const char* at) {
        ++facets_;
        if (!normal || !has_direction(*normal)) return missing_.add(at);
        if (side_of_normal(corners, *normal) < 0) opposed_.add(at);
    }
    [[nodiscard]] std::vector<FileRemark> finish(const InputText& source) const {
        std::vector<FileRemark> out;
        missing_.append_to(out, source, facets_, "facets state no normal");
        opposed_.append_to(out, source, facets_,
                           "facets state a normal that opposes the order of their corners");
        return out;
    }

private:
    static bool has_direction(const Point3d& n) {
        return std::isfinite(n[0]) && std::isfinite(n[1]) && std::isfinite(n[2]) &&
               (n[0] != 0 || n[1] != 0 || n[2] != 0);
    }

    std::uint64_t facets_ = 0;
    Finding missing_{RemarkKind::FacetNormalMissing};
    Finding opposed_{RemarkKind::FacetNormalOpposed};
};

Point3d load_floats(const char* at) {
    Point3d p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = static_cast<double>(detail::load<float, false>(at + 4 * k));
    return p;
}

std::vector<FileRemark> remarks_on_binary_stl(const InputText& source) {
    NormalRemarks remarks;
    const std::uint64_t count = detail::load<std::uint32_t, false>(source.begin() + 80);
    const char* record = source.begin() + detail::stl_header_size;
    for (std::uint64_t i = 0; i < count; ++i, record += detail::stl_record_size)
        remarks.facet(
            load_floats(record),
            {load_floats(record + 12), load_floats(record + 24), load_floats(record + 36)}, record);
    return remarks.finish(source);
}

class AsciiStlRemarks {
public:
    explicit AsciiStlRemarks(const InputText& source)
        : source_(source), text_(source, TextRules{}) {}

    std::vector<FileRemark> collect() {
        while (text_.seek_word()) {
            const std::string_view word = text_.word();
            if (is(word, "solid") || is(word, "endsolid")) {
                (void)text_.next_line();  // a name may be any words
            } else if (is(word, "facet")) {
                facet(word.data());
            }
        }
        return remarks_.finish(source_);
    }

private:
    void facet(const char* at) {
        std::string_view word = next();
        std::optional<Point3d> normal;
        if (is(word, "normal")) {
            Point3d n{};
            std::size_t numbers = 0;
            word = next();
            for (; numbers < 3 && read(word, n[numbers]); ++numbers) word = next();
            if (numbers == 3) normal = n;
        }
        FacetCorners corners{};
        for (std::size_t i = 0; i < 3; word = next()) {
            if (word.empty()) return;
            if (!is(word, "vertex")) continue;
            for (double& c : corners[i]) (void)read(next(), c);
            ++i;
        }
        remarks_.facet(normal, corners, at);
    }

    std::string_view next() { return text_.seek_word() ? text_.word() : std::string_view(); }

    static bool read(std::string_view word, double& value) {
        if (word.starts_with('+')) word.remove_prefix(1);
        const char* end = word.data() + word.size();
        const auto [stop, error] = detail::nearest_double(word.data(), end, value);
        return stop == end && error == std::errc{};
    }

    static bool is(std::string_view word, std::string_view keyword) {
        return std::equal(
            word.begin(), word.end(), keyword.begin(), keyword.end(),
            [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
    }

    const InputText& source_;
    TextCursor text_;
    NormalRemarks remarks_;
};

std::vector<FileRemark> remarks_on_obj(const InputText& source) {
    TextCursor text(source, TextRules{.hash_comments = true, .continuation = true});
    Finding empty(RemarkKind::EmptyIndexField);
    std::uint64_t corners = 0;
    while (text.next_line()) {
        const std::string_view keyword = text.word();
        if (keyword != "f" && keyword != "fo") continue;
        while (!text.at_line_end()) {
            const std::string_view corner = text.word();
            ++corners;
            if (corner.ends_with('/')) empty.add(corner.data());
        }
    }
    std::vector<FileRemark> out;
    empty.append_to(out, source, corners, "corners have nothing behind their last slash");
    return out;
}

}  // namespace

std::string_view name_of(RemarkKind kind) {
    switch (kind) {
        case RemarkKind::FacetNormalMissing:
            return "facet_normal_missing";
        case RemarkKind::FacetNormalOpposed:
            return "facet_normal_opposed";
        case RemarkKind::EmptyIndexField:
            return "empty_index_field";
    }
    return "unknown";
}

std::vector<FileRemark> file_remarks(std::string_view data, MeshFormat format,
                                     const std::string& name) {
    if (format == MeshFormat::Stl) format = detect_stl_kind(data);
    const InputText source(data, name, ReadLimits{}, format == MeshFormat::StlBinary);
    switch (format) {
        case MeshFormat::Obj:
            return remarks_on_obj(source);
        case MeshFormat::StlBinary:
            return remarks_on_binary_stl(source);
        case MeshFormat::Stl:
        case MeshFormat::StlAscii:
            return AsciiStlRemarks(source).collect();
        default:
            return {};
    }
}

}  // namespace trisect
