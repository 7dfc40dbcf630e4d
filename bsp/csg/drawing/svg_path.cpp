// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/svg_path.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include <trisect/bsp/csg/drawing/drawing.h>
#include <trisect/bsp/csg/drawing/svg_scanner.h>

namespace trisect::detail {
namespace {

constexpr int curve_edges = 20;
constexpr double pi = std::numbers::pi;

class SvgPathReader {
public:
    SvgPathReader(const InputText& source, const char* at, std::string_view data)
        : source_(source), at_(at), scan_(source, at, data) {}

    std::vector<SvgSubpath> read() {
        char command = '\0';
        while (!scan_.at_end()) {
            if (!scan_.is_at_number())
                command = scan_.take();
            else if (command == '\0' || std::toupper(command) == 'Z')
                scan_.fail();
            run(command);
            // Pairs after that of a move are lines.
            if (command == 'M') command = 'L';
            if (command == 'm') command = 'l';
        }
        std::erase_if(out_, [](const SvgSubpath& s) { return s.points.empty(); });
        return std::move(out_);
    }

private:
    [[nodiscard]] Point2d point(bool relative) {
        const double x = scan_.number();
        const double y = scan_.number();
        return relative ? Point2d{here_[0] + x, here_[1] + y} : Point2d{x, y};
    }

    void add(const Point2d& p) {
        if (++count_ > drawing_limit) source_.fail_limit(at_, "too many points");
        out_.back().points.push_back(p);
    }

    void begin_at(const Point2d& p) {
        out_.emplace_back();
        add(p);
        start_ = here_ = p;
    }

    void line_to(const Point2d& p) {
        add(p);
        here_ = p;
    }

    void run(char command) {
        const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(command)));
        const bool relative = letter != command;
        if (letter == 'M') {
            begin_at(point(relative));
        } else {
            if (out_.empty()) scan_.fail();
            // After a path was closed the next one begins where it did.
            if (out_.back().is_closed && letter != 'Z') begin_at(start_);
            draw(letter, relative);
        }
        if (letter != 'C' && letter != 'S') cubic_ = here_;
        if (letter != 'Q' && letter != 'T') quadratic_ = here_;
    }

    void draw(char letter, bool relative) {
        switch (letter) {
            case 'L':
                return line_to(point(relative));
            case 'H':
                return line_to({scan_.number() + (relative ? here_[0] : 0), here_[1]});
            case 'V':
                return line_to({here_[0], scan_.number() + (relative ? here_[1] : 0)});
            case 'C':
            case 'S': {
                const Point2d c = letter == 'C' ? point(relative) : mirrored(cubic_);
                cubic_ = point(relative);
                return curve({here_, c, cubic_, point(relative)}, 4);
            }
            case 'Q':
            case 'T': {
                quadratic_ = letter == 'Q' ? point(relative) : mirrored(quadratic_);
                return curve({here_, quadratic_, point(relative), {}}, 3);
            }
            case 'A':
                return arc(relative);
            case 'Z':
                out_.back().is_closed = true;
                here_ = start_;
                return;
            default:
                source_.fail(at_,
                             shown_word(std::string_view(&letter, 1)) + " is no command of a path");
        }
    }

    [[nodiscard]] Point2d mirrored(const Point2d& c) const {
        return {2 * here_[0] - c[0], 2 * here_[1] - c[1]};
    }

    /// By de Casteljau's scheme.
    void curve(const std::array<Point2d, 4>& controls, std::size_t count) {
        for (int i = 1; i < curve_edges; ++i) {
            const double t = static_cast<double>(i) / curve_edges;
            std::array<Point2d, 4> p = controls;
            for (std::size_t n = count - 1; n > 0; --n)
                for (std::size_t k = 0; k < n; ++k)
                    for (std::size_t d = 0; d < 2; ++d) p[k][d] += t * (p[k + 1][d] - p[k][d]);
            add(p[0]);
        }
        line_to(controls[count - 1]);
    }

    void arc(bool relative) {
        double rx = std::fabs(scan_.number());
        double ry = std::fabs(scan_.number());
        const double turn = scan_.number() * pi / 180;
        const bool is_large = scan_.flag();
        const bool is_positive = scan_.flag();
        const Point2d from = here_;
        const Point2d to = point(relative);
        if (from == to) return;
        if (rx == 0 || ry == 0) return line_to(to);
        const double c = std::cos(turn);
        const double s = std::sin(turn);
        // Half the chord in a frame in which the ellipse is a unit circle.
        const double hx = (from[0] - to[0]) / 2;
        const double hy = (from[1] - to[1]) / 2;
        double ux = (c * hx + s * hy) / rx;
        double uy = (c * hy - s * hx) / ry;
        double half = std::hypot(ux, uy);
        if (half > 1) {  // too small radii grow until they reach
            rx *= half;
            ry *= half;
            ux /= half;
            uy /= half;
            half = 1;
        }
        const double rise = std::sqrt(std::max(1 - half * half, 0.0)) / half;
        const double side = is_large == is_positive ? -rise : rise;
        const Point2d center{side * uy, -side * ux};
        const double begin = std::atan2(uy - center[1], ux - center[0]);
        double sweep = std::atan2(-uy - center[1], -ux - center[0]) - begin;
        if (sweep < 0) sweep += 2 * pi;
        if (!is_positive) sweep -= 2 * pi;
        const int edges = static_cast<int>(std::fabs(sweep) * 10 / pi + 4);
        const Point2d middle{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
        for (int i = 1; i < edges; ++i) {
            const double angle = begin + sweep * i / edges;
            const double x = rx * (std::cos(angle) + center[0]);
            const double y = ry * (std::sin(angle) + center[1]);
            add({middle[0] + c * x - s * y, middle[1] + s * x + c * y});
        }
        line_to(to);
    }

    const InputText& source_;
    const char* at_;
    SvgScanner scan_;
    std::vector<SvgSubpath> out_;
    Point2d here_{0, 0};
    Point2d start_{0, 0};
    Point2d cubic_{0, 0};  ///< the last control point of the curve before, else the place
    Point2d quadratic_{0, 0};
    std::size_t count_ = 0;
};

}  // namespace

std::vector<SvgSubpath> svg_subpaths(const InputText& source, const char* at,
                                     std::string_view data) {
    return SvgPathReader(source, at, data).read();
}

std::vector<double> svg_numbers(const InputText& source, const char* at, std::string_view list) {
    std::vector<double> out;
    SvgScanner scan(source, at, list);
    while (!scan.at_end()) {
        if (out.size() >= drawing_limit) source.fail_limit(at, "too many numbers");
        out.push_back(scan.number());
    }
    return out;
}

}  // namespace trisect::detail
