#include "Surface/SkinDistance.h"

#include "Base/LatticeCell.h"
#include "Base/OpenVDB.h"
#include "Base/Trilinear.h"
#include "Leaves/CentralGradient.h"
#include "Leaves/LeafTable.h"
#include "NarrowBandGrid.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace activesurface
{

namespace
{

constexpr float LeastGradientNorm = .05f;

// Not registered with the tree, so each call can create an accessor cheaply, in any thread.
using Reader = openvdb::tree::ValueAccessor<const PotentialTree, false>;

/** If the next node along an axis is in the layers, reads u at this node and increments steps. */
void SearchAlong(const LeafTable& table, const LeafTable::Place& node, int axis, int side,
  int& steps, float& value)
{
  const LeafTable::Place place = table.Step(node.Leaf, node.Node, axis, side);
  if (place.Leaf >= 0 && table[place.Leaf].UpToLayer[LastLayer].Has(place.Node))
  {
    value = table[place.Leaf].Value[place.Node];
    ++steps;
  }
}

/** Returns |grad u| at a node of the layers, from the neighbours that are in the layers. */
float GradientNormAt(const LeafTable& table, const LeafTable::Place& node)
{
  const float own = table[node.Leaf].Value[node.Node];
  float square = 0.f;
  bool isKnown = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    int steps = 0;
    float before = own, after = own;
    SearchAlong(table, node, axis, -1, steps, before);
    SearchAlong(table, node, axis, 1, steps, after);
    const float difference = steps > 0 ? (after - before) / static_cast<float>(steps) : 0.f;
    square += difference * difference;
    isKnown = isKnown || steps > 0;
  }
  return isKnown ? std::max(std::sqrt(square), LeastGradientNorm) : 1.f;
}

openvdb::CoordBBox CrossedNodes(const LeafTable& table)
{
  openvdb::CoordBBox box;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    table[i].UpToLayer[0].ForEach([&](int node)
      { box.expand(table[i].Origin.offsetBy(node >> 6, (node >> 3) & 7, node & 7)); });
  }
  return box;
}

}

// Two trees with the same leaves. Outside the leaves, only the sign of the potential is read.
struct SkinDistance::State
{
  explicit State(const NarrowBand& band)
    : VoxelSize(band.GetVoxelSize())
    , Potential(GetPotential(band)->tree())
    , GradientNorms(GetPotential(band)->tree())
    , Crossed(CrossedNodes(band.GetLeaves()))
  {
    this->Potential.evalLeafBoundingBox(this->Leaves);
  }

  void ReadLeaves(const LeafTable& table);
  void ReadNode(
    Reader& potential, Reader& norms, const openvdb::Coord& node, double& u, double& norm) const;

  const double VoxelSize;
  PotentialTree Potential;
  PotentialTree GradientNorms;
  openvdb::CoordBBox Crossed; //< corners of the crossed voxels
  openvdb::CoordBBox Leaves;  //< box of all leaves; contains all inside nodes
};

void SkinDistance::State::ReadLeaves(const LeafTable& table)
{
  // Both trees are copies of one tree, so their leaves are in the order of the table.
  std::vector<PotentialLeaf*> potential, norms;
  this->Potential.getNodes(potential);
  this->GradientNorms.getNodes(norms);
  table.ForEach(
    [&](std::size_t i)
    {
      const BandLeaf& leaf = table[i];
      float* u = potential[i]->buffer().data();
      float* norm = norms[i]->buffer().data();
      for (int node = 0; node < static_cast<int>(PotentialLeaf::SIZE); ++node)
      {
        const bool isInLayers = leaf.UpToLayer[LastLayer].Has(node);
        norm[node] =
          isInLayers ? GradientNormAt(table, { static_cast<std::int32_t>(i), node }) : 1.f;
        u[node] = isInLayers ? u[node] : leaf.Inside.Has(node) ? -HalfWidth : HalfWidth;
      }
    });
}

void SkinDistance::State::ReadNode(
  Reader& potential, Reader& norms, const openvdb::Coord& node, double& u, double& norm) const
{
  const PotentialLeaf* leaf = potential.probeConstLeaf(node);
  u = leaf ? leaf->getValue(node) : std::copysign(HalfWidth, potential.getValue(node));
  norm = leaf ? norms.getValue(node) : 1.f;
}

