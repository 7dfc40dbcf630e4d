// SPDX-License-Identifier: Apache-2.0
//
// Most pixels lie in the middle of a face or of the background and need one ray. Only where
// something else begins does a pixel need more, to smooth the step. So the first pass casts one ray
// a pixel, the second one the remaining rays of those pixels that differ from one of their eight
// neighbours. Details that fall between the rays of the first pass are missed, as they are by any
// sampling.
#include "render_samples.h"

#include <algorithm>
#include <atomic>

#include "parallel_rows.h"

namespace trisect::app {
namespace {

class Caster {
public:
    Caster(const Scene& scene, const Camera& camera, SampleGrid& grid)
        : scene_(scene), camera_(camera), grid_(grid), middle_(grid.per_pixel / 2) {}

    void cast_middle_rays(std::uint32_t row) {
        for (std::uint32_t x = 0; x < grid_.pixels.width; ++x) {
            cast(x * grid_.per_pixel + middle_, row * grid_.per_pixel + middle_);
        }
    }

    /// \return how many rays that took.
    std::uint64_t fill(std::uint32_t row) {
        std::uint64_t pixels_cast = 0;
        for (std::uint32_t x = 0; x < grid_.pixels.width; ++x) {
            if (is_uniform(x, row)) {
                copy_middle(x, row);
            } else {
                cast_others(x, row);
                ++pixels_cast;
            }
        }
        return pixels_cast * (std::uint64_t{grid_.per_pixel} * grid_.per_pixel - 1);
    }

private:
    void cast(std::uint32_t x, std::uint32_t y) {
        const SurfaceHit hit = scene_.first_hit(grid_.ray(camera_, x, y));
        const std::size_t i = grid_.index(x, y);
        grid_.look[i] = hit.look;
        grid_.depth[i] = hit.look == SurfaceHit::nothing ? 0.0F : static_cast<float>(hit.t);
    }

    [[nodiscard]] std::uint32_t middle_look(std::uint32_t x, std::uint32_t y) const {
        return grid_
            .look[grid_.index(x * grid_.per_pixel + middle_, y * grid_.per_pixel + middle_)];
    }

    [[nodiscard]] bool continues(std::uint32_t a, std::uint32_t b) const {
        if (a == b) return true;
        if (a == SurfaceHit::nothing || b == SurfaceHit::nothing) return false;
        return grid_.looks[a].continues(grid_.looks[b]);
    }

    [[nodiscard]] bool is_uniform(std::uint32_t x, std::uint32_t y) const {
        const std::uint32_t look = middle_look(x, y);
        const std::uint32_t right = std::min(x + 1, grid_.pixels.width - 1);
        const std::uint32_t bottom = std::min(y + 1, grid_.pixels.height - 1);
        for (std::uint32_t j = y == 0 ? 0 : y - 1; j <= bottom; ++j) {
            for (std::uint32_t i = x == 0 ? 0 : x - 1; i <= right; ++i) {
                if (!continues(look, middle_look(i, j))) return false;
            }
        }
        return true;
    }

    void cast_others(std::uint32_t x, std::uint32_t y) {
        for_samples(x, y, [this](std::uint32_t i, std::uint32_t j) { cast(i, j); });
    }

    void copy_middle(std::uint32_t x, std::uint32_t y) {
        const std::uint32_t mx = x * grid_.per_pixel + middle_;
        const std::uint32_t my = y * grid_.per_pixel + middle_;
        const std::uint32_t look = grid_.look[grid_.index(mx, my)];
        if (look == SurfaceHit::nothing) return;  // as all samples began
        const ViewRay ray = grid_.ray(camera_, mx, my);
        const double depth = grid_.depth[grid_.index(mx, my)];
        const Eigen::Vector3d normal = grid_.looks[look].normal.cast<double>();
        for_samples(x, y, [&](std::uint32_t i, std::uint32_t j) {
            grid_.look[grid_.index(i, j)] = look;
            grid_.depth[grid_.index(i, j)] =
                static_cast<float>(plane_distance(ray, depth, normal, grid_.ray(camera_, i, j)));
        });
    }

    /// Calls work(i, j) for the samples of a pixel but the middle one.
    template <class Work>
    void for_samples(std::uint32_t x, std::uint32_t y, const Work& work) const {
        const std::uint32_t n = grid_.per_pixel;
        for (std::uint32_t j = 0; j < n; ++j) {
            for (std::uint32_t i = 0; i < n; ++i) {
                if (i != middle_ || j != middle_) work(x * n + i, y * n + j);
            }
        }
    }

    const Scene& scene_;
    const Camera& camera_;
    SampleGrid& grid_;
    std::uint32_t middle_;
};

}  // namespace

SampleGrid::SampleGrid(PixelSize p, std::uint32_t samples)
    : pixels(p),
      per_pixel(samples),
      size{p.width * samples, p.height * samples},
      look(size.count(), SurfaceHit::nothing),
      depth(size.count(), 0.0F) {}

double plane_distance(const ViewRay& hit_ray, double hit_depth, const Eigen::Vector3d& normal,
                      const ViewRay& other) {
    const Eigen::Vector3d hit = hit_ray.origin + hit_depth * hit_ray.direction;
    return normal.dot(hit - other.origin) / normal.dot(other.direction);
}

SampleGrid cast_rays(const Scene& scene, const Camera& camera, PixelSize pixels,
                     std::uint32_t per_pixel) {
    SampleGrid grid(pixels, per_pixel);
    Caster caster(scene, camera, grid);
    for_rows(pixels.height, [&](std::uint32_t y) { caster.cast_middle_rays(y); });
    grid.rays = pixels.count();
    grid.looks = scene.looks();
    if (per_pixel == 1) return grid;
    std::atomic<std::uint64_t> more = 0;
    for_rows(pixels.height, [&](std::uint32_t y) { more += caster.fill(y); });
    grid.rays += more;
    grid.looks = scene.looks();
    return grid;
}

}  // namespace trisect::app
