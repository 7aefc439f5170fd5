// The part of a surface within the sides of a periodic box, for the outputs. The state itself
// extends beyond the sides, so that the surface enters the box from there.

#ifndef BoxView_h
#define BoxView_h

#include "Base/Walls.h"
#include "NarrowBand.h"

#include <array>
#include <memory>

namespace activesurface
{

class BoxView
{
public:
  void Clear() { this->Last = {}; }

  // Returns the part within the sides, closed at them. Caches the parts of the last two surfaces:
  // the same surface yields the same object.
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
