// Exponentials are accurate, and bitwise identical on any processor.

#include "Base/PortableMath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

using namespace activesurface;

namespace TestPortableMath
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

template <class Visitor>
void ForNumbersTo(double largest, Visitor&& visit)
{
  constexpr int numbers = 100000;
  for (int n = -numbers; n <= numbers; ++n)
  {
    const double part = static_cast<double>(n) / numbers;
    visit(largest * part * part * part); // most arguments are near 0
  }
}

// FNV-1a hash of the bits of all results.
template <class Function>
std::uint64_t HashOf(Function&& function, double largest)
{
  std::uint64_t hash = 14695981039346656037u;
  ForNumbersTo(largest,
    [&](double x)
    {
      const double value = function(x);
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof(bits));
      hash = (hash ^ bits) * 1099511628211u;
    });
  return hash;
}

}

TEST(TestPortableMath, ExponentialsAreRight)
{
  ForNumbersTo(700.0,
    [](double x)
    {
      ASSERT_NEAR(Exponential(x) / std::exp(x), 1.0, 1e-15) << x;
      const double less = x == 0.0 ? 1.0 : ExponentialMinusOne(x) / std::expm1(x);
      ASSERT_NEAR(less, 1.0, 1e-15) << x;
    });
  EXPECT_EQ(ExponentialMinusOne(0.0), 0.0);
  EXPECT_EQ(Exponential(-1e30), 0.0);
  EXPECT_EQ(ExponentialMinusOne(-Infinity), -1.0);
  EXPECT_EQ(Exponential(1e30), Infinity);
  EXPECT_TRUE(std::isnan(Exponential(std::nan(""))));
}

// Results of a C library would differ.
TEST(TestPortableMath, BitsAreTheSameEverywhere)
{
  EXPECT_EQ(HashOf(Exponential, 700.0), 8592372845995784326u);
  EXPECT_EQ(HashOf(ExponentialMinusOne, 700.0), 16780259053720530470u);
}

}
