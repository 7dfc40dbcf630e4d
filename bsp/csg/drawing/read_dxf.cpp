// SPDX-License-Identifier: Apache-2.0
//
// An entity ends where the next group with code 0 begins, so its groups are collected until then.
// Lines of the section BLOCKS wait under the name of their block; what is inserted into a block
// becomes part of it, so a block that inserts itself doubles, up to the limit.
#include <trisect/bsp/csg/drawing/read_dxf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/degrees.h>
#include <trisect/bsp/csg/drawing/dxf_groups.h>
#include <trisect/bsp/csg/drawing/line_chains.h>

namespace trisect::detail {
namespace {

using Segment = std::pair<Point2d, Point2d>;

struct Entity {
    std::string type;
    const char* at = nullptr;
    std::string layer;
    std::string name;  ///< of a section or block
    std::vector<double> x, y;
    Point2d end{0, 0};  ///< groups 11 and 21
    bool has_bulge = false;
    std::map<std::int64_t, double> numbers;

    [[nodiscard]] double number(std::int64_t code, double otherwise) const {
        const auto it = numbers.find(code);
        return it == numbers.end() ? otherwise : it->second;
    }
};

class DxfReader {
public:
    DxfReader(const InputText& source, const DxfOptions& options)
        : source_(source), options_(options) {}

    Drawing read() {
        if (source_.bytes().starts_with("AutoCAD Binary DXF"))
            source_.fail(source_.begin(), "binary DXF files are not read");
        DxfGroups groups(source_);
        while (groups.next()) {
            if (groups.code() == 0) {
                finish();
                entity_ = Entity();
                entity_.type = groups.value();
                entity_.at = groups.at();
                if (entity_.type == "EOF") break;
            } else {
                take(groups);
            }
        }
        finish();
        Drawing out;
        out.shapes.push_back({chains_.outlines(), {}});
        for (const auto& [type, count] : left_out_)
            out.remarks.push_back(std::to_string(count) + " of " + type + " left out");
        if (bulges_ > 0)
            out.remarks.push_back("bulges of " + std::to_string(bulges_) +
                                  " polylines are straight lines");
        return out;
    }

private:
    [[nodiscard]] bool in_entities() const { return section_ == "ENTITIES"; }
    [[nodiscard]] bool in_blocks() const { return section_ == "BLOCKS"; }
    [[nodiscard]] bool is_wanted() const {
        return in_blocks() || options_.layer.empty() || options_.layer == entity_.layer;
    }

    [[nodiscard]] bool is_read() const {
        static const std::array<std::string_view, 8> types{
            "SECTION", "LINE", "LWPOLYLINE", "CIRCLE", "ARC", "ELLIPSE", "INSERT", "BLOCK"};
        return std::find(types.begin(), types.end(), entity_.type) != types.end();
    }

    void take(const DxfGroups& group) {
        if (!is_read()) {
            if (group.code() == 8) entity_.layer = group.value();
            return;
        }
        switch (group.code()) {
            case 2:
                entity_.name = group.value();
                break;
            case 8:
                entity_.layer = group.value();
                break;
            case 10:
                entity_.x.push_back(group.number());
                break;
            case 20:
                entity_.y.push_back(group.number());
                break;
            case 11:
                entity_.end[0] = group.number();
                break;
            case 21:
                entity_.end[1] = group.number();
                break;
            case 70:
                entity_.numbers[70] = static_cast<double>(group.integer());
                break;
            case 40:
            case 41:
            case 42:
            case 50:
            case 51:
                entity_.numbers[group.code()] = group.number();
                entity_.has_bulge |= group.code() == 42 && group.number() != 0;
                break;
            default:
                break;
        }
        if (entity_.x.size() > drawing_limit) source_.fail_limit(group.at(), "too many points");
    }

    void finish() {
        if (entity_.type == "SECTION") section_ = entity_.name;
        if (entity_.type == "ENDSEC") section_.clear();
        if (!in_entities() && !in_blocks()) return;
        if (entity_.type == "BLOCK") {
            block_ = entity_.name;
        } else if (entity_.type == "ENDBLK") {
            block_.clear();
        } else if (is_read()) {
            if (entity_.type != "SECTION" && is_wanted()) draw();
        } else if (in_entities() && is_wanted() && !entity_.type.empty()) {
            ++left_out_[entity_.type];
        }
    }

    void draw() {
        if (entity_.x.empty() || entity_.x.size() != entity_.y.size())
            source_.fail(entity_.at, entity_.type + " without a point (groups 10 and 20)");
        if (entity_.type == "LINE") add(first(), place(entity_.end));
        if (entity_.type == "LWPOLYLINE") polyline();
        if (entity_.type == "CIRCLE") arc(0, 360);
        if (entity_.type == "ARC") {
            const double from = entity_.number(50, 0);
            arc(from, turned_beyond(from, entity_.number(51, 0), 360));
        }
        if (entity_.type == "ELLIPSE") ellipse();
        if (entity_.type == "INSERT") insert();
    }

