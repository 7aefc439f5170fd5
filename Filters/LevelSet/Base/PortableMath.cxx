#include "Base/PortableMath.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

constexpr double Short = .35; // half of ln 2, rounded up

/** Sums x + x^2/2 + x^3/6 + ..., for |x| <= Short. */
double SumSeries(double x)
{
  constexpr int terms = 15;
  double sum = 1.0;
  for (int n = terms; n > 1; --n)
  {
    sum = 1.0 + x / n * sum;
  }
  return x * sum;
}

}

double Exponential(double x)
{
  constexpr double largest = 800.0; // beyond this, e^x is 0 or infinite
  // ln 2 in two parts. The first has so few bits that its multiples are exact.
  constexpr double high = 0x1.62e42feep-1, low = 0x1.a39ef35793c76p-33;
  const double limited = std::min(std::max(x, -largest), largest);
  if (std::isnan(limited))
  {
    return limited;
  }
  const double doublings = std::floor(limited / (high + low) + .5);
  const double rest = (limited - doublings * high) - doublings * low;
  return std::ldexp(1.0 + SumSeries(rest), static_cast<int>(doublings));
}

double ExponentialMinusOne(double x)
{
  return std::fabs(x) <= Short ? SumSeries(x) : Exponential(x) - 1.0;
}

}
