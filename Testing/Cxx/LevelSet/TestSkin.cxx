// Triangles of the skin are closed, manifold, outward and on the lattice's edges for any shape.

#include "NarrowBandGrid.h"
#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestSkin
{
constexpr Point Origin = { 0.0, 0.0, 0.0 };

// A float near 1 is rounded by 6e-8: 1.5e-6 of a voxel at n = 48. The tolerance is twice that.
constexpr double CoordinateTolerance = 3e-6;

double Dot(const Point& a, const Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double Length(const Point& a)
{
  return std::sqrt(Dot(a, a));
}

bool HasInside(const openvdb::FloatGrid::ConstAccessor& potential, const openvdb::Coord& node)
{
  return potential.getValue(node) < 0.f;
}

std::size_t CountCrossedEdges(const NarrowBand& band)
{
  const openvdb::FloatGrid::ConstPtr grid = GetPotential(band);
  const openvdb::FloatGrid::ConstAccessor potential = grid->getConstAccessor();
  std::size_t count = 0;
  for (auto node = grid->cbeginValueOn(); node; ++node)
  {
    const openvdb::Coord lower = node.getCoord();
    for (int axis = 0; axis < 3; ++axis)
    {
      openvdb::Coord upper = lower;
      upper[axis] += 1;
      count += HasInside(potential, lower) != HasInside(potential, upper);
    }
  }
  return count;
}

// Point near a lattice edge: the edge's lower node and axis, and the point's height above this node
// [voxels].
struct EdgePoint
{
  openvdb::Coord Lower;
  int Axis = 0;
  double Fraction = 0.0;
  double OffEdge = 0.0; //< distance from the lattice edge [voxels]
};

EdgePoint FindEdge(const Point& point, double voxelSize)
{
  Point toNode;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double coordinate = point[axis] / voxelSize;
    toNode[axis] = std::abs(coordinate - std::round(coordinate));
  }
  EdgePoint edge;
  edge.Axis = static_cast<int>(std::max_element(toNode.begin(), toNode.end()) - toNode.begin());
  for (int axis = 0; axis < 3; ++axis)
  {
    const double coordinate = point[axis] / voxelSize;
    const bool along = axis == edge.Axis;
    edge.Lower[axis] = static_cast<int>(along ? std::floor(coordinate) : std::round(coordinate));
    edge.OffEdge = along ? edge.OffEdge : std::max(edge.OffEdge, toNode[axis]);
  }
  edge.Fraction = point[edge.Axis] / voxelSize - edge.Lower[edge.Axis];
  return edge;
}

// Linearly interpolated potential [voxels] at a point of a lattice edge.
double Interpolate(const openvdb::FloatGrid::ConstAccessor& potential, const EdgePoint& edge)
{
  openvdb::Coord upper = edge.Lower;
  upper[edge.Axis] += 1;
  const double lowerValue = potential.getValue(edge.Lower);
  return lowerValue + edge.Fraction * (potential.getValue(upper) - lowerValue);
}

void CheckVertices(const NarrowBand& band, const Mesh& mesh, const std::string& name)
{
  const openvdb::FloatGrid::ConstPtr grid = GetPotential(band);
  const openvdb::FloatGrid::ConstAccessor potential = grid->getConstAccessor();
  double offEdge = 0.0;
  double offZero = 0.0;
  double offUnit = 0.0;
  for (std::size_t vertex = 0; vertex < mesh.GetNumberOfPoints(); ++vertex)
  {
    const EdgePoint edge = FindEdge(mesh.GetPoint(vertex), band.GetVoxelSize());
    offEdge = std::max(offEdge, edge.OffEdge);
    offZero = std::max(offZero, std::abs(Interpolate(potential, edge)));
    offUnit = std::max(offUnit, std::abs(Length(mesh.GetNormal(vertex)) - 1.0));
  }
  EXPECT_LT(offEdge, CoordinateTolerance) << "vertices off their lattice edges [h], " << name;
  // The slope along the edge is up to 2, and vertices are 2^-13 voxel off the nodes.
  EXPECT_LT(offZero, 2.0 * (CoordinateTolerance + 1.0 / (1 << 13)))
    << "potential at the vertices [h], " << name;
  EXPECT_LT(offUnit, 1e-6) << "length of the normals less 1, " << name;
  EXPECT_EQ(mesh.GetNumberOfPoints(), CountCrossedEdges(band))
    << "one vertex per crossed lattice edge, " << name;
}

void CheckManifold(const Mesh& mesh, const std::string& name)
{
  const MeshDefects defects = FindDefects(mesh);
  EXPECT_EQ(defects.Edges, 0u) << "edges not run through once each way, " << name;
  EXPECT_EQ(defects.Vertices, 0u) << "vertices without one closed fan, " << name;
  EXPECT_EQ(defects.Unused, 0u) << "vertices of no triangle, " << name;
  EXPECT_GT(GetVolume(mesh), 0.0) << "volume, " << name;
}

void CheckWithinBox(const Mesh& mesh, double voxelSize, const std::string& name)
{
  double farthest = 0.0;
  for (const float coordinate : mesh.Points)
  {
    farthest = std::max(farthest, std::abs(double(coordinate)));
  }
  EXPECT_LT((farthest - 1.0) / voxelSize, 1.0) << "distance beyond the box's faces [h], " << name;
}

Mesh CheckSkin(const Shape& shape, int n, const std::string& name)
{
  NarrowBand band(VoxelSizeOf(n));
  StartOn(band, shape);
  const Mesh mesh = Polygonise(band);
  EXPECT_TRUE(mesh.GetNumberOfTriangles() > 0) << "there are triangles, " << name;
  CheckManifold(mesh, name);
  CheckVertices(band, mesh, name);
  CheckWithinBox(mesh, VoxelSizeOf(n), name);
  return mesh;
}

double GetLeastAltitude(const Mesh& mesh, std::size_t triangle)
{
  double longest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const Point first = mesh.GetPoint(mesh.Corners[3 * triangle + i]);
    const Point second = mesh.GetPoint(mesh.Corners[3 * triangle + (i + 1) % 3]);
    const Point side = { second[0] - first[0], second[1] - first[1], second[2] - first[2] };
    longest = std::max(longest, Length(side));
  }
  return longest > 0.0 ? Length(mesh.GetAreaVector(triangle)) / longest : 0.0;
}

