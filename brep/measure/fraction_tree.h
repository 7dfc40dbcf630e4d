// SPDX-License-Identifier: Apache-2.0
//
// FractionTree: exact sums of many fractions with factored denominators.
// Each denominator is a product of few numbers. Partial sums are not reduced. The essay is in
// measure.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/measure/exact_values.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

// The corners of the faces that have a plane point.
class ExactCorners {
public:
    // `boundary` as in face_sets.h.
    template <class Boundary>
    ExactCorners(const Boundary& boundary, std::span<const std::uint32_t> faces) {
        number_.assign(boundary.vertex_count(), EntityId<Corner>::none);
        std::map<mpz_class, std::uint32_t> numbers;
        numbers.emplace(1, 0U);
        for (const std::uint32_t f : faces) {
            boundary.for_each_corner(f, [&](std::uint32_t v) {
                if (number_[v] != EntityId<Corner>::none) return;
                number_[v] = static_cast<std::uint32_t>(corners_.size());
                corners_.push_back(corner_at(boundary.point(v)));
                Corner& c = corners_.back();
                const auto next = static_cast<std::uint32_t>(numbers.size());
                c.denominator = numbers.try_emplace(c.w, next).first->second;
            });
        }
        denominators_.resize(numbers.size());
        for (const auto& [w, number] : numbers) denominators_[number] = w;
    }
    const Corner& operator[](std::uint32_t v) const { return corners_[number_[v]]; }
    const mpz_class& denominator(std::uint32_t number) const { return denominators_[number]; }

private:
    std::vector<std::uint32_t> number_;
    std::vector<Corner> corners_;
    std::vector<mpz_class> denominators_;
};

// A set of denominators with exponents, by ascending number. Number 0 is the denominator 1.
using Denominators = std::vector<std::pair<std::uint32_t, unsigned>>;

class FractionTree {
public:
    explicit FractionTree(const ExactCorners& corners) : corners_(corners) {}

    // \pre the denominator of the fraction divides the product of the powers
    void add(const mpq_class& fraction, Denominators powers) {
        mpz_class product = 1;
        for (const auto& [number, exponent] : powers) product *= power(number, exponent);
        mpz_class numerator = product;
        mpz_divexact(numerator.get_mpz_t(), numerator.get_mpz_t(), fraction.get_den_mpz_t());
        numerator *= fraction.get_num();
        leaves_.push_back({std::move(numerator), std::move(product), std::move(powers)});
    }
    // Not in lowest terms.
    std::pair<mpz_class, mpz_class> sum() {
        if (leaves_.empty()) return {0, 1};
        while (leaves_.size() > 1) {
            std::vector<Node> merged;
            merged.reserve((leaves_.size() + 1) / 2);
            for (std::size_t i = 0; i + 1 < leaves_.size(); i += 2)
                merged.push_back(merge(leaves_[i], leaves_[i + 1]));
            if (leaves_.size() % 2 != 0) merged.push_back(std::move(leaves_.back()));
            leaves_ = std::move(merged);
        }
        return {std::move(leaves_[0].numerator), std::move(leaves_[0].denominator)};
    }

private:
    struct Node {
        mpz_class numerator;
        mpz_class denominator;  // the product of the powers
        Denominators powers;
    };

    mpz_class power(std::uint32_t number, unsigned exponent) const {
        mpz_class p;
        mpz_pow_ui(p.get_mpz_t(), corners_.denominator(number).get_mpz_t(), exponent);
        return p;
    }

    Node merge(const Node& a, const Node& b) const {
        mpz_class shared = 1;
        Node out;
        auto i = a.powers.begin();
        auto j = b.powers.begin();
        while (i != a.powers.end() && j != b.powers.end()) {
            if (i->first < j->first) {
                out.powers.push_back(*i++);
            } else if (j->first < i->first) {
                out.powers.push_back(*j++);
            } else {
                shared *= power(i->first, std::min(i->second, j->second));
                out.powers.emplace_back(i->first, std::max(i->second, j->second));
                ++i;
                ++j;
            }
        }
        out.powers.insert(out.powers.end(), i, a.powers.end());
        out.powers.insert(out.powers.end(), j, b.powers.end());
        mpz_class only_b;
        mpz_class only_a;
        mpz_divexact(only_b.get_mpz_t(), b.denominator.get_mpz_t(), shared.get_mpz_t());
        mpz_divexact(only_a.get_mpz_t(), a.denominator.get_mpz_t(), shared.get_mpz_t());
        out.numerator = a.numerator * only_b + b.numerator * only_a;
        out.denominator = a.denominator * only_b;
        return out;
    }

    const ExactCorners& corners_;
    std::vector<Node> leaves_;
};

}  // namespace trisect::detail
