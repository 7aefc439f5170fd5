/**
 * Reads numbers and bits of nodes that are some steps along an axis from the nodes of a leaf: in
 * the leaf, or in its neighbours on the axis.
 */
#ifndef LeafLine_h
#define LeafLine_h

#include "Leaves/LeafTable.h"

namespace activesurface
{

template <int Axis>
class LeafLine
{
public:
  static constexpr int Farthest = 3; //< steps

  /** arrayOf(leaf): the 512 numbers of a leaf. */
  template <class ArrayOf>
  ACTIVE_ALWAYS_INLINE LeafLine(const LeafTable& table, std::int32_t leaf, ArrayOf&& arrayOf)
  {
    const std::int32_t before = table[leaf].Neighbour[FaceNumber(Axis, -1)];
    const std::int32_t after = table[leaf].Neighbour[FaceNumber(Axis, 1)];
    const float* own = arrayOf(leaf);
    const float* ofBefore = before >= 0 ? arrayOf(before) : own;
    const float* ofAfter = after >= 0 ? arrayOf(after) : own;
    for (int p = 0; p < Planes; ++p)
    {
      const int place = p - Farthest;
      this->Plane[p] = (place < 0 ? ofBefore : place < 8 ? own : ofAfter) + Step * (place & 7);
    }
  }

  /**
   * Returns the value at the node `steps` from `node` along the axis. The value is arbitrary if
   * that node has no leaf, or if another thread writes the value at the same time (relaxed atomic
   * load). Callers must mask out both cases.
   */
  ACTIVE_ALWAYS_INLINE float At(int node, int steps) const
  {
    const float* from = this->Plane[((node / Step) & 7) + steps + Farthest] + (node & ~(7 * Step));
    return LoadRelaxed(from);
  }

private:
  static constexpr int Planes = 8 + 2 * Farthest;
  static constexpr int Step = Stride(Axis);

  const float* Plane[Planes]; //< first node of each plane, by its offset along the axis
};

/** Returns the mask whose node n is set if `mask` has n + Steps along an axis. next: the mask of
 * the leaf in that direction. Steps: -7 to 7, not 0. */
template <int Axis, int Steps>
ACTIVE_ALWAYS_INLINE LeafMask Seen(const LeafMask& mask, const LeafMask& next)
{
  return Steps < 0 ? SeenBehind(mask, next, Axis, -Steps) : SeenAhead(mask, next, Axis, Steps);
}

}

#endif
