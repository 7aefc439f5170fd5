/**
 * A sum that does not depend on the order of the terms, or on the ranks and threads that add terms.
 */
#ifndef FixedSum_h
#define FixedSum_h

#include <cmath>
#include <cstdint>

namespace activesurface
{

/** Two integers: whole numbers, and fractions in units of 2^-32. Each term is rounded by at most
 * half a unit. */
class FixedSum
{
public:
  /** value: finite, magnitude below 10^15. */
  void Add(double value)
  {
    const double whole = std::floor(value);
    this->Wholes += static_cast<std::int64_t>(whole);
    this->Parts += std::llround((value - whole) * Units);
  }

  void Add(const FixedSum& other)
  {
    this->Wholes += other.Wholes;
    this->Parts += other.Parts;
  }

  double Get() const
  {
    constexpr int bits = 32;
    const std::int64_t carry = this->Parts >> bits;
    const std::int64_t rest = this->Parts - (carry << bits);
    return static_cast<double>(this->Wholes + carry) + static_cast<double>(rest) / Units;
  }

private:
  static constexpr double Units = 4294967296.0;
  std::int64_t Wholes = 0;
  std::int64_t Parts = 0;
};

}

#endif
