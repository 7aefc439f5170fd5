// Copied, restarted and confined bands are as complete as a new band; damaged states are refused.

#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include "Base/Walls.h"
#include "NarrowBandGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

using namespace activesurface;

namespace TestBandStates
{

namespace
{

constexpr Point Origin = { 0.0, 0.0, 0.0 };

}

TEST(TestBandStates, ACopyHasTheSameMaximum)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(Origin, 0.3));
  band.SetMaximumNumberOfActiveVoxels(2 * band.GetNumberOfActiveNodes());
  const std::unique_ptr<NarrowBand> copy = band.Clone();
  ShapeTarget target(MakeBall(Origin, 0.7));
  EXPECT_TRUE(Throws<std::runtime_error>(
    [&] { copy->Advance(8.0, Motion(), target); }, "MaximumNumberOfActiveVoxels"))
    << "a ball of twice the radius has four times the nodes";
}

TEST(TestBandStates, AStartForgetsTheWorkBefore)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(Origin, 0.3));
  ShapeTarget target(MakeBall(Origin, 0.4));
  band.Advance(1.0, Motion(), target);
  EXPECT_GT(band.GetWork().Substeps, 0u) << "substeps before";
  StartOn(band, MakeBall(Origin, 0.3));
  EXPECT_EQ(band.GetWork().Substeps, 0u) << "substeps";
  EXPECT_EQ(band.GetWork().TargetEvaluations, 0u) << "evaluations";
}

// The ball ends one voxel beyond the wall.
TEST(TestBandStates, AConfinedBandIsWholeAtOnce)
{
  const double h = VoxelSizeOf(32);
  const double wall = -0.1;
  const Shape ball = MakeBall(Origin, 0.6);
  NarrowBand band(h);
  StartOn(band, { [&](const Point& x) { return std::max(ball.Value(x), x[0] - wall - h); }, {} });
  band.Confine({ true, { -0.9, wall, -0.9, 0.9, -0.9, 0.9 } });
  const std::unique_ptr<NarrowBand> again = NarrowBand::Unpack(band.Pack());
  EXPECT_TRUE(AreIdentical(band, *again)) << "the same to the bit";
  const Mesh mesh = Polygonise(band);
  EXPECT_EQ(FindDefects(mesh).Edges, 0u) << "edges that are not in two triangles";
  EXPECT_TRUE(Polygonise(*again).Points == mesh.Points) << "the same skin";
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    ASSERT_LT(mesh.Points[i], wall + 1e-6) << "beyond the wall, but for single precision";
  }
}

// A few damaged bytes could make the band grow to gigabytes.
TEST(TestBandStates, AnInsideThatHasNoSurfaceIsRefused)
{
  NarrowBand band(VoxelSizeOf(16));
  StartOn(band, MakeBall(Origin, 0.3));
  for (int axis = 0; axis < 3; ++axis)
  {
    const openvdb::FloatGrid::Ptr grid = ToGrid(band);
    openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    openvdb::Coord low = box.min() & ~7, high = low.offsetBy(4095);
    low[axis] = (box.max()[axis] | 7) + 1;
    grid->tree().fill({ low, high }, -grid->background(), false);
    EXPECT_TRUE(Throws<std::runtime_error>([&] { FromGrid(*grid); }, "state is damaged"))
      << "along the axis " << axis;
  }
  EXPECT_TRUE(AreIdentical(band, *FromGrid(*ToGrid(band)))) << "a sound one";
}

// A few damaged bytes can create a leaf whose neighbours' coordinates overflow.
TEST(TestBandStates, ALeafAtTheEndOfTheLatticeIsRefused)
{
  NarrowBand band(VoxelSizeOf(16));
  StartOn(band, MakeBall(Origin, 0.3));
  for (const int end : { std::numeric_limits<int>::min(), std::numeric_limits<int>::max() })
  {
    const openvdb::FloatGrid::Ptr grid = ToGrid(band);
    grid->tree().touchLeaf({ 0, end, 0 });
    EXPECT_TRUE(Throws<std::runtime_error>([&] { FromGrid(*grid); }, "state is damaged"))
      << "at " << end;
  }
}

// OpenVDB throws errors of its own for bytes that it cannot decompress, and allocates the sizes
// that the bytes declare.
TEST(TestBandStates, DamagedBytesAreReadOrRefused)
{
  NarrowBand band(VoxelSizeOf(16));
  StartOn(band, MakeBall(Origin, 0.3));
  const std::string whole = band.Pack();
  constexpr std::size_t numbers = 6 * sizeof(double); // every bit pattern is a valid number
  int refused = 0;
  const auto unpack = [&refused](const std::string& bytes)
  {
    try
    {
      NarrowBand::Unpack(bytes);
    }
    catch (const std::runtime_error&)
    {
      ++refused;
    }
  };
  for (std::size_t i = numbers; i < whole.size(); i += 3)
  {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x5a);
    unpack(bytes);
  }
  EXPECT_GT(refused, 0) << "of those with another byte";
  refused = 0;
  int tried = 0;
  for (std::size_t size = 0; size < whole.size(); size += 7, ++tried)
  {
    unpack(whole.substr(0, size));
  }
  EXPECT_EQ(refused, tried) << "those that are too short";
}

// OpenVDB reads incompressible bytes unchanged. Their count is the stored length, which may exceed
// the buffer.
TEST(TestBandStates, MoreBytesThanThereIsRoomForAreRefused)
{
  NarrowBand band(VoxelSizeOf(16));
  StartOn(band, MakeBall(Origin, 0.3));
  std::string bytes = band.Pack();
  const std::size_t place = (6 + 2) * sizeof(double); // after two counts
  const std::int64_t length = -static_cast<std::int64_t>(bytes.size());
  std::memcpy(&bytes[place], &length, sizeof length);
  bytes.append(bytes.size(), 'x');
  EXPECT_TRUE(Throws<std::runtime_error>([&] { NarrowBand::Unpack(bytes); }, "damaged"));
  const std::int64_t none = 0;
  std::memcpy(&bytes[place], &none, sizeof none);
  EXPECT_TRUE(Throws<std::runtime_error>([&] { NarrowBand::Unpack(bytes); }, "damaged"));
}

}
