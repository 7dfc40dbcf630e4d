// SPDX-License-Identifier: Apache-2.0
//
// Corner pieces reach a little into the edges beside them: pieces that only touched would come
// apart where their corners are rounded.
#include <trisect/bsp/csg/drawing/stroke_pieces.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trisect::detail {
namespace {

constexpr double overlap = 1e-3;                // of the radius
constexpr double arc_tolerance = 2.5e-5;        // of round ends, as OpenSCAD has it
constexpr double least_cosine_of_miter = -0.5;  // of turns: twice the radius

Point2d sum(const Point2d& a, const Point2d& b, double factor) {
    return {a[0] + factor * b[0], a[1] + factor * b[1]};
}

class StrokeWalker {
public:
    StrokeWalker(Outline points, const Stroke& stroke)
        : points_(std::move(points)), radius_(stroke.width / 2), cap_(stroke.cap) {}

    std::vector<Outline> pieces() {
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const Point2d d{points_[i + 1][0] - points_[i][0], points_[i + 1][1] - points_[i][1]};
            const double length = std::hypot(d[0], d[1]);
            directions_.push_back({d[0] / length, d[1] / length});
        }
        for (std::size_t i = 0; i < directions_.size(); ++i) edge(i);
        for (std::size_t i = 1; i < directions_.size(); ++i) corner(i);
        if (cap_ == Stroke::Cap::Round) {
            disk(points_.front());
            disk(points_.back());
        }
        return std::move(out_);
    }

private:
    /// To the right of a direction.
    static Point2d right_of(const Point2d& d) { return {d[1], -d[0]}; }

    void edge(std::size_t i) {
        const double cap = cap_ == Stroke::Cap::Square ? radius_ : 0;
        const Point2d a = sum(points_[i], directions_[i], i == 0 ? -cap : 0);
        const Point2d b =
            sum(points_[i + 1], directions_[i], i + 1 == directions_.size() ? cap : 0);
        const Point2d n = right_of(directions_[i]);
        out_.push_back(
            {sum(a, n, radius_), sum(b, n, radius_), sum(b, n, -radius_), sum(a, n, -radius_)});
    }

    void corner(std::size_t i) {
        const Point2d& before = directions_[i - 1];
        const Point2d& after = directions_[i];
        const double cosine = before[0] * after[0] + before[1] * after[1];
        const double turn = before[0] * after[1] - before[1] * after[0];
        if (turn == 0 && cosine > 0) return;
        // The outside is on the right of a turn to the left.
        const double side = turn >= 0 ? radius_ : -radius_;
        const Point2d& p = points_[i];
        const Point2d first = sum(p, right_of(before), side);
        const Point2d last = sum(p, right_of(after), side);
        Outline piece{first};
        if (cosine >= least_cosine_of_miter) {
            piece.push_back(sum(first, before, radius_ * std::fabs(turn) / (1 + cosine)));
        } else {
            // Half a side of the polygon around the circle whose sides touch both edges' ends.
            const double quarter = std::tan(std::atan2(std::fabs(turn), cosine) / 4) * radius_;
            piece.push_back(sum(first, before, quarter));
            piece.push_back(sum(last, after, -quarter));
        }
        piece.push_back(last);
        const Point2d inward{after[0] - before[0], after[1] - before[1]};
        const double length = std::hypot(inward[0], inward[1]);
        piece.push_back(sum(p, inward, overlap * radius_ / length));
        out_.push_back(std::move(piece));
    }

    void disk(const Point2d& center) {
        const double step = std::acos(std::max(1 - arc_tolerance / radius_, 0.0));
        const double sides = std::clamp(std::ceil(std::numbers::pi / step), 8.0, 4096.0);
        Outline piece;
        for (int i = 0; i < static_cast<int>(sides); ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            piece.push_back(sum(center, {std::cos(angle), std::sin(angle)}, radius_));
        }
        out_.push_back(std::move(piece));
    }

    Outline points_;
    double radius_;
    Stroke::Cap cap_;
    Outline directions_;
    std::vector<Outline> out_;
};

}  // namespace

std::vector<Outline> stroke_pieces(const Stroke& stroke) {
    Outline points = stroke.points;
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 2 || !(stroke.width > 0)) return {};
    return StrokeWalker(std::move(points), stroke).pieces();
}

}  // namespace trisect::detail
