// Rules that detect converged leaves: the surface speed of a leaf, when this speed is recomputed,
// and from which samples.

#include "Support/SurfaceMeasures.h"

#include "Front/ConvergedLeaves.h"
#include "Front/SamplePoints.h"
#include "Front/StepForward.h"
#include "Front/SubstepBuffers.h"
#include "Front/TargetSpeed.h"
#include "Leaves/Layers.h"
#include "NarrowBandGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestRestRules
{
const double VoxelSize = VoxelSizeOf(64);

Motion MakeMotion()
{
  Motion motion = activesurface::MakeMotion(1.0, 0.0);
  motion.Attraction = 5.0;
  motion.Tension = 0.01;
  return motion;
}

/** Leaves of a band without the band. */
struct OpenLeaves
{
  openvdb::FloatTree Tree;
  LeafTable Table;

  explicit OpenLeaves(const NarrowBand& band)
    : Tree(GetPotential(band)->tree())
  {
    this->Table.SetBackground(Far);
    this->Table.Rebuild(this->Tree);
    ActiveSet all;
    all.ChooseAll(this->Table);
    RebuildLayers(this->Table, all, this->Tree);
  }
};

// Target that has changed somewhere between two planes.
class ChangeBetween : public Target
{
public:
  ChangeBetween(double low, double high)
    : Low(low)
    , High(high)
  {
  }

  bool MayHaveChanged(const double bounds[6]) const override
  {
    return bounds[0] <= this->High && bounds[1] >= this->Low;
  }

  void Evaluate(std::size_t, const double*, const TargetResults&) const override {}

private:
  double Low;
  double High;
};

// A change between the last node of one leaf and the first node of the next leaf invalidates the
// speeds of both leaves.
TEST(TestRestRules, ForgetsWhereEdgesReach)
{
  NarrowBand band(VoxelSize);
  StartOn(band, MakeBall({ 0.013, -0.007, 0.021 }, 0.6));
  for (const bool isBefore : { true, false })
  {
    OpenLeaves leaves(band);
    LeafTable& table = leaves.Table;
    const double middle = isBefore ? -0.5 : 0.5; // of the edge, from node 0
    for (std::size_t i = 0; i < table.Size(); ++i)
    {
      const int x = table[i].Origin[0];
      table.SummaryOf(i).Speed.IsKnown = isBefore ? x >= 0 : x < 0;
    }
    ForgetChanged(
      table, VoxelSize, ChangeBetween((middle - 0.3) * VoxelSize, (middle + 0.3) * VoxelSize));
    int kept = 0, keptFar = 0;
    for (std::size_t i = 0; i < table.Size(); ++i)
    {
      const int x = table[i].Origin[0];
      kept += x == (isBefore ? 0 : -8) && table.SummaryOf(i).Speed.IsKnown;
      keptFar += x == (isBefore ? 16 : -24) && table.SummaryOf(i).Speed.IsKnown;
    }
    EXPECT_EQ(kept, 0) << "leaves that remember what has changed";
    EXPECT_GT(keptFar, 0) << "leaves far away that remember";
  }
}

// Samples the leaves below 0 and then the remaining ones, or all at once.
TEST(TestRestRules, MoreSamplesAreAsThoseOfAll)
{
  NarrowBand band(VoxelSize);
  StartOn(band, MakeBall({ 0.013, -0.007, 0.021 }, 0.6));
  const OpenLeaves leaves(band);
  const LeafTable& table = leaves.Table;
  const SampledLattice lattice = { table, leaves.Tree, VoxelSize };
  const ShapeTarget target(MakeBall({ 0.013, -0.007, 0.021 }, 0.61));
  const LeafList all = table.FindAll([](std::size_t) { return true; });
  const LeafList low = table.FindAll([&](std::size_t i) { return table[i].Origin[0] < 0; });
  SubstepBuffers once, twice;
  const TargetSamples whole = SampleLeaves(lattice, all, MakeMotion(), target, once);
  const TargetSamples first = SampleLeaves(lattice, low, MakeMotion(), target, twice);
  const TargetSamples more = SampleMore(lattice, all, MakeMotion(), target, twice);
  EXPECT_GT(first.Count, 0u) << "samples below 0";
  EXPECT_EQ(first.Count + more.Count, whole.Count) << "samples, one after the other";
  int different = 0;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    for (int k = 0; k < table[i].Crossings; ++k)
    {
      different += once.Samples[once.FirstSample[i] + k] != twice.Samples[twice.FirstSample[i] + k];
    }
  }
  EXPECT_EQ(different, 0) << "samples that differ";
}

std::vector<float> FindSurfaceSpeeds(OpenLeaves& leaves)
{
  LeafTable& table = leaves.Table;
  const Motion motion = MakeMotion();
  ShapeTarget target(MakeBall({ 0.013, -0.007, 0.021 }, 0.61));
  SubstepBuffers buffers;
  StepCoefficients coefficients;
  coefficients.HasTargetSpeed = true;
  coefficients.Advection = 1.f;
  coefficients.Tension = static_cast<float>(motion.Tension / VoxelSize);
  ActiveSet all;
  all.ChooseAll(table);
  SampleLeaves({ table, leaves.Tree, VoxelSize }, all.Active, motion, target, buffers);
  ApplySamples(table, all.Active, motion, buffers);
  FindRates(table, all.Active, coefficients, 1e30, buffers);
  std::vector<float> speeds;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    speeds.push_back(table.SummaryOf(i).Speed.AtSurface);
  }
  return speeds;
}

// Twice the potential is the same surface with the same speed: 5 * 0.01 towards the target, less
// 0.01 * 2 / 0.6 by tension. At least 12 leaves have a part of the surface: its area is 4490 h^2,
// and the part of a convex surface within a leaf is no larger than the leaf's own surface, 6 * 64
// h^2.
TEST(TestRestRules, SpeedUnderTensionIsThatOfTheSurface)
{
  NarrowBand band(VoxelSize);
  StartOn(band, MakeBall({ 0.013, -0.007, 0.021 }, 0.6));
  OpenLeaves leaves(band);
  const std::vector<float> once = FindSurfaceSpeeds(leaves);
  ScalePotential(leaves.Table, 2.f);
  const std::vector<float> twice = FindSurfaceSpeeds(leaves);
  EXPECT_TRUE(once == twice) << "the same to the bit";
  int crossed = 0;
  for (std::size_t i = 0; i < leaves.Table.Size(); ++i)
  {
    const bool isCrossed = leaves.Table[i].Crossings > 0;
    if (isCrossed || once[i] != 0.f)
    {
      EXPECT_NEAR(once[i], 0.0167, 0.002) << "speed of leaf " << i;
    }
    crossed += isCrossed;
  }
  EXPECT_GE(crossed, 12) << "leaves with a part of the surface";
}
}
