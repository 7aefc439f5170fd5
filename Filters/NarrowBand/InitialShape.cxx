#include "InitialShape.h"

#include "LeafTable.h"

#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace activesurface
{

namespace
{

using CrossedNodes = openvdb::BoolTree;

/** Lattice nodes first..last of the three axes; the outermost ones lie on or beyond the bounds. */
struct Box
{
  openvdb::Coord First;
  openvdb::Coord Last;

  int Size(int axis) const { return this->Last[axis] - this->First[axis] + 1; }
  bool Closes(const openvdb::Coord& node) const
  {
    bool closes = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      closes = closes || node[axis] <= this->First[axis] || node[axis] >= this->Last[axis];
    }
    return closes;
  }
};

[[noreturn]] void RefuseBounds(const double bounds[6], const char* why)
{
  std::ostringstream text;
  text << "The bounds (" << bounds[0] << ", " << bounds[1] << ", " << bounds[2] << ", " << bounds[3]
       << ", " << bounds[4] << ", " << bounds[5] << ") " << why;
  throw std::invalid_argument(text.str());
}

Box LatticeBox(double voxelSize, const double bounds[6])
{
  constexpr double farthest = 1e9; // node numbers are 32-bit integers
  constexpr double rounding = 1e-6;
  Box box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = bounds[2 * axis] / voxelSize, high = bounds[2 * axis + 1] / voxelSize;
    if (!(high > low) || !std::isfinite(bounds[2 * axis]) || !std::isfinite(bounds[2 * axis + 1]))
    {
      RefuseBounds(bounds, "are empty or not finite; set ModelBounds around the shape.");
    }
    if (!(std::fabs(low) < farthest && std::fabs(high) < farthest))
    {
      RefuseBounds(bounds,
        "hold more than 10^9 voxels along an axis; enlarge VoxelSize or shrink "
        "ModelBounds (without them: is there a particle far from the others?).");
    }
    box.First[axis] = static_cast<int>(std::floor(low + rounding));
    box.Last[axis] = static_cast<int>(std::ceil(high - rounding));
  }
  return box;
}

[[noreturn]] void RefuseSize(std::size_t maximum)
{
  std::ostringstream text;
  text << "The band would hold more than MaximumNumberOfActiveVoxels = " << maximum
       << " active voxels; enlarge VoxelSize, shrink ModelBounds or raise the maximum.";
  throw std::runtime_error(text.str());
}

/** A ball of .6 of the diameter of a box of n^3 voxels needs about 7 n^2 active ones, one that
 * fills it 20 n^2: a box for 7 n^2 too many is refused before sampling. So is one with so many
 * nodes that sampling them would take minutes, as for a stray particle far from the others. */
void CheckSize(const Box& box, std::size_t maximum)
{
  constexpr double nodesPerActiveVoxel = 40.0;
  const double x = box.Size(0), y = box.Size(1), z = box.Size(2);
  const double most = static_cast<double>(maximum);
  if (7.0 / 3.0 * (x * y + y * z + z * x) > most || x * y * z > nodesPerActiveVoxel * most)
  {
    std::ostringstream text;
    text << "The bounds hold " << x << " x " << y << " x " << z << " voxels, too many for "
         << "MaximumNumberOfActiveVoxels = " << maximum
         << ". Enlarge VoxelSize, shrink ModelBounds "
         << "(without them: is there a particle far from the others?) or raise the maximum.";
    throw std::runtime_error(text.str());
  }
}

/** Values of the function at nodes, closed at the faces of the box. */
class Sampler
{
public:
  Sampler(double voxelSize, const Box& box, const InitialFunction& function)
    : VoxelSize(voxelSize)
    , Limits(box)
    , Function(function)
  {
  }

  void Evaluate(const std::vector<openvdb::Coord>& nodes, std::vector<double>& values) const
  {
    values.resize(nodes.size());
    if (!this->Function.ThreadSafe)
    {
      this->EvaluateRange(nodes, 0, nodes.size(), values);
      return;
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 1024),
      [&](const tbb::blocked_range<std::size_t>& range)
      { this->EvaluateRange(nodes, range.begin(), range.end(), values); });
  }

