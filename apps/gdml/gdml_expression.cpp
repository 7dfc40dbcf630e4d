// SPDX-License-Identifier: Apache-2.0
#include "gdml_expression.h"

#include <trisect/brep/io/formats/decimal.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace trisect::app {
namespace {

constexpr std::size_t longest_formula = 1U << 14;
constexpr int deepest_formula = 100;

struct Function {
    std::string_view name;
    double (*of)(double);
};
constexpr std::array<Function, 16> functions{{
    {"sin", [](double x) { return std::sin(x); }},
    {"cos", [](double x) { return std::cos(x); }},
    {"tan", [](double x) { return std::tan(x); }},
    {"asin", [](double x) { return std::asin(x); }},
    {"acos", [](double x) { return std::acos(x); }},
    {"atan", [](double x) { return std::atan(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},
    {"cosh", [](double x) { return std::cosh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"exp", [](double x) { return std::exp(x); }},
    {"log", [](double x) { return std::log(x); }},
    {"log10", [](double x) { return std::log10(x); }},
    {"abs", [](double x) { return std::fabs(x); }},
    {"floor", [](double x) { return std::floor(x); }},
    {"ceil", [](double x) { return std::ceil(x); }},
}};

bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

class Parser {
public:
    Parser(std::string_view text, const GdmlNames& names) : rest_(text), names_(names) {
        if (text.size() > longest_formula) throw GdmlFormulaError("a formula that is too long");
    }

    double parse() {
        const double out = sum();
        if (next() != '\0') fail("does not end here");
        if (!std::isfinite(out)) throw GdmlFormulaError("a value that is not finite");
        return out;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw GdmlFormulaError("at '" + std::string(rest_.substr(0, 20)) + "': " + what);
    }

    /// The next character that is no blank; 0 at the end.
    char next() {
        const std::size_t at = rest_.find_first_not_of(" \t\r\n");
        rest_.remove_prefix(at == std::string_view::npos ? rest_.size() : at);
        return rest_.empty() ? '\0' : rest_.front();
    }
    bool take(char c) {
        if (next() != c) return false;
        rest_.remove_prefix(1);
        return true;
    }
    void expect(char c) {
        if (!take(c)) fail(std::string("expected '") + c + "'");
    }

    double sum() {
        double out = product();
        while (true) {
            if (take('+'))
                out += product();
            else if (take('-'))
                out -= product();
            else
                return out;
        }
    }

    double product() {
        double out = signed_power();
        while (true) {
            if (take('*'))
                out *= signed_power();
            else if (take('/'))
                out /= signed_power();
            else
                return out;
        }
    }

    double signed_power() {
        if (++depth_ > deepest_formula) throw GdmlFormulaError("a formula that nests too deeply");
        double out = 0;
        if (take('-'))
            out = -signed_power();
        else if (take('+'))
            out = signed_power();
        else
            out = power();
        --depth_;
        return out;
    }

    double power() {
        const double base = primary();
        if (next() == '*' && rest_.substr(0, 2) == "**")
            rest_.remove_prefix(2);
        else if (!take('^'))
            return base;
        return std::pow(base, signed_power());
    }

    double primary() {
        const char c = next();
        if (take('(')) {
            const double out = sum();
            expect(')');
            return out;
        }
        if (is_digit(c) || c == '.') return number();
        if (begins_name(c)) return named();
        fail("expected a number or a name");
    }

    double number() {
        const auto digits = [&](std::size_t at) {
            while (at < rest_.size() && is_digit(rest_[at])) ++at;
            return at;
        };
        std::size_t end = digits(0);
        if (end < rest_.size() && rest_[end] == '.') end = digits(end + 1);
        if (end < rest_.size() && (rest_[end] == 'e' || rest_[end] == 'E')) {
            std::size_t at = end + 1;
            if (at < rest_.size() && (rest_[at] == '+' || rest_[at] == '-')) ++at;
            if (digits(at) > at) end = digits(at);
        }
        double out = 0;
        const auto [stop, error] = detail::nearest_double(rest_.data(), rest_.data() + end, out);
        if (error != std::errc{} || stop != rest_.data() + end) fail("no number");
        rest_.remove_prefix(end);
        return out;
    }

    double named() {
        std::size_t end = 1;
        while (end < rest_.size() &&
               (begins_name(rest_[end]) || is_digit(rest_[end]) || rest_[end] == '.'))
            ++end;
        const std::string_view name = rest_.substr(0, end);
        rest_.remove_prefix(end);
        if (take('(')) return call(name, arguments(')'));
        std::vector<double> indices;
        if (take('[')) indices = arguments(']');
        if (const auto value = names_.value(name, indices)) return *value;
        throw GdmlFormulaError("'" + std::string(name) + "' is not defined");
    }

    std::vector<double> arguments(char close) {
        std::vector<double> out{sum()};
        while (take(',')) out.push_back(sum());
        expect(close);
        return out;
    }

    double call(std::string_view name, const std::vector<double>& in) const {
        if (in.size() == 2) {
            if (name == "pow") return std::pow(in[0], in[1]);
            if (name == "atan2") return std::atan2(in[0], in[1]);
            if (name == "min") return std::min(in[0], in[1]);
            if (name == "max") return std::max(in[0], in[1]);
        }
        for (const Function& f : functions)
            if (in.size() == 1 && f.name == name) return f.of(in[0]);
        throw GdmlFormulaError("no function '" + std::string(name) + "' of " +
                               std::to_string(in.size()) + " arguments");
    }

    std::string_view rest_;
    const GdmlNames& names_;
    int depth_ = 0;
};

}  // namespace

double gdml_value(std::string_view formula, const GdmlNames& names) {
    return Parser(formula, names).parse();
}

}  // namespace trisect::app
