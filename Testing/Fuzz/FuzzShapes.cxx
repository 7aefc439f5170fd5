// Two time steps of an arbitrary vtkPolyData (FuzzData.h), read and evaluated as in the filter, but
// without a skin: ten times as many executions per minute as FuzzTarget.

#include "FuzzData.h"

#include "Base/NodeTarget.h"
#include "Simulation/TargetBuilder.h"
#include "Targets/InputData.h"
#include "Targets/InputShape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <vector>

using namespace activesurface;

namespace
{

constexpr std::size_t MaximumNumberOfActiveVoxels = 2000;

// Chooses the arrays that the bits of `choices` select, by their names.
class FuzzArrays : public ChosenArrays
{
public:
  FuzzArrays(vtkPointData* arrays, int choices)
    : Arrays(arrays)
    , Choices(choices)
  {
  }

  vtkAbstractArray* FindRadii() const override { return this->Find(0); }
  vtkAbstractArray* FindIds() const override { return this->Find(1); }
  vtkAbstractArray* FindStrengths() const override { return this->Find(2); }
  vtkAbstractArray* FindVelocities() const override { return this->Find(3); }
  vtkAbstractArray* FindValues() const override { return nullptr; }

private:
  vtkAbstractArray* Find(int index) const
  {
    if (!(this->Choices >> index & 1))
    {
      return nullptr;
    }
    vtkAbstractArray* array = this->Arrays->GetAbstractArray(ArrayNames[index]);
    if (!array)
    {
      throw std::invalid_argument("missing, as the filter would say");
    }
    return array;
  }

  vtkPointData* Arrays;
  int Choices;
};

void SetProperties(FuzzInput& input, SurfaceSettings& settings)
{
  const int choices = input.Take<std::uint8_t>();
  settings.Inputs.TargetMoves = true;
  settings.Inputs.Steps = { 0.0, 1.0 };
  settings.VoxelSize = 0.5;
  settings.Particles.Model = static_cast<ParticleModel>(choices % 2);
  settings.Particles.Spacing = choices & 4 ? 0.4 : Automatic;
  settings.MeshThickness = choices & 8 ? 0.5 : 0.0;
  settings.Attraction = 1.0;
  settings.Parameters.Transport = choices & 16 ? 1.0 : 0.0;
  settings.Tension = choices & 32 ? 0.01 : 0.0;
  settings.Parameters.CreateParts = true;
}

void EvaluateLeaves(const NodeTarget& target, const Shell& shell)
{
  // The filter refuses more leaves than a sixteenth of the maximum of active voxels (NodeStep.cxx).
  constexpr std::size_t most = MaximumNumberOfActiveVoxels / 16;
  float values[512];
  LeafMotion motion;
  for (std::size_t i = 0; i < std::min(shell.Leaves.size(), most); ++i)
  {
    const ShellLeaf& leaf = shell.Leaves[i];
    target.EvaluateLeaf(leaf, values);
    for (int node = 0; node < 512; ++node)
    {
      if (leaf.Rows >> node / 8 & 1 && std::isnan(values[node]))
      {
        std::abort();
      }
    }
    target.FindMotion(leaf, motion);
    target.IsInside(leaf.Origin);
  }
}

void EvaluateTarget(MovingTarget& target)
{
  constexpr double Near = 0.7;
  constexpr std::size_t count = 4;
  const double points[3 * count] = { Center, Center, Center, Center + Near, Center, Center,
    Center - Near, Center + Near, Center, Center, Center - Near, Center + Near };
  double values[count], slopes[count];
  target.MoveAlong(0, 0.0, 1.0);
  for (const double time : { 0.0, 0.4, 1.0 })
  {
    target.MoveTo(time);
    target.Evaluate(count, points, { values, slopes });
    target.VisitRegions(0, target.CountRegionSources(), [](const TargetRegion&) {});
  }
  if (NodeTarget* nodes = target.GetNodes())
  {
    Shell shell;
    nodes->PlaceNodes({ 0.0, 0.4, 1.0, 0.5 });
    nodes->FindShell(true, shell);
    EvaluateLeaves(*nodes, shell);
  }
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  vtkObject::GlobalWarningDisplayOff();
  FuzzInput input(bytes, size);
  SurfaceSettings settings;
  SetProperties(input, settings);
  const int chosen = input.Take<std::uint8_t>();
  const ParticleArrays kept{ input.Below(2) == 0, chosen & 8 ? "velocity" : "" };
  Warnings messages;
  TargetBuilder builder(settings, messages);
  builder.SetMaximumNumberOfActiveVoxels(MaximumNumberOfActiveVoxels);
  try
  {
    for (int step = 0; step < 2; ++step)
    {
      const vtkSmartPointer<vtkPolyData> data = MakeData(input);
      builder.Add(step, MakeInputShape({ data, FuzzArrays(data->GetPointData(), chosen), kept }));
      builder.FindDomain();
    }
    if (builder.GetDomain())
    {
      builder.StartTarget();
      EvaluateTarget(*builder.GetMovingTarget());
    }
  }
  catch (const std::invalid_argument&)
  {
    // The data are unusable, or the two time steps do not fit together.
  }
  catch (const std::runtime_error&)
  {
    // The sizes exceed the guard.
  }
  return 0;
}
