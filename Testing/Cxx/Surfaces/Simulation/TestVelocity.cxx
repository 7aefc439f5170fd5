// Velocity of the skin through the filter. The normal part is compared with finite differences of
// the skin itself, the tangential part with the velocity of the particles.

#include "Support/GrainTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkImplicitPolyDataDistance.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

using namespace activesurface;

namespace TestVelocity
{

using Cloud = std::function<std::vector<Grain>(double time)>;
constexpr double Voxel = 0.02;

vtkSmartPointer<vtkActiveImplicitSurface> MakeMovingSkin(const Cloud& cloud)
{
  auto filter = MakeSkinOver(MakeSource(
    [cloud](double time) { return MakeCloud(cloud(time)); }, { 0.0, 1.0, 2.0, 3.0, 4.0 }));
  filter->SetVoxelSize(Voxel);
  filter->SetModelBounds(-1.5, 1.5, -1.0, 1.0, -1.0, 1.0);
  filter->ComputeVelocityOn();
  return filter;
}

struct Comparison
{
  double Error = 0.0; // mean of |emitted - difference|, over the mean speed
  double Speed = 0.0; // mean
  std::size_t Points = 0;
};

// Compares the velocity with the central difference in time of the distance to the skin, at the
// points of the skin. If the skin splits, points within two voxels of the plane x = 0 are ignored,
// because the difference is undefined where two surfaces meet.
Comparison Compare(vtkActiveImplicitSurface* filter, double time, double interval, bool tears)
{
  filter->UpdateTimeStep(time);
  vtkNew<vtkPolyData> skin;
  skin->DeepCopy(filter->GetOutput());
  vtkDataArray* velocity = skin->GetPointData()->GetArray("Velocity");
  vtkDataArray* normals = skin->GetPointData()->GetArray("Normals");
  const auto distancesAt = [&](double t)
  {
    filter->UpdateTimeStep(t);
    vtkNew<vtkImplicitPolyDataDistance> distance;
    distance->SetInput(filter->GetOutput());
    std::vector<double> distances;
    for (vtkIdType v = 0; v < skin->GetNumberOfPoints(); ++v)
    {
      distances.push_back(distance->FunctionValue(skin->GetPoint(v)));
    }
    return distances;
  };
  const std::vector<double> before = distancesAt(time - interval);
  const std::vector<double> after = distancesAt(time + interval);
  Comparison comparison;
  for (vtkIdType v = 0; v < skin->GetNumberOfPoints(); ++v)
  {
    if (tears && std::fabs(skin->GetPoint(v)[0]) < 2.0 * Voxel)
    {
      continue;
    }
    double speed = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      speed += velocity->GetComponent(v, axis) * normals->GetComponent(v, axis);
    }
    const double difference = (before[v] - after[v]) / (2.0 * interval);
    comparison.Error += std::fabs(speed - difference);
    comparison.Speed += std::fabs(difference);
    ++comparison.Points;
  }
  comparison.Error /= comparison.Speed;
  comparison.Speed /= double(comparison.Points);
  return comparison;
}

int CountParts(vtkActiveImplicitSurface* filter, double time)
{
  filter->UpdateTimeStep(time);
  const vtkIdType last = filter->GetHistory()->GetNumberOfRows() - 1;
  return filter->GetHistory()->GetValueByName(last, "Components").ToInt();
}

// Chords of the skin's triangles are off by h^2 / (8 r), 0.0004 here, and the skin moves 0.01 to
// 0.02 over the interval. Their ratio is the error of the measurement.
TEST(TestVelocity, VelocityOfATranslatingSkinIsItsDifference)
{
  auto filter = MakeMovingSkin(
    [](double time) {
      return std::vector<Grain>{ { 0.2 * time - 0.4, 0.0, 0.0, 1, 0.0 } };
    });
  const Comparison comparison = Compare(filter, 2.5, 0.1, false);
  EXPECT_GT(comparison.Speed, 0.05) << "mean speed, .1 on a ball that goes at .2";
  EXPECT_LT(comparison.Error, 0.05) << "mean error of it";
}

// With an Attraction above 2 per step, AUTOMATIC makes one step per time step, with Transport. At
// the last time the velocity is that of the preceding interval.
TEST(TestVelocity, VelocityOfACarriedSkinIsItsDifference)
{
  auto filter = MakeMovingSkin(
    [](double time) {
      return std::vector<Grain>{ { 0.2 * time - 0.4, 0.0, 0.0, 1, 0.0 } };
    });
  filter->SetAttraction(3.0);
  filter->SetTimeIntegrationToAutomatic();
  for (const double time : { 2.5, 3.0 })
  {
    const Comparison comparison = Compare(filter, time, 0.1, false);
    EXPECT_GT(comparison.Speed, 0.05) << "mean speed, .1 on a ball that goes at .2";
    EXPECT_LT(comparison.Error, 0.05) << "mean error of it at " << time;
  }
  filter->UpdateTimeStep(4.0);
  double range[2];
  filter->GetOutput()->GetPointData()->GetArray("Velocity")->GetRange(range, 0);
  EXPECT_NEAR(range[1], 0.2, 0.01) << "along the way, at its end";
}

