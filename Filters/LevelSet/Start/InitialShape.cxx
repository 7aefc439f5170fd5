#include "Start/InitialShape.h"

#include "Leaves/LeafTable.h"
#include "Start/InitialDistances.h"
#include "Start/LatticeBox.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace activesurface
{

namespace
{

/** Rejects too large boxes before sampling. A box of n^3 voxels is rejected if 7 n^2 exceeds the
 * maximum of active voxels: a ball of diameter 0.6 n needs about 7 n^2, a ball that fills the box
 * 20 n^2. Also rejects a box whose nodes would need minutes to sample, as with a stray particle far
 * from all other particles. */
void CheckSize(const LatticeBox& box, std::size_t maximum)
{
  constexpr double nodesPerActiveVoxel = 40.0;
  const double x = box.Size(0), y = box.Size(1), z = box.Size(2);
  const double most = static_cast<double>(maximum);
  if (7.0 / 3.0 * (x * y + y * z + z * x) > most || x * y * z > nodesPerActiveVoxel * most)
  {
    std::ostringstream text;
    text << "ModelBounds, set or automatic, hold " << x << " x " << y << " x " << z
         << " voxels, too many to sample with MaximumNumberOfActiveVoxels = " << maximum
         << ". Enlarge VoxelSize, set smaller ModelBounds, remove points far from all others, or "
         << "raise the maximum above about "
         << std::max(7.0 / 3.0 * (x * y + y * z + z * x), x * y * z / nodesPerActiveVoxel) << ".";
    throw std::runtime_error(text.str());
  }
}

/** Values of the function at nodes. The shape is closed at the faces of the box. */
class Sampler
{
public:
  Sampler(double voxelSize, const LatticeBox& box, const InitialFunction& function)
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
      this->EvaluateSome(nodes, 0, nodes.size(), values);
      return;
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 1024),
      [&](const tbb::blocked_range<std::size_t>& range)
      { this->EvaluateSome(nodes, range.begin(), range.end(), values); });
  }

private:
  void EvaluateSome(const std::vector<openvdb::Coord>& nodes, std::size_t begin, std::size_t end,
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
  const LatticeBox Limits;
  const InitialFunction& Function;
};

/** The function on one plane of the box; z fastest. */
struct Plane
{
  std::vector<double> Values;
  std::vector<unsigned char> Signs; //< 1 inside, 0 outside
};

void SamplePlane(const Sampler& sampler, const LatticeBox& box, int x,
  std::vector<openvdb::Coord>& nodes, Plane& plane)
{
  nodes.clear();
  for (int y = box.First[1]; y <= box.Last[1]; ++y)
  {
    for (int z = box.First[2]; z <= box.Last[2]; ++z)
    {
      nodes.emplace_back(x, y, z);
    }
  }
  sampler.Evaluate(nodes, plane.Values);
  plane.Signs.resize(nodes.size());
  std::transform(plane.Values.begin(), plane.Values.end(), plane.Signs.begin(),
    [](double value) { return value < 0.0; });
}

/** Adds the corners of the crossed voxels between two planes of nodes. */
void AddCrossedVoxels(
  const LatticeBox& box, int x, const Plane& before, const Plane& after, CrossedNodes& crossed)
{
  openvdb::tree::ValueAccessor<openvdb::BoolTree> accessor(crossed.Nodes);
  const int rows = box.Size(1), columns = box.Size(2);
  for (int y = 0; y + 1 < rows; ++y)
  {
    for (int z = 0; z + 1 < columns; ++z)
    {
      const std::size_t a = std::size_t(y) * columns + z, b = a + columns;
      const unsigned char *p = before.Signs.data(), *q = after.Signs.data();
      const int inside = p[a] + p[a + 1] + p[b] + p[b + 1] + q[a] + q[a + 1] + q[b] + q[b + 1];
      if (inside == 0 || inside == 8)
      {
        continue;
      }
      for (int corner = 0; corner < 8; ++corner)
      {
        const int dx = corner >> 2, dy = corner >> 1 & 1, dz = corner & 1;
        const double value = std::fabs((dx ? after : before).Values[(dy ? b : a) + dz]);
        crossed.Largest = std::isfinite(value) ? std::max(crossed.Largest, value) : crossed.Largest;
        accessor.setValueOn(
          openvdb::Coord(x - 1 + dx, box.First[1] + y + dy, box.First[2] + z + dz));
      }
    }
  }
}

/** Finds the corners of all crossed voxels. Returns false if `progress` cancelled the search. */
bool FindCrossedNodes(const Sampler& sampler, const LatticeBox& box, std::size_t maximum,
  const ProgressFunction& progress, CrossedNodes& crossed)
{
  std::vector<openvdb::Coord> nodes;
  Plane before, after;
  for (int x = box.First[0]; x <= box.Last[0]; ++x)
  {
    if (progress && !progress(double(x - box.First[0]) / box.Size(0)))
    {
      return false;
    }
    SamplePlane(sampler, box, x, nodes, after);
    if (x > box.First[0])
    {
      AddCrossedVoxels(box, x, before, after, crossed);
    }
    std::swap(before, after);
    if (crossed.Nodes.activeVoxelCount() > maximum)
    {
      RefuseSize(maximum);
    }
  }
  return true;
}

}

openvdb::FloatTree::Ptr MakeInitialPotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress)
{
  const LatticeBox box = FindLatticeBox(voxelSize, bounds);
  CheckSize(box, maximumNumberOfActiveVoxels);
  const Sampler sampler(voxelSize, box, function);
  CrossedNodes crossed;
  if (!FindCrossedNodes(sampler, box, maximumNumberOfActiveVoxels, progress, crossed))
  {
    return nullptr;
  }
  const NodeFunction values = { [&sampler](const std::vector<openvdb::Coord>& nodes,
                                  std::vector<double>& results)
    { sampler.Evaluate(nodes, results); },
    function.ThreadSafe };
  const openvdb::FloatTree::Ptr potential =
    crossed.Nodes.empty() ? nullptr : MakeNearbyDistances(crossed, values);
  return potential ? potential : std::make_shared<openvdb::FloatTree>(Far);
}

void RefuseSize(std::size_t maximumNumberOfActiveVoxels)
{
  std::ostringstream text;
  text << "The narrow band would have more than MaximumNumberOfActiveVoxels = "
       << maximumNumberOfActiveVoxels << " active voxels; enlarge VoxelSize, raise the maximum or, "
       << "at the start, set smaller ModelBounds.";
  throw std::runtime_error(text.str());
}

}
