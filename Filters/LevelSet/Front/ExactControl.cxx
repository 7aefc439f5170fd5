#include "Front/ExactControl.h"

#include "Front/RowKernels.h"
#include "Front/SkinMeasure.h"
#include "Front/StepForward.h"
#include "Front/SubstepBuffers.h"
#include "Front/WalledTarget.h"
#include "Leaves/LeafKernels.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

constexpr double Precision = 1e-9; // relative

// Lengths in voxels.
constexpr double Farthest = 2.0 / (3.0 * 1.7320508075688772); // per displacement, as for a substep
constexpr double FarthestInAll = 1.5;
constexpr double Noticeable = 1e-5; // the gain of a smaller displacement is mostly rounding

/**
 * |grad u| of a row by central differences, like those of tension, limited to 0.9 to 1.1 times the
 * upwind differences. Without limits, central differences amplify noise, and a steep fold next to a
 * crease grows without bound.
 */
ACTIVE_ALWAYS_INLINE void DisplacedSlopes(const float* u, float direction, float* slopes)
{
  constexpr RowMask unrelaxed{};
  constexpr float least = 0.9f, most = 1.1f;
  float directions[8], upwind[8] = {}, squares[8];
  std::fill_n(directions, 8, direction);
  AddTransport(u, directions, -direction, unrelaxed, upwind);
  CentralGradientSquares(u, squares);
  for (int z = 0; z < 8; ++z)
  {
    slopes[z] = std::min(std::max(std::sqrt(squares[z]), least * upwind[z]), most * upwind[z]);
  }
}

/** u -= distance * |grad u| at the active nodes. */
struct DisplaceLeaf
{
  const LeafTable& Table;
  SubstepBuffers& Buffers;
  const float Distance;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const BandLeaf& leaf = this->Table[i];
    LeafBlock block;
    block.Gather(this->Table, leaf);
    for (int row = 0; row < 64; ++row)
    {
      const float* u = block.Row(row / 8, row % 8);
      const unsigned active = leaf.Active.Row(row / 8, row % 8);
      float slopes[8];
      DisplacedSlopes(u, this->Distance > 0.f ? 1.f : -1.f, slopes);
      float* result = this->Buffers.NextOf(i) + 8 * row;
      for (int z = 0; z < 8; ++z)
      {
        result[z] = (active >> z) & 1u ? u[z] - this->Distance * slopes[z] : u[z];
      }
    }
  }
};

void Displace(const ControlledBand& band, double distance)
{
  LeafTable& table = band.Leaves;
  band.Set.ChooseAll(table);
  band.Buffers.MakeRoomForNodes(table.Size());
  ForEachLeaf(table, DisplaceLeaf{ table, band.Buffers, static_cast<float>(distance) });
  ClampToBounds({ band.Box, band.Solid, band.VoxelSize }, table, band.Set, band.Buffers);
  CommitStep(table, band.Set, band.Buffers);
  band.Rebuild(band.Set);
}

/** Restores the area or the volume of the skin by the secant method. wanted, skin: wanted and
 * present values [voxels^2 or voxels^3]. gain: initial estimate of the change of the value per
 * voxel of displacement. */
void Restore(const ControlledBand& band, double SkinMeasure::*number, double wanted,
  SkinMeasure skin, double gain)
{
  constexpr int mostSteps = 8;
  constexpr double least = 1e-3; // with a smaller gain, the measure cannot be restored
  double left = FarthestInAll * band.Rounds;
  for (int step = 0; step < mostSteps * band.Rounds && skin.Area > 0.0 && left > 0.0; ++step)
  {
    const double missing = wanted - skin.*number;
    if (std::fabs(missing) <= Precision * wanted || std::fabs(gain) < least)
    {
      break;
    }
    const double most = std::min(Farthest, left);
    const double distance = std::min(std::max(missing / gain, -most), most);
    Displace(band, distance);
    left -= std::fabs(distance);
    const double before = skin.*number;
    skin = MeasureSkin(band.Leaves);
    const double gained = skin.*number - before;
    gain = std::fabs(distance) > Noticeable && gained != 0.0 ? gained / distance : gain;
  }
}

}

void RestoreVolume(const ControlledBand& band, double volume)
{
  const SkinMeasure skin = MeasureSkin(band.Leaves);
  Restore(band, &SkinMeasure::Volume, volume, skin, skin.Area);
}

void RestoreArea(const ControlledBand& band, double area)
{
  const SkinMeasure skin = MeasureSkin(band.Leaves);
  const double ofASphere = AreaGainOfSphere(skin.Area);
  Restore(band, &SkinMeasure::Area, area, skin, ofASphere);
}

}
