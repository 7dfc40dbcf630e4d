// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/io/exact_boundary.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <trisect/brep/brep_builder.h>
#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/formats/text_cursor.h>
#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/brep/planar_loops.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>

namespace trisect {

namespace {

using detail::InputText;
using detail::TextCursor;
using detail::TextRules;

// ---------------------------------------------------------------- writing

// Bits of the coefficients of planes.
struct Widths {
    int normal;
    int offset;
};
constexpr Widths widths_of(int version) {
    return version == 1 ? Widths{109, 162} : Widths{328, 383};
}

// An integer, or the shortest digits that read back as the same double.
std::string coordinate_text(Coordinate c) {
    if (c.is_whole()) return std::to_string(c.to_integer());
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), c.to_double()).ptr};
}

// Planes by their coefficients; a number for each.
class PlaneTable {
public:
    std::uint32_t number_of(const Plane& p) {
        const Key key{p.normal(0), p.normal(1), p.normal(2), p.offset()};
        const auto [it, is_new] =
            numbers_.try_emplace(key, static_cast<std::uint32_t>(planes_.size()));
        if (is_new) planes_.push_back(p);
        return it->second;
    }
    [[nodiscard]] const std::vector<Plane>& planes() const { return planes_; }

private:
    struct Key {
        Plane::Coefficient a, b, c, d;
        bool operator<(const Key& o) const {
            if (a != o.a) return a < o.a;
            if (b != o.b) return b < o.b;
            if (c != o.c) return c < o.c;
            return d < o.d;
        }
    };
    std::map<Key, std::uint32_t> numbers_;
    std::vector<Plane> planes_;
};

class Writer {
public:
    explicit Writer(const Brep& brep) : brep_(brep) {}

    std::string write() {
        number_vertices();
        // Planes get their numbers while vertices and faces are written, but stand before them.
        write_vertices();
        write_faces();
        std::string head = "trisect-exact " + std::to_string(version()) + "\nlattice " +
                           std::to_string(brep_.lattice().exponent) + "\nplanes " +
                           std::to_string(planes_.planes().size()) + '\n';
        for (const Plane& p : planes_.planes()) {
            for (int i = 0; i < 3; ++i) head += detail::to_gmp(p.normal(i)).get_str() + ' ';
            head += detail::to_gmp(p.offset()).get_str() + '\n';
        }
        return head + body_;
    }

private:
    // The first one wherever it can say what there is.
    [[nodiscard]] int version() const {
        const bool fits = std::ranges::all_of(planes_.planes(), [](const Plane& p) {
            const Widths& most = widths_of(1);
            return p.offset().bit_length() <= most.offset &&
                   p.normal(0).bit_length() <= most.normal &&
                   p.normal(1).bit_length() <= most.normal &&
                   p.normal(2).bit_length() <= most.normal;
        });
        return fits && are_whole_ && brep_.lattice().exponent % 8 == 0 ? 1 : 2;
    }
    // Copies of a vertex are one.
    void number_vertices() {
        number_.resize(brep_.vertices().size());
        for (const VertexId v : brep_.vertices()) {
            const auto copies = brep_.copies(v);
            const VertexId first =
                copies.empty() ? v : *std::min_element(copies.begin(), copies.end());
            if (first == v) {
                number_[v.index] = static_cast<std::uint32_t>(listed_.size());
                listed_.push_back(v);
            } else {
                number_[v.index] = number_[first.index];
            }
        }
    }
    void write_vertices() {
        body_ += "vertices " + std::to_string(listed_.size()) + '\n';
        for (const VertexId v : listed_) {
            const Point& p = brep_.point(v);
            if (p.is_lattice()) {
                body_ += 'p';
                for (int i = 0; i < 3; ++i) body_ += ' ' + coordinate_text(p.lattice()[i]);
                are_whole_ = are_whole_ && p.lattice().is_whole();
            } else {
                body_ += 'q';
                for (const Plane& plane : p.plane_point()->planes)
                    body_ += ' ' + std::to_string(planes_.number_of(plane));
            }
            body_ += '\n';
        }
    }
    void write_faces() {
        body_ += "faces " + std::to_string(brep_.faces().size()) + '\n';
        for (const FaceId f : brep_.faces()) {
            const FaceSource source = brep_.source(f);
            body_ += std::to_string(planes_.number_of(brep_.plane(f))) + ' ' +
                     std::to_string(source.operand) + ' ' + std::to_string(source.face) + ' ' +
                     std::to_string(brep_.loops(f).size());
            for (const LoopId l : brep_.loops(f)) {
                body_ += ' ' + std::to_string(brep_.halfedges(l).size());
                for (const HalfedgeId h : brep_.halfedges(l))
                    body_ += ' ' + std::to_string(number_[brep_.origin(h).index]);
            }
            body_ += '\n';
        }
    }

