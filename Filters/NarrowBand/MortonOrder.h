/**
 * Morton order of places on a lattice: a cube, then the next. Places in a box are between its
 * lowest and its highest corner.
 */
#ifndef MortonOrder_h
#define MortonOrder_h

#include <type_traits>

namespace activesurface
{

/** The axis along which two places differ by the highest bit; the first one if they are the same.
 */
template <class Coordinate>
int FindDecidingAxis(const Coordinate a[3], const Coordinate b[3])
{
  using Bits = std::make_unsigned_t<Coordinate>;
  Bits most = 0;
  int decides = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Bits difference = static_cast<Bits>(a[axis]) ^ static_cast<Bits>(b[axis]);
    if (most < difference && most < (most ^ difference))
    {
      most = difference;
      decides = axis;
    }
  }
  return decides;
}

template <class Coordinate>
bool IsBeforeInMortonOrder(const Coordinate a[3], const Coordinate b[3])
{
  const int axis = FindDecidingAxis(a, b);
  return a[axis] < b[axis];
}

/** Between two places, a first one and a last one along an axis: where the highest bit that differs
 * is set. */
template <class Coordinate>
Coordinate FindMortonCut(Coordinate first, Coordinate last)
{
  using Bits = std::make_unsigned_t<Coordinate>;
  Bits bit = 1;
  for (Bits difference = static_cast<Bits>(first) ^ static_cast<Bits>(last); difference > 1;
       difference >>= 1)
  {
    bit <<= 1;
  }
  return static_cast<Coordinate>(static_cast<Bits>(last) & ~(bit - 1));
}

}

#endif
