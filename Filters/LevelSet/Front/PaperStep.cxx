#include "Front/PaperStep.h"

#include "Base/Tension.h"
#include "Front/RowKernels.h"
#include "Front/SubstepBuffers.h"
#include "Leaves/Layers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace activesurface
{

namespace
{

float Clamp(float value, float most)
{
  return std::min(std::max(value, -most), most);
}

/** Completes the speed of one leaf; tension and uniform in the unit of the speeds. */
PaperLimits FindLeafSpeed(const LeafTable& table, std::size_t i, bool attracted, float uniform,
  float tension, SubstepBuffers& buffers)
{
  constexpr float sharpest = 4.f; // per voxel
  LeafBlock block;
  block.Gather(table, table[i]);
  PaperLimits limits;
  for (int row = 0; row < 64; ++row)
  {
    const float* u = block.Row(row / 8, row % 8);
    float* speed = buffers.SpeedOf(i) + 8 * row;
    float squares[8], rates[8] = {}; // curvature * gradient norm
    CentralGradientSquares(u, squares);
    AddTension<LeafBlock::X, LeafBlock::Y>(u, 1.f, rates);
    for (int z = 0; z < 8; ++z)
    {
      if (!((table[i].Active.Row(row / 8, row % 8) >> z) & 1u))
      {
        continue;
      }
      const float norm = std::sqrt(squares[z]);
      const float curvature = norm > 1e-6f ? Clamp(rates[z] / norm, sharpest) : 0.f;
      speed[z] = (attracted ? speed[z] : 0.f) + uniform - tension * curvature;
      limits.Speed = std::max(limits.Speed, double(std::fabs(speed[z])));
      limits.GradientNorm = std::max(limits.GradientNorm, double(norm));
    }
  }
  return limits;
}

}

PaperLimits FindPaperSpeed(
  const LeafTable& table, bool attracted, double uniform, double tension, SubstepBuffers& buffers)
{
  buffers.MakeRoomForNodes(table.Size()); // already allocated if there are speeds
  std::vector<PaperLimits> parts(table.Size());
  table.ForEach(
    [&](std::size_t i)
    {
      parts[i] = FindLeafSpeed(
        table, i, attracted, static_cast<float>(uniform), static_cast<float>(tension), buffers);
    });
  PaperLimits limits;
  for (const PaperLimits& part : parts)
  {
    limits.Speed = std::max(limits.Speed, part.Speed);
    limits.GradientNorm = std::max(limits.GradientNorm, part.GradientNorm);
  }
  return limits;
}

double PaperTimeStep(const PaperLimits& limits, double tension, double voxelSize, double boxSize)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const double advection = limits.Speed > 0.0 ? voxelSize / limits.Speed : none;
  const double square = voxelSize * voxelSize;
  const double steepest = limits.GradientNorm / (PaperThreshold * voxelSize / boxSize); // |grad f|
  const double diffusion =
    tension != 0.0 && steepest > 0.0 ? square / (2.0 * std::fabs(tension) * steepest) : none;
  return std::min(advection, diffusion);
}

void StepPaper(const LeafTable& table, double advection, SubstepBuffers& buffers)
{
  const float factor = static_cast<float>(advection);
  table.ForEach(
    [&](std::size_t i)
    {
      LeafBlock block;
      block.Gather(table, table[i]);
      for (int row = 0; row < 64; ++row)
      {
        const float* u = block.Row(row / 8, row % 8);
        float next[8];
        std::copy_n(u, 8, next);
        AddCentralTransport(u, buffers.SpeedOf(i) + 8 * row, factor, next);
        for (int z = 0; z < 8; ++z)
        {
          const bool active = (table[i].Active.Row(row / 8, row % 8) >> z) & 1u;
          buffers.NextOf(i)[8 * row + z] = active ? Clamp(next[z], PaperThreshold) : u[z];
        }
      }
    });
}

void RebuildPaperBand(LeafTable& table, ActiveSet& set, PotentialTree& tree)
{
  FindLayers(table, set, tree);
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      for (int node = 0; node < 512; ++node)
      {
        float& value = leaf.Value[node];
        value = Clamp(value, PaperThreshold);
        if (leaf.UpToLayer[LastBandLayer].Has(node))
        {
          leaf.Active.Add(node);
        }
        else if (!leaf.Active.Has(node) || std::fabs(value) >= PaperThreshold)
        {
          leaf.Active.Remove(node);
          value = leaf.Inside.Has(node) ? -PaperThreshold : PaperThreshold;
        }
      }
      table.Summarise(i);
    });
}

void BeginScheme(LeafTable& table, bool isPaper)
{
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    BandLeaf& leaf = table[i];
    leaf.Updated = leaf.Active;
    leaf.Active = isPaper ? leaf.UpToLayer[LastLayer] : leaf.Active;
    leaf.HoldsStaleValue = LeafMask::All();
  }
}

}
