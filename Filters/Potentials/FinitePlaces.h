// Flags the finite ones of some points; the others are not evaluated.

#ifndef FinitePlaces_h
#define FinitePlaces_h

#include "CompilerBuiltins.h"

#include <cmath>
#include <cstddef>

namespace activesurface
{

template <std::size_t Capacity>
class FinitePlaces
{
public:
  // Tests up to Capacity points (x y z each).
  ACTIVE_ALWAYS_INLINE FinitePlaces(std::size_t count, const double* places)
    : Size(count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const double* x = places + 3 * i;
      this->IsFinite[i] = std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
    }
  }

  bool operator[](std::size_t i) const { return this->IsFinite[i]; }

  // Calls visit(index) for each point that is not finite.
  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void ForEachOther(Visitor visit) const
  {
    for (std::size_t i = 0; i < this->Size; ++i)
    {
      if (!this->IsFinite[i])
      {
        visit(i);
      }
    }
  }

private:
  const std::size_t Size;
  bool IsFinite[Capacity];
};

}

#endif
