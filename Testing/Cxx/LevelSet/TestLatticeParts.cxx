// Connected parts of a shape on a lattice, its hollows, and the cells of its surface, compared with
// a search node by node.

#include "Support/RandomShapes.h"

#include "Base/LatticeShape.h"
#include "Surface/LatticeParts.h"
#include "Surface/LatticeSurface.h"

#include <gtest/gtest.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <set>
#include <vector>

using namespace activesurface;

namespace TestLatticeParts
{

using openvdb::Coord;
using IsInside = std::function<bool(const Coord&)>;

/** Shape on the nodes of a cube around the origin. */
LatticeShape MakeShape(int half, const IsInside& isInside)
{
  LatticeShape shape;
  for (int x = -half; x <= half; ++x)
  {
    for (int y = -half; y <= half; ++y)
    {
      for (int z = -half; z <= half; ++z)
      {
        if (isInside(Coord(x, y, z)))
        {
          shape.Inside.setValueOn(Coord(x, y, z));
        }
      }
    }
  }
  return shape;
}

IsInside MakeBallAt(double x, double radius)
{
  return [x, radius](const Coord& node)
  { return std::hypot(node[0] - x, node[1], node[2]) < radius; };
}

struct Counts
{
  int Parts = 0;
  int Hollows = 0;
};

Counts Count(const LatticeShape& shape)
{
  Counts counts;
  LatticeParts(shape).ForEachPart(
    [&](const TargetPart& part) { ++(part.IsHollow() ? counts.Hollows : counts.Parts); });
  return counts;
}

std::set<Coord> PointsOf(const TargetPart& part, bool samplesAlone)
{
  std::set<Coord> nodes;
  const PointVisitor add = [&nodes](const double x[3])
  {
    const openvdb::Vec3d place(x);
    nodes.insert(Coord::round(place));
    return true;
  };
  samplesAlone ? part.ForEachSample(add) : part.ForEachPoint(add);
  return nodes;
}

/** Nodes of the cube max |coordinate| <= half that are connected with `from`, across faces, on the
 * same side of the surface. */
std::set<Coord> Flood(const LatticeShape& shape, int half, const Coord& from)
{
  const bool side = shape.Inside.isValueOn(from);
  std::set<Coord> known = { from };
  std::vector<Coord> waiting = { from };
  while (!waiting.empty())
  {
    const Coord node = waiting.back();
    waiting.pop_back();
    for (int face = 0; face < 6; ++face)
    {
      Coord next = node;
      next[face / 2] += face % 2 ? 1 : -1;
      const int most = std::max({ std::abs(next[0]), std::abs(next[1]), std::abs(next[2]) });
      if (most <= half && shape.Inside.isValueOn(next) == side && known.insert(next).second)
      {
        waiting.push_back(next);
      }
    }
  }
  return known;
}

TEST(TestLatticeParts, BodiesAndHollowsAreCounted)
{
  const IsInside left = MakeBallAt(-12.3, 9.0), right = MakeBallAt(12.1, 7.0);
  const IsInside core = MakeBallAt(-12.3, 5.0), seed = MakeBallAt(-12.3, 2.0);
  const Counts two = Count(MakeShape(24, [&](const Coord& n) { return left(n) || right(n); }));
  EXPECT_EQ(two.Parts, 2);
  EXPECT_EQ(two.Hollows, 0);
  const Counts nested = Count(
    MakeShape(24, [&](const Coord& n) { return (left(n) && !core(n)) || seed(n) || right(n); }));
  EXPECT_EQ(nested.Parts, 3) << "a ball in a hollow";
  EXPECT_EQ(nested.Hollows, 1);
  const Counts open = Count(MakeShape(
    24, [&](const Coord& n) { return left(n) && !core(n) && !(n[1] == 0 && n[2] == 0); }));
  EXPECT_EQ(open.Hollows, 0) << "a hole leads out";
  const Counts nothing = Count(LatticeShape());
  EXPECT_EQ(nothing.Parts + nothing.Hollows, 0);
}

// The deepest points come first: a skin that meets the part most likely contains these points.
TEST(TestLatticeParts, SamplesBeginDeepInside)
{
  const LatticeShape shape = MakeShape(24, MakeBallAt(0.0, 20.0));
  int parts = 0;
  LatticeParts(shape).ForEachPart(
    [&](const TargetPart& part)
    {
      ++parts;
      double first = -1.0;
      part.ForEachSample(
        [&first](const double x[3])
        {
          first = std::hypot(x[0], x[1], x[2]);
          return false;
        });
      // The outermost corner of a leaf that is entirely inside is within the radius. The leaf's
      // centre is at least 4 nodes nearer to the origin.
      EXPECT_LE(first, 20.0 - 4.0);
      EXPECT_GE(first, 0.0);
    });
  EXPECT_EQ(parts, 1);
}

// Tiles with sides of 8 and of 128 nodes, and a hollow of tiles.
TEST(TestLatticeParts, TilesArePartOfThem)
{
  LatticeShape shape;
  shape.Inside.denseFill(openvdb::CoordBBox(Coord(-200), Coord(200)), true, true);
  shape.Inside.denseFill(openvdb::CoordBBox(Coord(-7), Coord(150)), false, false);
  shape.Inside.denseFill(openvdb::CoordBBox(Coord(20), Coord(135)), true, true);
  openvdb::tools::prune(shape.Inside);
  const Counts counts = Count(shape);
  EXPECT_EQ(counts.Parts, 2);
  EXPECT_EQ(counts.Hollows, 1);
  EXPECT_LT(shape.Inside.leafCount(), 51u * 51u * 51u / 4u) << "most of it are tiles";
}

TEST(TestLatticeParts, NoiseHasThePartsOfAFlood)
{
  constexpr int half = 13; // leaves that are cut, and whole ones
  for (const double share : { 0.25, 0.5, 0.75 })
  {
    RandomShapes random(static_cast<unsigned>(100.0 * share));
    const LatticeShape shape =
      MakeShape(half, [&](const Coord&) { return random.DrawBetween(0.0, 1.0) < share; });
    const std::set<Coord> unbounded = Flood(shape, half + 1, Coord(half + 1));
    std::set<Coord> all;
    std::size_t points = 0;
    LatticeParts(shape).ForEachPart(
      [&](const TargetPart& part)
      {
        const std::set<Coord> nodes = PointsOf(part, false), samples = PointsOf(part, true);
        ASSERT_FALSE(samples.empty());
        EXPECT_EQ(shape.Inside.isValueOn(*nodes.begin()), !part.IsHollow());
        EXPECT_EQ(nodes, Flood(shape, half + 1, *nodes.begin())) << share;
        EXPECT_TRUE(std::includes(nodes.begin(), nodes.end(), samples.begin(), samples.end()));
        all.insert(nodes.begin(), nodes.end());
        points += nodes.size();
      });
    EXPECT_EQ(points, all.size()) << "once each";
    const std::size_t side = 2 * half + 3;
    EXPECT_EQ(all.size() + unbounded.size(), side * side * side) << "everything: " << share;
  }
}

// The lattice is turned by a right angle, scaled and moved.
TEST(TestLatticeParts, SurfaceIsInTheCellsOfBothSides)
{
  constexpr int half = 10;
  RandomShapes random(7);
  LatticeShape shape =
    MakeShape(half, [&](const Coord&) { return random.DrawBetween(0.0, 1.0) < 0.02; });
  shape.Origin = openvdb::Vec3d(1.0, 2.0, 3.0);
  shape.Axis[0] = openvdb::Vec3d(0.0, 0.5, 0.0);
  shape.Axis[1] = openvdb::Vec3d(-0.25, 0.0, 0.0);
  shape.Axis[2] = openvdb::Vec3d(0.0, 0.0, 2.0);
  std::set<std::array<int, 3>> expected, found; // eight times the points
  for (int x = -half - 1; x <= half; ++x)
  {
    for (int y = -half - 1; y <= half; ++y)
    {
      for (int z = -half - 1; z <= half; ++z)
      {
        int inside = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
          inside += shape.Inside.isValueOn(
            Coord(x + (corner >> 2), y + (corner >> 1 & 1), z + (corner & 1)));
        }
        if (inside > 0 && inside < 8)
        {
          expected.insert({ 8 - 2 * y - 1, 16 + 4 * x + 2, 24 + 16 * z + 8 });
        }
      }
    }
  }
  const SurfacePoints surface = FindSurfacePoints(shape);
  ASSERT_TRUE(surface.ForEach);
  std::size_t visits = 0;
  surface.ForEach(
    [&](const double x[3])
    {
      ++visits;
      found.insert({ int(std::lround(8.0 * x[0])), int(std::lround(8.0 * x[1])),
        int(std::lround(8.0 * x[2])) });
    });
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(visits, found.size());
  EXPECT_EQ(surface.Reach, 1.0) << "half of the longest side of a cell";
}

// The search would miss a surface between two tiles, so the points are then unknown.
TEST(TestLatticeParts, SurfaceOfBareTilesIsNotKnown)
{
  LatticeShape shape;
  shape.Inside.addTile(1, Coord(0), true, true);
  EXPECT_FALSE(FindSurfacePoints(shape).ForEach);
}

}
