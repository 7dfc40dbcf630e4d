// SPDX-License-Identifier: Apache-2.0
//
// Frames of a moving pair as one picture (contact_frames.png): a dovetail comes from the front of
// its socket, touches it, slides home with both flanks flush, and is then lifted or turned by less
// than a degree, so that it cuts into the flanks. The areas in which they touch are green, those in
// which they touch while they overlap elsewhere and the lines in which faces pass through each
// other are red; both shine through the bodies. What is green is in contact exactly: the gap is
// zero and nothing overlaps.
//
// Every sample is a ray, asked in the frame of each solid by way of the inverse of its pose.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <png.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/trisect.h>

namespace {

using trisect::BrepIndex;
using trisect::FaceId;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using Vector = std::array<double, 3>;

// Of a frame, in pixels.
constexpr std::size_t width = 320;
constexpr std::size_t height = 230;
constexpr std::size_t columns = 3;
// Samples of a pixel in each direction.
constexpr std::size_t samples = 2;

Vector operator+(const Vector& a, const Vector& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector normalized(const Vector& a) { return (1 / std::sqrt(dot(a, a))) * a; }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A matrix in doubles; good enough for pictures.
struct Map {
    std::array<double, 12> m;
    [[nodiscard]] Vector direction(const Vector& v) const {
        return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[4] * v[0] + m[5] * v[1] + m[6] * v[2],
                m[8] * v[0] + m[9] * v[1] + m[10] * v[2]};
    }
    [[nodiscard]] Vector point(const Vector& v) const {
        return direction(v) + Vector{m[3], m[7], m[11]};
    }
};

struct Body {
    BrepIndex index;
    InterferenceModel model;
    Vector color;

    Body(const Solid& solid, const Vector& c)
        : index(BrepIndex(solid).with_brep()), model(index), color(c) {}
};

/// A body in a frame.
struct Placed {
    const Body& body;
    Map to_world;
    Map to_body;

    Placed(const Body& b, const Pose& pose)
        : body(b), to_world{pose.approximate()}, to_body{pose.inverse().approximate()} {}
};

struct Seen {
    double at = 0;
    Vector color{};
    const Body* body = nullptr;
    FaceId face;
};

std::optional<Seen> look(const Placed& placed, const Vector& origin, const Vector& direction) {
    const auto hit = placed.body.index.first_hit(
        trisect::Ray{placed.to_body.point(origin), placed.to_body.direction(direction)});
    if (!hit) return std::nullopt;
    // Poses here are rigid, so normals turn as directions do.
    const Vector normal = normalized(placed.to_world.direction(
        {hit->plane.approx_normal(0), hit->plane.approx_normal(1), hit->plane.approx_normal(2)}));
    const double light =
        0.45 + 0.55 * std::max(0.0, dot(normal, normalized(Vector{-0.5, -0.8, 1.2})));
    return Seen{hit->enter.nearest(), light * placed.body.color, &placed.body, hit->place.face};
}

trisect::InterferenceResult contacts_of(const Placed& a, const Pose& pose_a, const Placed& b,
                                        const Pose& pose_b) {
    trisect::InterferenceOptions options;
    options.contacts = true;
    options.regions = true;
    auto result = interfere(a.body.model, pose_a, b.body.model, pose_b, options);
    std::cout << to_string(result.relation) << ", " << result.contacts.size() << " contacts, "
              << result.regions.size() << " regions\n";
    return result;
}

/// A point on the screen, in samples.
using ScreenPoint = std::array<double, 2>;

/// One frame, in samples.
class Frame {
public:
    Frame() : colors_(columns_ * rows_, Vector{1, 1, 1}) {}

