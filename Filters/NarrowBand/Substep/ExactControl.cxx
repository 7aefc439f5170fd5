#include "Substep/ExactControl.h"

#include "Substep/RowKernels.h"
#include "Substep/SkinMeasure.h"
#include "Substep/StepForward.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/WalledTarget.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

constexpr double Precision = 1e-9; // relative

double Clamp(double value, double most)
{
  return std::min(std::max(value, -most), most);
}

/** u -= distance * |grad u| at the active nodes. */
void Displace(const ControlledBand& band, double distance)
{
  LeafTable& table = band.Leaves;
  band.Set.ChooseAll(table);
  band.Buffers.MakeRoomForNodes(table.Size());
  const float shift = static_cast<float>(distance);
  table.ForEach(
    [&](std::size_t i)
    {
      LeafBlock block;
      block.Gather(table, table[i]);
      for (int row = 0; row < 64; ++row)
      {
        const float* u = block.Row(row / 8, row % 8);
        const unsigned active = table[i].Active.Row(row / 8, row % 8);
        float* next = band.Buffers.NextOf(i) + 8 * row;
        float squares[8];
        CentralGradientSquares(u, squares);
        for (int z = 0; z < 8; ++z)
        {
          next[z] = (active >> z) & 1u ? u[z] - shift * std::sqrt(squares[z]) : u[z];
        }
      }
    });
  if (band.Box.Present)
  {
    ClampToWalls(table, band.Set, band.Box, band.VoxelSize, band.Buffers);
  }
  CommitStep(table, band.Set, band.Buffers);
  band.Rebuild(band.Set);
}

}

void RestoreVolume(const ControlledBand& band, double volume)
{
  constexpr int mostSteps = 3;
  constexpr double farthest = 0.5; // what upwinding allows the surface to go at a time
  for (int step = 0; step < mostSteps; ++step)
  {
    const SkinMeasure skin = MeasureSkin(band.Leaves);
    if (!(skin.Area > 0.0) || std::fabs(skin.Volume - volume) <= Precision * volume)
    {
      break;
    }
    const double distance = Clamp((volume - skin.Volume) / skin.Area, farthest);
    Displace(band, distance);
  }
}

void RestoreArea(const ControlledBand& band, double area)
{
  constexpr int mostSteps = 6;
  constexpr double farthest = 0.25;
  constexpr double least = 1e-3; // gain of area per displacement below which there is no way
  SkinMeasure skin = MeasureSkin(band.Leaves);
  double gain = AreaGainOfSphere(skin.Area);
  for (int step = 0; step < mostSteps && skin.Area > 0.0; ++step)
  {
    if (std::fabs(skin.Area - area) <= Precision * area || std::fabs(gain) < least)
    {
      break;
    }
    const double distance = Clamp((area - skin.Area) / gain, farthest);
    Displace(band, distance);
    const SkinMeasure after = MeasureSkin(band.Leaves);
    gain = distance != 0.0 && after.Area != skin.Area ? (after.Area - skin.Area) / distance : gain;
    skin = after;
  }
}

}