TEST(TestVelocity, VelocityOfAGrowingSkinIsItsDifference)
{
  // Six grains that move apart while they are one body.
  auto filter = MakeMovingSkin(
    [](double time)
    {
      const double d = 0.1 * time;
      return std::vector<Grain>{ { -d, 0.0, 0.0, 1, 0.0 }, { d, 0.0, 0.0, 2, 0.0 },
        { 0.0, -d, 0.0, 3, 0.0 }, { 0.0, d, 0.0, 4, 0.0 }, { 0.0, 0.0, -d, 5, 0.0 },
        { 0.0, 0.0, d, 6, 0.0 } };
    });
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(0.6);
  const Comparison comparison = Compare(filter, 2.5, 0.5, false);
  EXPECT_GT(comparison.Speed, 0.005) << "mean speed";
  EXPECT_LT(comparison.Error, 0.05) << "mean error of it";
}

TEST(TestVelocity, VelocityOfASplittingSkinIsItsDifference)
{
  auto filter = MakeMovingSkin(
    [](double time)
    {
      const double d = 0.06 + 0.1 * time;
      return std::vector<Grain>{ { -d, 0.0, 0.0, 1, 0.0 }, { d, 0.0, 0.0, 2, 0.0 } };
    });
  filter->SetMaximumVelocity(1e30); // the ends of a torn neck outrun the particles
  EXPECT_EQ(CountParts(filter, 1.0), 1) << "parts at first";
  EXPECT_EQ(CountParts(filter, 2.0), 2) << "parts in the end";
  for (const double time : { 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 3.25 })
  {
    const Comparison comparison = Compare(filter, time, 0.2, true);
    EXPECT_GT(comparison.Speed, 0.01) << "mean speed at " << time;
    EXPECT_LT(comparison.Error, 0.05) << "mean error of it";
  }
}

// Largest difference between the velocity and a vector, without the normal component.
double CompareDrift(vtkActiveImplicitSurface* filter, const std::array<double, 3>& expected)
{
  vtkPointData* arrays = filter->GetOutput()->GetPointData();
  double worst = 0.0;
  for (vtkIdType v = 0; v < filter->GetOutput()->GetNumberOfPoints(); ++v)
  {
    double difference[3], along = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      difference[axis] = arrays->GetArray("Velocity")->GetComponent(v, axis) - expected[axis];
      along += difference[axis] * arrays->GetArray("Normals")->GetComponent(v, axis);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const double normal = arrays->GetArray("Normals")->GetComponent(v, axis);
      worst = std::max(worst, std::fabs(difference[axis] - along * normal));
    }
  }
  return worst;
}

// Mean length of the difference between the velocity and a field, over the field's mean length.
double CompareWhole(vtkActiveImplicitSurface* filter,
  const std::function<std::array<double, 3>(const double* x)>& field)
{
  vtkPolyData* skin = filter->GetOutput();
  vtkDataArray* velocity = skin->GetPointData()->GetArray("Velocity");
  double error = 0.0, whole = 0.0;
  for (vtkIdType v = 0; v < skin->GetNumberOfPoints(); ++v)
  {
    const std::array<double, 3> expected = field(skin->GetPoint(v));
    const double* found = velocity->GetTuple3(v);
    error += std::hypot(found[0] - expected[0], found[1] - expected[1], found[2] - expected[2]);
    whole += std::hypot(expected[0], expected[1], expected[2]);
  }
  return error / whole;
}

// A slab of grains around the origin, along x and y, turned by an angle; 1.6 by 0.8, far larger
// than the kernels.
std::vector<Grain> MakeSlab(double angle, double shift)
{
  std::vector<Grain> grains;
  const double c = std::cos(angle), s = std::sin(angle);
  for (int i = -16; i <= 16; ++i)
  {
    for (int j = -8; j <= 8; ++j)
    {
      const double x = 0.05 * i, y = 0.05 * j;
      grains.push_back({ c * x - s * y + shift, s * x + c * y, 0.0, int(grains.size()) + 1, 0.0 });
    }
  }
  return grains;
}

// Most of the slab's surface moves tangentially, so the normal part lacks most of the velocity.
TEST(TestVelocity, ATranslatingSlabHasItsWholeVelocity)
{
  auto filter = MakeMovingSkin([](double time) { return MakeSlab(0.0, 0.1 * time - 0.2); });
  const auto field = [](const double*) { return std::array<double, 3>{ 0.1, 0.0, 0.0 }; };
  for (const double time : { 1.0, 2.5, 4.0 })
  {
    filter->UpdateTimeStep(time);
    EXPECT_LT(CompareWhole(filter, field), 0.1) << "by default at " << time;
  }
  filter->TangentialVelocityOff();
  filter->UpdateTimeStep(2.5);
  EXPECT_GT(CompareWhole(filter, field), 0.5) << "only the normal part";
}

