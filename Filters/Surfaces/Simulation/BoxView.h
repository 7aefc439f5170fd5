// The part of a surface in a periodic box, which outputs show. The state extends beyond the sides,
// so that the surface is carried in from there.

#ifndef BoxView_h
#define BoxView_h

#include "NarrowBand.h"
#include "Walls.h"

#include <array>
#include <memory>

namespace activesurface
{

class BoxView
{
public:
  void Clear() { this->Last = {}; }

  // Closed at the sides. The last two are kept, so that the same surface has the same part.
  std::shared_ptr<const NarrowBand> Cut(
    const std::shared_ptr<const NarrowBand>& whole, const Walls& sides)
  {
    for (const Entry& entry : this->Last)
    {
      if (entry.Whole == whole)
      {
        return entry.Part;
      }
    }
    std::shared_ptr<const NarrowBand> part = whole->MakePartWithin(sides);
    this->Last = { Entry{ whole, part }, this->Last[0] };
    return part;
  }

private:
  struct Entry
  {
    std::shared_ptr<const NarrowBand> Whole, Part;
  };
  std::array<Entry, 2> Last;
};

}

#endif
