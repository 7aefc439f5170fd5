#include "StepForward.h"

#include "Layers.h"
#include "RowKernels.h"
#include "SubstepBuffers.h"

namespace activesurface
{

namespace
{

/** Nodes at either end of a crossed edge: they are not relaxed, which would move the surface. */
LeafMask NodesWithCrossing(const LeafTable& table, const BandLeaf& leaf)
{
  LeafMask nodes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int32_t before = leaf.Neighbour[FaceNumber(axis, -1)];
    static const LeafMask nothing;
    const LeafMask& edges = before >= 0 ? table[before].Edge[axis] : nothing;
    nodes = nodes | leaf.Edge[axis] | SeenBehind(leaf.Edge[axis], edges, axis, 1);
  }
  return nodes;
}

ACTIVE_ALWAYS_INLINE void CountSlopes(const float* u, unsigned bits, int& flat, int& steep)
{
  float squares[8];
  CentralSlopes(u, squares);
  for (int z = 0; z < 8; ++z)
  {
    const bool counts = (bits >> z) & 1u;
    flat += counts && squares[z] < .5f;
    steep += counts && squares[z] > 2.f;
  }
}

ACTIVE_FOR_EACH_INSTRUCTION_SET
void StepLeaf(const LeafTable& table, std::size_t i, const StepCoefficients& coefficients,
  SubstepBuffers& buffers)
{
  const BandLeaf& leaf = table[i];
  LeafBlock block;
  block.Gather(table, leaf);
  const LeafMask relaxed = coefficients.Relaxation > 0.f
    ? LeafMask::All().Without(NodesWithCrossing(table, leaf))
    : LeafMask();
  const float* speeds = coefficients.Moves ? buffers.Speed.data() + 512 * i : nullptr;
  int flat = 0, steep = 0;
  for (int row = 0; row < 64; ++row)
  {
    const int x = row / 8, y = row % 8;
    const unsigned active = leaf.Active.Row(x, y);
    float* result = buffers.Next.data() + 512 * i + 8 * row;
    const float* u = block.Row(x, y);
    if (active == 0)
    {
      std::copy_n(u, 8, result);
      continue;
    }
    float next[8];
    std::copy_n(u, 8, next);
    if (coefficients.Moves)
    {
      RowMask relaxation = MaskOfBits(relaxed.Row(x, y));
      for (float& q : relaxation)
      {
        q *= coefficients.Relaxation;
      }
      AddTransport(u, speeds + 8 * row, coefficients.Advection, relaxation, next);
    }
    if (coefficients.Tension != 0.f)
    {
      AddTension(u, coefficients.Tension, next);
    }
    for (int z = 0; z < 8; ++z)
    {
      result[z] = (active >> z) & 1u ? next[z] : u[z];
    }
    if (const unsigned zero = leaf.Upto[0].Row(x, y))
    {
      CountSlopes(u, zero, flat, steep);
    }
  }
  buffers.FlatNodes[i] = flat;
  buffers.SteepNodes[i] = steep;
}

}

SlopeCounts StepForward(
  LeafTable& table, const StepCoefficients& coefficients, SubstepBuffers& buffers)
{
  const std::size_t size = table.Size();
  buffers.Next.resize(512 * size);
  buffers.FlatNodes.resize(size);
  buffers.SteepNodes.resize(size);
  table.ForEach([&](std::size_t i) { StepLeaf(table, i, coefficients, buffers); });
  table.ForEach(
    [&](std::size_t i)
    {
      std::copy_n(buffers.Next.data() + 512 * i, 512, table[i].Value);
      table[i].Advanced = table[i].Active;
      table[i].Inside = InsideNodes(table[i].Value);
    });
  SlopeCounts counts;
  for (std::size_t i = 0; i < size; ++i)
  {
    counts.Nodes += table[i].Upto[0].Count();
    counts.Flat += buffers.FlatNodes[i];
    counts.Steep += buffers.SteepNodes[i];
  }
  return counts;
}

void ScalePotential(LeafTable& table, float factor)
{
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      leaf.Upto[LastLayer].ForEach([&](int node) { leaf.Value[node] *= factor; });
    });
}

}