    void draw(const Placed& a, const Placed& b) {
        const Vector forward = -1.0 * towards_eye_;
        std::vector<std::optional<Seen>> seen(colors_.size());
        for (std::size_t y = 0; y < rows_; ++y) {
            for (std::size_t x = 0; x < columns_; ++x) {
                const double u = (static_cast<double>(x) + 0.5 - columns_ / 2.0) / scale;
                const double v = (rows_ / 2.0 - static_cast<double>(y) - 0.5) / scale;
                const Vector origin = middle_ + 10.0 * towards_eye_ + u * right_ + v * up_;
                const auto first = look(a, origin, forward);
                const auto second = look(b, origin, forward);
                auto& nearest = seen[y * columns_ + x];
                nearest = !second || (first && first->at < second->at) ? first : second;
                if (nearest) colors_[y * columns_ + x] = nearest->color;
            }
        }
        draw_edges(seen);
    }

    /// A region, also where a body hides it.
    void draw(const trisect::ContactRegion& region, const Vector& color) {
        std::vector<std::vector<ScreenPoint>> loops;
        for (const auto& loop : region.loops) {
            auto& points = loops.emplace_back();
            for (const trisect::ContactPoint& p : loop) points.push_back(on_screen(p.nearest));
        }
        if (region.dimension == 2) fill(loops, color);
        for (const auto& loop : loops)
            for (std::size_t i = 0; i < loop.size(); ++i)
                draw_line(loop[i], loop[(i + 1) % loop.size()], 0.75 * color);
    }

    /// Averaged over the samples of a pixel.
    [[nodiscard]] Vector pixel(std::size_t x, std::size_t y) const {
        Vector sum{};
        for (std::size_t j = 0; j < samples; ++j)
            for (std::size_t i = 0; i < samples; ++i)
                sum = sum + colors_[(y * samples + j) * columns_ + x * samples + i];
        return 1.0 / (samples * samples) * sum;
    }

private:
    static constexpr std::size_t columns_ = width * samples;
    static constexpr std::size_t rows_ = height * samples;
    /// Samples a unit.
    static constexpr double scale = columns_ / 5.8;

    [[nodiscard]] ScreenPoint on_screen(const Vector& point) const {
        const Vector p = point + -1.0 * middle_;
        return {columns_ / 2.0 + scale * dot(p, right_), rows_ / 2.0 - scale * dot(p, up_)};
    }

    /// Dark where the next sample shows something else.
    void draw_edges(const std::vector<std::optional<Seen>>& seen) {
        const auto differ = [&seen](std::size_t i, std::size_t j) {
            if (!seen[i] || !seen[j]) return seen[i].has_value() != seen[j].has_value();
            return seen[i]->body != seen[j]->body || seen[i]->face != seen[j]->face;
        };
        for (std::size_t y = 0; y + 1 < rows_; ++y)
            for (std::size_t x = 0; x + 1 < columns_; ++x) {
                const std::size_t i = y * columns_ + x;
                if (differ(i, i + 1) || differ(i, i + columns_)) colors_[i] = {0.2, 0.22, 0.26};
            }
    }

    void fill(const std::vector<std::vector<ScreenPoint>>& loops, const Vector& color) {
        const auto is_inside = [&loops](double x, double y) {
            bool inside = false;
            for (const auto& loop : loops)
                for (std::size_t i = 0; i < loop.size(); ++i) {
                    const auto [ax, ay] = loop[i];
                    const auto [bx, by] = loop[(i + 1) % loop.size()];
                    if ((ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax))
                        inside = !inside;
                }
            return inside;
        };
        for (std::size_t y = 0; y < rows_; ++y)
            for (std::size_t x = 0; x < columns_; ++x)
                if (is_inside(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5)) {
                    Vector& c = colors_[y * columns_ + x];
                    c = 0.45 * c + 0.55 * color;
                }
    }

    void draw_line(const ScreenPoint& from, const ScreenPoint& to, const Vector& color) {
        for (int i = 0; i <= 1000; ++i) {
            const double t = i / 1000.0;
            const auto x = static_cast<std::size_t>(from[0] + t * (to[0] - from[0]));
            const auto y = static_cast<std::size_t>(from[1] + t * (to[1] - from[1]));
            for (std::size_t k = 0; k < 9; ++k) {
                const std::size_t at = (y + k / 3) * columns_ + x + k % 3;
                if (at < colors_.size()) colors_[at] = color;
            }
        }
    }

