#include "Simulation/SurfaceDomain.h"

#include "Base/LatticeOrigin.h"
#include "Simulation/SurfaceSettings.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr double VoxelsPerSpacing = 2.0;
constexpr double ReachPerSpacing = 3.0;
constexpr double VoxelsAcross = 64.0;
constexpr double ImageMargin = 2.0; // voxels

void MoveToOrigin(SurfaceDomain& domain)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    double* bounds = domain.Bounds + 2 * axis;
    domain.Origin[axis] = FindLatticeOrigin(bounds[0], bounds[1], domain.VoxelSize);
    bounds[0] -= domain.Origin[axis];
    bounds[1] -= domain.Origin[axis];
  }
}

// Returns the voxel size for images. The longest side with its margin has VoxelsAcross voxels, or
// more if pixels are finer: voxels are then as large as pixels, down to 1/1000 of the longest side.
double FindVoxelSizeOfImages(double longest, double pixel)
{
  constexpr double mostAcross = 1000.0;
  const double coarsest = longest / (VoxelsAcross - 2.0 * ImageMargin);
  return pixel > 0.0 ? std::min(coarsest, std::max(pixel, longest / mostAcross)) : coarsest;
}

// Throws for a period of less than four voxels. A much shorter period contains no node, and the
// periodic copies of the particles exhaust the memory.
void CheckPeriodicBox(const ParticleSettings& particles, double voxelSize)
{
  constexpr double fewestVoxels = 4.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = particles.Periodic[2 * axis + 1] - particles.Periodic[2 * axis];
    if (particles.IsPeriodic(axis) && !(length >= fewestVoxels * voxelSize))
    {
      std::ostringstream text;
      text << "PeriodicBounds is " << length << " long along "
           << "xyz"[axis] << ", less than four voxels of " << voxelSize
           << "; enlarge PeriodicBounds, or reduce VoxelSize or ParticleSpacing.";
      throw std::invalid_argument(text.str());
    }
  }
}

// Size of a voxel, and the source of this size in words.
struct ChosenVoxel
{
  double Size;
  const char* Source;
};

// Throws for an automatic VoxelSize beyond the range of lengths, except 0, the size of an empty
// input.
void CheckVoxel(const ChosenVoxel& voxel)
{
  const bool isLength = voxel.Size >= ranges::ShortestLength && voxel.Size <= ranges::LongestLength;
  if (voxel.Size != 0.0 && !isLength)
  {
    std::ostringstream text;
    text << "The automatic VoxelSize is " << voxel.Size << ", computed from " << voxel.Source
         << ", but has to be between " << ranges::ShortestLength << " and " << ranges::LongestLength
         << "; scale the data, or set VoxelSize.";
    throw std::invalid_argument(text.str());
  }
}

// Chooses the first size that is available: VoxelSize, half of the spacing, `image` (the voxel size
// for images; 0: no images), 1/64 of the longest side.
ChosenVoxel ChooseVoxel(
  const SurfaceSettings& settings, double longest, double particleSpacing, double image)
{
  if (settings.VoxelSize > 0.0)
  {
    return { settings.VoxelSize, "VoxelSize" };
  }
  if (particleSpacing > 0.0)
  {
    return { particleSpacing / VoxelsPerSpacing, "the points' spacing" };
  }
  if (image > 0.0)
  {
    return { image, "the image's pixels and bounds" };
  }
  return { longest / VoxelsAcross,
    settings.HasBounds() ? "ModelBounds" : "the bounds of the target and the initial shape" };
}

// image: voxel size for images; 0: no images.
SurfaceDomain MakeDomainOf(
  const SurfaceSettings& settings, const double bounds[6], double particleSpacing, double image)
{
  SurfaceDomain domain;
  std::copy(bounds, bounds + 6, domain.Bounds);
  double longest = 0.0;
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double side = bounds[2 * axis + 1] - bounds[2 * axis];
    longest = std::max(longest, side);
    square += side * side;
  }
  const ChosenVoxel voxel = ChooseVoxel(settings, longest, particleSpacing, image);
  CheckVoxel(voxel);
  domain.VoxelSize = voxel.Size;
  if (particleSpacing > 0.0)
  {
    CheckPeriodicBox(settings.Particles, domain.VoxelSize);
  }
  domain.Reach = settings.Reach > 0.0 ? settings.Reach
    : particleSpacing > 0.0           ? ReachPerSpacing * particleSpacing
                                      : std::sqrt(square) / 8.0;
  MoveToOrigin(domain);
  return domain;
}

}

bool SurfaceDomain::GetExtent(int extent[6]) const
{
  constexpr double rounding = 1e-6; // tolerance for bounds at a node [voxels]
  constexpr double farthest = 1e9;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = std::floor(this->Bounds[2 * axis] / this->VoxelSize + rounding);
    const double high = std::ceil(this->Bounds[2 * axis + 1] / this->VoxelSize - rounding);
    if (!(low > -farthest && high < farthest))
    {
      return false;
    }
    extent[2 * axis] = static_cast<int>(low);
    extent[2 * axis + 1] = static_cast<int>(high);
  }
  return true;
}

SurfaceDomain MakeDomain(const SurfaceSettings& settings)
{
  const double spacing = settings.UsesInput() ? settings.Particles.Spacing : 0.0;
  return MakeDomainOf(settings, settings.Bounds.data(), spacing, 0.0);
}

SurfaceDomain MakeDomainOfNothing(const SurfaceSettings& settings, double particleSpacing)
{
  const double nowhere[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  return MakeDomainOf(settings, nowhere, particleSpacing, 0.0);
}

SurfaceDomain MakeDomain(const SurfaceSettings& settings, const FirstShapes& first)
{
  vtkBoundingBox shapes = first.Shapes;
  if (shapes.IsValid())
  {
    shapes.Inflate(shapes.GetMaxLength() / 8.0);
  }
  shapes.AddBox(first.Images);
  double voxel = 0.0;
  if (first.Images.IsValid())
  {
    voxel = settings.VoxelSize > 0.0 ? settings.VoxelSize
                                     : FindVoxelSizeOfImages(shapes.GetMaxLength(), first.Pixel);
    shapes.Inflate(ImageMargin * voxel);
  }
  if (!(shapes.GetMaxLength() > 0.0))
  {
    throw std::invalid_argument(
      "The target is a single point, and so is the initial shape, if there is one. Causes: an "
      "image has one pixel or too small a Spacing, all corners of a mesh coincide, or points are "
      "so far from the origin that they are equal in double precision. Correct or move the input.");
  }
  double bounds[6];
  shapes.GetBounds(bounds);
  return MakeDomainOf(settings, bounds, first.ParticleSpacing, voxel);
}

}
