// SPDX-License-Identifier: Apache-2.0
#include "triangle_stream.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <sstream>
#include <string_view>
#include <vector>

#include <trisect/kernel/error.h>

#include "piecewise_file.h"

namespace trisect::app {

namespace {

// Records that are read at a time.
constexpr std::uint64_t records_at_once = 16384;
// After which mapped memory is given back.
constexpr std::uint64_t records_of_a_mapping = 128 * records_at_once;

template <class T>
T number_at(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

// --- STL: a header of 80 bytes, a count, records of a normal, three corners and two bytes.

constexpr std::uint64_t stl_header = 84;
constexpr std::uint64_t stl_record = 50;

class StlStream final : public TriangleStream {
public:
    explicit StlStream(const std::string& name) : file_(name) {
        std::array<char, 4> count{};
        file_.read(80, count);
        size_ = number_at<std::uint32_t>(count.data());
        const std::uint64_t bytes = stl_header + stl_record * size_;
        if (file_.size() < bytes)
            throw InputError({name, 0, 0, file_.size()},
                             "the file ends before its " + std::to_string(size_) + " triangles");
    }
    [[nodiscard]] std::uint64_t size() const override { return size_; }
    [[nodiscard]] bool is_single() const override { return true; }
    void read(std::uint64_t begin, std::uint64_t end,
              const std::function<void(std::uint64_t, const Corners&)>& take) const override {
        std::vector<char> bytes(records_at_once * stl_record);
        for (std::uint64_t at = begin; at < end; at += records_at_once) {
            const std::uint64_t n = std::min(records_at_once, end - at);
            file_.read(stl_header + stl_record * at, std::span(bytes).first(n * stl_record));
            for (std::uint64_t i = 0; i < n; ++i) {
                Corners c;
                const char* from = bytes.data() + i * stl_record + 12;
                for (Point3d& p : c)
                    for (double& x : p) {
                        x = static_cast<double>(number_at<float>(from)) + 0.0;
                        from += sizeof(float);
                    }
                take(at + i, c);
            }
        }
    }

private:
    InputFile file_;
    std::uint64_t size_ = 0;
};

// --- PLY: points of one size, then triangles of one size.

std::size_t bytes_of_type(const std::string& type) {
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
    if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
    if (type == "int" || type == "uint" || type == "int32" || type == "uint32") return 4;
    if (type == "float" || type == "float32") return 4;
    if (type == "double" || type == "float64") return 8;
    return 0;
}

/// Offsets of all that is read.
struct PlyLayout {
    std::uint64_t points = 0;
    std::uint64_t point_bytes = 0;
    std::array<std::uint64_t, 3> coordinate{};
    bool is_double = false;
    std::uint64_t faces = 0;
    std::uint64_t face_bytes = 0;
    std::uint64_t corners = 0;  ///< of a face's numbers, behind their count
    std::uint64_t header = 0;
};

class PlyHeader {
public:
    explicit PlyHeader(const std::string& name) : name_(name) {}

    PlyLayout read(const InputFile& file) {
        std::string text(std::min<std::uint64_t>(file.size(), 65536), '\0');
        file.read(0, text);
        const std::string_view last = "end_header\n";
        const std::size_t end = text.find(last);
        if (end == std::string::npos) refuse("its header has no end");
        layout_.header = end + last.size();
        std::istringstream lines(text.substr(0, end));
        for (std::string line; std::getline(lines, line);) take(line);
        if (found_ != 7 || layout_.corners == 0) refuse("it lacks x, y, z or its faces");
        return layout_;
    }

private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw UnsupportedError(name_ + ": is not read in pieces: " + why);
    }
    void take(const std::string& line) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "format") {
            words >> word;
            if (word != "binary_little_endian") refuse("its format is " + word);
        } else if (word == "element") {
            std::uint64_t count = 0;
            words >> element_ >> count;
            if (element_ == "vertex" && layout_.faces == 0)
                layout_.points = count;
            else if (element_ == "face")
                layout_.faces = count;
            else if (layout_.faces == 0)
                refuse("it has the element " + element_);
        } else if (word == "property" && element_ == "vertex") {
            std::string type;
            words >> type >> word;
            add_to_point(type, word);
        } else if (word == "property" && element_ == "face") {
            std::string type;
            words >> type;
            add_to_face(type, words);
        }
    }
    void add_to_point(const std::string& type, const std::string& what) {
        const std::size_t bytes = bytes_of_type(type);
        if (bytes == 0) refuse("a point has a property " + type);
        if (what == "x" || what == "y" || what == "z") {
            const bool is_double = bytes == 8;
            if ((type[0] != 'f' && type[0] != 'd') ||
                (found_ != 0 && is_double != layout_.is_double))
                refuse("coordinates are " + type);
            layout_.is_double = is_double;
            const auto k = static_cast<std::size_t>(what[0] - 'x');
            layout_.coordinate[k] = layout_.point_bytes;
            found_ |= 1U << k;
        }
        layout_.point_bytes += bytes;
    }
    void add_to_face(const std::string& type, std::istringstream& words) {
        if (type != "list") {
            const std::size_t bytes = bytes_of_type(type);
            if (bytes == 0) refuse("a face has a property " + type);
            layout_.face_bytes += bytes;
            return;
        }
        std::string count;
        std::string number;
        words >> count >> number;
        if (layout_.corners != 0 || bytes_of_type(count) != 1 || bytes_of_type(number) != 4)
            refuse("its lists are other than one of uchar and int");
        layout_.corners = layout_.face_bytes + 1;
        layout_.face_bytes += 13;
    }

