#include "MorphScenes.h"

#include "Scenes.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/MeshToVolume.h>

#include <cmath>
#include <functional>
#include <vector>

namespace activesurface
{

namespace
{

constexpr double Margin = 8.0; // the band and its dilation

void SetBounds(MorphScene& scene, double size)
{
  for (int i = 0; i < 6; ++i)
  {
    scene.Bounds[i] = (i % 2 ? 1.0 : -1.0) * (size + Margin);
  }
}

/** Distances on all nodes of a box around the origin. */
template <class Distance>
openvdb::FloatGrid::Ptr SampleBox(const Distance& distance, int size)
{
  auto grid = openvdb::FloatGrid::create(static_cast<float>(size));
  auto values = grid->getAccessor();
  for (const openvdb::Coord& at :
    openvdb::CoordBBox::createCube(openvdb::Coord(-size), 2 * size + 1))
  {
    const openvdb::Vec3d point = at.asVec3d();
    values.setValueOn(at, static_cast<float>(distance(point.asPointer())));
  }
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

double SampleGrid(const openvdb::FloatGrid::ConstAccessor& values, const double* at)
{
  return openvdb::tools::BoxSampler::sample(values, openvdb::Vec3d(at));
}

/** Distances from a grid, trilinear between the nodes. */
class GridTarget : public Target
{
public:
  explicit GridTarget(const openvdb::FloatGrid::Ptr& grid)
    : Grid(grid)
  {
  }

  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override
  {
    const openvdb::FloatGrid::ConstAccessor samples = this->Grid->getConstAccessor();
    for (std::size_t i = 0; i < count; ++i)
    {
      results.Values[i] = SampleGrid(samples, points + 3 * i);
      results.Slopes[i] = 1.0;
    }
  }

private:
  openvdb::FloatGrid::Ptr Grid;
};

InitialFunction MakeGridInitial(const openvdb::FloatGrid::Ptr& grid)
{
  InitialFunction initial;
  initial.Evaluate = [grid](std::size_t count, const double* points, double* values)
  {
    const openvdb::FloatGrid::ConstAccessor samples = grid->getConstAccessor();
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = SampleGrid(samples, points + 3 * i);
    }
  };
  return initial;
}

using Direction = openvdb::Vec3d;
using RadiusOfDirection = std::function<double(const Direction&)>;

struct Mesh
{
  std::vector<openvdb::Vec3s> Points;
  std::vector<openvdb::Vec4I> Quads;
};

/** The six faces of a cube, each with `cells` by `cells` quads, mapped to a star-shaped body. Seams
 * match bitwise, since a point of two faces is computed from the same numbers. */
Mesh BlowUpCube(int cells, const RadiusOfDirection& radius)
{
  Mesh mesh;
  const auto coordinate = [cells](int i) { return 2.0 * i / cells - 1.0; };
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2;
    const double side = face % 2 ? 1.0 : -1.0;
    const auto first = static_cast<openvdb::Index32>(mesh.Points.size());
    for (int j = 0; j <= cells; ++j)
    {
      for (int i = 0; i <= cells; ++i)
      {
        Direction direction;
        direction[axis] = side;
        direction[(axis + 1) % 3] = coordinate(i);
        direction[(axis + 2) % 3] = coordinate(j);
        direction.normalize();
        mesh.Points.emplace_back(direction * radius(direction));
      }
    }
    for (int j = 0; j < cells; ++j)
    {
      for (int i = 0; i < cells; ++i)
      {
        const openvdb::Index32 corner = first + j * (cells + 1) + i;
        const openvdb::Index32 above = corner + cells + 1;
        mesh.Quads.push_back(side > 0.0 ? openvdb::Vec4I(corner, corner + 1, above + 1, above)
                                        : openvdb::Vec4I(corner, above, above + 1, corner + 1));
      }
    }
  }
  return mesh;
}

double Bump(const Direction& at, Direction centre, double width)
{
  centre.normalize();
  return std::exp(-(at - centre).lengthSqr() / (width * width));
}

Mesh MakeHeadWithEars(double radius)
{
  return BlowUpCube(96,
    [radius](const Direction& at)
    {
      return radius *
        (0.6 + 0.4 * Bump(at, { 0.4, 0.1, 1.0 }, 0.25) + 0.4 * Bump(at, { -0.4, 0.1, 1.0 }, 0.25) +
          0.15 * Bump(at, { 0.0, 1.0, -0.2 }, 0.3) + 0.1 * Bump(at, { 0.0, -1.0, -0.5 }, 0.4));
    });
}

Mesh MakeBumpyBody(double radius)
{
  return BlowUpCube(96,
    [radius](const Direction& at)
    {
      return radius *
        (0.7 + 0.12 * std::sin(5.0 * at[0] + 1.0) * std::sin(6.0 * at[1]) * std::sin(5.0 * at[2]) +
          0.25 * Bump(at, { 1.0, 0.2, -0.3 }, 0.35) + 0.2 * Bump(at, { -1.0, -0.3, 0.2 }, 0.3));
    });
}

openvdb::FloatGrid::Ptr MakeDistances(const Mesh& mesh, float halfWidth)
{
  return openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(
    *openvdb::math::Transform::createLinearTransform(1.0), mesh.Points, mesh.Quads, halfWidth);
}

}

MorphScene MakeBallToTorus(double radius)
{
  const TorusDistance torus = { 0.7 * radius, 0.35 * radius };
  MorphScene scene;
  scene.Name = "ball to torus, radius " + std::to_string(std::lround(radius));
  SetBounds(scene, radius);
  scene.Initial = MakeInitial(BallDistance{ radius });
  scene.Source = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
    static_cast<float>(radius), openvdb::Vec3f(0.f), 1.f);
  scene.Goal = std::make_shared<FormulaTarget<TorusDistance>>(torus);
  scene.GoalGrid = SampleBox(torus, static_cast<int>(1.05 * radius + Margin));
  return scene;
}

MorphScene MakeMeshToMesh(double radius)
{
  // The two bodies are less than half a radius apart.
  const auto reach = static_cast<float>(0.5 * radius + Margin);
  const Mesh start = MakeHeadWithEars(radius);
  MorphScene scene;
  scene.Name = "mesh to mesh, radius " + std::to_string(std::lround(radius));
  SetBounds(scene, 1.05 * radius);
  scene.Initial = MakeGridInitial(MakeDistances(start, 3.f));
  scene.Source = MakeDistances(start, 3.f);
  scene.GoalGrid = MakeDistances(MakeBumpyBody(radius), reach);
  scene.Goal = std::make_shared<GridTarget>(scene.GoalGrid);
  return scene;
}

}