TEST(TestVelocity, ATurningSlabHasItsWholeVelocity)
{
  constexpr double rate = 0.15; // a chord between steps is 0.1 % shorter than its arc
  auto filter = MakeMovingSkin([](double time) { return MakeSlab(rate * time, 0.0); });
  for (const double time : { 1.0, 3.0 })
  {
    filter->UpdateTimeStep(time);
    // Particles move straight from step to step: their velocity is that of half a step before.
    const double c = std::cos(0.5 * rate), s = std::sin(0.5 * rate);
    const auto field = [&](const double* x)
    {
      const double u = -rate * x[1], v = rate * x[0];
      return std::array<double, 3>{ c * u + s * v, c * v - s * u, 0.0 };
    };
    // At the rim the average comes from particles that are further in by up to a third of the
    // kernel radius of 0.3. They are slower by rate * 0.1, a fifth of the mean speed.
    EXPECT_LT(CompareWhole(filter, field), 0.2) << "by default at " << time;
  }
}

// All particles have the same velocity, and so has their average. Floats of size 0.2 are accurate
// to 2e-8, their products with unit normals to a few times that.
TEST(TestVelocity, DriftIsThatOfTheParticles)
{
  auto filter = MakeMovingSkin([](double time) { return MakeBlob(0.2 * time - 0.4); });
  filter->TangentialVelocityOn();
  for (const double time : { 0.0, 0.5, 1.0, 3.5, 4.0 })
  {
    filter->UpdateTimeStep(time);
    EXPECT_LT(CompareDrift(filter, { 0.2, 0.0, 0.0 }), 2e-7) << "drift at " << time;
  }
  filter->TangentialVelocityOff();
  filter->UpdateTimeStep(3.5);
  EXPECT_LT(CompareDrift(filter, { 0.0, 0.0, 0.0 }), 1e-7) << "none when it is not wanted";
}

// The unit is motion time, as for the velocity along the normal.
TEST(TestVelocity, DriftIsPerMotionTime)
{
  auto filter = MakeMovingSkin([](double time) { return MakeBlob(0.2 * time - 0.4); });
  filter->TangentialVelocityOn();
  filter->SetTimeScale(0.1);
  filter->UpdateTimeStep(2.0);
  EXPECT_LT(CompareDrift(filter, { 2.0, 0.0, 0.0 }), 2e-6) << "ten times as fast";
}

// The particles stand still, but their array describes a flow. The particles deep inside, with NaN,
// do not contribute to the skin.
TEST(TestVelocity, DriftComesFromTheChosenArray)
{
  auto source = MakeSource(
    [](double)
    {
      auto cloud = MakeCloud(MakeBlob(0.0));
      vtkNew<vtkDoubleArray> flow;
      flow->SetName("flow");
      flow->SetNumberOfComponents(3);
      for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
      {
        const double* x = cloud->GetPoint(i);
        const bool isDeep = std::hypot(x[0], x[1], x[2]) < 0.2;
        flow->InsertNextTuple3(isDeep ? std::nan("") : 0.0, 0.5, 0.25);
      }
      cloud->GetPointData()->AddArray(flow);
      return cloud;
    });
  auto filter = MakeSkinOver(source);
  filter->ComputeVelocityOn();
  filter->TangentialVelocityOn();
  filter->Update();
  EXPECT_LT(CompareDrift(filter, { 0.0, 0.0, 0.0 }), 1e-7) << "without the array";
  filter->ResetCounters();
  filter->SetInputArrayToProcess(5, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "flow");
  filter->Update();
  EXPECT_LT(CompareDrift(filter, { 0.0, 0.5, 0.25 }), 1e-6) << "with it";
  EXPECT_EQ(filter->GetSubsteps(), vtkIdType(0)) << "substeps for it";
}

TEST(TestVelocity, AnArrayThatIsNoVelocityIsRefused)
{
  auto filter = MakeMovingSkin([](double time) { return MakeBlob(0.1 * time); });
  MessageCapture messages(filter);
  filter->TangentialVelocityOn();
  filter->SetInputArrayToProcess(5, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "temperature");
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "three numbers"), 1)
    << "errors of one component";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), vtkIdType(0)) << "points";
  messages.Errors.clear();
  filter->SetInputArrayToProcess(5, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "none such");
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "none such"), 1) << "errors of a missing one";
  filter->TangentialVelocityOff();
  filter->UpdateTimeStep(1.0);
  EXPECT_GT(double(filter->GetOutput()->GetNumberOfPoints()), 100.0) << "points without the wish";
}

}