private:
  void EvaluateRange(const std::vector<openvdb::Coord>& nodes, std::size_t begin, std::size_t end,
    std::vector<double>& values) const
  {
    std::vector<double> points(3 * (end - begin));
    double* point = points.data();
    for (std::size_t i = begin; i < end; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        *point++ = this->VoxelSize * nodes[i][axis];
      }
    }
    this->Function.Evaluate(end - begin, points.data(), values.data() + begin);
    for (std::size_t i = begin; i < end; ++i)
    {
      if (std::isnan(values[i]))
      {
        values[i] = HUGE_VAL;
      }
      values[i] = this->Limits.Closes(nodes[i]) ? std::fabs(values[i]) : values[i];
    }
  }

  const double VoxelSize;
  const Box Limits;
  const InitialFunction& Function;
};

/** The signs of one plane of the box: 1 inside, 0 outside; z fastest. */
using SignPlane = std::vector<unsigned char>;

void SamplePlane(const Sampler& sampler, const Box& box, int x, std::vector<openvdb::Coord>& nodes,
  std::vector<double>& values, SignPlane& signs)
{
  nodes.clear();
  for (int y = box.First[1]; y <= box.Last[1]; ++y)
  {
    for (int z = box.First[2]; z <= box.Last[2]; ++z)
    {
      nodes.emplace_back(x, y, z);
    }
  }
  sampler.Evaluate(nodes, values);
  signs.resize(values.size());
  std::transform(
    values.begin(), values.end(), signs.begin(), [](double value) { return value < 0.0; });
}

/** Turns on the corners of the voxels between two planes whose corners differ in sign. */
void AddCrossedVoxels(
  const Box& box, int x, const SignPlane& before, const SignPlane& after, CrossedNodes& crossed)
{
  openvdb::tree::ValueAccessor<CrossedNodes> accessor(crossed);
  const int rows = box.Size(1), columns = box.Size(2);
  for (int y = 0; y + 1 < rows; ++y)
  {
    for (int z = 0; z + 1 < columns; ++z)
    {
      const std::size_t a = std::size_t(y) * columns + z, b = a + columns;
      const int inside = before[a] + before[a + 1] + before[b] + before[b + 1] + after[a] +
        after[a + 1] + after[b] + after[b + 1];
      if (inside == 0 || inside == 8)
      {
        continue;
      }
      for (int corner = 0; corner < 8; ++corner)
      {
        accessor.setValueOn(openvdb::Coord(x - 1 + (corner >> 2),
          box.First[1] + y + (corner >> 1 & 1), box.First[2] + z + (corner & 1)));
      }
    }
  }
}

/** The corners of all crossed voxels; false when `progress` stopped it. */
bool FindCrossedNodes(const Sampler& sampler, const Box& box, std::size_t maximum,
  const ProgressFunction& progress, CrossedNodes& crossed)
{
  std::vector<openvdb::Coord> nodes;
  std::vector<double> values;
  SignPlane before, after;
  for (int x = box.First[0]; x <= box.Last[0]; ++x)
  {
    if (progress && !progress(double(x - box.First[0]) / box.Size(0)))
    {
      return false;
    }
    SamplePlane(sampler, box, x, nodes, values, after);
    if (x > box.First[0])
    {
      AddCrossedVoxels(box, x, before, after, crossed);
    }
    std::swap(before, after);
    if (crossed.activeVoxelCount() > maximum)
    {
      RefuseSize(maximum);
    }
  }
  return true;
}

/** The power of two that brings the largest finite value at the crossed nodes to about 1. */
double ScaleOf(const std::vector<openvdb::Coord>& nodes, const std::vector<double>& values,
  const CrossedNodes& crossed)
{
  openvdb::tree::ValueAccessor<const CrossedNodes> isCrossed(crossed);
  double largest = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    if (std::isfinite(values[i]) && isCrossed.isValueOn(nodes[i]))
    {
      largest = std::max(largest, std::fabs(values[i]));
    }
  }
  return largest > 0.0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1.0;
}

/** The function at the active nodes of a tree, scaled to about 1 at the crossed ones. */
void SampleActiveNodes(
  const Sampler& sampler, const CrossedNodes& crossed, openvdb::FloatTree& tree)
{
  constexpr double most = 1e6; // far from the surface functions may do what they like
  std::vector<openvdb::Coord> nodes;
  nodes.reserve(tree.activeVoxelCount());
  for (auto it = tree.cbeginValueOn(); it; ++it)
  {
    nodes.push_back(it.getCoord());
  }
  std::vector<double> values;
  sampler.Evaluate(nodes, values);
  const double scale = ScaleOf(nodes, values, crossed);
  std::size_t i = 0;
  for (auto it = tree.beginValueOn(); it; ++it, ++i)
  {
    const double value = std::min(std::max(scale * values[i], -most), most);
    // What rounds to zero keeps its side.
    const float stored = static_cast<float>(value);
    it.setValue(value < 0.0 ? std::min(stored, -1e-30f) : stored);
  }
}

