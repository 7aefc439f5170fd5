// Particles as the target: their motion between steps, their shapes, and the particles that count.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/TestFolders.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataReader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestParticles
{
namespace
{
constexpr double VoxelSize = 0.05;

vtkSmartPointer<ParticleSource> MakeSource(const ParticleSource::Cloud& cloud)
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  source->SetCloud(cloud);
  source->SetSteps({ 0.0, 1.0, 2.0 });
  return source;
}

std::string BytesOver(const ParticleSource::Cloud& cloud, double time)
{
  return GetBytesAt(MakeSkinOver(MakeSource(cloud)), time);
}

void UseNoIds(vtkActiveImplicitSurface* filter)
{
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
}

double GetCentre(vtkActiveImplicitSurface* filter)
{
  const auto bounds = GetSkinBounds(filter);
  return 0.5 * (bounds[0] + bounds[1]);
}

// Three particles that move apart.
std::vector<Particle> Three(double t)
{
  return { { -0.5 - 0.1 * t, 0.0, 0.0, 3 }, { 0.1 * t, 0.0, 0.0, 9 }, { 0.5, 0.1 * t, 0.0, -4 } };
}

vtkSmartPointer<vtkPolyData> MakePoints(const std::vector<std::array<double, 3>>& positions)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& position : positions)
  {
    points->InsertNextPoint(position.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

template <class Array>
void AddArray(vtkPointSet* points, const char* name, const std::vector<double>& values)
{
  vtkNew<Array> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextTuple1(value);
  }
  points->GetPointData()->AddArray(array);
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOverData(vtkPointSet* points)
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInputData(points);
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(0.3);
  filter->SetVoxelSize(VoxelSize);
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  return filter;
}

}

// A ball of speed 0.2 lags behind by 0.2 / Attraction; tolerance 0.12 h as for a function.
TEST(TestParticles, SkinFollowsParticlesBetweenSteps)
{
  auto filter = MakeSkinOver(MakeSource(MovingBall));
  for (const double time : { 0.75, 1.0, 1.5, 2.0 })
  {
    filter->UpdateTimeStep(time);
    const double lag = 0.2 / 10.0 * (1.0 - std::exp(-10.0 * time));
    EXPECT_NEAR(GetCentre(filter), 0.2 * time - lag, 0.12 * VoxelSize) << "centre at " << time;
  }
}

TEST(TestParticles, ParticlesAreMatchedByTheirIds)
{
  const auto shuffled = [](double t)
  {
    const std::vector<Particle> p = Three(t);
    return t == 1.0 ? std::vector<Particle>{ p[2], p[0], p[1] } : p;
  };
  EXPECT_TRUE(AreSameSkins(BytesOver(shuffled, 1.0), BytesOver(Three, 1.0)))
    << "shuffled in the later step";

  auto numbered = MakeSkinOver(MakeSource(shuffled));
  UseNoIds(numbered);
  EXPECT_TRUE(GetBytesAt(numbered, 1.0) != BytesOver(Three, 1.0)) << "not so by number";
  auto plain = MakeSkinOver(MakeSource(Three));
  UseNoIds(plain);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(plain, 1.0), BytesOver(Three, 1.0)))
    << "by number if they are in order";
}

// TestBirths tests the fade itself.
TEST(TestParticles, ParticleThatIsMissingLaterFadesOut)
{
  const auto still = [](double) { return Three(0.0); };
  const auto missing = [](double t)
  {
    const std::vector<Particle> p = Three(0.0);
    return t == 1.0 ? std::vector<Particle>{ p[1], p[2] } : p;
  };
  auto filter = MakeSkinOver(MakeSource(missing));
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.0), BytesOver(still, 0.0)))
    << "not before its last step";
  const double left = GetSkinBounds(filter)[0];
  filter->UpdateTimeStep(0.4);
  EXPECT_LT(left + 0.5 * VoxelSize, GetSkinBounds(filter)[0]) << "from then on";
  filter->UpdateTimeStep(1.0);
  EXPECT_GT(GetSkinBounds(filter)[0], -0.2) << "gone at the next step";
}

