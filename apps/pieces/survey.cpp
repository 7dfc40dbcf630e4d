// SPDX-License-Identifier: Apache-2.0
#include "survey.h"

#include <algorithm>
#include <cmath>

#include <trisect/kernel/error.h>

#include "piecewise_file.h"

namespace trisect::app {

namespace {

constexpr std::uint64_t sample_size = 200'000;

double volume_of(const Point3d& a, const Point3d& b, const Point3d& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Point3d difference_of(const Point3d& a, const Point3d& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Survey::Reach reach_of_corners(const Corners& c) {
    Survey::Reach r{c[0], c[0]};
    for (const Point3d& p : c)
        for (std::size_t k = 0; k < 3; ++k) {
            r.low[k] = std::min(r.low[k], p[k]);
            r.high[k] = std::max(r.high[k], p[k]);
        }
    return r;
}

// Volumes of shares are about one point.
Point3d first_corner(const TriangleStream& stream) {
    Point3d out{};
    stream.read(0, std::min<std::uint64_t>(1, stream.size()),
                [&](std::uint64_t, const Corners& c) { out = c[0]; });
    return out;
}

/// What a file has of a survey, before its sample.
struct SurveyHeader {
    std::uint64_t triangles;
    Point3d low;
    Point3d high;
    double volume;
    std::uint64_t step;
    std::uint64_t samples;
};

}  // namespace

void Survey::add(const Survey& next) {
    if (triangles == 0) {
        *this = next;
        return;
    }
    if (next.triangles == 0) return;
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], next.low[k]);
        high[k] = std::max(high[k], next.high[k]);
    }
    triangles += next.triangles;
    volume += next.volume;
    sample.insert(sample.end(), next.sample.begin(), next.sample.end());
}

Survey survey_of(const TriangleStream& stream, const std::string& name, std::size_t share,
                 std::size_t shares) {
    const std::uint64_t begin = stream.size() * share / shares;
    const std::uint64_t end = stream.size() * (share + 1) / shares;
    Survey out;
    out.triangles = end - begin;
    out.step = 1 + stream.size() / sample_size;
    const Point3d origin = first_corner(stream);
    stream.read(begin, end, [&](std::uint64_t i, const Corners& c) {
        const Survey::Reach r = reach_of_corners(c);
        for (std::size_t k = 0; k < 3; ++k)
            if (!std::isfinite(r.low[k]) || !std::isfinite(r.high[k]) ||
                !std::isfinite(c[0][k] + c[1][k] + c[2][k]))
                throw Error(ErrorCode::InvalidSolid, name + ": triangle " + std::to_string(i) +
                                                         " has a coordinate that is not finite");
        if (i == begin) {
            out.low = r.low;
            out.high = r.high;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            out.low[k] = std::min(out.low[k], r.low[k]);
            out.high[k] = std::max(out.high[k], r.high[k]);
        }
        out.volume += volume_of(difference_of(c[0], origin), difference_of(c[1], origin),
                                difference_of(c[2], origin));
        if (i % out.step == 0) out.sample.push_back(r);
    });
    return out;
}

void write_surveys(const std::string& name, const std::vector<Survey>& surveys) {
    OutputStream out(name);
    for (const Survey& s : surveys) {
        out.write(SurveyHeader{s.triangles, s.low, s.high, s.volume, s.step, s.sample.size()});
        out.write(s.sample.data(), s.sample.size() * sizeof(Survey::Reach));
    }
    out.finish();
}

std::vector<Survey> read_surveys(const std::string& name, std::size_t operands) {
    const InputFile file(name);
    std::vector<Survey> out;
    std::uint64_t at = 0;
    for (std::size_t i = 0; i < operands; ++i) {
        SurveyHeader header{};
        file.read(at, {reinterpret_cast<char*>(&header), sizeof header});
        at += sizeof header;
        if (header.samples > (file.size() - at) / sizeof(Survey::Reach))
            throw InputError({name, 0, 0, at}, "is damaged");
        Survey s{header.triangles, header.low, header.high, header.volume, header.step, {}};
        s.sample.resize(header.samples);
        const std::uint64_t bytes = header.samples * sizeof(Survey::Reach);
        file.read(at, {reinterpret_cast<char*>(s.sample.data()), bytes});
        at += bytes;
        out.push_back(std::move(s));
    }
    return out;
}

}  // namespace trisect::app
