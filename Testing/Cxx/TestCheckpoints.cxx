// States that are kept to go back to: what they cost, and that nothing can be told from them.

#include "Check.h"
#include "PipelineTools.h"
#include "SurfaceMeasures.h"

#include "vtkTable.h"
#include "vtkVariant.h"

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace activesurface;

namespace
{

// Two drops that meet and part again, in 31 steps; voxels of .08.
vtkSmartPointer<ParticleSource> MakeDrops()
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  std::vector<double> steps;
  for (int i = 0; i <= 30; ++i)
  {
    steps.push_back(0.1 * i);
  }
  source->SetSteps(steps);
  source->SetCloud(
    [](double time) -> std::vector<Particle>
    {
      const double apart = 0.1 + 0.25 * std::fabs(time - 1.5);
      return { { -apart, 0.0, 0.02, 1 }, { apart, 0.03, 0.0, 2 }, { 0.0, 0.9, 0.0, 3 } };
    });
  return source;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOverDrops(ParticleSource* source)
{
  auto filter = MakeSkinOver(source);
  filter->SetVoxelSize(0.08);
  filter->SetParticleRadius(0.6);
  filter->SetModelBounds(-1.5, 1.5, -1.5, 1.5, -1.0, 1.0);
  filter->SetAttraction(20.0);
  filter->SetTension(0.01);
  filter->SetVolumeControlToPenalty();
  return filter;
}

std::string TextOf(vtkTable* table)
{
  std::string text;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    for (vtkIdType column = 0; column < table->GetNumberOfColumns(); ++column)
    {
      text += table->GetValue(row, column).ToString() + " ";
    }
  }
  return text;
}

// Skin and history at a time.
std::string GetAllAt(vtkActiveImplicitSurface* filter, double time)
{
  const std::string skin = GetBytesAt(filter, time);
  return skin + TextOf(filter->GetHistory());
}

// 200 times in any order, a third of them between the steps; raw numbers of the generator, which
// are the same everywhere.
std::vector<double> DrawTimes(int count)
{
  std::mt19937 random(4);
  std::vector<double> times;
  for (int i = 0; i < count; ++i)
  {
    const double step = 0.1 * (random() % 30);
    times.push_back(random() % 3 ? step : step + 0.1 * (random() % 1000) / 1000.0);
  }
  return times;
}

// By a filter of its own that goes there directly.
std::string GetFresh(double time)
{
  auto source = MakeDrops();
  auto filter = MakeSkinOverDrops(source);
  filter->SetCheckpointInterval(0);
  return GetAllAt(filter, time);
}

void AnyOrderOfTimesGivesTheSameBytes(Check& check)
{
  auto source = MakeDrops();
  std::vector<vtkSmartPointer<vtkActiveImplicitSurface>> filters;
  for (const int interval : { 10, 3, 1 })
  {
    filters.push_back(MakeSkinOverDrops(source));
    filters.back()->SetCheckpointInterval(interval);
  }
  filters[1]->SetNumberOfThreads(1);
  std::map<double, std::string> fresh;
  std::size_t wrong = 0;
  const std::vector<double> times = DrawTimes(200);
  for (const double time : times)
  {
    if (!fresh.count(time))
    {
      fresh[time] = GetFresh(time);
    }
    for (const auto& filter : filters)
    {
      wrong += GetAllAt(filter, time) != fresh[time];
    }
  }
  check.Less(50, fresh.size(), "different times");
  check.Equal(wrong, std::size_t(0), "skins or histories that differ from a fresh run's");
}

