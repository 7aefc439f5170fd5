#include "SurfaceSettings.h"

#include "vtkBoundingBox.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace activesurface
{

namespace
{

void Require(bool condition, const char* sentence)
{
  if (!condition)
  {
    throw std::invalid_argument(sentence);
  }
}

bool IsPositive(double value)
{
  return std::isfinite(value) && value > 0.0;
}

bool IsZeroOrPositive(double value)
{
  return std::isfinite(value) && value >= 0.0;
}

// Speeds are kept in single precision.
constexpr double ShortestLength = 1e-30;
constexpr double LongestLength = 1e30;

bool IsLength(double value)
{
  return value >= ShortestLength && value <= LongestLength;
}

void CheckBounds(const std::array<double, 6>& bounds)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = bounds[2 * axis];
    const double high = bounds[2 * axis + 1];
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
    {
      std::ostringstream text;
      text << "ModelBounds has to be (xmin, xmax, ymin, ymax, zmin, zmax) with finite min < max on "
              "each axis; on axis "
           << "xyz"[axis] << " it is " << low << ", " << high << ".";
      throw std::invalid_argument(text.str());
    }
  }
}

// The first step that is not finite, or not after the one before; as many as there are, if none is.
std::size_t FindBadStep(const std::vector<double>& steps)
{
  std::size_t i = 0;
  while (i < steps.size() && std::isfinite(steps[i]) && (i == 0 || steps[i - 1] < steps[i]))
  {
    ++i;
  }
  return i;
}

void CheckSteps(const std::vector<double>& steps, bool areOfInput)
{
  const std::size_t bad = FindBadStep(steps);
  if (!steps.empty() && bad == steps.size())
  {
    return;
  }
  std::ostringstream text;
  text << (areOfInput ? "The time steps of the input" : "The filter's own time steps")
       << " have to be finite and ascending";
  if (!steps.empty())
  {
    text << ", but number " << bad << " is " << steps[bad];
  }
  if (bad > 0)
  {
    text << ", after " << steps[bad - 1];
  }
  text << (areOfInput ? "; check what is upstream (TIME_STEPS)."
                      : "; check StartTime and TimeStepSize (which has to be > 0, and not lost in "
                        "rounding beside StartTime).");
  throw std::invalid_argument(text.str());
}

void CheckStrategy(const Motion& motion)
{
  Require(IsZeroOrPositive(motion.Attraction), "Attraction has to be a finite number >= 0.");
  Require(IsZeroOrPositive(motion.Tension),
    "Tension has to be a finite number >= 0: a negative one would be unstable.");
  constexpr double leastCFL = 1e-6; // below, what a substep moves is lost in rounding
  Require(motion.CFL >= leastCFL && motion.CFL <= 1.0, "CFL has to be between 1e-6 and 1.");
  Require(IsZeroOrPositive(motion.AreaStiffness), "AreaStiffness has to be a finite number >= 0.");
  Require(
    IsZeroOrPositive(motion.VolumeStiffness), "VolumeStiffness has to be a finite number >= 0.");
  Require(IsZeroOrPositive(motion.TargetArea),
    "TargetArea has to be a finite number > 0, or 0 for the area at the start.");
  Require(IsZeroOrPositive(motion.TargetVolume),
    "TargetVolume has to be a finite number > 0, or 0 for the volume at the start.");
  Require(motion.AreaControl != Control::Exact || motion.VolumeControl != Control::Exact,
    "AreaControl and VolumeControl cannot both be EXACT, as one displacement cannot restore two "
    "numbers; make one of them PENALTY.");
}

SurfaceDomain MakeDomainOf(const SurfaceSettings& settings, const double bounds[6])
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
  domain.VoxelSize = settings.VoxelSize > 0.0 ? settings.VoxelSize : longest / 64.0;
  if (domain.VoxelSize != 0.0 && !IsLength(domain.VoxelSize))
  {
    std::ostringstream text;
    text << "VoxelSize, which is not set, would be " << domain.VoxelSize
         << ", a 64th of the longest side of ModelBounds, or of the target; it has to be between "
         << ShortestLength << " and " << LongestLength << ".";
    throw std::invalid_argument(text.str());
  }
  domain.Reach = settings.Reach > 0.0 ? settings.Reach : std::sqrt(square) / 8.0;
  return domain;
}

}