// The new particle is so near to an old one that it attracts the old one's skin.
TEST(TestParticles, NewParticleFadesIn)
{
  const auto two = [](double)
  {
    const std::vector<Particle> p = Three(0.0);
    return std::vector<Particle>{ p[0], p[1] };
  };
  const auto born = [two](double t)
  {
    std::vector<Particle> p = two(t);
    if (t == 2.0)
    {
      p.push_back({ 0.15, 0.0, 0.0, 100 });
    }
    return p;
  };
  EXPECT_TRUE(AreSameSkins(BytesOver(born, 1.0), BytesOver(two, 1.0)))
    << "not before the step without it";
  auto filter = MakeSkinOver(MakeSource(born));
  filter->UpdateTimeStep(1.0);
  const double before = GetSkinBounds(filter)[1];
  filter->UpdateTimeStep(1.5);
  const double half = GetSkinBounds(filter)[1];
  filter->UpdateTimeStep(2.0);
  EXPECT_LT(before + 0.5 * VoxelSize, half) << "half there half the way";
  EXPECT_LT(half + 0.5 * VoxelSize, GetSkinBounds(filter)[1]) << "all there at its own step";
}

TEST(TestParticles, WithoutIdsOtherCountsAreCrossFaded)
{
  const auto growing = [](double t)
  {
    std::vector<Particle> p = Three(0.0);
    if (t == 1.0)
    {
      p.insert(p.begin(), { 0.8, 0.8, 0.8, 1 });
    }
    return p;
  };
  const auto still = [](double) { return Three(0.0); };
  auto filter = MakeSkinOver(MakeSource(growing));
  UseNoIds(filter);
  filter->CreatePartsOff();
  filter->UpdateTimeStep(1.0);
  const auto bounds = GetSkinBounds(filter);
  auto other = MakeSkinOver(MakeSource(still));
  other->UpdateTimeStep(1.0);
  // Without CreateParts no skin appears around an isolated particle. The other particles fade out
  // and in at the same positions, so their sum is constant.
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], GetSkinBounds(other)[i], 1e-4 * VoxelSize) << "they stay";
  }
}

// From halfway on, no sum exceeds the threshold.
TEST(TestParticles, NoParticlesLaterMakeTheSkinVanish)
{
  const auto leaving = [](double t) { return t < 1.0 ? MovingBall(0.0) : std::vector<Particle>(); };
  auto filter = MakeSkinOver(MakeSource(leaving));
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.4);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles between the steps";
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles at the step without any";
  EXPECT_TRUE(filter->GetOutput()->GetPoints() != nullptr) << "the output is valid";
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles after it";
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "has vanished"), 1) << "warnings";
  EXPECT_EQ(messages.Errors.size(), 0u) << "errors";
}

// The surface of a WYVILL ball is at kernel radius * sqrt(1 - cbrt(threshold / strength)).
// Crossings of chords are within h^2 / 8r, and this potential's curvature adds as much: 0.1 h.
TEST(TestParticles, RadiusAndStrengthComeFromArrays)
{
  vtkSmartPointer<vtkPolyData> points = MakePoints({ { -0.5, 0.0, 0.0 }, { 0.4, 0.0, 0.0 } });
  AddArray<vtkFloatArray>(points, "size", { 0.2, 0.3 });
  AddArray<vtkDoubleArray>(points, "weight", { 1.0, 2.0 });
  auto filter = MakeSkinOverData(points);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "size");
  filter->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "weight");
  filter->Update();
  const auto bounds = GetSkinBounds(filter);
  const double left = -0.5 - 0.2;
  const double right = 0.4 + 0.3 * std::sqrt((1.0 - std::cbrt(0.25)) / (1.0 - std::cbrt(0.5)));
  EXPECT_NEAR(bounds[0], left, 0.1 * VoxelSize) << "radius .2, strength 1";
  EXPECT_NEAR(bounds[1], right, 0.1 * VoxelSize) << "radius .3, strength 2";

  points->GetPointData()->SetActiveScalars("size");
  filter->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
  filter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  filter->Update();
  EXPECT_NEAR(GetSkinBounds(filter)[0], left, 0.1 * VoxelSize) << "as the active scalars";
}

