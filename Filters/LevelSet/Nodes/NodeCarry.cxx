#include "Nodes/NodeCarry.h"

#include "Nodes/LeafPoints.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace activesurface
{

namespace
{

/** Largest blocks of old values [nodes]: for a whole leaf, and for one row. */
constexpr std::size_t UsualNodes = std::size_t(48) * 48 * 48;
constexpr std::size_t MostNodes = std::size_t(128) * 128 * 128;

struct LimitKernel
{
  float* Values; //< padded with up to seven numbers
  std::size_t Count;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    for (std::size_t n = 0; n < this->Count; n += 8)
    {
      StoreLanes(this->Values + n, Clamp(LoadLanes(this->Values + n), NodeLimit));
    }
  }
};

/** Old values at the nodes of a box. */
struct OldBlock
{
  int Low[3];
  int Size[3];
  std::vector<float> Values;

  std::size_t Count() const
  {
    return std::size_t(this->Size[0]) * std::size_t(this->Size[1]) * std::size_t(this->Size[2]);
  }
  int StrideX() const { return this->Size[1] * this->Size[2]; }
  int StrideY() const { return this->Size[2]; }

  void Read(const OldPotential& old)
  {
    constexpr std::size_t lanes = 8;
    this->Values.resize(this->Count() + lanes - 1);
    this->ForEachLeaf([this, &old](const NodeIndex& origin) { this->ReadLeaf(old, origin); });
    RunCompiled(LimitKernel{ this->Values.data(), this->Count() });
  }

  void ListLeaves(std::vector<NodeIndex>& origins) const
  {
    this->ForEachLeaf([&origins](const NodeIndex& origin) { origins.push_back(origin); });
  }

  bool IsOfOneValue() const
  {
    return std::all_of(this->Values.begin(), this->Values.begin() + this->Count(),
      [this](float value) { return value == this->Values[0]; });
  }

private:
  template <class Visit>
  void ForEachLeaf(Visit&& visit) const
  {
    NodeIndex origin;
    for (origin[0] = this->Low[0] & ~7; origin[0] < this->Low[0] + this->Size[0]; origin[0] += 8)
    {
      for (origin[1] = this->Low[1] & ~7; origin[1] < this->Low[1] + this->Size[1]; origin[1] += 8)
      {
        for (origin[2] = this->Low[2] & ~7; origin[2] < this->Low[2] + this->Size[2];
             origin[2] += 8)
        {
          visit(origin);
        }
      }
    }
  }

  void ReadLeaf(const OldPotential& old, const NodeIndex& origin)
  {
    int first[3], end[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = std::max(origin[axis], this->Low[axis]);
      end[axis] = std::min(origin[axis] + 8, this->Low[axis] + this->Size[axis]);
    }
    const float* values = old.Find(origin);
    const float side = values ? 0.f : old.SideOf(origin);
    for (int x = first[0]; x < end[0]; ++x)
    {
      for (int y = first[1]; y < end[1]; ++y)
      {
        float* to = this->Values.data() + std::size_t(x - this->Low[0]) * this->StrideX() +
          std::size_t(y - this->Low[1]) * this->StrideY() + (first[2] - this->Low[2]);
        const int count = end[2] - first[2];
        const float* from = values ? values + 64 * (x & 7) + 8 * (y & 7) + (first[2] & 7) : nullptr;
        if (from && count == 8)
        {
          StoreLanes(to, LoadLanes(from));
          continue;
        }
        for (int z = 0; z < count; ++z)
        {
          to[z] = from ? from[z] : side;
        }
      }
    }
  }
};

/** Finds the feet of a leaf's nodes: the positions x - D(x) from which the values come. */
struct FeetKernel
{
  const LeafMotion& Motion;
  float (*Feet)[3][8]; //< of 64 rows, relative to the first node of the leaf

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    for (int row = 0; row < 64; ++row)
    {
      const int x = row >> 3, y = row & 7;
      const Lanes place[3] = { AllLanes(static_cast<float>(x)), AllLanes(static_cast<float>(y)),
        Lanes{ 0.f, 1.f, 2.f, 3.f, 4.f, 5.f, 6.f, 7.f } };
      for (int axis = 0; axis < 3; ++axis)
      {
        StoreLanes(
          this->Feet[row][axis], place[axis] - ExpandRow(this->Motion.Displacement[axis], x, y));
      }
    }
  }
};

/** Interpolates the old values at the feet of a row. */
struct RowKernel
{
  const float* Block;
  int StrideX, StrideY;
  const float (*Feet)[8];
  const int* Offset; //< of the leaf's first node in the block
  float* Carried;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    alignas(32) float t[3][8];
    alignas(32) int at[8], nearest[3][8];
    for (int i = 0; i < 8; ++i)
    {
      int lower[3], upper[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        const float foot = this->Feet[axis][i];
        const float floor = std::floor(foot);
        t[axis][i] = foot - floor;
        lower[axis] = static_cast<int>(floor) + this->Offset[axis];
        upper[axis] = t[axis][i] > .5f ? 1 : 0;
      }
      at[i] = lower[0] * this->StrideX + lower[1] * this->StrideY + lower[2];
      const int step[3] = { upper[0] * this->StrideX, upper[1] * this->StrideY, upper[2] };
      nearest[0][i] = at[i] + step[1] + step[2];
      nearest[1][i] = at[i] + step[0] + step[2];
      nearest[2][i] = at[i] + step[0] + step[1];
    }
    const Lanes u[3] = { LoadLanes(t[0]), LoadLanes(t[1]), LoadLanes(t[2]) };
    const int strides[3] = { this->StrideX, this->StrideY, 1 };
    Lanes result = this->Linear(at, u);
    for (int axis = 0; axis < 3; ++axis)
    {
      result -= this->Curve(nearest[axis], strides[axis], u[axis]);
    }
    StoreLanes(this->Carried, Clamp(result, NodeLimit));
  }