    const Brep& brep_;
    PlaneTable planes_;
    std::vector<std::uint32_t> number_;
    std::vector<VertexId> listed_;
    std::string body_;
    bool are_whole_ = true;
};

// ---------------------------------------------------------------- reading

class Reader {
public:
    explicit Reader(const InputText& source)
        : source_(source), text_(source, TextRules{.hash_comments = true, .continuation = false}) {}

    Brep read() {
        expect("trisect-exact");
        const std::int64_t version = text_.integer("the version");
        if (version != 1 && version != 2) text_.fail_word("the version", "is neither 1 nor 2");
        version_ = static_cast<int>(version);
        text_.expect_line_end();
        expect("lattice");
        const std::int64_t exponent = text_.integer("the lattice's exponent");
        const bool in_range = exponent >= -1200 && exponent <= 1016;
        if (version_ == 1 && (!in_range || exponent % 8 != 0))
            text_.fail_word("the lattice's exponent", "is not a multiple of 8 from -1200 to 1016");
        if (!in_range) text_.fail_word("the lattice's exponent", "is not from -1200 to 1016");
        text_.expect_line_end();
        read_planes();
        read_vertices();
        BrepBuilder builder(Lattice{static_cast<int>(exponent)});
        for (const Point& p : points_) builder.add_vertex(p);
        read_faces(builder);
        if (text_.seek_word()) {
            const std::string_view extra = text_.word();
            source_.fail(extra.data(), detail::shown_word(extra) + " after the last face");
        }
        return std::move(builder).build();
    }

private:
    void expect(std::string_view keyword) {
        if (!text_.seek_word())
            source_.fail(text_.here(),
                         "the file ends where '" + std::string(keyword) + "' is expected");
        const std::string_view word = text_.word();
        if (word != keyword)
            source_.fail(word.data(), detail::shown_word(word) + " where '" + std::string(keyword) +
                                          "' is expected");
    }
    // "planes 12" and its kind. Counts beyond what the file can hold are refused at once.
    std::uint64_t counted(const char* keyword, std::uint64_t limit) {
        expect(keyword);
        const std::uint64_t n = text_.count("a number of lines");
        const char* at = text_.last_number();
        text_.expect_line_end();
        if (n > limit) source_.fail_limit(at, "more than " + std::to_string(limit) + ' ' + keyword);
        if (n > static_cast<std::uint64_t>(source_.end() - text_.here()))
            source_.fail(at,
                         "more " + std::string(keyword) + " than the rest of the file can hold");
        return n;
    }
    void seek(const char* what, std::uint64_t i, std::uint64_t n) {
        if (!text_.seek_word())
            source_.fail(text_.here(), "the file ends before " + std::string(what) + ' ' +
                                           std::to_string(i) + " of " + std::to_string(n));
    }
    std::uint32_t index(const char* what, std::size_t size) {
        const std::uint64_t i = text_.count(what);
        if (i >= size) text_.fail_word(what, "is out of range");
        return static_cast<std::uint32_t>(i);
    }

