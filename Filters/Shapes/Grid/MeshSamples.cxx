#include "Grid/MeshSamples.h"

#include "Base/LatticeCell.h"
#include "Base/LatticeShape.h"
#include "Base/OpenVDB.h"
#include "Base/StaticShutdown.h"
#include "Base/Trilinear.h"
#include "Grid/InsideMask.h"
#include "Grid/MeshDistance.h"
#include "Grid/MeshVoxels.h"
#include "Grid/OpenMesh.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace activesurface
{

namespace
{

constexpr double DefaultVoxels = 64.0; // voxels along the longest side
constexpr double DefaultReach = 0.125; // fraction of the diagonal
constexpr double LeastReach = 3.0;     // voxels: up to neighbours of crossed voxels' corners
constexpr double Margin = 2.0;         // voxels beyond Reach, so that interpolation has all corners
constexpr double FarthestNode = 1e9;   // node indices are 32-bit integers

void CheckNumber(double number, const char* name)
{
  if (!std::isfinite(number) || number < 0.0)
  {
    std::ostringstream text;
    text << name << " must be a finite number >= 0, not " << number << ".";
    throw std::invalid_argument(text.str());
  }
}

void CheckLength(double length, const char* name)
{
  if (!(std::isfinite(length) && length > 0.0) && length != Automatic)
  {
    std::ostringstream text;
    text << name << " must be a finite number > 0, or -1 (automatic); it is " << length << ".";
    throw std::invalid_argument(text.str());
  }
}

void CheckMesh(const MeshTriangles& mesh)
{
  if (mesh.Triangles.empty())
  {
    throw std::invalid_argument(mesh.Defects.BrokenPolygons + mesh.Defects.FlatPolygons > 0
        ? "The mesh has no valid polygon; correct it. " + mesh.Defects.Describe()
        : std::string("The mesh has no polygons, and no strip that has a triangle of three "
                      "different points; connect a closed mesh."));
  }
  if (mesh.Triangles.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
  {
    throw std::invalid_argument("The mesh has more than 2^31 - 1 triangles; use fewer.");
  }
}

void CheckPlace(const std::array<double, 6>& bounds, double voxelSize)
{
  for (const double bound : bounds)
  {
    if (!(std::fabs(bound) / voxelSize < FarthestNode))
    {
      std::ostringstream text;
      text << "A point of the mesh is 10^9 voxels or more from the origin or, in a filter, from "
           << "the first time step's shapes (from ModelBounds, if set); enlarge VoxelSize (now "
           << voxelSize << "), move the mesh, or remove points that are far away.";
      throw std::invalid_argument(text.str());
    }
  }
}

void CheckSize(const MeshTriangles& mesh, double voxelSize, double band, double maximum)
{
  if (!(EstimateVoxelsNear(mesh, voxelSize, band, maximum) <= maximum))
  {
    const std::array<double, 6> bounds = mesh.GetBounds();
    std::ostringstream text;
    text << "The distances to the mesh, whose box is " << bounds[1] - bounds[0] << " x "
         << bounds[3] - bounds[2] << " x " << bounds[5] - bounds[4]
         << ", would need more voxels than MaximumNumberOfVoxels = " << maximum
         << "; move or remove points that are far away, enlarge VoxelSize (now " << voxelSize
         << "), reduce Reach or MeshThickness, or raise the maximum.";
    throw std::runtime_error(text.str());
  }
}

}

MeshSamples::MeshSamples(const MeshTriangles& mesh, const MeshMeasure& measure)
  : Bounds(mesh.GetBounds())
{
  CheckLength(measure.VoxelSize, "VoxelSize");
  CheckLength(measure.Reach, "Reach");
  CheckNumber(measure.Thickness, "MeshThickness");
  CheckMesh(mesh);
  this->Measure(measure);
  const bool isClosed = mesh.Defects.IsClosed();
  const bool isShell = measure.Thickness > 0.0 && !isClosed;
  if (isShell)
  {
    this->Thicken(measure.Thickness);
  }
  const double band = this->Reach + this->HalfShell + Margin;
  CheckSize(mesh, this->VoxelSize, band, measure.MaximumNumberOfVoxels);
  this->Distance = isClosed || isShell ? MakeMeshDistance(mesh, { this->VoxelSize, band, !isShell })
                                       : MakeOpenMeshDistance(mesh, this->VoxelSize, band);
  this->Distance->tree().evalLeafBoundingBox(this->Leaves);
  if (isShell || isClosed)
  {
    this->Surface = activesurface::SampleSurface(mesh);
    this->Surface.IsMiddle = isShell;
  }
}

MeshSamples::~MeshSamples()
{
  ReleaseUnlessExiting(std::move(this->Distance));
}

void MeshSamples::Measure(const MeshMeasure& measure)
{
  const double x = this->Bounds[1] - this->Bounds[0], y = this->Bounds[3] - this->Bounds[2],
               z = this->Bounds[5] - this->Bounds[4];
  this->VoxelSize =
    measure.VoxelSize > 0.0 ? measure.VoxelSize : std::max({ x, y, z }) / DefaultVoxels;
  CheckPlace(this->Bounds, this->VoxelSize);
  const double reach = measure.Reach > 0.0 ? measure.Reach : DefaultReach * std::hypot(x, y, z);
  this->Reach = std::max(reach / this->VoxelSize, LeastReach);
}

void MeshSamples::Thicken(double thickness)
{
  this->HalfShell = 0.5 * thickness / this->VoxelSize;
  for (int i = 0; i < 6; ++i)
  {
    this->Bounds[i] += (i % 2 == 0 ? -0.5 : 0.5) * thickness;
  }
}

double MeshSamples::Evaluate(const double x[3], double* gradient) const
{
  const bool isFinite = std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
  const double far =
    isFinite ? this->Reach * this->VoxelSize : std::numeric_limits<double>::quiet_NaN();
  if (gradient)
  {
    std::fill_n(gradient, 3, isFinite ? 0.0 : far);
  }
  const double place[3] = { x[0] / this->VoxelSize, x[1] / this->VoxelSize,
    x[2] / this->VoxelSize };
  if (!isFinite || IsBeyond(this->Leaves, place))
  {
    return far;
  }
  const LatticeCell cell(place);
  // An accessor that is not registered with the tree is cheap to construct, in any thread.
  openvdb::tree::ValueAccessor<const openvdb::FloatTree, false> distance(this->Distance->tree());
  double corner[CornersOfCell];
  for (int c = 0; c < CornersOfCell; ++c)
  {
    corner[c] = distance.getValue(cell.Corner(c));
  }
  double rise[3];
  const double value = Trilinear(corner, cell.Fraction, rise) - this->HalfShell;
  if (std::fabs(value) >= this->Reach)
  {
    return std::copysign(far, value);
  }
  std::copy_n(rise, gradient ? 3 : 0, gradient);
  return value * this->VoxelSize;
}

bool MeshSamples::GetBounds(double bounds[6]) const
{
  std::copy(this->Bounds.begin(), this->Bounds.end(), bounds);
  return true;
}

bool MeshSamples::FindShape(double level, LatticeShape& shape) const
{
  const double voxels = level / this->VoxelSize;
  if (!(std::fabs(voxels) < this->Reach))
  {
    return false;
  }
  const double most = voxels + this->HalfShell;
  FindInside(
    this->Distance->tree(), [most](float distance) { return distance < most; }, shape.Inside);
  for (int axis = 0; axis < 3; ++axis)
  {
    shape.Axis[axis] *= this->VoxelSize;
  }
  return true;
}

}
