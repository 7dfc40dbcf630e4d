// SPDX-License-Identifier: Apache-2.0
//
// Frames of a moving pair as one picture (contact_frames.png): a dovetail comes from above its
// socket, touches it, slides home with both flanks flush, and is then turned by less than a degree,
// so that it cuts into the flanks. Faces that touch are green, faces that cross are red, and the
// regions in which they do so are outlined, also where they are hidden. What is green is in contact
// exactly: the gap is zero and nothing overlaps.
//
// Every pixel is a ray, asked in the frame of each solid by way of the inverse of its pose.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <set>
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

constexpr std::size_t width = 320;
constexpr std::size_t height = 240;
constexpr std::size_t columns = 3;

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
    std::set<FaceId> in_contact;

    Placed(const Body& b, const Pose& pose)
        : body(b), to_world{pose.approximate()}, to_body{pose.inverse().approximate()} {}
};

struct Seen {
    double at = 0;
    Vector color{};
};

std::optional<Seen> look(const Placed& placed, const Vector& origin, const Vector& direction,
                         const Vector& contact_color) {
    const auto hit = placed.body.index.first_hit(
        trisect::Ray{placed.to_body.point(origin), placed.to_body.direction(direction)});
    if (!hit) return std::nullopt;
    // Poses here are rigid, so normals turn as directions do.
    const Vector normal = normalized(placed.to_world.direction(
        {static_cast<double>(hit->plane.normal(0)), static_cast<double>(hit->plane.normal(1)),
         static_cast<double>(hit->plane.normal(2))}));
    const double light =
        0.25 + 0.75 * std::max(0.0, dot(normal, normalized(Vector{-0.5, -0.8, 1.2})));
    const bool touched = placed.in_contact.count(hit->place.face) != 0;
    return Seen{hit->enter.nearest(), light * (touched ? contact_color : placed.body.color)};
}

/// Notes which faces of the two have a piece of area in common, or cross.
trisect::InterferenceResult contacts_of(Placed& a, const Pose& pose_a, Placed& b,
                                        const Pose& pose_b) {
    trisect::InterferenceOptions options;
    options.contacts = true;
    options.regions = true;
    auto result = interfere(a.body.model, pose_a, b.body.model, pose_b, options);
    std::size_t faces = 0;
    for (const trisect::Contact& contact : result.contacts) {
        if (!contact.a.is_face() || !contact.b.is_face()) continue;
        ++faces;
        a.in_contact.insert(contact.a.face());
        b.in_contact.insert(contact.b.face());
    }
    std::cout << to_string(result.relation) << ", " << result.contacts.size() << " contacts, "
              << faces << " pairs of faces, " << result.regions.size() << " regions\n";
    return result;
}

class Picture {
public:
    explicit Picture(std::size_t frames)
        : columns_(columns * width),
          rows_((frames + columns - 1) / columns * height),
          bytes_(3 * columns_ * rows_, 255) {}

    void draw(std::size_t frame, const Placed& a, const Placed& b, const Vector& contact_color) {
        const Vector forward = -1.0 * towards_eye_;
        for (std::size_t y = 0; y < height; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                const double u = (static_cast<double>(x) - width / 2.0) / scale;
                const double v = (height / 2.0 - static_cast<double>(y)) / scale;
                const Vector origin = middle_ + 10.0 * towards_eye_ + u * right_ + v * up_;
                const auto first = look(a, origin, forward, contact_color);
                const auto second = look(b, origin, forward, contact_color);
                if (!first && !second) continue;
                set(frame, x, y,
                    !second || (first && first->at < second->at) ? first->color : second->color);
            }
        }
    }

    /// The outline of a region, also where a body hides it.
    void draw(std::size_t frame, const trisect::ContactRegion& region, const Vector& color) {
        for (const auto& loop : region.loops) {
            for (std::size_t i = 0; i < loop.size(); ++i)
                draw_line(frame, loop[i].nearest, loop[(i + 1) % loop.size()].nearest, color);
        }
    }

    void write(const char* name) const {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        image.width = static_cast<png_uint_32>(columns_);
        image.height = static_cast<png_uint_32>(rows_);
        image.format = PNG_FORMAT_RGB;
        if (png_image_write_to_file(&image, name, 0, bytes_.data(), 0, nullptr) == 0) {
            std::cerr << name << ": " << image.message << '\n';
            std::exit(1);
        }
    }

private:
    /// Pixels a unit.
    static constexpr double scale = width / 6.0;

    void draw_line(std::size_t frame, const Vector& from, const Vector& to, const Vector& color) {
        for (int i = 0; i <= 400; ++i) {
            const Vector p = from + (i / 400.0) * (to + -1.0 * from) + -1.0 * middle_;
            const auto x = static_cast<std::size_t>(width / 2.0 + scale * dot(p, right_));
            const auto y = static_cast<std::size_t>(height / 2.0 - scale * dot(p, up_));
            for (std::size_t k = 0; k < 4; ++k) set(frame, x + k % 2, y + k / 2, color);
        }
    }
    void set(std::size_t frame, std::size_t x, std::size_t y, const Vector& color) {
        const std::size_t column = frame % columns * width + x;
        const std::size_t row = frame / columns * height + y;
        for (std::size_t k = 0; k < 3; ++k)
            bytes_[3 * (row * columns_ + column) + k] =
                static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[k], 0.0, 1.0)));
    }

    std::size_t columns_;
    std::size_t rows_;
    std::vector<std::uint8_t> bytes_;
    Vector middle_{0, -0.5, 0.4};
    Vector towards_eye_ = normalized({-1.0, -2.2, 1.3});
    Vector right_ = normalized(cross(-1.0 * towards_eye_, {0, 0, 1}));
    Vector up_ = cross(towards_eye_, right_);
};

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
    const Body socket(evaluate(block - along_y(tail_outline, -2, 2)), {0.62, 0.66, 0.75});
    // A tail with a knob, to see it move.
    const Solid knob = Solid::from_mesh(trisect::make_box({-0.25, -0.25, 1}, {0.25, 0.25, 1.5}));
    const Body slider(evaluate(tail | knob), {0.85, 0.72, 0.45});

    struct Frame {
        Pose pose;
        Relation expected;
    };
    const auto at = [](double y, double z) { return Pose::from_translation({0, y, z}); };
    const std::vector<Frame> frames{
        {at(-2.5, 0), Relation::Disjoint},      // in front of the socket
        {at(-2, 0), Relation::Touching},        // its end face comes to the mouth
        {at(-1, 0), Relation::Touching},        // half in, both flanks and the bottom flush
        {at(0, 0), Relation::Touching},         // home
        {at(-1, 0.25), Relation::Overlapping},  // lifted: the flanks cut in
        {at(-1, 0) * Pose::from_quaternion({200, 0, 0, 1}), Relation::Overlapping}};
    const Vector green{0.25, 0.85, 0.35};
    const Vector red{0.95, 0.25, 0.2};

    Picture picture(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        Placed a(socket, Pose());
        Placed b(slider, frames[i].pose);
        std::cout << "frame " << i << ": ";
        const auto result = contacts_of(a, Pose(), b, frames[i].pose);
        if (result.relation != frames[i].expected) {
            std::cerr << "unexpected relation\n";
            return 1;
        }
        const bool touching = result.relation == Relation::Touching;
        picture.draw(i, a, b, touching ? green : red);
        for (const trisect::ContactRegion& region : result.regions)
            picture.draw(i, region, 0.4 * (touching ? green : red));
    }
    picture.write("contact_frames.png");
    return 0;
}