    const std::string& name_;
    PlyLayout layout_;
    std::string element_;
    unsigned found_ = 0;
};

class PlyStream final : public TriangleStream {
public:
    explicit PlyStream(const std::string& name)
        : file_(name), layout_(PlyHeader(file_.name()).read(file_)) {
        const std::uint64_t most = file_.size() - layout_.header;
        if (layout_.points > most / layout_.point_bytes ||
            layout_.faces > (most - layout_.points * layout_.point_bytes) / layout_.face_bytes)
            throw InputError({name, 0, 0, file_.size()}, "the file ends before its faces");
        first_face_ = layout_.header + layout_.points * layout_.point_bytes;
    }
    [[nodiscard]] std::uint64_t size() const override { return layout_.faces; }
    [[nodiscard]] bool is_single() const override { return !layout_.is_double; }
    void read(std::uint64_t begin, std::uint64_t end,
              const std::function<void(std::uint64_t, const Corners&)>& take) const override {
        const char* const points = file_.mapped() + layout_.header;
        std::vector<char> bytes(records_at_once * layout_.face_bytes);
        for (std::uint64_t at = begin; at < end; at += records_at_once) {
            const std::uint64_t n = std::min(records_at_once, end - at);
            if (at % records_of_a_mapping < records_at_once) file_.release();
            const std::uint64_t offset = first_face_ + layout_.face_bytes * at;
            file_.read(offset, std::span(bytes).first(n * layout_.face_bytes));
            for (std::uint64_t i = 0; i < n; ++i)
                take(at + i, corners_of(bytes.data() + i * layout_.face_bytes,
                                        offset + i * layout_.face_bytes, points));
        }
    }

private:
    Corners corners_of(const char* face, std::uint64_t offset, const char* points) const {
        if (face[layout_.corners - 1] != 3)
            throw UnsupportedError(file_.name() + ": byte " + std::to_string(offset) +
                                   ": only triangles are read in pieces");
        Corners c;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto number =
                number_at<std::uint32_t>(face + layout_.corners + i * sizeof(std::uint32_t));
            if (number >= layout_.points)
                throw InputError({file_.name(), 0, 0, offset}, "a corner is no point of the file");
            const char* const point = points + number * layout_.point_bytes;
            for (std::size_t k = 0; k < 3; ++k) {
                const char* const x = point + layout_.coordinate[k];
                c[i][k] = (layout_.is_double ? number_at<double>(x)
                                             : static_cast<double>(number_at<float>(x))) +
                          0.0;
            }
        }
        return c;
    }

    InputFile file_;
    PlyLayout layout_;
    std::uint64_t first_face_ = 0;
};

// --- Corners as they are in memory.

class GatheredStream final : public TriangleStream {
public:
    explicit GatheredStream(const std::string& name) : file_(name) {}
    [[nodiscard]] std::uint64_t size() const override { return file_.size() / sizeof(Corners); }
    [[nodiscard]] bool is_single() const override { return false; }
    void read(std::uint64_t begin, std::uint64_t end,
              const std::function<void(std::uint64_t, const Corners&)>& take) const override {
        std::vector<Corners> corners(records_at_once);
        for (std::uint64_t at = begin; at < end; at += records_at_once) {
            const std::uint64_t n = std::min(records_at_once, end - at);
            file_.read(at * sizeof(Corners),
                       {reinterpret_cast<char*>(corners.data()), n * sizeof(Corners)});
            for (std::uint64_t i = 0; i < n; ++i) take(at + i, corners[i]);
        }
    }

private:
    InputFile file_;
};

enum class StreamKind : std::uint8_t { Stl, Ply, Other };

StreamKind kind_of(const InputFile& file) {
    std::array<char, stl_header> first{};
    const auto n = std::min<std::uint64_t>(file.size(), first.size());
    file.read(0, std::span(first).first(n));
    const std::string_view text(first.data(), n);
    if (text.starts_with("ply\n")) return StreamKind::Ply;
    if (n < stl_header) return StreamKind::Other;
    const std::uint64_t count = number_at<std::uint32_t>(first.data() + 80);
    const std::uint64_t bytes = stl_header + stl_record * count;
    // What begins like a text may be binary all the same; then its size fits.
    return !text.starts_with("solid") || bytes == file.size() ? StreamKind::Stl : StreamKind::Other;
}

bool is_named(const std::string& name, std::string_view ending) {
    if (name.size() < ending.size()) return false;
    return std::equal(ending.rbegin(), ending.rend(), name.rbegin(), [](char a, char b) {
        return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
    });
}

}  // namespace

std::unique_ptr<TriangleStream> TriangleStream::open(const std::string& name) {
    const StreamKind kind = kind_of(InputFile(name));
    if (kind == StreamKind::Ply) return std::make_unique<PlyStream>(name);
    if (kind == StreamKind::Stl && is_named(name, ".stl")) return std::make_unique<StlStream>(name);
    throw UnsupportedError(name + ": only binary STL and binary PLY are read in pieces");
}

std::unique_ptr<TriangleStream> TriangleStream::open_gathered(const std::string& name) {
    return std::make_unique<GatheredStream>(name);
}

bool TriangleStream::can_open(const std::string& name) {
    try {
        (void)open(name);
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace trisect::app
