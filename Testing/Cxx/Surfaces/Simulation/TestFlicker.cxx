// A pool of particles with jitter: the skin flickers less than the particles' own surface, at the
// ratio that its rate predicts. Testing/Benchmarks/flicker.py prints the whole table.

#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"
#include "vtkStaticCellLocator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace activesurface;

namespace TestFlicker
{

namespace
{

constexpr int Frames = 40;
constexpr int FirstFrame = 10; // e^-3.3 of the start remains at the lowest rate
constexpr double Spacing = 0.1;
constexpr double Radius = 2.0 * Spacing;
constexpr double Jitter = 0.1 * Radius;
constexpr double Threshold = 2.5; // about half of the sum within the pool
constexpr double Voxel = 0.4 * Spacing;
constexpr double Top = 0.6;
constexpr double Bottom = 0.1;

using Heights = std::vector<double>;

// 12 by 12 by 4 particles at their lattice points, with jitter that is new in each frame: uniform,
// with the standard deviation Jitter.
vtkSmartPointer<vtkPolyData> MakePool(int frame)
{
  std::mt19937_64 generator(frame);
  std::uniform_real_distribution<double> jitter(-std::sqrt(3.0) * Jitter, std::sqrt(3.0) * Jitter);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < 576; ++i)
  {
    const int layer = i / 144;
    const double shift = layer % 2 == 0 ? 0.0 : 0.5;
    points->InsertNextPoint(Spacing * (i % 12 + shift) + jitter(generator),
      Spacing * (i / 12 % 12 + shift) + jitter(generator), Spacing * layer + jitter(generator));
  }
  auto pool = vtkSmartPointer<vtkPolyData>::New();
  pool->SetPoints(points);
  return pool;
}

// Heights of columns in the middle of the pool.
template <class GetHeight>
Heights MeasureColumns(GetHeight getHeight)
{
  Heights heights;
  for (int i = 0; i < 64; ++i)
  {
    heights.push_back(getHeight(0.4 + 0.05 * (i % 8), 0.4 + 0.05 * (i / 8)));
  }
  return heights;
}

// Exact heights of the iso-surface of the frame's own potential.
Heights MeasureFrame(int frame)
{
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetInput(MakePool(frame));
  potential->SetRadius(Radius);
  potential->SetThreshold(Threshold);
  return MeasureColumns(
    [&potential](double x, double y)
    {
      double inside = Bottom;
      double outside = Top;
      for (int i = 0; i < 40; ++i)
      {
        const double middle = 0.5 * (inside + outside);
        (potential->EvaluateFunction(x, y, middle) < 0.0 ? inside : outside) = middle;
      }
      return inside;
    });
}

Heights MeasureSkin(vtkPolyData* skin)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(skin);
  locator->BuildLocator();
  return MeasureColumns(
    [&locator](double x, double y)
    {
      const double above[3] = { x, y, Top };
      const double below[3] = { x, y, Bottom };
      double t;
      double hit[3];
      double coordinates[3];
      int part;
      return locator->IntersectWithLine(above, below, 0.0, t, hit, coordinates, part)
        ? hit[2]
        : std::nan("");
    });
}

// Root mean square of the second difference in time.
double GetFlicker(const std::vector<Heights>& rows)
{
  double sum = 0.0;
  int count = 0;
  for (std::size_t row = FirstFrame + 1; row + 1 < rows.size(); ++row)
  {
    for (std::size_t i = 0; i < rows[row].size(); ++i, ++count)
    {
      const double difference = rows[row - 1][i] - 2.0 * rows[row][i] + rows[row + 1][i];
      sum += difference * difference;
    }
  }
  return std::sqrt(sum / count);
}

double GetFlickerOfFrames()
{
  std::vector<Heights> rows;
  for (int frame = 0; frame < Frames; ++frame)
  {
    rows.push_back(MeasureFrame(frame));
  }
  return GetFlicker(rows);
}

double GetFlickerOfSkin(double rate)
{
  std::vector<double> steps;
  for (int frame = 0; frame < Frames; ++frame)
  {
    steps.push_back(frame);
  }
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  const vtkSmartPointer<ShapeSource> source =
    MakeSource([](double t) { return MakePool(static_cast<int>(t)); }, steps);
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(Radius);
  filter->SetParticleThreshold(Threshold);
  filter->SetVoxelSize(Voxel);
  filter->SetModelBounds(-0.2, 1.4, -0.2, 1.4, -0.3, 0.7);
  filter->SetAttraction(rate);
  filter->SetCFL(0.1);
  std::vector<Heights> rows;
  for (int frame = 0; frame < Frames; ++frame)
  {
    filter->UpdateTimeStep(frame);
    rows.push_back(MeasureSkin(filter->GetOutput()));
  }
  return GetFlicker(rows);
}

// The heights n of the frames are independent, and linear in time between frames. The height x of
// the skin follows x' = rate (n - x), so x(k+1) = d x(k) + a n(k) + b n(k+1). The ratio is the norm
// of the second difference of the response to a single n, over sqrt(6), that of n itself.
double PredictRatio(double rate)
{
  const double d = std::exp(-rate);
  const double b = 1.0 - (1.0 - d) / rate;
  const double a = 1.0 - d - b;
  const double c = d * b + a;
  const double first = b;
  const double second = c - 2.0 * b;
  const double third = (d - 2.0) * c + b;
  const double fourth = c * (1.0 - d) * (1.0 - d); // then multiplied by d repeatedly
  return std::sqrt(
    (first * first + second * second + third * third + fourth * fourth / (1.0 - d * d)) / 6.0);
}

}

// The measured ratio has a random error of sqrt(1 / 250) = 6 %, from 28 frames and about 3 by 3
// independent bumps. Substeps add an error, because they are a tenth of the rate's time constant
// and evaluate the target at their beginning. Tolerance for both: 15 %.
TEST(TestFlicker, SkinFlickersAsItsRateTells)
{
  const double frames = GetFlickerOfFrames();
  EXPECT_LT(0.1 * Spacing, frames) << "the frames flicker";
  for (const double rate : { 0.35, 0.5, 1.0 })
  {
    const double expected = PredictRatio(rate);
    EXPECT_NEAR(GetFlickerOfSkin(rate) / frames, expected, 0.15 * expected)
      << "flicker against the frames', rate " << rate;
  }
}

// A lag of two or three frames achieves these reductions.
TEST(TestFlicker, SkinFlickersAFifthAndATenth)
{
  const double frames = GetFlickerOfFrames();
  EXPECT_LT(GetFlickerOfSkin(0.5), frames / 5.0) << "flicker at half per frame";
  EXPECT_LT(GetFlickerOfSkin(0.33), frames / 10.0) << "flicker at a third per frame";
}

}
