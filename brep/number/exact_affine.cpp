// SPDX-License-Identifier: Apache-2.0
//
// Fractions grow with each map that is multiplied, so readers bound how deep maps nest. Most maps
// are translations and quarter turns; a sum of two doubles and its error are exact in
// doubles. Other images are computed in pairs of doubles, with a bound, and in fractions where that
// does not decide how to round, or whether there is anything to round.
#include <trisect/brep/number/exact_affine.h>

#include <trisect/kernel/error.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {
namespace {

bool is_power_of_two(double value) {
    int exponent = 0;
    return std::fabs(std::frexp(value, &exponent)) == 0.5 && std::abs(exponent) < 100;
}

/// What the sum of two doubles, rounded to `sum`, lacks of it. Exact.
double rest_of_sum(double a, double b, double sum) {
    const double part = sum - a;
    return (a - (sum - part)) + (b - part);
}

/// Neither so large nor so small that products with others leave the doubles or lose digits.
bool is_moderate(double value) {
    const double size = std::fabs(value);
    return size == 0 || (size > 1e-100 && size < 1e100);
}

/// A sum as a double, what it lacks, and the sum of the sizes of its terms.
struct DotSum {
    double head = 0;
    double tail = 0;
    double size = 0;

    void add(double value) {
        const double sum = head + value;
        tail += rest_of_sum(head, value, sum);
        head = sum;
        size += std::fabs(value);
    }
    void add_product(double a, double b) {
        const double product = a * b;
        tail += std::fma(a, b, -product);
        add(product);
    }
};

ExactRational image_of(const ExactRational* row, const Point3d& p) {
    ExactRational sum = row[3];
    for (std::size_t k = 0; k < 3; ++k)
        if (row[k].sign() != 0) sum += row[k] * ExactRational::from_double(p[k]);
    return sum;
}

}  // namespace

ExactAffine::ExactAffine() {
    for (std::size_t i = 0; i < 3; ++i) {
        rows_[5 * i] = 1;
        high_[5 * i] = 1;
        simple_[i].column = i;
    }
}

ExactAffine ExactAffine::from_rows(const std::array<double, 12>& rows) {
    ExactAffine out;
    for (std::size_t i = 0; i < 12; ++i) out.rows_[i] = ExactRational::from_double(rows[i]);
    out.note_rows();
    return out;
}

ExactAffine ExactAffine::from_parts(const std::array<double, 3>& scale,
                                    const std::array<double, 4>& quaternion,
                                    const std::array<double, 3>& translation) {
    std::array<ExactRational, 4> q;
    ExactRational length;
    for (std::size_t i = 0; i < 4; ++i) {
        q[i] = ExactRational::from_double(quaternion[i]);
        length += q[i] * q[i];
    }
    ExactAffine out;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        const ExactRational two(2);
        out.rows_[4 * i + i] = ExactRational(1) - two * (q[j] * q[j] + q[k] * q[k]) / length;
        out.rows_[4 * i + j] = two * (q[i] * q[j] - q[k] * q[3]) / length;
        out.rows_[4 * i + k] = two * (q[i] * q[k] + q[j] * q[3]) / length;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            out.rows_[4 * i + j] *= ExactRational::from_double(scale[j]);
        out.rows_[4 * i + 3] = ExactRational::from_double(translation[i]);
    }
    out.note_rows();
    return out;
}

ExactAffine ExactAffine::then(const ExactAffine& next) const {
    ExactAffine out;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            ExactRational sum = j == 3 ? next.at(i, 3) : ExactRational();
            for (std::size_t k = 0; k < 3; ++k) sum += next.at(i, k) * at(k, j);
            out.rows_[4 * i + j] = sum;
        }
    }
    out.note_rows();
    return out;
}

bool ExactAffine::is_identity() const {
    for (std::size_t i = 0; i < 12; ++i)
        if (rows_[i] != ExactRational(i % 5 == 0 ? 1 : 0)) return false;
    return true;
}

