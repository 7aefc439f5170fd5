// Groups nearby points, so that one search serves a whole group.

#ifndef PlaceGroups_h
#define PlaceGroups_h

#include "CompilerBuiltins.h"
#include "FinitePlaces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace activesurface
{

class PlaceGroups
{
public:
  static constexpr std::size_t Capacity = 256;

  // Sorts the finite points among up to Capacity points (x y z each) along a Morton curve. size:
  // largest extent of the box around a group.
  PlaceGroups(std::size_t count, const double* places, double size)
    : Finite(count, places)
    , Places(places)
    , Limit(size)
  {
    double low[3];
    std::fill_n(low, 3, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < count; ++i)
    {
      const double* x = places + 3 * i;
      for (int axis = 0; axis < 3 && this->Finite[i]; ++axis)
      {
        low[axis] = std::min(low[axis], x[axis]);
      }
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->Finite[i])
      {
        this->Order[this->Usable] =
          GetKey(places + 3 * i, low, StepsPerSize / size) << BitsOfNumber | i;
        ++this->Usable;
      }
    }
    std::sort(this->Order.begin(), this->Order.begin() + this->Usable);
  }

  // Calls visit(members, count) for each group. members are indices of points; count is at most
  // `most`.
  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void ForEachGroup(int most, Visitor visit) const
  {
    std::size_t members[Capacity];
    for (std::size_t k = 0; k < this->Usable; ++k)
    {
      members[k] = this->Order[k] % Capacity;
    }
    for (std::size_t first = 0; first < this->Usable;)
    {
      const int count =
        this->CountGroup(members + first, std::min<std::size_t>(most, this->Usable - first));
      visit(members + first, count);
      first += count;
    }
  }

  // Points that are not finite are in no group.
  const FinitePlaces<Capacity>& GetFinite() const { return this->Finite; }

private:
  static constexpr int BitsOfNumber = 8;
  static constexpr int BitsOnAxis = 18;
  static constexpr double StepsPerSize = 4.0;

  // Inserts two zeros after each of the lower bits.
  static std::uint64_t SpreadBits(std::uint64_t bits)
  {
    bits = (bits | bits << 32) & 0x1f00000000ffffu;
    bits = (bits | bits << 16) & 0x1f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
  }

  // Returns the Morton code; coordinates are clamped at the far end.
  static std::uint64_t GetKey(const double x[3], const double low[3], double stepsPerLength)
  {
    constexpr double last = (1 << BitsOnAxis) - 1;
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double step = std::min((x[axis] - low[axis]) * stepsPerLength, last);
      key |= SpreadBits(static_cast<std::uint64_t>(step)) << axis;
    }
    return key;
  }

  // Returns how many of the next points, at least one, fit into a group.
  int CountGroup(const std::size_t* members, std::size_t most) const
  {
    double low[3], high[3];
    std::size_t count = 0;
    for (; count < most; ++count)
    {
      const double* x = this->Places + 3 * members[count];
      bool isNear = true;
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = count > 0 ? std::min(low[axis], x[axis]) : x[axis];
        high[axis] = count > 0 ? std::max(high[axis], x[axis]) : x[axis];
        isNear = isNear && high[axis] - low[axis] <= this->Limit;
      }
      if (!isNear)
      {
        break;
      }
    }
    return static_cast<int>(count);
  }

  const FinitePlaces<Capacity> Finite;
  const double* const Places;
  const double Limit;
  std::size_t Usable = 0;
  std::array<std::uint64_t, Capacity> Order; // keys, each with a point's index in the low bits
};

}

#endif
