// What of the outputs is this rank's.

#ifndef OutputShare_h
#define OutputShare_h

namespace activesurface
{

// All of them in a program of one process.
struct OutputShare
{
  int Rank = 0;
  int Size = 1;

  bool IsAll() const { return this->Size < 2; }
};

}

#endif