// From the checkpoint to the step: nine steps at most of an interval of ten.
void GoingBackCostsLessThanAnInterval(Check& check)
{
  for (const int interval : { 10, 4 })
  {
    auto source = MakeDrops();
    auto filter = MakeSkinOverDrops(source);
    filter->SetCheckpointInterval(interval);
    GetBytesAt(filter, 3.0);
    filter->GetHistory();
    std::vector<int> substeps;
    for (vtkIdType row = 0; row < filter->GetHistory()->GetNumberOfRows(); ++row)
    {
      substeps.push_back(filter->GetHistory()->GetValueByName(row, "Substeps").ToInt());
    }
    for (const int step : { 29, 19, 13, 12, 7, 1, 0 })
    {
      int expected = 0;
      for (int i = step / interval * interval + 1; i <= step; ++i)
      {
        expected += substeps[i];
      }
      GetBytesAt(filter, 3.0);
      filter->ResetCounters();
      GetBytesAt(filter, 0.1 * step);
      check.Equal(filter->GetSubsteps(), vtkIdType(expected),
        "substeps back to step " + std::to_string(step) + ", interval " + std::to_string(interval));
    }
  }
}

void WithoutCheckpointsItStartsOver(Check& check)
{
  auto source = MakeDrops();
  for (const bool byInterval : { false, true })
  {
    auto filter = MakeSkinOverDrops(source);
    byInterval ? filter->SetCheckpointInterval(0) : filter->SetCheckpointMemory(0);
    GetBytesAt(filter, 1.0);
    const vtkIdType way = filter->GetSubsteps();
    GetBytesAt(filter, 2.0);
    filter->ResetCounters();
    GetBytesAt(filter, 1.0);
    check.Equal(filter->GetSubsteps(), way, "substeps of the way from the start");
  }
}

void ChangingTheCheckpointsDoesNotRestart(Check& check)
{
  auto source = MakeDrops();
  auto filter = MakeSkinOverDrops(source);
  GetBytesAt(filter, 1.0);
  filter->ResetCounters();
  filter->SetCheckpointInterval(5);
  filter->SetCheckpointMemory(100);
  GetBytesAt(filter, 1.0);
  check.Equal(filter->GetSubsteps(), vtkIdType(0), "substeps");
}

// 4 bytes per active voxel is the aim; the signs and masks are in it.
void PackedStateIsSmallAndGoesOnToTheSameBytes(Check& check)
{
  for (const int n : { 40, 96 })
  {
    for (const bool paper : { false, true })
    {
      NarrowBand band(VoxelSizeOf(n));
      StartOn(band, MakeSixMetaballs());
      ShapeTarget target(MakeTorus({ 0.01, 0.02, 0.013 }, 0.5, 0.22));
      Motion motion;
      motion.Tension = 0.01;
      motion.Paper = paper;
      motion.VolumeControl = Control::Penalty;
      band.Advance(0.1, motion, target);
      const std::string bytes = band.Pack();
      const auto other = NarrowBand::Unpack(bytes);
      const double active = double(band.GetNumberOfActiveNodes());
      check.Less(double(bytes.size()) / active, 4.0, "bytes per active voxel");
      check.True(AreIdentical(band, *other), "the same potential");
      band.Advance(0.2, motion, target);
      other->Advance(0.2, motion, target);
      check.True(AreIdentical(band, *other), "the same potential later");
    }
  }
}

void EmptySurfacePacks(Check& check)
{
  const NarrowBand band(0.1);
  check.True(NarrowBand::Unpack(band.Pack())->IsEmpty(), "it is still empty");
  for (const std::string& damaged : { std::string(), std::string(30, 'x'), std::string(100, 'x') })
  {
    check.Throws<std::exception>([&] { NarrowBand::Unpack(damaged); }, "", "damaged bytes");
  }
}

}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "AnyOrderOfTimesGivesTheSameBytes", AnyOrderOfTimesGivesTheSameBytes },
      { "GoingBackCostsLessThanAnInterval", GoingBackCostsLessThanAnInterval },
      { "WithoutCheckpointsItStartsOver", WithoutCheckpointsItStartsOver },
      { "ChangingTheCheckpointsDoesNotRestart", ChangingTheCheckpointsDoesNotRestart },
      { "PackedStateIsSmallAndGoesOnToTheSameBytes", PackedStateIsSmallAndGoesOnToTheSameBytes },
      { "EmptySurfacePacks", EmptySurfacePacks } });
}
