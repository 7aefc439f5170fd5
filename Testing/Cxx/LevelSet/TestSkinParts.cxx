// Parts of the skin: number, size and genus.

#include "Support/SurfaceMeasures.h"

#include "Surface/SkinParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestSkinParts
{
constexpr double Pi = 3.14159265358979323846;

struct Expected
{
  double Area;
  double Volume;
  int EulerCharacteristic;
};

Expected ExpectBall(double radius)
{
  return { 4.0 * Pi * radius * radius, 4.0 / 3.0 * Pi * radius * radius * radius, 2 };
}

// Polygons with corners on a surface of curvature 1/r miss about h^2 / (3 r^2) of its area and
// twice that of its volume. The tolerance is three times that.
void CheckParts(const std::string& name, const Shape& shape, const std::vector<Expected>& expected,
  double smallest)
{
  const double h = VoxelSizeOf(64);
  NarrowBand band(h);
  StartOn(band, shape);
  const std::vector<SkinPart> parts = FindSkinParts(band);
  EXPECT_EQ(parts.size(), expected.size()) << "parts of " << name;
  const double missing = h * h / (smallest * smallest);
  std::size_t found = 0;
  double area = 0.0, volume = 0.0;
  for (const SkinPart& part : parts)
  {
    area += part.Area;
    volume += part.Volume;
    for (const Expected& one : expected)
    {
      found += std::fabs(part.Area / one.Area - 1.0) < missing &&
        std::fabs(part.Volume / one.Volume - 1.0) < 2.0 * missing &&
        part.EulerCharacteristic == one.EulerCharacteristic;
    }
  }
  EXPECT_EQ(found, expected.size()) << "parts as expected of " << name;
  // Parts are computed from triangles, whose vertices are at least 2^-13 voxel off the nodes. About
  // one in 4096 vertices is moved for this, by less than 2^-13 voxel.
  const double moved = h / smallest / (1 << 13) / (1 << 12);
  EXPECT_NEAR(area / band.GetArea(), 1.0, 100.0 * moved) << "sum of the areas of " << name;
  EXPECT_NEAR(volume / band.GetVolume(), 1.0, 100.0 * moved) << "sum of the volumes of " << name;
}

TEST(TestSkinParts, PartsHaveTheirAreasVolumesAndGenus)
{
  CheckParts("a ball", MakeBall(CentreA, 0.6), { ExpectBall(0.6) }, 0.6);
  const Expected outer = ExpectBall(0.8), inner = ExpectBall(0.6);
  CheckParts("a ball in a shell", MakeBallInShell(0.8, 0.6, 0.3),
    { outer, { inner.Area, -inner.Volume, 2 }, ExpectBall(0.3) }, 0.3);
  const double ring = 0.55, tube = 0.2;
  CheckParts("a torus", MakeTorus(CentreA, ring, tube),
    { { 4.0 * Pi * Pi * ring * tube, 2.0 * Pi * Pi * ring * tube * tube, 0 } }, tube);
  CheckParts("two balls",
    MakeBalls({ { { -0.43, 0.01, 0.02 }, 0.3 }, { { 0.45, 0.03, -0.01 }, 0.33 } }),
    { ExpectBall(0.3), ExpectBall(0.33) }, 0.3);
}

TEST(TestSkinParts, NothingHasNoParts)
{
  const NarrowBand band(0.1);
  EXPECT_EQ(FindSkinParts(band).size(), 0u) << "parts";
  EXPECT_EQ(band.GetVolume(), 0.0) << "volume";
}
}
