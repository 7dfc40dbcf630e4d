// SPDX-License-Identifier: Apache-2.0
//
// Flat shading by three lights that stand still relative to the camera: a key light from the upper
// left, a weak one from the right, and the sky, which is brighter from above. What lies behind its
// surroundings is darkened by unsharp masking of the depths (Luft, Colditz, Deussen: Image
// enhancement by unsharp masking the depth buffer, SIGGRAPH 2006): a hint of contact and distance
// that costs no rays.
//
// Light is added and averaged as light; only finished pixels become sRGB.
#include "render_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "color.h"
#include "parallel_rows.h"
#include "render_lines.h"
#include "render_samples.h"

namespace trisect::app {
namespace {

using Eigen::Vector3f;

// --- light -------------------------------------------------------------------------------------

/// How bright a face is, by its normal.
class Lighting {
public:
    explicit Lighting(const View& view) {
        const auto towards = [&](float right, float up, float back) {
            return (right * view.right.cast<float>() + up * view.up.cast<float>() -
                    back * view.forward.cast<float>())
                .normalized();
        };
        key_ = towards(-0.55F, 0.75F, 0.65F);
        fill_ = towards(0.9F, 0.05F, 0.55F);
        up_ = towards(0.0F, 1.0F, 0.35F);
    }
    [[nodiscard]] float brightness(const Vector3f& normal) const {
        const float key = std::max(0.0F, normal.dot(key_));
        const float fill = std::max(0.0F, normal.dot(fill_));
        const float sky = 0.5F + 0.5F * normal.dot(up_);
        return 0.26F + 0.62F * key + 0.20F * fill + 0.24F * sky;
    }

private:
    Vector3f key_;
    Vector3f fill_;
    Vector3f up_;
};

// --- depth -------------------------------------------------------------------------------------

/// One value a pixel and a weight: 0 where nothing was hit.
struct DepthMap {
    std::vector<float> depth;
    std::vector<float> weight;
};

DepthMap depths_of(const SampleGrid& grid) {
    DepthMap map{std::vector<float>(grid.pixels.count()), std::vector<float>(grid.pixels.count())};
    const std::uint32_t middle = grid.per_pixel / 2;
    for (std::uint32_t y = 0; y < grid.pixels.height; ++y) {
        for (std::uint32_t x = 0; x < grid.pixels.width; ++x) {
            const std::size_t s =
                grid.index(x * grid.per_pixel + middle, y * grid.per_pixel + middle);
            if (grid.look[s] == SurfaceHit::nothing) continue;
            const std::size_t i = std::size_t{y} * grid.pixels.width + x;
            map.depth[i] = grid.depth[s];
            map.weight[i] = 1;
        }
    }
    return map;
}

/// Running mean over 2 radius + 1 values, `step` apart.
void box_blur_line(const float* in, float* out, std::size_t count, std::size_t step,
                   std::size_t radius) {
    double sum = 0;
    for (std::size_t i = 0; i < std::min(radius, count); ++i) sum += in[i * step];
    const double scale = 1.0 / static_cast<double>(2 * radius + 1);
    for (std::size_t i = 0; i < count; ++i) {
        if (i + radius < count) sum += in[(i + radius) * step];
        if (i > radius) sum -= in[(i - radius - 1) * step];
        out[i * step] = static_cast<float>(sum * scale);
    }
}

/// Three running means both ways are nearly a Gaussian filter.
void blur(std::vector<float>& values, PixelSize size, std::size_t radius) {
    std::vector<float> other(values.size());
    for (int pass = 0; pass < 3; ++pass) {
        for_rows(size.height, [&](std::uint32_t y) {
            const std::size_t row = std::size_t{y} * size.width;
            box_blur_line(&values[row], &other[row], size.width, 1, radius);
        });
        for_rows(size.width, [&](std::uint32_t x) {
            box_blur_line(&other[x], &values[x], size.height, size.width, radius);
        });
    }
}

/// A factor for each pixel, 1 or less.
std::vector<float> contact_shades(const SampleGrid& grid, double diameter) {
    const DepthMap map = depths_of(grid);
    std::vector<float> weighted(map.depth.size());
    std::transform(map.depth.begin(), map.depth.end(), map.weight.begin(), weighted.begin(),
                   [](float d, float w) { return d * w; });
    std::vector<float> weight = map.weight;
    const std::size_t radius =
        std::max<std::size_t>(1, std::min(grid.pixels.width, grid.pixels.height) / 50);
    blur(weighted, grid.pixels, radius);
    blur(weight, grid.pixels, radius);
    std::vector<float> shade(map.depth.size(), 1.0F);
    for (std::size_t i = 0; i < shade.size(); ++i) {
        if (map.weight[i] == 0 || weight[i] < 1e-6F) continue;
        const double behind = (map.depth[i] - weighted[i] / weight[i]) / diameter;
        shade[i] = static_cast<float>(1 - 0.45 * (1 - std::exp(-14 * std::max(0.0, behind))));
    }
    return shade;
}

// --- colour ------------------------------------------------------------------------------------

struct Backdrop {
    LinearColor top;
    LinearColor bottom;
    bool is_opaque = true;
};

Backdrop backdrop_of(Background background) {
    switch (background) {
        case Background::Light:
            return {to_light({0xfbfcfe}), to_light({0xd9e1ea})};
        case Background::White:
            return {to_light({0xffffff}), to_light({0xffffff})};
        case Background::Dark:
            return {to_light({0x39424f}), to_light({0x171b21})};
        case Background::Transparent:
            break;
    }
    return {LinearColor{}, LinearColor{}, false};
}

/// Diagonal stripes, fixed to the picture.
bool is_on_hatch(std::uint32_t x, std::uint32_t y, std::uint32_t per_pixel) {
    constexpr std::uint32_t period = 9;
    constexpr std::uint32_t width = 2;
    return (x + y) % (period * per_pixel) < width * per_pixel;
}

class Painter {
public:
    Painter(double diameter, const Camera& camera, const SampleGrid& grid,
            const PictureStyle& style)
        : grid_(grid),
          backdrop_(backdrop_of(style.background)),
          lines_(draw_lines(camera, grid, style.edges, style.line_width)),
          shades_(contact_shades(grid, diameter)),
          ink_(to_light(ink)),
          section_(to_light(section_color)),
          hatch_(to_light(hatch_color)) {
        const Lighting lighting(camera.view());
        brightness_.reserve(grid.looks.size());
        for (const Look& look : grid.looks) {
            brightness_.push_back(lighting.brightness(look.normal));
        }
        for (std::size_t i = 0; i < palette_.size(); ++i) palette_[i] = to_light(operand_color(i));
    }

