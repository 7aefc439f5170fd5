// States at some of the steps that a surface has been at, to go back to.

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
  // Every so many steps, 0: none; in so many bytes.
  void SetLimits(int interval, std::size_t memory);

  void Clear() { this->States.clear(); }

  // Keeps the state if the step is one to keep. Those that are needed least go when memory ends:
  // the ones without which the steps that are left lie closest together.
  void Add(int step, const NarrowBand& band);

  // Keeps it in any case, instead of one at the same step.
  void Keep(int step, const NarrowBand& band);

  // The last one that is not after a step; -1 if there is none.
  int FindUpTo(int step) const;

  std::unique_ptr<NarrowBand> Restore(int step) const;

private:
  struct Saved
  {
    std::string Bytes;
    std::shared_ptr<const BandPart> Part;
    std::size_t Size; // in the memory; of a part the same on all ranks
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
