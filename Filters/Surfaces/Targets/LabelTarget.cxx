#include "Targets/LabelTarget.h"

#include "Base/IndexMap.h"
#include "Grid/LabelSamples.h"
#include "Targets/TargetFrames.h"
#include "vtkGridPotential.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace activesurface
{

namespace
{

// Distance at which the potential of EvaluateLeaf is 1 [NodeFreedom::Unit]: more than NodeLimit.
constexpr double Farthest = 4.0;

// Distance that the stages know beyond the skin's farthest place [voxels]: differences reach two
// nodes.
constexpr double Margin = 2.0;

// Automatic freedom [pixels]. The surface of a label is unknown within half a pixel. The freedom is
// less, because conservation of volume and interpolation between nodes also displace the skin.
constexpr double UsualFreedom = 0.47;

// Distance [pixels] to the label of an image that has none.
constexpr double Absent = 3.5;

// Extends the range `low` to `high` of leaves so that it contains the box of a grid, enlarged by
// `reach` voxels.
void AddBox(
  vtkImplicitFunction* function, double voxelSize, double reach, NodeIndex& low, NodeIndex& high)
{
  double bounds[6];
  auto grid = vtkGridPotential::SafeDownCast(function);
  if (!grid || !grid->GetGridBounds(bounds))
  {
    return;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] =
      std::min(low[axis], static_cast<int>(std::floor(bounds[2 * axis] / voxelSize - reach)) & ~7);
    high[axis] = std::max(
      high[axis], static_cast<int>(std::ceil(bounds[2 * axis + 1] / voxelSize + reach)) & ~7);
  }
}

}

struct LabelTarget::Block
{
  NodeIndex Origin;
  int Size; // nodes along each axis, 8 times a power of 2
};

double LabelTarget::FindFreedom(const TargetOptions& options, double leastPixel)
{
  return options.LabelNoise < 0.0 ? UsualFreedom : options.LabelNoise / leastPixel;
}

void LabelTarget::PlaceNodes(const NodeMotion& motion)
{
  this->VoxelSize = motion.VoxelSize;
  this->MoveTo(motion.End);
  this->LeastPixel = std::numeric_limits<double>::infinity();
  this->LargestPixel = 0.0;
  for (const Shape* shape : { &this->Earlier, &this->Later })
  {
    if (const LabelFacts* facts = this->Frames.GetLabel(shape->Step))
    {
      this->LeastPixel = std::min(this->LeastPixel, facts->LeastPixel);
      this->LargestPixel = std::max(this->LargestPixel, facts->LargestPixel);
    }
  }
}

NodeFreedom LabelTarget::GetFreedom() const
{
  const double scale = this->LeastPixel / this->GetReach();
  const double width = FindFreedom(this->GetOptions(), this->LeastPixel);
  return { static_cast<float>(scale * width),
    static_cast<float>(scale * this->VoxelSize / this->LargestPixel),
    static_cast<float>(this->FindUnit()) };
}

// Returns NodeFreedom::Unit. Distances beyond Absent are unknown.
double LabelTarget::FindUnit() const
{
  const double width = std::min(FindFreedom(this->GetOptions(), this->LeastPixel), Absent);
  const double farthestSkin = width * this->LargestPixel / this->VoxelSize;
  return std::max(1.0, (farthestSkin + Margin) / double(NodeLimit));
}

double LabelTarget::GetReach() const
{
  return this->VoxelSize * this->FindUnit() * Farthest;
}

// Finds distances in pixels to the label of one step.
void LabelTarget::SampleLabel(
  const Shape& shape, std::size_t count, const double* points, double* distances) const
{
  const LabelFacts* facts = this->Frames.GetLabel(shape.Step);
  if (facts && facts->Volume > 0.0)
  {
    this->SampleShape(shape, count, points, distances, nullptr);
    return;
  }
  std::fill_n(distances, count, Absent);
}

// count: at most the nodes of a leaf.
void LabelTarget::SampleNodes(std::size_t count, const double* points, double* distances) const
{
  this->SampleLabel(this->Earlier, count, points, distances);
  if (this->Blend > 0.0)
  {
    double later[512];
    this->SampleLabel(this->Later, count, points, later);
    for (std::size_t i = 0; i < count; ++i)
    {
      distances[i] = (1.0 - this->Blend) * distances[i] + this->Blend * later[i];
    }
  }
}

