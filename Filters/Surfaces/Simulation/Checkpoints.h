// States of a surface at some of its steps, to resume from.

#ifndef Checkpoints_h
#define Checkpoints_h

#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace activesurface
{

struct BandPart;
class NarrowBand;

class Checkpoints
{
public:
  // interval: steps between two states; 0 turns checkpoints off. memory: capacity [bytes].
  void SetLimits(int interval, std::size_t memory);

  void Clear() { this->States.clear(); }

  // Saves the state if the step is a multiple of the interval. While the capacity is exceeded,
  // removes the state that leaves the smallest gap between steps; the first state is removed last.
  void Add(int step, const NarrowBand& band);

  // Saves the state at any step and replaces an older one there. Ignores both limits.
  void Keep(int step, const NarrowBand& band);

  // Returns the last saved step <= step, or -1.
  int FindUpTo(int step) const;

  std::unique_ptr<NarrowBand> Restore(int step) const;

private:
  struct Saved
  {
    std::string Bytes;
    std::shared_ptr<const BandPart> Part;
    std::size_t Size; // [bytes]; for a part an estimate that is equal on all ranks
  };

  static Saved Save(const NarrowBand& band);
  void MakeRoom();
  std::size_t GetSize() const;

  int Interval = 10;
  std::size_t Memory = std::size_t(256) << 20;
  std::map<int, Saved> States; // by step
};

}

#endif