    /// The angle plus whole turns, so that it is not before the first one.
    static double turned_beyond(double first, double angle, double turn) {
        return angle < first ? angle + turn * std::ceil((first - angle) / turn) : angle;
    }

    /// Points of blocks are placed where the block is inserted.
    [[nodiscard]] double scale() const { return in_blocks() ? 1 : options_.scale; }
    [[nodiscard]] Point2d place(const Point2d& p) const {
        if (in_blocks()) return p;
        return {(p[0] - options_.origin[0]) * options_.scale,
                (p[1] - options_.origin[1]) * options_.scale};
    }
    [[nodiscard]] Point2d first() const { return place({entity_.x[0], entity_.y[0]}); }

    void polyline() {
        const std::size_t n = entity_.x.size();
        std::vector<Point2d> points;
        for (std::size_t i = 0; i < n; ++i) points.push_back(place({entity_.x[i], entity_.y[i]}));
        for (std::size_t i = 1; i < n; ++i) add(points[i - 1], points[i]);
        const bool is_closed = std::fmod(std::fabs(entity_.number(70, 0)), 2) == 1;
        if (is_closed && n > 1) add(points[n - 1], points[0]);
        if (entity_.has_bulge) ++bulges_;
    }

    /// Sides of a part of a whole turn.
    [[nodiscard]] std::uint32_t sides_of(double radius, double part) const {
        const double n = std::ceil(options_.sides(radius) * part);
        if (!(n <= static_cast<double>(drawing_limit)))
            source_.fail_limit(entity_.at, "too many sides");
        return static_cast<std::uint32_t>(n);
    }

    void arc(double from, double to) {
        const double radius = entity_.number(40, 0) * scale();
        if (!(radius > 0)) return;
        const Point2d center = first();
        const std::uint32_t n = sides_of(radius, (to - from) / 360);
        const auto at = [&](std::uint32_t i) -> Point2d {
            const double angle = from + (to - from) * i / n;
            return {center[0] + radius * cosine_of_degrees(angle),
                    center[1] + radius * sine_of_degrees(angle)};
        };
        for (std::uint32_t i = 0; i < n; ++i) add(at(i), at(i + 1));
    }

    void ellipse() {
        constexpr double turn = 2 * std::numbers::pi;
        const Point2d major{entity_.end[0] * scale(), entity_.end[1] * scale()};
        const double ratio = entity_.number(40, 0);
        const double from = entity_.number(41, 0);
        const double to = turned_beyond(from, entity_.number(42, 0), turn);
        const std::uint32_t n = sides_of(std::hypot(major[0], major[1]), (to - from) / turn);
        const Point2d center = first();
        const auto at = [&](std::uint32_t i) -> Point2d {
            const double angle = from + (to - from) * i / n;
            const double c = std::cos(angle);
            const double s = std::sin(angle) * ratio;
            return {center[0] + c * major[0] - s * major[1],
                    center[1] + c * major[1] + s * major[0]};
        };
        for (std::uint32_t i = 0; i < n; ++i) add(at(i), at(i + 1));
    }

    void insert() {
        const auto it = blocks_.find(entity_.name);
        if (it == blocks_.end()) return;
        const double c = cosine_of_degrees(entity_.number(50, 0));
        const double s = sine_of_degrees(entity_.number(50, 0));
        const Point2d to = first();
        const auto placed = [&](const Point2d& p) -> Point2d {
            const double x = p[0] * entity_.number(41, 1);
            const double y = p[1] * entity_.number(42, 1);
            return {(c * x - s * y) * scale() + to[0], (s * x + c * y) * scale() + to[1]};
        };
        const std::size_t n = it->second.size();  // grows where a block inserts itself
        for (std::size_t i = 0; i < n; ++i) {
            const Segment line = it->second[i];
            add(placed(line.first), placed(line.second));
        }
    }

    void add(const Point2d& from, const Point2d& to) {
        if (++lines_ > drawing_limit) source_.fail_limit(entity_.at, "too many lines");
        for (const Point2d& p : {from, to})
            if (!(std::fabs(p[0]) < LineChains::largest && std::fabs(p[1]) < LineChains::largest))
                source_.fail_limit(entity_.at, "coordinates are too large");
        if (in_entities())
            chains_.add(from, to);
        else
            blocks_[block_].emplace_back(from, to);
    }

    const InputText& source_;
    const DxfOptions& options_;
    Entity entity_;
    std::string section_;
    std::string block_;
    std::map<std::string, std::vector<Segment>> blocks_;
    LineChains chains_;
    std::size_t lines_ = 0;
    std::map<std::string, std::size_t> left_out_;
    std::size_t bulges_ = 0;
};

}  // namespace

Drawing read_dxf(const InputText& source, const DxfOptions& options) {
    return DxfReader(source, options).read();
}

}  // namespace trisect::detail