    std::vector<Vector> colors_;
    Vector middle_{0.1, -0.75, 0.3};
    Vector towards_eye_ = normalized({-1.0, -2.0, 1.5});
    Vector right_ = normalized(cross(-1.0 * towards_eye_, {0, 0, 1}));
    Vector up_ = cross(towards_eye_, right_);
};

/// The frames side by side.
void write(const std::vector<Frame>& frames, const char* name) {
    const std::size_t rows = (frames.size() + columns - 1) / columns * height;
    std::vector<std::uint8_t> bytes(3 * columns * width * rows, 255);
    for (std::size_t f = 0; f < frames.size(); ++f)
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const Vector color = frames[f].pixel(x, y);
                const std::size_t row = f / columns * height + y;
                const std::size_t column = f % columns * width + x;
                for (std::size_t k = 0; k < 3; ++k)
                    bytes[3 * (row * columns * width + column) + k] = static_cast<std::uint8_t>(
                        std::lround(255 * std::clamp(color[k], 0.0, 1.0)));
            }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(columns * width);
    image.height = static_cast<png_uint_32>(rows);
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, name, 0, bytes.data(), 0, nullptr) == 0) {
        std::cerr << name << ": " << image.message << '\n';
        std::exit(1);
    }
}

/// Extruded along y: the outline is drawn in x and z.
Solid along_y(const trisect::Outline& outline, double from, double to) {
    // (x, y, z) -> (x, -z, y): a quarter turn about x, exact.
    const auto turn = trisect::AffineMap::rotation({1, 0, 0}, 90);
    return Solid::from_mesh(
        trisect::transformed(trisect::make_extrusion(outline, {}, -to, -from), turn));
}

}  // namespace

int main() {
    // The tail narrows towards the top, so it can only come in along y.
    const trisect::Outline tail_outline{{-1, 0}, {1, 0}, {0.5, 1}, {-0.5, 1}};
    const Solid tail = along_y(tail_outline, -1, 1);
    const Solid block = Solid::from_mesh(trisect::make_box({-2, -1, -0.5}, {2, 1, 1}));
    const Body socket(evaluate(block - along_y(tail_outline, -2, 2)), {0.72, 0.77, 0.86});
    // A tail with a knob, to see it move.
    const Solid knob = Solid::from_mesh(trisect::make_box({-0.25, -0.25, 1}, {0.25, 0.25, 1.5}));
    const Body slider(evaluate(tail | knob), {0.96, 0.82, 0.5});

    struct Step {
        Pose pose;
        Relation expected;
    };
    const auto at = [](double y, double z) { return Pose::from_translation({0, y, z}); };
    const std::vector<Step> steps{
        {at(-2.5, 0), Relation::Disjoint},      // in front of the socket
        {at(-2, 0), Relation::Touching},        // its end face comes to the mouth
        {at(-1, 0), Relation::Touching},        // half in, both flanks and the bottom flush
        {at(0, 0), Relation::Touching},         // home
        {at(-1, 0.25), Relation::Overlapping},  // lifted: the flanks cut in
        {at(-1, 0) * Pose::from_quaternion({200, 0, 0, 1}), Relation::Overlapping}};
    const Vector green{0.1, 0.7, 0.25};
    const Vector red{0.9, 0.12, 0.1};

    std::vector<Frame> frames;
    for (const Step& step : steps) {
        const Placed a(socket, Pose());
        const Placed b(slider, step.pose);
        std::cout << "frame " << frames.size() << ": ";
        const auto result = contacts_of(a, Pose(), b, step.pose);
        if (result.relation != step.expected) {
            std::cerr << "unexpected relation\n";
            return 1;
        }
        Frame& frame = frames.emplace_back();
        frame.draw(a, b);
        for (const trisect::ContactRegion& region : result.regions)
            frame.draw(region, result.relation == Relation::Touching ? green : red);
    }
    write(frames, "contact_frames.png");
    return 0;
}
