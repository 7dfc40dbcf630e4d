// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/number/gmp_conversion.h>

#include <cstddef>

namespace trisect::detail {

std::vector<std::uint64_t> limbs_of(const mpz_class& magnitude) {
    std::vector<std::uint64_t> limbs(mpz_size(magnitude.get_mpz_t()) + 1);
    std::size_t count = 0;
    mpz_export(limbs.data(), &count, -1, sizeof limbs[0], 0, 0, magnitude.get_mpz_t());
    limbs.resize(count);
    return limbs;
}

ExactRational from_gmp(const mpq_class& value) {
    const mpz_class magnitude = abs(value.get_num());
    return ExactRational::from_limbs(sgn(value) < 0, limbs_of(magnitude),
                                     limbs_of(value.get_den()));
}

std::vector<mpz_class> common_numerators(std::span<const mpq_class> values,
                                         mpz_class& denominator) {
    denominator = 1;
    for (const mpq_class& v : values)
        mpz_lcm(denominator.get_mpz_t(), denominator.get_mpz_t(), v.get_den_mpz_t());
    std::vector<mpz_class> numerators;
    numerators.reserve(values.size());
    for (const mpq_class& v : values)
        numerators.push_back(v.get_num() * mpz_class(denominator / v.get_den()));
    return numerators;
}

}  // namespace trisect::detail