    // An integer below 2^bits.
    Plane::Coefficient wide(const char* what, int bits) {
        const std::string_view word = text_.word();
        std::string_view digits = word;
        if (!digits.empty() && digits.front() == '-') digits.remove_prefix(1);
        const bool good =
            !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
        if (!good)
            source_.fail(word.empty() ? text_.here() : word.data(),
                         detail::shown_word(word) + ", read as " + what + ", is not an integer");
        // 10^116 < 2^386: nothing is lost before the check.
        constexpr std::size_t most_digits = 116;
        WideInt<7> value;
        if (digits.size() <= most_digits)
            for (const char c : digits)
                value = multiply<7>(value, WideInt<1>(10)) + WideInt<7>(c - '0');
        if (digits.size() > most_digits || value.bit_length() > bits)
            source_.fail(word.data(), detail::shown_word(word) + ", read as " + what +
                                          ", is not below 2^" + std::to_string(bits));
        return Plane::Coefficient(word.front() == '-' ? -value : value);
    }
    Plane::Coefficient narrow(const char* what) { return wide(what, widths_of(version_).normal); }

    void read_planes() {
        const std::uint64_t n = counted("planes", source_.limits().faces);
        for (std::uint64_t i = 0; i < n; ++i) {
            seek("plane", i, n);
            const char* at = text_.here();
            const Plane::Coefficient a = narrow("a coefficient of a plane");
            const Plane::Coefficient b = narrow("a coefficient of a plane");
            const Plane::Coefficient c = narrow("a coefficient of a plane");
            const Plane::Coefficient d = wide("the offset of a plane", widths_of(version_).offset);
            text_.expect_line_end();
            if (a == 0 && b == 0 && c == 0) source_.fail(at, "a plane without a normal");
            planes_.emplace_back(a, b, c, d);
        }
    }

