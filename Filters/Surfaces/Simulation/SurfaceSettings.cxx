#include "Simulation/SurfaceSettings.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <type_traits>

namespace activesurface
{

namespace
{

template <class Value>
void AppendNumbers(const Value& value, std::vector<double>& numbers)
{
  numbers.push_back(static_cast<double>(value));
}

void AppendNumbers(const std::array<double, 6>& values, std::vector<double>& numbers)
{
  numbers.insert(numbers.end(), values.begin(), values.end());
}

// Returns the values of all properties, to compare settings.
std::vector<double> ListNumbers(const SurfaceSettings& settings)
{
  std::vector<double> numbers;
  ForEachProperty(settings,
    [&numbers](const Property&, const auto& value, auto&&) { AppendNumbers(value, numbers); });
  return numbers;
}

void Require(bool condition, const char* sentence)
{
  if (!condition)
  {
    throw std::invalid_argument(sentence);
  }
}

void CheckPeriodic(const std::array<double, 6>& bounds)
{
  bool isFinite = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    isFinite = isFinite && std::isfinite(bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  Require(isFinite,
    "PeriodicBounds has to be (xmin, xmax, ymin, ymax, zmin, zmax), finite; an axis with min >= "
    "max "
    "is not periodic.");
}

void CheckBox(const Property& property, const std::array<double, 6>& bounds)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = bounds[2 * axis];
    const double high = bounds[2 * axis + 1];
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
    {
      std::ostringstream text;
      text << property.Name
           << " has to be (xmin, xmax, ymin, ymax, zmin, zmax) with finite min < max on each axis; "
              "on axis "
           << "xyz"[axis] << " it is " << low << ", " << high << ".";
      throw std::invalid_argument(text.str());
    }
  }
}

// Returns the index of the first step that is not finite or not after the previous step; the number
// of steps if all steps are valid.
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
    text << ", but step " << bad << " (counted from 0) is " << steps[bad];
  }
  if (bad > 0)
  {
    text << ", after " << steps[bad - 1];
  }
  text << (areOfInput
      ? "; check the TIME_STEPS of the source, the requested times or, with Advance, "
        "StartTime."
      : "; check StartTime and TimeStepSize (> 0, and large enough to change "
        "StartTime when added).");
  throw std::invalid_argument(text.str());
}

}

bool SurfaceInputs::operator==(const SurfaceInputs& other) const
{
  // The bindings list all members, so a new member that is missing here is a compile error.
  const auto compare = [](const SurfaceInputs& a, const SurfaceInputs& b)
  {
    const auto& [function, moves, time, initial, hasInitial, initialTime, obstacle, obstacleTime,
      arrays, steps, inputSteps, forward] = a;
    const auto& [function2, moves2, time2, initial2, hasInitial2, initialTime2, obstacle2,
      obstacleTime2, arrays2, steps2, inputSteps2, forward2] = b;
    return function == function2 && moves == moves2 && time == time2 && initial == initial2 &&
      hasInitial == hasInitial2 && initialTime == initialTime2 && obstacle == obstacle2 &&
      obstacleTime == obstacleTime2 && arrays == arrays2 && steps == steps2 &&
      inputSteps == inputSteps2 && forward == forward2;
  };
  return compare(*this, other);
}

bool SurfaceSettings::operator==(const SurfaceSettings& other) const
{
  return this->Inputs == other.Inputs && ListNumbers(*this) == ListNumbers(other);
}

bool SurfaceSettings::AreContinuedBy(const SurfaceSettings& others) const
{
  const std::vector<double>& known = this->Inputs.InputSteps;
  const std::vector<double>& all = others.Inputs.InputSteps;
  SurfaceSettings same = others;
  same.Inputs.TargetMoves = this->Inputs.TargetMoves;
  same.Inputs.TargetMTime = this->Inputs.TargetMTime;
  same.Inputs.Steps = this->Inputs.Steps;
  same.Inputs.InputSteps = known;
  return this->UsesInput() && !this->IsEquilibrium() && !known.empty() &&
    all.size() > known.size() && std::equal(known.begin(), known.end(), all.begin()) &&
    same == *this;
}

std::vector<std::pair<std::string, double>> SurfaceSettings::ListForFiles() const
{
  std::vector<std::pair<std::string, double>> list;
  ForEachProperty(*this,
    [this, &list](const Property& property, const auto& value, auto&&)
    {
      // Files store the voxel size itself, and boxes are not numbers.
      if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, std::array<double, 6>>)
      {
        const double number = static_cast<double>(value);
        if (static_cast<const void*>(&value) != &this->VoxelSize)
        {
          list.emplace_back(property.Name, number);
        }
      }
    });
  return list;
}

void CheckProperty(const Property& property, double value)
{
  if (!property.Range.Includes(value))
  {
    std::ostringstream text;
    text << property.Name << " has to be " << property.Range.Words << ", but is " << value << ".";
    throw std::invalid_argument(text.str());
  }
}

