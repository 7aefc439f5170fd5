/**
 * Numbers for the nodes of leaves.
 */
#ifndef NodeArrays_h
#define NodeArrays_h

#include <cstddef>
#include <memory>
#include <vector>

namespace activesurface
{

/** 512 numbers per leaf, in blocks of 64 KiB: the heap reuses freed memory for blocks of this size.
 */
class NodeArrays
{
public:
  /** Enlarges the arrays to `leaves` leaves; keeps the values of earlier leaves. */
  void MakeRoom(std::size_t leaves)
  {
    while (LeavesAtOnce * this->Blocks.size() < leaves)
    {
      this->Blocks.emplace_back(new float[512 * LeavesAtOnce]);
    }
  }

  float* Of(std::size_t leaf) const
  {
    return this->Blocks[leaf / LeavesAtOnce].get() + 512 * (leaf % LeavesAtOnce);
  }

private:
  static constexpr std::size_t LeavesAtOnce = 32;
  std::vector<std::unique_ptr<float[]>> Blocks;
};

}

#endif