SkinDistance::SkinDistance(const NarrowBand& band)
{
  if (!band.HasGhosts())
  {
    const std::unique_ptr<NarrowBand> extended = band.Clone();
    extended->AddGhosts();
    this->Read(*extended);
    return;
  }
  this->Read(band);
}

void SkinDistance::Read(const NarrowBand& band)
{
  this->Members = std::make_unique<State>(band);
  band.Run([&] { this->Members->ReadLeaves(band.GetLeaves()); });
}

SkinDistance::~SkinDistance() = default;

double SkinDistance::Evaluate(const double x[3], double* gradient) const
{
  const State& own = *this->Members;
  const bool isFinite = std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
  const double far = isFinite ? HalfWidth * own.VoxelSize : std::nan("");
  const double place[3] = { x[0] / own.VoxelSize, x[1] / own.VoxelSize, x[2] / own.VoxelSize };
  if (gradient)
  {
    std::fill_n(gradient, 3, isFinite ? 0.0 : far);
  }
  if (!isFinite || IsBeyond(own.Leaves, place))
  {
    return far;
  }
  const LatticeCell cell(place);
  double u[CornersOfCell], norm[CornersOfCell];
  Reader potential(own.Potential), norms(own.GradientNorms);
  for (int c = 0; c < CornersOfCell; ++c)
  {
    own.ReadNode(potential, norms, cell.Corner(c), u[c], norm[c]);
  }
  double rise[3], bend[3];
  const double level = Trilinear(u, cell.Fraction, rise);
  const double steepness = Trilinear(norm, cell.Fraction, bend);
  const double distance = level / steepness;
  if (std::fabs(distance) >= HalfWidth)
  {
    return std::copysign(far, distance);
  }
  for (int axis = 0; gradient && axis < 3; ++axis)
  {
    gradient[axis] = (rise[axis] - distance * bend[axis]) / steepness;
  }
  return own.VoxelSize * distance;
}

bool SkinDistance::GetBounds(double bounds[6]) const
{
  const State& own = *this->Members;
  for (int axis = 0; axis < 3 && !own.Crossed.empty(); ++axis)
  {
    bounds[2 * axis] = own.VoxelSize * own.Crossed.min()[axis];
    bounds[2 * axis + 1] = own.VoxelSize * own.Crossed.max()[axis];
  }
  return !own.Crossed.empty();
}

namespace
{

/** Returns u divided by its central gradient norm: a distance of first order [voxels]. */
float DistanceAt(
  const openvdb::tree::ValueAccessor<const PotentialTree>& potential, const openvdb::Coord& node)
{
  const float value = potential.getValue(node);
  if (!potential.isValueOn(node))
  {
    return value < 0.f ? -HalfWidth : HalfWidth;
  }
  const float square = CentralGradientSquare<float>(
    node, [&potential](const openvdb::Coord& next) { return potential.getValue(next); });
  // Where the gradient vanishes, on a medial axis, the quotient would be infinite or NaN.
  const float distance = square > 0.f ? value / std::sqrt(square) : value;
  return std::min(std::max(distance, -HalfWidth), HalfWidth);
}

void WritePlane(
  const PotentialTree& tree, const int extent[6], int z, float voxelSize, float* distances)
{
  openvdb::tree::ValueAccessor<const PotentialTree> potential(tree);
  for (int y = extent[2]; y <= extent[3]; ++y)
  {
    for (int x = extent[0]; x <= extent[1]; ++x)
    {
      *distances++ = voxelSize * DistanceAt(potential, openvdb::Coord(x, y, z));
    }
  }
}

}

void WriteDistances(const NarrowBand& band, const int extent[6], float* distances)
{
  const std::size_t plane =
    (std::size_t(extent[1] - extent[0]) + 1) * (std::size_t(extent[3] - extent[2]) + 1);
  band.Run(
    [&]
    {
      tbb::parallel_for(extent[4], extent[5] + 1,
        [&](int z)
        {
          WritePlane(GetPotential(band)->tree(), extent, z, static_cast<float>(band.GetVoxelSize()),
            distances + std::size_t(z - extent[4]) * plane);
        });
    });
}

}