/** |F| / |grad F| by central differences, or a negative number where that means nothing. */
float FirstOrderDistance(const openvdb::tree::ValueAccessor<const openvdb::FloatTree>& function,
  const openvdb::Coord& node)
{
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    openvdb::Coord low = node, high = node;
    --low[axis];
    ++high[axis];
    if (!function.isValueOn(low) || !function.isValueOn(high))
    {
      return -1.f;
    }
    const double difference = .5 * (double(function.getValue(high)) - function.getValue(low));
    square += difference * difference;
  }
  return square > 0.0 ? static_cast<float>(std::fabs(function.getValue(node)) / std::sqrt(square))
                      : -1.f;
}

/** Sets the active nodes of `potential`, distances from fast sweeping, to the smoother first-order
 * distance of the function within half of them either way. */
void SmoothDistances(const openvdb::FloatTree& function, openvdb::FloatTree& potential)
{
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(potential);
  leaves.foreach (
    [&](PotentialLeaf& leaf, std::size_t)
    {
      openvdb::tree::ValueAccessor<const openvdb::FloatTree> accessor(function);
      for (auto it = leaf.beginValueOn(); it; ++it)
      {
        const float swept = std::fabs(*it);
        float distance = FirstOrderDistance(accessor, it.getCoord());
        distance = distance < 0.f ? swept : std::min(std::max(distance, .5f * swept), 1.5f * swept);
        it.setValue(accessor.getValue(it.getCoord()) < 0.f ? -distance : distance);
      }
    });
}

/** Whether a node is inside by more than what fast sweeping takes for zero; it refuses others. */
bool HasInside(const openvdb::FloatTree& function)
{
  constexpr float zero = 1e-8f;
  for (auto it = function.cbeginValueOn(); it; ++it)
  {
    if (*it < -zero)
    {
      return true;
    }
  }
  return false;
}

/** Null if there is nothing inside. */
openvdb::FloatTree::Ptr NearbyDistances(const Sampler& sampler, const CrossedNodes& crossed)
{
  // One node more than the layers, so that every layer has central differences.
  CrossedNodes nearby(crossed);
  openvdb::tools::dilateActiveValues(
    nearby, NumberOfLayers, openvdb::tools::NN_FACE, openvdb::tools::IGNORE_TILES);
  auto function = openvdb::FloatGrid::create(NarrowBand::Far);
  function->setTree(
    std::make_shared<openvdb::FloatTree>(nearby, NarrowBand::Far, openvdb::TopologyCopy()));
  SampleActiveNodes(sampler, crossed, function->tree());
  if (!HasInside(function->tree()))
  {
    return nullptr;
  }
  openvdb::tools::signedFloodFillWithValues(function->tree(), NarrowBand::Far, -NarrowBand::Far);
  const auto swept = openvdb::tools::sdfToSdf(*function, 0.f, 1);
  SmoothDistances(function->tree(), swept->tree());
  // Fast sweeping has its own background: the signs beyond are those of the flooded function.
  auto potential = std::make_shared<openvdb::FloatTree>(function->tree());
  for (auto leaf = potential->beginLeaf(); leaf; ++leaf)
  {
    const PotentialLeaf* from = swept->tree().probeConstLeaf(leaf->origin());
    for (auto it = leaf->beginValueOn(); it; ++it)
    {
      it.setValue(from->getValue(it.pos()));
    }
  }
  return potential;
}

}

openvdb::FloatTree::Ptr MakeInitialPotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress)
{
  const Box box = LatticeBox(voxelSize, bounds);
  CheckSize(box, maximumNumberOfActiveVoxels);
  const Sampler sampler(voxelSize, box, function);
  CrossedNodes crossed;
  if (!FindCrossedNodes(sampler, box, maximumNumberOfActiveVoxels, progress, crossed))
  {
    return nullptr;
  }
  const openvdb::FloatTree::Ptr potential =
    crossed.empty() ? nullptr : NearbyDistances(sampler, crossed);
  return potential ? potential : std::make_shared<openvdb::FloatTree>(NarrowBand::Far);
}

}
