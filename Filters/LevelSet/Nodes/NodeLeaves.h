/**
 * The leaves of the node scheme and their neighbours, and blocks of numbers around a leaf.
 */
#ifndef NodeLeaves_h
#define NodeLeaves_h

#include "Base/FloatLanes.h"
#include "Base/IndexMap.h"
#include "Base/NodeTarget.h"
#include "Leaves/LeafTable.h"
#include "Leaves/NodeArrays.h"
#include "Nodes/OldPotential.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cstring>
#include <vector>

namespace activesurface
{

inline NodeIndex CentreOf(const NodeIndex& origin)
{
  return { origin[0] + 4, origin[1] + 4, origin[2] + 4 };
}

struct NodeLeaf : ShellLeaf
{
  /** Numbers of the leaf and its 26 neighbours, by NeighbourNumber. Missing leaves are NoLeafInside
   * or NoLeafOutside. Set only for own leaves. */
  std::array<std::int32_t, 27> Near;
};

class NodeLeaves
{
public:
  /** Replaces the leaves by those of `shell`. own: number of this rank's leaves, which come first.
   * isInside(origin): true if a leaf that is not in the shell is inside; several threads call
   * isInside at once if isThreadSafe. */
  template <class IsInside>
  void Adopt(
    const std::vector<ShellLeaf>& shell, std::size_t own, bool isThreadSafe, IsInside&& isInside)
  {
    this->Own = own;
    this->Leaves.resize(shell.size());
    this->Numbers.Clear(shell.size());
    for (std::size_t i = 0; i < shell.size(); ++i)
    {
      static_cast<ShellLeaf&>(this->Leaves[i]) = shell[i];
      this->Numbers.Add(shell[i].Origin);
    }
    const auto adopt = [&](std::size_t i)
    {
      NodeLeaf& leaf = this->Leaves[i];
      for (int n = 0; n < 27; ++n)
      {
        const NodeIndex origin = { leaf.Origin[0] + 8 * (n / 9 - 1),
          leaf.Origin[1] + 8 * (n / 3 % 3 - 1), leaf.Origin[2] + 8 * (n % 3 - 1) };
        const std::int32_t found = this->Numbers.Find(origin);
        leaf.Near[n] = found >= 0 ? found : isInside(origin) ? NoLeafInside : NoLeafOutside;
      }
    };
    if (isThreadSafe)
    {
      this->ForEach(adopt);
      return;
    }
    for (std::size_t i = 0; i < own; ++i)
    {
      adopt(i);
    }
  }

  /** Returns the number of the leaf at an origin, or a negative number. */
  std::int32_t Find(const NodeIndex& origin) const { return this->Numbers.Find(origin); }
  std::size_t Size() const { return this->Leaves.size(); }
  std::size_t GetOwn() const { return this->Own; }
  NodeLeaf& operator[](std::size_t i) { return this->Leaves[i]; }
  const NodeLeaf& operator[](std::size_t i) const { return this->Leaves[i]; }

  ///@{
  /** ForEach calls function(i) for this rank's leaves, ForAll for all leaves; both in parallel. */
  template <class Function>
  void ForEach(Function&& function) const
  {
    ForRange(this->Own, function);
  }
  template <class Function>
  void ForAll(Function&& function) const
  {
    ForRange(this->Leaves.size(), function);
  }
  ///@}

  /** Runs a kernel on this rank's leaves in parallel, compiled for the chosen instruction set. */
  template <class Kernel>
  void RunKernel(const Kernel& kernel) const
  {
    const auto run = CompiledKernel<Kernel, std::size_t>::GetBest();
    this->ForEach([&kernel, run](std::size_t i) { run(kernel, i); });
  }

private:
  template <class Function>
  static void ForRange(std::size_t size, Function&& function)
  {
    constexpr std::size_t grain = 4;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, grain),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
        {
          function(i);
        }
      });
  }

  std::vector<NodeLeaf> Leaves;
  std::size_t Own = 0; // this rank's leaves come first
  IndexMap Numbers;
};

/** The numbers at the nodes of a leaf, and at W <= 4 layers of nodes around the leaf. Rows of 16
 * along z begin 4 nodes before the leaf. Nodes of missing leaves have + or - `outside`. */
template <int W>
struct NodeBlock
{
  static constexpr int Side = 8 + 2 * W;
  static constexpr int X = 16 * Side; //< distance in memory of neighbours along x
  static constexpr int Y = 16;

  alignas(32) float Value[Side * Side * 16];

  ACTIVE_ALWAYS_INLINE const float* Row(int x, int y) const
  {
    return this->Value + X * (x + W) + Y * (y + W) + 4;
  }

  ACTIVE_ALWAYS_INLINE void Gather(const NodeArrays& from, const NodeLeaf& leaf, float outside)
  {
    for (int x = -W; x < 8 + W; ++x)
    {
      for (int y = -W; y < 8 + W; ++y)
      {
        this->GatherRow(from, leaf, outside, x, y);
      }
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void GatherRow(
    const NodeArrays& from, const NodeLeaf& leaf, float outside, int x, int y)
  {
    float* to = this->Value + X * (x + W) + Y * (y + W) + 4;
    const std::int32_t* near = leaf.Near.data() + 9 * ((x + 8) / 8) + 3 * ((y + 8) / 8);
    const int row = 64 * (x & 7) + 8 * (y & 7);
    const auto side = [&](std::int32_t n) { return n == NoLeafInside ? -outside : outside; };
    StoreLanes(to, near[1] >= 0 ? LoadLanes(from.Of(near[1]) + row) : AllLanes(side(near[1])));
    for (int k = 1; k <= W; ++k)
    {
      to[-k] = near[0] >= 0 ? from.Of(near[0])[row + 8 - k] : side(near[0]);
      to[7 + k] = near[2] >= 0 ? from.Of(near[2])[row + k - 1] : side(near[2]);
    }
  }
};

}

#endif