double LabelTarget::DistanceAt(const double (&node)[3]) const
{
  const double point[3] = { this->VoxelSize * node[0], this->VoxelSize * node[1],
    this->VoxelSize * node[2] };
  double value;
  this->SampleNodes(1, point, &value);
  return value;
}

bool LabelTarget::IsInside(const NodeIndex& node) const
{
  return this->DistanceAt({ double(node[0]), double(node[1]), double(node[2]) }) < 0.0;
}

// Returns true if the potential is 1 in the whole block, or -1 in the whole block. Distances
// [pixels] change by at most about 1 / LeastPixel per unit of length, averaged over a pixel.
bool LabelTarget::IsUniform(const Block& block, double& distance) const
{
  const double half = 0.5 * block.Size;
  distance =
    this->DistanceAt({ block.Origin[0] + half, block.Origin[1] + half, block.Origin[2] + half });
  const double radius = this->VoxelSize * std::sqrt(3.0) * half + this->GetReach();
  return std::fabs(distance) * this->LeastPixel > radius;
}

void LabelTarget::Visit(const Block& block, bool wantsInside, Shell& shell) const
{
  double distance;
  const bool isUniform = this->IsUniform(block, distance);
  if (isUniform && (distance > 0.0 || !wantsInside))
  {
    return;
  }
  if (block.Size == 8)
  {
    if (isUniform)
    {
      shell.InsideLeaves.push_back(block.Origin);
    }
    else
    {
      shell.Leaves.push_back({ block.Origin, ~std::uint64_t(0), 0 });
    }
    return;
  }
  const int half = block.Size / 2;
  for (int part = 0; part < 8; ++part)
  {
    this->Visit({ { block.Origin[0] + half * (part >> 2), block.Origin[1] + half * (part >> 1 & 1),
                    block.Origin[2] + half * (part & 1) },
                  half },
      wantsInside, shell);
  }
}

void LabelTarget::FindShell(bool wantsInside, Shell& shell) const
{
  constexpr int none = std::numeric_limits<int>::max();
  shell.Leaves.clear();
  shell.InsideLeaves.clear();
  NodeIndex low = { none, none, none }, high = { -none, -none, -none };
  const double reach = this->GetReach() / this->VoxelSize;
  AddBox(this->Earlier.Source, this->VoxelSize, reach, low, high);
  AddBox(this->Blend > 0.0 ? this->Later.Source : nullptr, this->VoxelSize, reach, low, high);
  int size = 8;
  for (int axis = 0; axis < 3; ++axis)
  {
    while (low[axis] <= high[axis] && high[axis] - low[axis] >= size)
    {
      size *= 2;
    }
  }
  if (low[0] <= high[0])
  {
    this->Visit({ low, size }, wantsInside, shell);
  }
  std::sort(shell.Leaves.begin(), shell.Leaves.end(),
    [](const ShellLeaf& a, const ShellLeaf& b) { return a.Origin < b.Origin; });
}

void LabelTarget::EvaluateLeaf(const ShellLeaf& leaf, float* values) const
{
  double points[3 * 512], distances[512];
  for (int n = 0; n < 512; ++n)
  {
    points[3 * n] = this->VoxelSize * (leaf.Origin[0] + (n >> 6));
    points[3 * n + 1] = this->VoxelSize * (leaf.Origin[1] + (n >> 3 & 7));
    points[3 * n + 2] = this->VoxelSize * (leaf.Origin[2] + (n & 7));
  }
  this->SampleNodes(512, points, distances);
  const double scale = this->LeastPixel / this->GetReach();
  std::transform(distances, distances + 512, values,
    [scale](double distance)
    { return static_cast<float>(std::clamp(scale * distance, -1.0, 1.0)); });
}

void LabelTarget::FindMotion(const ShellLeaf&, LeafMotion& motion) const
{
  for (float(&displacements)[LeafMotion::Points] : motion.Displacement)
  {
    std::fill_n(displacements, LeafMotion::Points, 0.f);
  }
  std::fill_n(motion.Bulk, LeafMotion::Points, 1.f);
  motion.IsStill = false; // the label may have changed
}

}