bool SurfaceSettings::CanShareSpace() const
{
  const bool hasControl = this->Parameters.VolumeControl != Control::None ||
    this->Parameters.AreaControl != Control::None;
  const bool hasRadii = !this->Inputs.Arrays.front().empty();
  if (!this->UsesInput() || !this->UsesNodes() || !this->Inputs.TargetMoves ||
    this->StartsElsewhere() || this->Particles.Model != ParticleModel::Anisotropic ||
    this->Particles.ArePeriodic() || hasControl || hasRadii)
  {
    return false;
  }
  const std::vector<double>& steps = this->Inputs.Steps;
  for (std::size_t i = 1; i < steps.size() && !this->HasAutomaticAttraction(); ++i)
  {
    const double factors = this->Attraction * this->TimeScale * (steps[i] - steps[i - 1]);
    if (!(factors >= FewestFactorsOfNodes))
    {
      return false;
    }
  }
  return true;
}

Motion SurfaceSettings::GetLaw() const
{
  Motion motion = this->Parameters;
  motion.Attraction = this->Attraction == Automatic ? Motion().Attraction : this->Attraction;
  motion.Tension = this->Tension == Automatic ? 0.0 : this->Tension;
  return motion;
}

const char* SurfaceSettings::FindWhatNeedsSubsteps() const
{
  const Motion& motion = this->Parameters;
  const bool isSum = this->Particles.Model == ParticleModel::Sum;
  const std::pair<bool, const char*> needs[] = {
    { motion.Paper, "PaperScheme" },
    { this->Integration == IntegrationChoice::Explicit, "TimeIntegration EXPLICIT" },
    { !this->UsesInput(), "TargetFunction" },
    { this->IsEquilibrium(), "EvolutionMode EQUILIBRIUM" },
    { motion.Evaluation != TargetEvaluation::Shifted, "TargetEvaluation other than SHIFTED" },
    { motion.Gradient != GradientScheme::Upwind, "GradientScheme CENTRAL" },
    { motion.VolumeControl == Control::Penalty, "VolumeControl PENALTY" },
    { motion.AreaControl == Control::Penalty, "AreaControl PENALTY" },
    { !motion.CreateParts, "CreateParts off" },
    { !this->Normalize, "NormalizeTarget off" },
    { this->Invert, "InvertTarget" },
    { isSum ? this->IsoValue >= this->Particles.Threshold : this->IsoValue != 0.0,
      isSum ? "TargetIsoValue not below ParticleThreshold" : "TargetIsoValue other than 0" },
  };
  for (const auto& [isNeeded, name] : needs)
  {
    if (isNeeded)
    {
      return name;
    }
  }
  return nullptr;
}

void SurfaceSettings::Check() const
{
  ForEachProperty(*this,
    [this](const Property& property, const auto& value, auto&&)
    {
      if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, std::array<double, 6>>)
      {
        CheckProperty(property, static_cast<double>(value));
      }
      else if (&value == &this->Particles.Periodic)
      {
        CheckPeriodic(value);
      }
      else if (this->HasBounds())
      {
        CheckBox(property, value);
      }
    });
  Require(this->Parameters.AreaControl != Control::Exact ||
      this->Parameters.VolumeControl != Control::Exact,
    "AreaControl and VolumeControl cannot both be EXACT, as one displacement cannot restore two "
    "numbers; set one of them to PENALTY or NONE.");
  Require(!this->Particles.ArePeriodic() ||
      (this->Parameters.VolumeControl == Control::None &&
        this->Parameters.AreaControl == Control::None),
    "VolumeControl and AreaControl need a skin that ends within the box, but PeriodicBounds "
    "continues the skin across the sides; set both controls to NONE, or unset PeriodicBounds.");
  Require(this->ArrivalTime == 0.0 || !this->Inputs.TargetMoves || this->IsEquilibrium(),
    "ArrivalTime needs a target that stands still, but the input moves in time; set ArrivalTime "
    "to 0, or connect an input with one time step.");
  Require(this->ArrivalTime == 0.0 || (this->Normalize && !this->Parameters.Paper),
    "ArrivalTime needs distances, and is no part of the paper's scheme; turn NormalizeTarget on "
    "and PaperScheme off, or set ArrivalTime to 0.");
  CheckSteps(this->Inputs.Steps, this->Inputs.HaveOwnSteps());
  Require(std::isfinite(this->GetMotionTimeOf(this->GetNumberOfSteps() - 1).Value),
    "The motion time of the last time step, TimeScale * (last time - first time), has to be "
    "finite; check TimeScale, StartTime, TimeStepSize and NumberOfTimeSteps, or the time steps of "
    "the input.");
  Require(std::isfinite(this->GetArrival().Value),
    "The motion time of the arrival, TimeScale * ArrivalTime, has to be finite; lower "
    "TimeScale or ArrivalTime.");
}

}