// Number of triangle corners whose normal faces away from the triangle. Ignores triangles of at
// most this altitude.
std::size_t CountContradictions(const Mesh& mesh, double leastAltitude)
{
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.GetNumberOfTriangles(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Point normal = mesh.GetNormal(mesh.Corners[3 * t + i]);
      const bool contradicts = Dot(mesh.GetAreaVector(t), normal) <= 0.0;
      count += contradicts && GetLeastAltitude(mesh, t) > leastAltitude;
    }
  }
  return count;
}

// The corners of a triangle are off the tangent plane of a surface of curvature radius r by up to
// d^2 / 2 r, d < 1.8 h. The tilt of the triangle is this offset over its least altitude.
void CheckOrientation(const Mesh& mesh, double curvatureRadius, double h, const std::string& name)
{
  const double sagitta = 1.8 * 1.8 * h * h / (2.0 * curvatureRadius);
  EXPECT_EQ(CountContradictions(mesh, 2.0 * sagitta), 0u)
    << "corners whose normal contradicts the triangle, " << name;
}

TEST(TestSkin, BallsHaveAClosedOutwardSkin)
{
  for (const double radius : { 0.1, 0.3, 0.77 })
  {
    const std::string name = "radius " + std::to_string(radius).substr(0, 4);
    const Mesh mesh = CheckSkin(MakeBall(CentreA, radius), 48, name);
    CheckOrientation(mesh, radius, VoxelSizeOf(48), name);
    EXPECT_EQ(GetTopology(mesh).EulerCharacteristic, 2) << "Euler characteristic, " << name;
  }
}

TEST(TestSkin, ToriHaveAClosedOutwardSkin)
{
  for (const double tube : { 0.1, 0.22, 0.3 })
  {
    const std::string name = "tube " + std::to_string(tube).substr(0, 4);
    const Mesh mesh = CheckSkin(MakeTorus({ 0.01, 0.02, 0.013 }, 0.55, tube), 48, name);
    CheckOrientation(mesh, tube, VoxelSizeOf(48), name);
    EXPECT_EQ(GetTopology(mesh).EulerCharacteristic, 0) << "Euler characteristic, " << name;
  }
}

// Gyroid of period 0.8, cut off by a ball.
Shape MakeGyroid(double cutRadius)
{
  return { [cutRadius](const Point& point)
    {
      const double k = 2.0 * 3.14159265358979 / 0.8;
      const double x = k * point[0];
      const double y = k * point[1];
      const double z = k * point[2];
      const double wave =
        std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
      return std::max(wave / (1.5 * k), Length(point) - cutRadius);
    },
    {} };
}

TEST(TestSkin, GyroidHasAClosedSkin)
{
  CheckSkin(MakeGyroid(0.87), 48, "gyroid within a ball");
}