private:
  ACTIVE_ALWAYS_INLINE Lanes Get(const int* at, int offset) const
  {
    alignas(32) float values[8];
    for (int i = 0; i < 8; ++i)
    {
      values[i] = this->Block[at[i] + offset];
    }
    return LoadLanes(values);
  }

  static ACTIVE_ALWAYS_INLINE Lanes Mix(const Lanes& a, const Lanes& b, const Lanes& t)
  {
    return a + t * (b - a);
  }

  ACTIVE_ALWAYS_INLINE Lanes Linear(const int* at, const Lanes (&t)[3]) const
  {
    const int x = this->StrideX, y = this->StrideY;
    const Lanes low = Mix(Mix(this->Get(at, 0), this->Get(at, 1), t[2]),
      Mix(this->Get(at, y), this->Get(at, y + 1), t[2]), t[1]);
    const Lanes high = Mix(Mix(this->Get(at, x), this->Get(at, x + 1), t[2]),
      Mix(this->Get(at, x + y), this->Get(at, x + y + 1), t[2]), t[1]);
    return Mix(low, high, t[0]);
  }

  /** Returns t (1 - t) / 2 times the second difference along an axis, interpolated between the ends
   * of the edge nearest to the foot; t is the position of the foot along this edge. */
  ACTIVE_ALWAYS_INLINE Lanes Curve(const int* at, int stride, const Lanes& t) const
  {
    const Lanes before = this->Get(at, -stride), a = this->Get(at, 0);
    const Lanes b = this->Get(at, stride), after = this->Get(at, 2 * stride);
    const Lanes first = before - a - a + b, second = a - b - b + after;
    return AllLanes(.5f) * t * (AllLanes(1.f) - t) * Mix(first, second, t);
  }
};

/** Finds the box of the old nodes that the interpolation of rows reads. */
void FindBox(const NodeLeaf& leaf, const float (*feet)[3][8], int rows, OldBlock& block)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    float low = HUGE_VALF, high = -HUGE_VALF;
    for (int row = 0; row < rows; ++row)
    {
      low = std::min(low, *std::min_element(feet[row][axis], feet[row][axis] + 8));
      high = std::max(high, *std::max_element(feet[row][axis], feet[row][axis] + 8));
    }
    const int first = static_cast<int>(std::floor(low)) - 1;
    block.Low[axis] = leaf.Origin[axis] + first;
    block.Size[axis] = static_cast<int>(std::floor(high)) + 3 - first;
  }
}

void CarryRows(const OldPotential& old, const NodeLeaf& leaf, const float (*feet)[3][8], int rows,
  OldBlock& block, float* carried)
{
  block.Read(old);
  if (block.IsOfOneValue()) // then all interpolated values are equal
  {
    std::fill_n(carried, 8 * rows, block.Values[0]);
    return;
  }
  const int offset[3] = { leaf.Origin[0] - block.Low[0], leaf.Origin[1] - block.Low[1],
    leaf.Origin[2] - block.Low[2] };
  for (int row = 0; row < rows; ++row)
  {
    RunCompiled(RowKernel{ block.Values.data(), block.StrideX(), block.StrideY(), feet[row], offset,
      carried + 8 * row });
  }
}

void CopyLeaf(const OldPotential& old, const NodeIndex& origin, float* carried)
{
  if (const float* values = old.Find(origin))
  {
    std::transform(values, values + 512, carried,
      [](float value) { return std::min(std::max(value, -NodeLimit), NodeLimit); });
    return;
  }
  std::fill_n(carried, 512, old.SideOf(origin));
}

}

void CarryNodes(const OldPotential& old, const NodeLeaf& leaf, const LeafMotion& motion,
  const float* psi, float* carried)
{
  if (motion.IsStill)
  {
    CopyLeaf(old, leaf.Origin, carried);
    return;
  }
  alignas(32) float feet[64][3][8];
  RunCompiled(FeetKernel{ motion, feet });
  thread_local OldBlock block;
  FindBox(leaf, feet, 64, block);
  if (block.Count() <= UsualNodes)
  {
    CarryRows(old, leaf, feet, 64, block, carried);
    return;
  }
  for (int row = 0; row < 64; ++row)
  {
    FindBox(leaf, feet + row, 1, block);
    if (block.Count() <= MostNodes)
    {
      CarryRows(old, leaf, feet + row, 1, block, carried + 8 * row);
    }
    else
    {
      std::copy_n(psi + 8 * row, 8, carried + 8 * row);
    }
  }
}

void ListOldLeaves(const NodeLeaf& leaf, const LeafMotion& motion, std::vector<NodeIndex>& origins)
{
  origins.push_back(leaf.Origin);
  if (motion.IsStill)
  {
    return;
  }
  alignas(32) float feet[64][3][8];
  RunCompiled(FeetKernel{ motion, feet });
  OldBlock block;
  FindBox(leaf, feet, 64, block);
  if (block.Count() <= UsualNodes)
  {
    block.ListLeaves(origins);
    return;
  }
  for (int row = 0; row < 64; ++row)
  {
    FindBox(leaf, feet + row, 1, block);
    if (block.Count() <= MostNodes)
    {
      block.ListLeaves(origins);
    }
  }
}

}
