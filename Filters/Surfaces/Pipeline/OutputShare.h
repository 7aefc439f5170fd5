// Part of the outputs that belongs to this rank.

#ifndef OutputShare_h
#define OutputShare_h

namespace activesurface
{

// Rank and number of ranks. One process has the complete outputs.
struct OutputShare
{
  int Rank = 0;
  int Size = 1;

  bool IsAll() const { return this->Size < 2; }
};

}

#endif