TEST(TestSkin, FacesOfTheBoxCloseTheSkin)
{
  CheckSkin(MakeGyroid(9.0), 48, "gyroid cut by all faces");
  CheckSkin(MakeBall({ 0.7, 0.0, 0.0 }, 0.6), 32, "ball cut by one face");
  CheckSkin(MakeBall({ 1.0, -1.0, 1.0 }, 0.6), 32, "ball in a corner");
  const Mesh box = CheckSkin(MakeBall(Origin, 9.0), 32, "everything inside");
  // Each face is accurate to a voxel.
  const double h = VoxelSizeOf(32);
  EXPECT_NEAR(std::cbrt(GetVolume(box)), 2.0, 2.0 * h) << "side of the box that is all inside";
}

struct Segment
{
  Point First;
  Point Second;
  double Reach;
};

double GetDistance(const Segment& segment, const Point& point)
{
  Point along;
  Point to;
  for (int axis = 0; axis < 3; ++axis)
  {
    along[axis] = segment.Second[axis] - segment.First[axis];
    to[axis] = point[axis] - segment.First[axis];
  }
  const double square = std::max(Dot(along, along), 1e-30);
  const double fraction = std::clamp(Dot(to, along) / square, 0.0, 1.0);
  return std::sqrt(
    std::max(0.0, Dot(to, to) - 2.0 * fraction * Dot(to, along) + fraction * fraction * square));
}

// One to eight points and segments with compact kernels.
Shape MakeRandomSkeleton(std::mt19937& random, double extent)
{
  // Avoids standard distributions, whose numbers differ between libraries.
  const auto number = [&random](double low, double high)
  { return low + (high - low) * (random() / 4294967296.0); };
  std::vector<Segment> segments(1 + random() % 8);
  for (Segment& segment : segments)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      segment.First[axis] = number(-extent, extent);
      segment.Second[axis] = number(-extent, extent);
    }
    segment.Second = random() % 2 == 0 ? segment.First : segment.Second;
    segment.Reach = number(0.15, 0.5);
  }
  return { [segments](const Point& point)
    {
      double sum = 0.0;
      for (const Segment& segment : segments)
      {
        const double ratio = GetDistance(segment, point) / segment.Reach;
        sum += std::pow(std::max(0.0, 1.0 - ratio * ratio), 3);
      }
      return 0.2 - sum;
    },
    {} };
}

TEST(TestSkin, HundredRandomSkeletonsHaveAClosedSkin)
{
  std::mt19937 random(1998);
  for (int i = 0; i < 100; ++i)
  {
    const double extent = i % 2 == 0 ? 0.6 : 1.1;
    NarrowBand band(VoxelSizeOf(32));
    StartOn(band, MakeRandomSkeleton(random, extent));
    const Mesh mesh = Polygonise(band);
    if (!band.IsEmpty())
    {
      const std::string name = "skeleton " + std::to_string(i);
      CheckManifold(mesh, name);
      CheckVertices(band, mesh, name);
      CheckWithinBox(mesh, VoxelSizeOf(32), name);
    }
    EXPECT_TRUE(!band.IsEmpty() || extent > 1.0) << "only what is cut away may be empty";
  }
}

// Includes surfaces between two shapes, where the potential is no distance.
TEST(TestSkin, SkinIsClosedWhileItMoves)
{
  NarrowBand band(VoxelSizeOf(40));
  StartOn(band, MakeBall(Origin, 0.5));
  ShapeTarget target(
    MakeBalls({ { { -0.43, 0.01, 0.02 }, 0.3 }, { { 0.45, 0.03, -0.01 }, 0.33 } }));
  for (int frame = 1; frame <= 40; ++frame)
  {
    band.Advance(0.15 * frame, Motion(), target);
    const Mesh mesh = Polygonise(band);
    const std::string name = "frame " + std::to_string(frame);
    CheckManifold(mesh, name);
    CheckVertices(band, mesh, name);
  }
}
// Nodes lie on the surface: in all faces of a box, and in tilted faces of an octahedron. Twice the
// area of a triangle is at least the square of the least distance of a vertex from a node. This
// distance is 2^-13 voxel, apart from the rounding of vertices to floats.
TEST(TestSkin, NoTriangleIsWithoutAreaWhereNodesLieOnTheSurface)
{
  constexpr double h = VoxelSizeOf(32);
  const Shape box = { [](const Point& p)
    {
      return std::max({ std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2]) }) - 8 * h;
    },
    {} };
  const Shape octahedron = { [](const Point& p)
    { return (std::fabs(p[0]) + std::fabs(p[1]) + std::fabs(p[2]) - 9 * h) / std::sqrt(3.0); },
    {} };
  for (const Shape& shape : { box, octahedron })
  {
    NarrowBand band(h);
    StartOn(band, shape);
    const Mesh mesh = Polygonise(band);
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < mesh.GetNumberOfTriangles(); ++i)
    {
      least = std::min(least, Length(mesh.GetAreaVector(i)) / (h * h));
    }
    EXPECT_GT(least, 0.5 / (1 << 26)) << "twice the least area [voxels^2]";
  }
}

}