int ExactAffine::orientation() const {
    ExactRational determinant;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t u = (i + 1) % 3;
        const std::size_t v = (i + 2) % 3;
        determinant += at(0, i) * (at(1, u) * at(2, v) - at(1, v) * at(2, u));
    }
    return determinant.sign();
}

void ExactAffine::note_rows() {
    for (std::size_t i = 0; i < 12; ++i) {
        high_[i] = rows_[i].to_double();
        low_[i] = std::isfinite(high_[i])
                      ? (rows_[i] - ExactRational::from_double(high_[i])).to_double()
                      : 0;
    }
    is_simple_ = true;
    for (std::size_t i = 0; i < 3 && is_simple_; ++i) {
        std::size_t entries = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (at(i, k).sign() == 0) continue;
            ++entries;
            simple_[i].column = k;
        }
        simple_[i].factor = at(i, simple_[i].column).to_double();
        simple_[i].shift = at(i, 3).to_double();
        is_simple_ = entries == 1 && is_power_of_two(simple_[i].factor) &&
                     std::isfinite(simple_[i].shift) &&
                     ExactRational::from_double(simple_[i].factor) == at(i, simple_[i].column) &&
                     ExactRational::from_double(simple_[i].shift) == at(i, 3);
    }
}

bool ExactAffine::apply_in_doubles(const Point3d& p, Image& image) const {
    if (!is_simple_) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const double c = p[simple_[i].column];
        const bool is_extreme = std::fabs(c) > 1e200 || (c != 0 && std::fabs(c) < 1e-200);
        if (is_extreme) return false;
        const double product = simple_[i].factor * c;
        image.point[i] = product + simple_[i].shift;
        if (!std::isfinite(image.point[i])) return false;
        image.note(rest_of_sum(product, simple_[i].shift, image.point[i]));
    }
    return true;
}

// Dot2 of Ogita, Rump and Oishi errs by less than 2^-100 of the sizes of a dozen terms; what the
// rows lack beyond two doubles is less than 2^-105 of them. 2^-96 is on the safe side of both.
bool ExactAffine::apply_in_pairs(const Point3d& p, Image& image) const {
    for (std::size_t i = 0; i < 3; ++i) {
        DotSum sum;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!is_moderate(p[k]) || !is_moderate(high_[4 * i + k])) return false;
            sum.add_product(high_[4 * i + k], p[k]);
            sum.tail += low_[4 * i + k] * p[k];
        }
        if (!is_moderate(high_[4 * i + 3])) return false;
        sum.add(high_[4 * i + 3]);
        sum.tail += low_[4 * i + 3];
        const double value = sum.head + sum.tail;
        const double rest = std::fabs(rest_of_sum(sum.head, sum.tail, value));
        const double error = std::ldexp(sum.size, -96);
        const double gap = std::fabs(value) - std::nextafter(std::fabs(value), 0.0);
        if (!is_moderate(value) || value == 0 || rest <= 16 * error || rest + error >= gap / 2)
            return false;
        image.point[i] = value;
        image.note(rest);
    }
    return true;
}

ExactAffine::Image ExactAffine::apply(const Point3d& p) const {
    Image image;
    if (apply_in_doubles(p, image)) return image;
    image = {};
    if (apply_in_pairs(p, image)) return image;
    image = {};
    for (std::size_t i = 0; i < 3; ++i) {
        const ExactRational exact = image_of(&rows_[4 * i], p);
        image.point[i] = exact.to_double();
        if (!std::isfinite(image.point[i]))
            throw LimitError("a transform leaves the range of doubles");
        image.note((exact - ExactRational::from_double(image.point[i])).to_double());
    }
    return image;
}

std::array<double, 12> ExactAffine::rows() const {
    std::array<double, 12> out{};
    for (std::size_t i = 0; i < 12; ++i) out[i] = rows_[i].to_double();
    return out;
}

}  // namespace trisect::detail
