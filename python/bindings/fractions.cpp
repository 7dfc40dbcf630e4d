// SPDX-License-Identifier: Apache-2.0
//
// Python refuses to make integers of more than 4300 decimal digits, and takes quadratic time for
// them. Volumes have a hundred thousand. So numbers change over as bytes.

#include "fractions.h"

#include <string>
#include <vector>

#include <trisect/kernel/error.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::python {

namespace {

// A GMP integer that ends with its scope.
class Integer {
public:
    explicit Integer(const std::string& decimal) { mpz_init_set_str(value_, decimal.c_str(), 10); }
    Integer(const Integer&) = delete;
    Integer& operator=(const Integer&) = delete;
    ~Integer() { mpz_clear(value_); }

    [[nodiscard]] py::object to_python() const {
        std::string bytes((mpz_sizeinbase(value_, 2) + 7) / 8, '\0');
        std::size_t written = 0;
        mpz_export(bytes.data(), &written, -1, 1, 0, 0, value_);
        bytes.resize(written);
        const py::object type =
            py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyLong_Type));
        const py::object magnitude = type.attr("from_bytes")(py::bytes(bytes), "little");
        return mpz_sgn(value_) < 0 ? -magnitude : magnitude;
    }

private:
    mpz_t value_;
};

std::vector<std::uint64_t> limbs_of(const py::object& magnitude) {
    const auto bits = magnitude.attr("bit_length")().cast<std::size_t>();
    std::vector<std::uint64_t> limbs(bits / 64 + 1);
    const py::bytes bytes = magnitude.attr("to_bytes")(8 * limbs.size(), "little");
    const std::string text = bytes;
    for (std::size_t i = 0; i < text.size(); ++i)
        limbs[i / 8] |= std::uint64_t{static_cast<unsigned char>(text[i])} << (8 * (i % 8));
    return limbs;
}

}  // namespace

py::object to_fraction(const ExactRational& value) {
    const std::string text = value.to_string();
    const std::size_t bar = text.find('/');
    const py::object numerator = Integer(text.substr(0, bar)).to_python();
    const py::object denominator =
        bar == std::string::npos ? py::int_(1) : Integer(text.substr(bar + 1)).to_python();
    return py::module_::import("fractions").attr("Fraction")(numerator, denominator);
}

py::tuple to_fractions(const ExactPoint& point) {
    return py::make_tuple(to_fraction(point[0]), to_fraction(point[1]), to_fraction(point[2]));
}

ExactRational exact_of(const py::handle& number, const char* what) {
    if (PyFloat_Check(number.ptr()) != 0) return ExactRational::from_double(number.cast<double>());
    if (!py::hasattr(number, "numerator") || !py::hasattr(number, "denominator"))
        throw py::type_error(std::string(what) + ": must be an int, a float or a Fraction");
    const py::object numerator = py::int_(py::object(number.attr("numerator")));
    const py::object denominator = py::int_(py::object(number.attr("denominator")));
    const bool is_negative = numerator < py::int_(0);
    return ExactRational::from_limbs(is_negative,
                                     limbs_of(is_negative ? py::object(-numerator) : numerator),
                                     limbs_of(denominator));
}

}  // namespace trisect::python