bool SurfaceSettings::operator==(const SurfaceSettings& other) const
{
  const auto all = [](const SurfaceSettings& s)
  {
    const Motion& m = s.Strategy;
    return std::tie(s.TargetFunction, s.InputMoves, s.TargetStamp, s.Particles.Radius,
      s.Particles.Threshold, s.Particles.Kernel, s.MeshThickness, s.Arrays, s.IsoValue, s.Invert,
      s.Normalize, s.Reach, s.InitialFunction, s.HasInitialInput, s.InitialStamp, s.VoxelSize,
      s.BoundsGiven, s.Bounds, s.Bounded, m.Attraction, m.Tension, m.CFL, m.AreaControl,
      m.VolumeControl, m.AreaStiffness, m.VolumeStiffness, m.TargetArea, m.TargetVolume,
      m.Evaluation, m.Gradient, m.Paper, s.Settles, s.Rest.Tolerance, s.Rest.MaximumSubsteps,
      s.Steps, s.InputSteps, s.OnlyForward, s.TimeScale);
  };
  return all(*this) == all(other);
}

bool SurfaceSettings::AreContinuedBy(const SurfaceSettings& others) const
{
  const std::size_t known = this->InputSteps.size();
  SurfaceSettings same = others;
  same.InputMoves = this->InputMoves;
  same.TargetStamp = this->TargetStamp;
  same.Steps = this->Steps;
  same.InputSteps = this->InputSteps;
  return this->UsesInput() && !this->Settles && known > 0 && others.InputSteps.size() > known &&
    std::equal(this->InputSteps.begin(), this->InputSteps.end(), others.InputSteps.begin()) &&
    same == *this;
}

bool SurfaceSettings::HasStepsOfInput() const
{
  return this->OnlyForward || this->InputSteps.size() > 1;
}

double SurfaceSettings::GetMotionTime(double pipelineTime) const
{
  return this->TimeScale * (pipelineTime - this->Steps.front());
}

void SurfaceSettings::Check() const
{
  Require(this->VoxelSize == 0.0 || IsLength(this->VoxelSize),
    "VoxelSize has to be between 1e-30 and 1e30, or 0 for a 64th of the bounds' longest side.");
  Require(IsZeroOrPositive(this->Reach),
    "TargetReach has to be a finite number > 0, or 0 for an eighth of the bounds' diagonal.");
  Require(std::isfinite(this->IsoValue), "TargetIsoValue has to be a finite number.");
  CheckStrategy(this->Strategy);
  Require(IsZeroOrPositive(this->Rest.Tolerance), "RestTolerance has to be a finite number >= 0.");
  Require(IsPositive(this->TimeScale), "TimeScale has to be a finite number > 0.");
  Require(this->Particles.Radius == 0.0 || IsLength(this->Particles.Radius),
    "ParticleRadius has to be between 1e-30 and 1e30, or 0 for one that is estimated.");
  Require(IsPositive(this->Particles.Threshold),
    "ParticleThreshold has to be a finite number > 0: at 0 or below, all space is inside.");
  Require(this->MeshThickness >= 0.0 && this->MeshThickness <= LongestLength,
    "MeshThickness has to be between 0 and 1e30.");
  CheckSteps(this->Steps, this->HasStepsOfInput());
  Require(std::isfinite(this->GetMotionTime(this->Steps.back())),
    "The motion time of the last step, TimeScale * (its time - that of the first step), has to be "
    "finite; check TimeScale, StartTime, TimeStepSize and NumberOfTimeSteps, or the time steps of "
    "the input.");
  if (this->BoundsGiven)
  {
    CheckBounds(this->Bounds);
  }
}

bool SurfaceDomain::GetExtent(int extent[6]) const
{
  constexpr double rounding = 1e-6; // a bound on a node, but for rounding, is that node
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
  return MakeDomainOf(settings, settings.Bounds.data());
}

SurfaceDomain MakeDomain(
  const SurfaceSettings& settings, vtkBoundingBox shapes, const vtkBoundingBox& images)
{
  if (shapes.IsValid())
  {
    shapes.Inflate(shapes.GetMaxLength() / 8.0);
  }
  shapes.AddBox(images);
  if (images.IsValid())
  {
    // The longest side then is 64 voxels.
    const double voxel =
      settings.VoxelSize > 0.0 ? settings.VoxelSize : shapes.GetMaxLength() / 60.0;
    shapes.Inflate(2.0 * voxel);
  }
  double bounds[6];
  shapes.GetBounds(bounds);
  return MakeDomainOf(settings, bounds);
}

}
