#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

#include "lang/builtin_functions.h"
#include "tenon/math/affine3.h"

namespace tenon::lang {

namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

double sine(double x) {
  return std::isfinite(x) ? sin_degrees(x) : std::numeric_limits<double>::quiet_NaN();
}
double cosine(double x) {
  return std::isfinite(x) ? cos_degrees(x) : std::numeric_limits<double>::quiet_NaN();
}

// Period 180, and exact at the multiples of 45 degrees; the poles are infinite with the sign of OpenSCAD: tan(90) =
// inf, tan(270) = -inf.
double tangent(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  const double a = std::fmod(x, 360.0);
  const double b = std::fabs(a);
  if (b == 90 || b == 270)
    return (b == 90) == (a > 0) ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  const double c = std::fmod(b, 180.0);
  double t = 0;
  if (c == 0) {
    t = b == 180 ? -0.0 : 0;
    return a == -180 ? t : a < 0 ? -t : t;
  }
  if (c == 30 || c == 150) {
    t = c == 30 ? std::numbers::sqrt3 / 3 : -std::numbers::sqrt3 / 3;
  } else if (c == 45 || c == 135) {
    t = c == 45 ? 1 : -1;
  } else if (c == 60 || c == 120) {
    t = c == 60 ? std::numbers::sqrt3 : -std::numbers::sqrt3;
  } else {
    t = sin_degrees(c) / cos_degrees(c);
  }
  return a < 0 ? -t : t;
}

// An angle next to a whole number of degrees, where the sine of that is the argument, is that number: so
// asin(sqrt(3)/2) is 60.
// @param roundings  of half an ulp, by which the argument may differ
template <class Function>
double snapped(double angle, double argument, Function function, double roundings) {
  const double nearest = std::round(angle);
  const double tolerance = roundings * 0.5 * std::numeric_limits<double>::epsilon();
  return std::fabs(function(nearest) - argument) <= tolerance * std::fabs(argument) ? nearest : angle;
}

double arc_sine(double x) {
  if (!(std::fabs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  return snapped(std::asin(x) * degrees_per_radian, x, sin_degrees, 1);
}
double arc_cosine(double x) {
  if (!(std::fabs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  return snapped(std::acos(x) * degrees_per_radian, x, cos_degrees, 1);
}
double arc_tangent(double x) {
  if (std::isinf(x)) return x > 0 ? 90 : -90;
  return snapped(std::atan(x) * degrees_per_radian, x, tangent, 2);
}

double arc_tangent_2(double y, double x) {
  if (std::isnan(y) || std::isnan(x)) return std::numeric_limits<double>::quiet_NaN();
  if (y == 0) return x < 0 ? 180 : 0;
  if (x == 0) return y > 0 ? 90 : -90;
  if (std::isinf(x) || std::isinf(y)) return std::atan2(y, x) * degrees_per_radian;
  const double a = arc_tangent(std::fabs(y) / std::fabs(x));
  const double b = x > 0 ? a : 180 - a;
  return y > 0 ? b : -b;
}

double sign(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}
double absolute(double x) {
  return std::fabs(x);
}
double floor_of(double x) {
  return std::floor(x);
}
double ceiling(double x) {
  return std::ceil(x);
}
double rounded(double x) {
  return std::round(x);
}
double exponential(double x) {
  return std::exp(x);
}
double natural_logarithm(double x) {
  return std::log(x);
}
double decimal_logarithm(double x) {
  return std::log10(x);
}
double square_root(double x) {
  return std::sqrt(x);
}
double power(double x, double y) {
  return std::pow(x, y);
}

template <double (*function)(double)>
Value unary(const BuiltinCall& call) {
  if (!call.has_arguments(1, 1)) return {};
  const double* x = call.number(0);
  return x ? Value(function(*x)) : Value();
}

template <double (*function)(double, double)>
Value binary(const BuiltinCall& call) {
  if (!call.has_arguments(2, 2)) return {};
  const double* x = call.number(0);
  const double* y = x ? call.number(1) : nullptr;
  return y ? Value(function(*x, *y)) : Value();
}

// Random numbers are those of OpenSCAD, which has them by std::uniform_real_distribution of GNU's library: two words of
// the generator each, the second above the first. They are made here, for other libraries have others.
double random_between(std::mt19937& generator, double low, double high) {
  const auto below = static_cast<double>(generator()), above = static_cast<double>(generator());
  const double share = (below + above * 0x1p32) * 0x1p-64;
  return std::min(share, 1 - 0x1p-53) * (high - low) + low;
}

// The seed that OpenSCAD makes of a number: the number modulo the prime 2^31 - 1, where division by two is a
// multiplication by 2^30. It is that of a whole number itself.
std::uint32_t seed_of(double number) {
  constexpr std::uint64_t prime = (std::uint64_t{1} << 31) - 1;
  int exponent = 0;
  double fraction = std::frexp(std::fabs(number), &exponent);
  std::uint64_t seed = 0;
  // Bits go in at the lower end, 28 at once.
  constexpr int bits = 28;
  while (fraction != 0) {
    fraction = std::ldexp(fraction, bits);
    const double whole = std::floor(fraction);
    fraction -= whole;
    seed = ((seed << bits) + static_cast<std::uint64_t>(whole)) % prime;
    exponent -= bits;
  }
  constexpr int period = 31;
  const int shift = (exponent % period + period) % period;
  seed = (seed << shift) % prime;
  const auto word = static_cast<std::uint32_t>(seed);
  return number < 0 ? ~word + 1 : word;
}

Value random_numbers(const BuiltinCall& call) {
  if (!call.has_arguments(3, 4)) return {};
  std::array<double, 4> values{};
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const double* value = call.number(i);
    if (!value) return {};
    if (!std::isfinite(*value)) return call.refuse("takes finite numbers");
    values[i] = *value;
  }
  const double low = std::min(values[0], values[1]), high = std::max(values[0], values[1]);
  std::mt19937& generator = call.environment.random;
  // What is drawn later without a seed goes on from here.
  if (call.arguments.size() == 4) generator.seed(seed_of(values[3]));
  ListBuilder list(call.environment.budget);
  const double count = std::fabs(std::trunc(values[2]));
  // Where there is no choice, no number is drawn.
  for (double i = 0; i < count; ++i) list.add(Value(low < high ? random_between(generator, low, high) : low));
  return std::move(list).finish();
}

}  // namespace

void add_math_functions(BuiltinFunctionTable& table, SymbolTable& symbols) {
  const std::pair<const char*, BuiltinFunction> functions[] = {
      {"sin", unary<sine>},
      {"cos", unary<cosine>},
      {"tan", unary<tangent>},
      {"asin", unary<arc_sine>},
      {"acos", unary<arc_cosine>},
      {"atan", unary<arc_tangent>},
      {"atan2", binary<arc_tangent_2>},
      {"abs", unary<absolute>},
      {"sign", unary<sign>},
      {"floor", unary<floor_of>},
      {"ceil", unary<ceiling>},
      {"round", unary<rounded>},
      {"exp", unary<exponential>},
      {"ln", unary<natural_logarithm>},
      {"log", unary<decimal_logarithm>},
      {"sqrt", unary<square_root>},
      {"pow", binary<power>},
      {"rands", random_numbers},
  };
  for (const auto& [name, function] : functions) table.emplace(symbols.intern(name), function);
}

}  // namespace tenon::lang
