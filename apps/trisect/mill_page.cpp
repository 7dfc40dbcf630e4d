// SPDX-License-Identifier: Apache-2.0
//
// The numbers are arrays one after the other, deflated together and written in base64. Indices and
// coordinates are differences to the one before, as bytes of seven bits: neighbours in a mesh are
// neighbours in its lists, so most take one byte or two.
#include "mill_page.h"

#include <trisect/kernel/error.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

namespace trisect::app {
namespace {

/// Bytes of several arrays, with their places for the reader.
class PageData {
public:
    void add(const char* name, std::string_view bytes) {
        while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
        places_[name] = {bytes_.size(), bytes.size()};
        bytes_ += bytes;
    }
    void add_floats(const char* name, const std::vector<float>& values) {
        static_assert(std::endian::native == std::endian::little);
        std::string bytes(values.size() * sizeof(float), '\0');
        if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
        add(name, bytes);
    }
    [[nodiscard]] const Json& places() const { return places_; }
    [[nodiscard]] std::string deflated() const {
        uLongf size = compressBound(static_cast<uLong>(bytes_.size()));
        std::string out(size, '\0');
        const int result = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                                     reinterpret_cast<const Bytef*>(bytes_.data()),
                                     static_cast<uLong>(bytes_.size()), Z_DEFAULT_COMPRESSION);
        if (result != Z_OK) throw LimitError("no memory for the data of the page");
        out.resize(size);
        return out;
    }

private:
    std::string bytes_;
    Json places_ = Json::object();
};

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word =
                word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : digits[(word >> (18 - 6 * k)) & 63];
    }
    return out;
}

/// Differences of integers, the sign in the last bit, seven bits a byte, the lowest first.
class Differences {
public:
    void add(std::int64_t value) {
        const std::int64_t d = value - last_;
        last_ = value;
        auto n = static_cast<std::uint64_t>(d < 0 ? -2 * d - 1 : 2 * d);
        for (; n >= 128; n >>= 7) bytes_ += static_cast<char>((n & 127) | 128);
        bytes_ += static_cast<char>(n);
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::int64_t last_ = 0;
};

Bounds box_of(const std::vector<Point3d>& points) {
    if (points.empty()) return {};
    Bounds box{points.front(), points.front()};
    for (const Point3d& p : points)
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = std::min(box.lo[k], p[k]);
            box.hi[k] = std::max(box.hi[k], p[k]);
        }
    return box;
}

void add_film(PageData& data, Json& facts, const MillFilm& film) {
    const Bounds box = box_of(film.points());
    for (std::size_t k = 0; k < 3; ++k) {
        const double extent = std::max(box.hi[k] - box.lo[k], 1e-300);
        Differences coordinates;
        for (const Point3d& p : film.points())
            coordinates.add(std::lround((p[k] - box.lo[k]) / extent * 65535));
        constexpr std::array names{"x", "y", "z"};
        data.add(names.at(k), coordinates.bytes());
    }
    Differences corners;
    std::string births;
    std::string deaths;
    std::string cuts;
    for (const MillFilm::Triangle& t : film.triangles()) {
        for (const std::uint32_t c : t.corners) corners.add(c);
        births += static_cast<char>(t.birth);
        deaths += static_cast<char>(t.death);
        cuts += static_cast<char>(t.is_cut ? 1 : 0);
    }
    data.add("corners", corners.bytes());
    data.add("births", births);
    data.add("deaths", deaths);
    data.add("cuts", cuts);
    facts["box"] = {box.lo, box.hi};
    facts["points"] = film.points().size();
    facts["triangles"] = film.triangles().size();
    facts["frames"] = film.frames();
}

/// Corners of triangles, nine numbers each.
std::vector<float> soup_of(const PolygonMesh& mesh) {
    std::vector<float> out;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto c = mesh.face(f);
        for (std::size_t i = 1; i + 1 < c.size(); ++i)
            for (const std::uint32_t v : {c[0], c[i], c[i + 1]})
                for (const double x : mesh.points[v]) out.push_back(static_cast<float>(x));
    }
    return out;
}

PolygonMesh tool_mesh(const MillJob& job) {
    PolygonMesh out;
    for (const LatticeMesh& part : job.tool->hulls()) {
        PolygonMesh mesh;
        for (const LatticePoint& p : part.points)
            mesh.points.push_back(job.grid.to_user(p.doubles()));
        for (const auto& t : part.triangles) mesh.add_triangle(t[0], t[1], t[2]);
        append(out, mesh);
    }
    return out;
}

void add_bodies(PageData& data, const MillJob& job) {
    data.add_floats("tool", soup_of(tool_mesh(job)));
    data.add_floats("holder", soup_of(job.holder.solid.to_mesh()));
    PolygonMesh fixtures;
    for (const MillBody& f : job.fixtures) append(fixtures, f.solid.to_mesh());
    data.add_floats("fixtures", soup_of(fixtures));
}

/// Eight numbers a step: position, time, line, removed volume, orientation, whether it is rapid.
void add_steps(PageData& data, const MillJob& job, const MillRun& run) {
    std::vector<float> values;
    for (std::size_t i = 0; i < run.done(); ++i) {
        const MillStep& s = job.steps[i];
        for (const double c : job.grid.to_user(s.to)) values.push_back(static_cast<float>(c));
        values.push_back(static_cast<float>(s.end_time));
        values.push_back(static_cast<float>(s.line));
        values.push_back(static_cast<float>(run.records()[i].removed));
        values.push_back(static_cast<float>(s.orientation));
        values.push_back(s.is_rapid ? 1.0F : 0.0F);
    }
    data.add_floats("steps", values);
}

/// JSON within a script: no text of it may end the element.
std::string script_text(const Json& json) {
    std::string out = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    for (std::size_t at = out.find("</"); at != std::string::npos; at = out.find("</", at + 3))
        out.insert(at + 1, "\\");
    return out;
}

}  // namespace

std::string page_text(const MillJob& job, const MillRun& run, const MillFilm& film) {
    PageData data;
    Json facts;
    add_film(data, facts, film);
    add_bodies(data, job);
    add_steps(data, job, run);
    facts["path"] = job.path.file;
    facts["step_count"] = job.steps.size();
    facts["orientations"] = job.path.orientations;
    facts["collisions"] = run.collisions();
    facts["stock_volume"] = job.stock_volume;
    facts["places"] = data.places();
    return mill_page_before_facts + script_text(facts) + mill_page_before_data +
           base64(data.deflated()) + mill_page_end;
}

}  // namespace trisect::app