    void paint_row(std::uint32_t y, Image& image) const {
        for (std::uint32_t x = 0; x < grid_.pixels.width; ++x) {
            image.pixels[std::size_t{y} * grid_.pixels.width + x] = pixel(x, y);
        }
    }

private:
    /// Light that is not covered by anything counts as the background, or with it the pixel's
    /// alpha.
    struct Sum {
        LinearColor light{};
        float coverage = 0;
        void add(const LinearColor& color, float factor, float part) {
            for (std::size_t k = 0; k < 3; ++k) light[k] += color[k] * factor * part;
            coverage += part;
        }
    };

    [[nodiscard]] std::array<std::uint8_t, 4> pixel(std::uint32_t x, std::uint32_t y) const {
        Sum sum;
        const std::uint32_t n = grid_.per_pixel;
        const float shade = shades_[std::size_t{y} * grid_.pixels.width + x];
        for (std::uint32_t j = y * n; j < (y + 1) * n; ++j) {
            for (std::uint32_t i = x * n; i < (x + 1) * n; ++i) add_sample(i, j, shade, sum);
        }
        const float scale = 1.0F / static_cast<float>(n * n);
        const float coverage = sum.coverage * scale;
        LinearColor light{};
        for (std::size_t k = 0; k < 3; ++k) light[k] = sum.light[k] * scale;
        if (backdrop_.is_opaque) {
            const float s =
                (static_cast<float>(y) + 0.5F) / static_cast<float>(grid_.pixels.height);
            for (std::size_t k = 0; k < 3; ++k) {
                const float behind = backdrop_.top[k] * (1 - s) + backdrop_.bottom[k] * s;
                light[k] += (1 - coverage) * behind;
            }
            return {to_srgb(light[0]), to_srgb(light[1]), to_srgb(light[2]), 255};
        }
        if (coverage == 0) return {0, 0, 0, 0};
        const auto alpha = static_cast<std::uint8_t>(std::lround(255 * std::min(coverage, 1.0F)));
        return {to_srgb(light[0] / coverage), to_srgb(light[1] / coverage),
                to_srgb(light[2] / coverage), alpha};
    }

    void add_sample(std::uint32_t x, std::uint32_t y, float shade, Sum& sum) const {
        const std::size_t i = grid_.index(x, y);
        const float line = static_cast<float>(lines_[i]) / 255;
        if (line > 0) sum.add(ink_, 1, line);
        const std::uint32_t number = grid_.look[i];
        if (number == SurfaceHit::nothing) return;
        const Look& look = grid_.looks[number];
        if (look.is_section) {
            const bool striped = is_on_hatch(x, y, grid_.per_pixel);
            sum.add(striped ? hatch_ : section_, 1, 1 - line);
        } else {
            sum.add(palette_[look.color % palette_.size()], brightness_[number] * shade, 1 - line);
        }
    }

    const SampleGrid& grid_;
    Backdrop backdrop_;
    std::vector<std::uint8_t> lines_;
    std::vector<float> shades_;
    std::vector<float> brightness_;
    std::array<LinearColor, 8> palette_{};
    LinearColor ink_;
    LinearColor section_;
    LinearColor hatch_;
};

}  // namespace

Picture draw_picture(const Scene& scene, const Camera& camera, const PictureStyle& style) {
    const SampleGrid grid = cast_rays(scene, camera, style.size, style.samples);
    Picture picture{Image(style.size), grid.rays, 0};
    const Painter painter(scene.diameter(), camera, grid, style);
    for_rows(style.size.height, [&](std::uint32_t y) { painter.paint_row(y, picture.image); });
    const std::uint32_t middle = style.samples / 2;
    for (std::uint32_t y = 0; y < style.size.height; ++y) {
        for (std::uint32_t x = 0; x < style.size.width; ++x) {
            const std::size_t i =
                grid.index(x * style.samples + middle, y * style.samples + middle);
            if (grid.look[i] != SurfaceHit::nothing) ++picture.covered;
        }
    }
    return picture;
}

}  // namespace trisect::app