TEST(TestParticles, ScalarsAloneAreNoRadii)
{
  vtkSmartPointer<vtkPolyData> points = MakePoints({ { 0.0, 0.0, 0.0 } });
  AddArray<vtkFloatArray>(points, "temperature", { 300.0 });
  points->GetPointData()->SetActiveScalars("temperature");
  auto filter = MakeSkinOverData(points);
  filter->Update();
  EXPECT_NEAR(GetSkinBounds(filter)[1], 0.3 * 0.4542, 0.1 * VoxelSize) << "radius of the skin";
}

TEST(TestParticles, KernelAndThresholdShapeTheSkin)
{
  auto filter = MakeSkinOverData(MakePoints({ { 0.0, 0.0, 0.0 } }));
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(0.6);
  const auto radius = [filter]
  {
    filter->Update();
    return GetSkinBounds(filter)[1];
  };
  EXPECT_NEAR(radius(), 0.6 * 0.4542, 0.1 * VoxelSize) << "WYVILL";
  filter->SetParticleKernelToCubicSpline();
  EXPECT_NEAR(radius(), 0.6 * 0.3611, 0.1 * VoxelSize) << "CUBIC_SPLINE";
  filter->SetParticleKernelToMetaball();
  EXPECT_NEAR(radius(), 0.6 * 0.4226, 0.1 * VoxelSize) << "METABALL";
  filter->SetParticleKernelToWyvill();
  filter->SetParticleThreshold(0.25);
  EXPECT_NEAR(radius(), 0.6 * std::sqrt(1.0 - std::cbrt(0.25)), 0.1 * VoxelSize) << "threshold";
}

// The filter and the potential compute the same formula. The start over particles is sampled only
// near the particles, which gives distances to 4e-6 voxel (TestSparseStart).
TEST(TestParticles, ParticlesActLikeASkeletonPotential)
{
  vtkSmartPointer<vtkPolyData> points =
    MakePoints({ { -0.2, 0.0, 0.0 }, { 0.2, 0.1, 0.0 }, { 0.0, -0.3, 0.2 } });
  auto input = MakeSkinOverData(points);
  auto function = MakeSkinOverData(points);
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetInput(points);
  potential->SetRadius(0.3);
  function->RemoveAllInputs();
  function->SetTargetFunction(potential);
  for (const double time : { 0.0, 1.0 })
  {
    input->UpdateTimeStep(time);
    function->UpdateTimeStep(time);
    const auto bounds = GetSkinBounds(input);
    for (int i = 0; i < 6; ++i)
    {
      EXPECT_NEAR(bounds[i], GetSkinBounds(function)[i], 1e-4 * VoxelSize) << "time " << time;
    }
    EXPECT_EQ(input->GetOutput()->GetNumberOfPoints(), function->GetOutput()->GetNumberOfPoints());
  }
}

