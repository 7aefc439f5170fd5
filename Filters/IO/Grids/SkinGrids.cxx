#include "Grids/SkinGrids.h"

#include "Base/OpenVDB.h"
#include "Grids/ArrayValues.h"

#include "vtkDataArray.h"

#include <openvdb/math/Proximity.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace activesurface
{

namespace
{

using openvdb::Vec3d;

// Returns the barycentric weights of the triangle's point nearest to a node.
Vec3d FindWeights(const LatticeMesh& mesh, std::int32_t triangle, const openvdb::Coord& node)
{
  const auto& t = mesh.Triangles[triangle];
  Vec3d weights;
  openvdb::math::closestPointOnTriangleToPoint(
    mesh.Points[t[0]], mesh.Points[t[1]], mesh.Points[t[2]], node.asVec3d(), weights);
  return weights;
}

template <class Value>
Value Blend(const Value corner[3], const Vec3d& weights, std::true_type)
{
  return static_cast<Value>(
    corner[0] * weights[0] + corner[1] * weights[1] + corner[2] * weights[2]);
}

template <class Value>
Value Blend(const Value corner[3], Vec3d weights, std::false_type)
{
  const double* const first = weights.asPointer();
  return corner[std::max_element(first, first + 3) - first];
}

/** Visits leaves in parallel, without OpenVDB's LeafManager, which costs a second of compilation
 * per type. */
template <class Tree, class Function>
void ForEachLeaf(Tree& tree, Function function)
{
  std::vector<typename Tree::LeafNodeType*> leaves;
  tree.getNodes(leaves);
  const std::function<void(std::size_t)> ofNumber = [&](std::size_t i) { function(*leaves[i]); };
  tbb::parallel_for(std::size_t(0), leaves.size(), ofNumber);
}

template <class Value>
openvdb::GridBase::Ptr Spread(vtkDataArray* array, const LatticeMesh& mesh, const MeshBand& band)
{
  using Element = typename openvdb::VecTraits<Value>::ElementType;
  using Tree = typename openvdb::FloatTree::ValueConverter<Value>::Type;
  auto tree = std::make_shared<Tree>(
    band.Triangles->tree(), openvdb::zeroVal<Value>(), openvdb::TopologyCopy());
  ForEachLeaf(*tree,
    [&](typename Tree::LeafNodeType& leaf)
    {
      const auto* nearest = band.Triangles->tree().probeConstLeaf(leaf.origin());
      for (auto value = leaf.beginValueOn(); value; ++value)
      {
        const std::int32_t triangle = nearest->getValue(value.pos());
        const Vec3d weights = FindWeights(mesh, triangle, value.getCoord());
        Value corner[3];
        for (int i = 0; i < 3; ++i)
        {
          corner[i] = GetValue<Value>(array, mesh.Triangles[triangle][i]);
        }
        value.setValue(Blend(corner, weights, std::is_floating_point<Element>()));
      }
    });
  return openvdb::Grid<Tree>::create(tree);
}

}

void CheckGridVoxel(double voxelSize)
{
  constexpr double smallest = 2e-5; // OpenVDB treats determinants below 3e-15 as 0
  constexpr double largest = 1e37;  // distances have single precision
  if (!(voxelSize >= smallest && voxelSize <= largest))
  {
    std::ostringstream text;
    constexpr int digits = 8;
    text
      << std::setprecision(digits) << "The voxel size is " << voxelSize
      << ", but has to be between " << smallest << " and " << largest
      << " in .vdb files; scale the scene, or change VoxelSize: of the writer for a mesh, of the "
      << "filter for its skin.";
    throw std::invalid_argument(text.str());
  }
}

openvdb::FloatGrid::Ptr MakeSurfaceGrid(const MeshBand& band, double voxelSize)
{
  auto tree = std::make_shared<openvdb::FloatTree>(band.Distances->tree());
  const auto scale = static_cast<float>(voxelSize);
  const auto background = static_cast<float>(HalfWidth * voxelSize);
  const float largest = std::nextafter(background, 0.f);
  ForEachLeaf(*tree,
    [=](openvdb::FloatTree::LeafNodeType& leaf)
    {
      for (auto value = leaf.beginValueOn(); value; ++value)
      {
        value.setValue(std::min(std::max(*value * scale, -largest), largest));
      }
    });
  openvdb::tools::changeLevelSetBackground(*tree, background);
  auto grid = openvdb::FloatGrid::create(tree);
  grid->setName("surface");
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxelSize));
  return grid;
}

openvdb::FloatGrid::Ptr MakeDensityGrid(const openvdb::FloatGrid& surface)
{
  openvdb::FloatGrid::Ptr grid = surface.deepCopy();
  openvdb::tools::sdfToFogVolume(*grid);
  grid->setName("density");
  return grid;
}

openvdb::GridBase::Ptr MakeArrayGrid(
  vtkDataArray* array, const LatticeMesh& mesh, const MeshBand& band)
{
  openvdb::GridBase::Ptr grid;
  DispatchValues(array, [&](auto zero) { grid = Spread<decltype(zero)>(array, mesh, band); });
  grid->setName(array->GetName() ? array->GetName() : "");
  return grid;
}

}