    Coordinate coordinate() {
        if (version_ > 1) return fraction();
        const std::int64_t c = text_.integer("a coordinate");
        if (c <= -coordinate_limit || c >= coordinate_limit)
            text_.fail_word("a coordinate", "is not below 2^53");
        return c;
    }
    Coordinate fraction() {
        const double v = text_.real("a coordinate");
        if (!(std::fabs(v) < static_cast<double>(coordinate_limit)))
            text_.fail_word("a coordinate", "is not below 2^53");
        const Coordinate c(v);
        if (detail::fraction_bits(c) > fraction_limit)
            text_.fail_word("a coordinate", "has more than 73 bits behind the point");
        return c;
    }
    static bool meet_in_one_point(const Plane& p, const Plane& q, const Plane& r) {
        std::array<std::array<mpz_class, 3>, 3> m;
        const std::array<const Plane*, 3> planes{&p, &q, &r};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                m[i][j] = detail::to_gmp(planes[i]->normal(static_cast<int>(j)));
        const mpz_class det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                              m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                              m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        return det != 0;
    }
    void read_vertices() {
        const std::uint64_t n = counted("vertices", source_.limits().vertices);
        std::vector<const char*> places;
        for (std::uint64_t i = 0; i < n; ++i) {
            seek("vertex", i, n);
            const std::string_view kind = text_.word();
            places.push_back(kind.data());
            if (kind == "p") {
                const Coordinate x = coordinate();
                const Coordinate y = coordinate();
                points_.emplace_back(LatticePoint{x, y, coordinate()});
            } else if (kind == "q") {
                std::array<std::uint32_t, 3> k{};
                for (std::uint32_t& number : k)
                    number = index("a plane of a vertex", planes_.size());
                if (!meet_in_one_point(planes_[k[0]], planes_[k[1]], planes_[k[2]]))
                    source_.fail(kind.data(), "the planes of a vertex do not meet in one point");
                points_.emplace_back(planes_[k[0]], planes_[k[1]], planes_[k[2]]);
            } else {
                source_.fail(kind.data(),
                             detail::shown_word(kind) + " where 'p' or 'q' is expected");
            }
            text_.expect_line_end();
        }
        std::vector<std::uint32_t> order(points_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return compare_lexicographic(points_[a], points_[b]) < 0;
        });
        for (std::size_t i = 1; i < order.size(); ++i)
            if (points_[order[i - 1]] == points_[order[i]])
                source_.fail(places[std::max(order[i - 1], order[i])],
                             "a vertex at the place of vertex " +
                                 std::to_string(std::min(order[i - 1], order[i])));
    }

    void read_faces(BrepBuilder& builder) {
        const std::uint64_t n = counted("faces", source_.limits().faces);
        std::vector<std::vector<std::uint32_t>> loops;
        for (std::uint64_t i = 0; i < n; ++i) {
            seek("face", i, n);
            const Plane& plane = planes_[index("the plane of a face", planes_.size())];
            FaceSource source;
            source.operand = index("the operand of a face", EntityId<void>::none);
            source.face = index("the source of a face", EntityId<void>::none);
            const std::uint64_t count = text_.count("the number of loops");
            if (count == 0) text_.fail_word("the number of loops", "is 0");
            loops.clear();
            for (std::uint64_t l = 0; l < count; ++l) {
                const char* at = nullptr;
                loops.push_back(loop(plane, l == 0 ? 3 : 2, at));
                if (!runs_around(plane, loops.back(), l == 0))
                    source_.fail(at, l == 0 ? "the outer loop of a face runs clockwise"
                                            : "a hole of a face runs counter-clockwise");
            }
            text_.expect_line_end();
            builder.add_face(plane, loops, source);
        }
    }
    // Told by the corner that is farthest to one side. All that a face has there is on the other
    // side of it, so an outer loop turns left at it each time that it comes by; a hole has the face
    // around it and turns right, at least once.
    bool runs_around(const Plane& plane, const std::vector<std::uint32_t>& loop,
                     bool is_outer) const {
        const PlaneProjection seen(plane, points_);
        const std::size_t n = loop.size();
        std::uint32_t farthest = loop[0];
        for (const std::uint32_t v : loop)
            if (seen.compare(v, farthest) < 0) farthest = v;
        bool any_left = false;
        bool any_right = false;
        for (std::size_t i = 0; i < n; ++i) {
            if (loop[i] != farthest) continue;
            const int turn = seen.orientation(loop[(i + n - 1) % n], loop[i], loop[(i + 1) % n]);
            (turn > 0 ? any_left : any_right) = true;
        }
        return is_outer ? !any_right : any_right;
    }
    // `at` becomes the place of the loop. A hole of two corners is a slit.
    std::vector<std::uint32_t> loop(const Plane& plane, std::uint64_t least, const char*& at) {
        const std::uint64_t n = text_.count("the number of corners of a loop");
        at = text_.last_number();
        if (n < least)
            text_.fail_word("the number of corners of a loop",
                            ("is less than " + std::to_string(least)).c_str());
        if (n > source_.limits().loop_corners)
            source_.fail_limit(text_.last_number(),
                               "a loop of more than " +
                                   std::to_string(source_.limits().loop_corners) + " corners");
        std::vector<std::uint32_t> corners;
        for (std::uint64_t k = 0; k < n; ++k) {
            corners.push_back(index("a corner", points_.size()));
            if (side_of(points_[corners.back()], plane) != Side::On)
                text_.fail_word("a corner", "is not on the plane of its face");
        }
        return corners;
    }

    int version_ = 1;
    const InputText& source_;
    TextCursor text_;
    std::vector<Plane> planes_;
    std::vector<Point> points_;
};

}  // namespace

std::string exact_text(const Brep& brep) { return Writer(brep).write(); }

Brep read_exact(std::string_view text, const std::string& name, const ReadLimits& limits) {
    const InputText source(text, name, limits, false);
    if (text.size() > limits.bytes)
        throw LimitError(name + ": more than " + std::to_string(limits.bytes) +
                         " bytes, the limit for a file");
    return Reader(source).read();
}

Brep read_exact(const std::filesystem::path& path, const ReadLimits& limits) {
    const FileBytes bytes = read_file(path, limits.bytes);
    return read_exact(bytes.view(), path.string(), limits);
}

}  // namespace trisect