TEST(TestParticles, SpacingIsEstimated)
{
  std::vector<std::array<double, 3>> lattice;
  for (int i = 0; i < 1000; ++i)
  {
    lattice.push_back({ 0.1 * (i % 10), 0.1 * (i / 10 % 10), 0.1 * (i / 100) });
  }
  lattice.push_back(lattice.front()); // a duplicate is no neighbour
  lattice.push_back({ 50.0, 0.0, 0.0 });
  auto estimated = MakeSkinOverData(MakePoints(lattice));
  estimated->SetKernelRadius(-1.0);
  MessageCapture messages(estimated);
  const std::string bytes = GetBytesAt(estimated, 0.1);
  estimated->UpdateTimeStep(0.2);
  estimated->UpdateTimeStep(0.1);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "a ParticleSpacing of 0.1, the estimated"), 1)
    << "warnings that say the value";
  auto given = MakeSkinOverData(MakePoints(lattice));
  given->SetKernelRadius(0.2);
  // The estimated spacing has rounding errors, so the bytes differ.
  EXPECT_NEAR(double(bytes.size()) / GetBytesAt(given, 0.1).size(), 1.0, 0.01) << "as 0.2";
}

TEST(TestParticles, PointsThatAreNotFiniteAreLeftOut)
{
  const double bad = std::numeric_limits<double>::quiet_NaN();
  const double far = std::numeric_limits<double>::infinity();
  auto filter = MakeSkinOverData(
    MakePoints({ { bad, 0.0, 0.0 }, { 0.1, 0.0, 0.0 }, { 0.0, far, 0.0 }, { -0.1, 0.0, 0.0 } }));
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  MessageCapture messages(filter);
  const std::string bytes = GetBytesAt(filter, 0.3);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "2 particles are left out"), 1) << "warnings";
  EXPECT_EQ(messages.Warnings.size(), 1u) << "warnings in all";
  auto good = MakeSkinOverData(MakePoints({ { 0.1, 0.0, 0.0 }, { -0.1, 0.0, 0.0 } }));
  good->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  EXPECT_TRUE(AreSameSkins(bytes, GetBytesAt(good, 0.3))) << "as without them";
}

TEST(TestParticles, BoundsComeFromTheParticles)
{
  auto filter = MakeSkinOverData(MakePoints({ { 100.0, 0.0, 0.0 }, { 100.2, 0.0, 0.0 } }));
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  filter->SetVoxelSize(-1.0);
  filter->OutputPotentialOn();
  filter->Update();
  // The supports' box is 0.8 long, and 1 with a margin of a quarter.
  EXPECT_NEAR(filter->GetPotential()->GetSpacing()[0], 1.0 / 64.0, 1e-9) << "voxel size";
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles";
}

TEST(TestParticles, AnyPointSetWillDo)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkSmartPointer<vtkPolyData> points = MakePoints({ { 0.0, 0.0, 0.0 }, { 0.2, 0.0, 0.0 } });
  grid->SetPoints(points->GetPoints());
  const vtkIdType first = 0;
  grid->InsertNextCell(VTK_VERTEX, 1, &first);
  EXPECT_TRUE(AreSameSkins(
    GetBytesAt(MakeSkinOverData(grid), 0.0), GetBytesAt(MakeSkinOverData(points), 0.0)))
    << "a vtkUnstructuredGrid with a vertex: all its points count";
}

// 41 time steps of 992 particles, 25 per second. The reader numbers the time steps 0, 1, 2 ...
TEST(TestParticles, TheSplashIsReadOnceAndStaysClosed)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((std::string(TestDataFolder) + "/sph_drop.vtp").c_str());
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputConnection(reader->GetOutputPort());
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(0.2);
  filter->SetVoxelSize(0.06);
  filter->SetAttraction(50.0);
  filter->SetTimeScale(1.0 / 25.0);
  MessageCapture messages(filter);
  int executions = 0;
  CountExecutions(reader, executions);
  for (int step = 0; step < 41; step += 8)
  {
    filter->UpdateTimeStep(step);
    vtkPolyData* skin = filter->GetOutput();
    // A closed surface has 3 edges for 2 triangles, hence an even number of triangles.
    EXPECT_GT(skin->GetNumberOfPolys(), 1000) << "triangles at step " << step;
    EXPECT_EQ(skin->GetNumberOfPolys() % 2, 0) << "odd number of triangles";
  }
  EXPECT_EQ(executions, 41) << "executions of the reader";
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

}
